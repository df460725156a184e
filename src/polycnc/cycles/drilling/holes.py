"""Drilling, tapping and boring of one hole: each cycle is a generator of strokes.

A hole is four levels along the drilling axis and a few amounts; a cycle says in which order the tool visits
the levels. Positioning over the hole, units, word lifetimes and the choice of a cycle by its code are the
control's (`control.word_address.drilling`); here is only what the tool does, the same for every control:

    initial ─┐                         ┌─ back (initial level or R, as G98 or G99 say)
             │ rapid                   │
    r ───────┤                         │ rapid, feed or tap
             │ feed, pecks             │
    bottom ──┴── dwell, spindle, shift ┘
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import Enum

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.geometry.tolerances import NO_WAY


@dataclass(frozen=True, slots=True)
class Hole:
    """One hole; levels are coordinates on the drilling axis, mm.

    Attributes:
        initial: Level from which the cycle began.
        r: Level to which the tool comes at rapid.
        bottom: Level of the bottom; above `r` in back boring.
        back: Level at which the cycle ends: `initial` or `r`.
        dwell_s: Time at the bottom.
        dwell_out_s: Time at `r` after the tap has come out.
        peck: Depth of a peck, 0 for the whole depth at once.
        relief: Retract between pecks, or clearance above the depth reached; 0: a pecking tap goes to `r`.
        by_r: A retract at rapid stops at `r` on its way to `back`.
    """

    initial: float
    r: float
    bottom: float
    back: float
    dwell_s: float = 0.0
    dwell_out_s: float = 0.0
    peck: float = 0.0
    relief: float = 0.0
    by_r: bool = False


class Action(Enum):
    """What a stroke is; its value is a level, seconds, or as stated."""

    RAPID = "to a level at rapid"
    FEED = "to a level at feed"
    TAP = "to a level, feed and spindle in step"
    DWELL = "stand still, seconds"
    SHIFT = "off the hole's axis by this part of the shift: 1 out, 0 back"
    SPINDLE = "direction against that before the cycle: 1 the same, -1 reversed, 0 stopped"
    ORIENT = "stop the spindle at its angle"
    HALT = "wait for the operator"
    OUTPUT = "send this M code to the machine"
    ARRIVAL = "wait for the spindle's speed, seconds"
    RETURN = "to a level at rapid, and back over the hole on the way"


class Stroke(NamedTuple):
    """One step of a cycle.

    Attributes:
        action: What it is.
        value: A level, seconds, or as the action states.
        factor: Multiplies the feed.
        overlaps: How far before its end the next stroke may begin, mm: 0 when the axes rest, infinite as soon as they
            come to rest; None in a cycle without overlap.
    """

    action: Action
    value: float = 0.0
    factor: float = 1.0
    overlaps: float | None = None


Cycle = Callable[[Hole], Iterator[Stroke]]
#: Cycles that tap: overrides do not act in their strokes.
TAPS: set[Cycle] = set()


def taps(cycle: Cycle) -> Cycle:
    """A cycle that taps; who looks for one among `TAPS` has loaded its module."""
    TAPS.add(cycle)
    return cycle


def depths(hole: Hole) -> Iterator[float]:
    """Levels of the pecks from `r` down, the last one exactly the bottom; one without pecking."""
    total = abs(hole.bottom - hole.r)
    sign = 1.0 if hole.bottom > hole.r else -1.0
    peck = abs(hole.peck)
    k = 1
    while peck > 0.0 and k * peck < total - NO_WAY:
        yield hole.r + sign * k * peck
        k += 1
    yield hole.bottom


def above(hole: Hole, depth: float) -> float:
    """The level `relief` short of a depth, not beyond `r`."""
    way = min(abs(hole.relief), abs(depth - hole.r))
    return depth - way if depth > hole.r else depth + way


def leave(hole: Hole) -> Iterator[Stroke]:
    """Out of the hole at rapid."""
    if hole.by_r:
        yield Stroke(Action.RAPID, hole.r)
    yield Stroke(Action.RAPID, hole.back)


def feed_in(hole: Hole) -> Iterator[Stroke]:
    """At feed to the bottom in one go, and the dwell there."""
    yield Stroke(Action.RAPID, hole.r)
    yield Stroke(Action.FEED, hole.bottom)
    yield Stroke(Action.DWELL, hole.dwell_s)


def drill(hole: Hole) -> Iterator[Stroke]:
    """Feed in, dwell, rapid out (G81, G82)."""
    yield from feed_in(hole)
    yield from leave(hole)


def peck_by_peck(hole: Hole, into: Action, back: Action, *, clears: bool) -> Iterator[Stroke]:
    """From depth to depth to the bottom, between pecks back by the relief; `clears`: out to R before that."""
    yield Stroke(Action.RAPID, hole.r)
    for depth in depths(hole):
        yield Stroke(into, depth)
        if depth != hole.bottom:
            if clears:
                yield Stroke(back, hole.r)
            yield Stroke(back, above(hole, depth))


def peck_breaking_chips(hole: Hole) -> Iterator[Stroke]:
    """Peck by peck, with a short retract between (G73)."""
    yield from peck_by_peck(hole, Action.FEED, Action.RAPID, clears=False)
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield from leave(hole)


def peck_clearing_chips(hole: Hole) -> Iterator[Stroke]:
    """Peck by peck, out to R after each, and back to the clearance above the depth reached (G83)."""
    yield from peck_by_peck(hole, Action.FEED, Action.RAPID, clears=True)
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield from leave(hole)


@taps
def tap(hole: Hole) -> Iterator[Stroke]:
    """In with the spindle in step, reverse, out (G84; G74 with a left-hand tap); peck by peck where asked."""
    yield Stroke(Action.RAPID, hole.r)
    for depth in depths(hole):
        yield Stroke(Action.TAP, depth)
        yield Stroke(Action.DWELL, hole.dwell_s)
        yield Stroke(Action.SPINDLE, -1.0)
        if depth != hole.bottom:
            yield Stroke(Action.TAP, above(hole, depth) if hole.relief else hole.r)
            yield Stroke(Action.DWELL, hole.dwell_out_s)
            yield Stroke(Action.SPINDLE, 1.0)
    yield Stroke(Action.TAP, hole.r)
    yield Stroke(Action.DWELL, hole.dwell_out_s)
    yield Stroke(Action.SPINDLE, 1.0)
    yield Stroke(Action.RAPID, hole.back)


def bore(hole: Hole, out: float = 1.0) -> Iterator[Stroke]:
    """Feed in, dwell, feed out to R at `out` times the feed (G85, G89)."""
    yield from feed_in(hole)
    yield Stroke(Action.FEED, hole.r, out)
    yield Stroke(Action.RAPID, hole.back)


def bore_and_stop(hole: Hole) -> Iterator[Stroke]:
    """Feed in, spindle stop, rapid out, spindle on (G86)."""
    yield from feed_in(hole)
    yield Stroke(Action.SPINDLE, 0.0)
    yield from leave(hole)
    yield Stroke(Action.SPINDLE, 1.0)


def bore_and_shift(hole: Hole) -> Iterator[Stroke]:
    """Fine boring: feed in, oriented stop, off the wall, rapid out, back over the hole (G76)."""
    yield from feed_in(hole)
    yield Stroke(Action.ORIENT)
    yield Stroke(Action.SHIFT, 1.0)
    yield from leave(hole)
    yield Stroke(Action.SHIFT, 0.0)
    yield Stroke(Action.SPINDLE, 1.0)


def bore_back(hole: Hole) -> Iterator[Stroke]:
    """Back boring: shifted through the hole to R below it, feed up to the bottom level, shifted out (G87)."""
    yield Stroke(Action.ORIENT)
    yield Stroke(Action.SHIFT, 1.0)
    yield Stroke(Action.RAPID, hole.r)
    yield Stroke(Action.SHIFT, 0.0)
    yield Stroke(Action.SPINDLE, 1.0)
    yield Stroke(Action.FEED, hole.bottom)
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield Stroke(Action.ORIENT)
    yield Stroke(Action.SHIFT, 1.0)
    yield Stroke(Action.RAPID, hole.initial)
    yield Stroke(Action.SHIFT, 0.0)
    yield Stroke(Action.SPINDLE, 1.0)


def bore_and_halt(hole: Hole, *, feeds_out: bool = False) -> Iterator[Stroke]:
    """Feed in, dwell, spindle stop, wait for the operator, out (G88); `feeds_out`: to R at feed."""
    yield from feed_in(hole)
    yield Stroke(Action.SPINDLE, 0.0)
    yield Stroke(Action.HALT)
    if feeds_out:
        yield Stroke(Action.FEED, hole.r)
    yield from leave(hole)
    yield Stroke(Action.SPINDLE, 1.0)


def bore_and_lift(hole: Hole) -> Iterator[Stroke]:
    """Feed in, dwell, oriented stop, off the wall, rapid to R, then back over the hole on the way up (SINUMERIK)."""
    yield from feed_in(hole)
    yield Stroke(Action.SPINDLE, 0.0)
    yield Stroke(Action.SHIFT, 1.0)
    yield Stroke(Action.RAPID, hole.r)
    yield Stroke(Action.RETURN, hole.back)
    yield Stroke(Action.SPINDLE, 1.0)


def bore_and_leave_standing(hole: Hole) -> Iterator[Stroke]:
    """Feed in, dwell, spindle stop, wait for the operator, rapid out with the spindle at rest (SINUMERIK)."""
    yield from feed_in(hole)
    yield Stroke(Action.SPINDLE, 0.0)
    yield Stroke(Action.HALT)
    yield Stroke(Action.RAPID, hole.back)
