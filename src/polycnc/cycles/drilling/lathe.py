"""What lathes add to the drilling cycles: clamping, faster taps, overlap of strokes, waits for the spindle."""

from __future__ import annotations

from enum import IntEnum
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING

from polycnc.cycles.drilling.holes import Action, Hole, Stroke, peck_by_peck, taps

if TYPE_CHECKING:
    from collections.abc import Container, Iterator

#: Strokes that move an axis.
_MOVES = (Action.RAPID, Action.FEED)


class Joint(IntEnum):
    """Where two strokes of a drilling cycle meet: the bits of 1681 that keep them apart (II.4.4)."""

    HOLE = 0
    R_LEVEL = 1
    RETRACT = 2
    REENTRY = 3
    PECK = 4
    BOTTOM = 5


def overlapping(strokes: Iterator[Stroke], hole: Hole, apart: Container[Joint]) -> Iterator[Stroke]:
    """Say of each stroke whether the next one may begin before the axes rest at its end.

    A stroke that a dwell or an output follows may not; the last one meets the way to the next hole.
    """
    made = [stroke for stroke in strokes if stroke.action is not Action.DWELL or stroke.value]
    deepest, level = hole.r, hole.initial
    for stroke, following in pairwise((*made, None)):
        if stroke is None or stroke.action not in _MOVES:
            yield from () if stroke is None else (stroke,)
            continue
        joints = _joints(hole, stroke, level, deepest)
        bores = Joint.BOTTOM in joints and following is not None and following.action is Action.FEED
        goes_on = following is None or (following.action in _MOVES and not bores)
        stays_apart = not goes_on or any(joint in apart for joint in joints)
        yield stroke._replace(overlaps=0.0 if stays_apart else inf)
        level = stroke.value
        if abs(level - hole.r) > abs(deepest - hole.r):
            deepest = level


def _joints(hole: Hole, stroke: Stroke, level: float, deepest: float) -> set[Joint]:
    """What the end of a stroke is, from the level where it begins and the depth that the hole has."""
    inwards = abs(stroke.value - hole.bottom) < abs(level - hole.bottom)
    drilled = deepest == hole.bottom
    if stroke.action is Action.FEED and inwards:
        return {Joint.BOTTOM if stroke.value == hole.bottom else Joint.PECK}
    if not drilled and deepest != hole.r:
        return {Joint.REENTRY if inwards else Joint.RETRACT}
    ends = {Joint.HOLE} if drilled and stroke.value == hole.back else set[Joint]()
    at_r = stroke.value == hole.r and (stroke.action is Action.FEED or not ends)
    return ends | ({Joint.R_LEVEL} if at_r else set[Joint]())


def leading_on(strokes: Iterator[Stroke], hole: Hole) -> Iterator[Stroke]:
    """The way to the next hole may begin before the axes rest on the initial level (11507#7, II.4.3.6)."""
    for stroke, following in pairwise((*strokes, None)):
        if stroke is not None:
            ends = following is None and stroke.action is Action.RAPID and stroke.value == hole.initial
            yield stroke._replace(overlaps=inf) if ends else stroke


def when_arrived(strokes: Iterator[Stroke], seconds: float) -> Iterator[Stroke]:
    """The first stroke that works waits for the spindle's speed (3740, II.4.3.6)."""
    waits = True
    for stroke in strokes:
        if waits and stroke.action in (Action.FEED, Action.TAP):
            yield Stroke(Action.ARRIVAL, seconds)
            waits = False
        yield stroke


def clamped(strokes: Iterator[Stroke], clamp: int, unclamp: int, dwell_s: float) -> Iterator[Stroke]:
    """The axis is clamped once the tool is over the hole and unclamped when it is back at R (II.4.3.4)."""
    yield Stroke(Action.OUTPUT, clamp)
    held: Stroke | None = None
    for stroke in strokes:
        if held is not None:
            yield held
        held = stroke
    yield Stroke(Action.OUTPUT, unclamp)
    yield Stroke(Action.DWELL, dwell_s)
    if held is not None:
        yield held


def with_extraction(strokes: Iterator[Stroke], hole: Hole, factor: float) -> Iterator[Stroke]:
    """Taps that cut nothing, out of the hole and back to the depth reached, run `factor` times as fast."""
    deepest = 0.0
    for stroke in strokes:
        if stroke.action is not Action.TAP:
            yield stroke
            continue
        depth = abs(stroke.value - hole.r)
        yield stroke if depth > deepest else stroke._replace(factor=stroke.factor * factor)
        deepest = max(deepest, depth)


@taps
def tap_clearing_chips(hole: Hole) -> Iterator[Stroke]:
    """As `tap`; after each peck out to R and back to `relief` above the depth reached (5200#5)."""
    yield from peck_by_peck(hole, Action.TAP, Action.TAP, clears=True)
    yield from _tap_out(hole)


@taps
def tap(hole: Hole) -> Iterator[Stroke]:
    """In with the spindle in step, dwell, reverse, out; pecks retract by `relief` (II.4.5)."""
    yield from peck_by_peck(hole, Action.TAP, Action.TAP, clears=False)
    yield from _tap_out(hole)


def _tap_out(hole: Hole) -> Iterator[Stroke]:
    """The dwell at the bottom, and out with the spindle reversed."""
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield Stroke(Action.SPINDLE, -1.0)
    yield Stroke(Action.TAP, hole.r)
    yield Stroke(Action.SPINDLE, 1.0)
    yield Stroke(Action.RAPID, hole.back)
