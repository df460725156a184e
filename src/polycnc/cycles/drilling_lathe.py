"""What lathes add to the drilling cycles: clamping of the spindle axis, taps that come out faster."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.cycles.drilling import Action, Hole, Stroke, above, depths

if TYPE_CHECKING:
    from collections.abc import Iterator


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
    """Taps away from the bottom run `factor` times as fast."""
    level = hole.r
    for stroke in strokes:
        if stroke.action is Action.TAP:
            outwards = abs(stroke.value - hole.bottom) > abs(level - hole.bottom)
            level = stroke.value
            yield stroke._replace(factor=stroke.factor * factor) if outwards else stroke
        else:
            yield stroke


def tap_clearing_chips(hole: Hole) -> Iterator[Stroke]:
    """As `tap`; after each peck out to R and back to `relief` above the depth reached (5200#5)."""
    yield Stroke(Action.RAPID, hole.r)
    for depth in depths(hole):
        yield Stroke(Action.TAP, depth)
        if depth != hole.bottom:
            yield Stroke(Action.TAP, hole.r)
            yield Stroke(Action.TAP, above(hole, depth))
    yield from _tap_out(hole)


def tap(hole: Hole) -> Iterator[Stroke]:
    """In with the spindle in step, dwell, reverse, out; pecks retract by `relief` (II.4.5)."""
    yield Stroke(Action.RAPID, hole.r)
    for depth in depths(hole):
        yield Stroke(Action.TAP, depth)
        if depth != hole.bottom:
            yield Stroke(Action.TAP, above(hole, depth))
    yield from _tap_out(hole)


def _tap_out(hole: Hole) -> Iterator[Stroke]:
    """The dwell at the bottom, and out with the spindle reversed."""
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield Stroke(Action.SPINDLE, -1.0)
    yield Stroke(Action.TAP, hole.r)
    yield Stroke(Action.SPINDLE, 1.0)
    yield Stroke(Action.RAPID, hole.back)
