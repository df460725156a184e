"""Deep holes in strokes that become shorter: the division of the depth, and the strokes of the tool.

Source: SINUMERIK cycles, deep hole drilling (CYCLE83, CYCLE830) and tapping in steps (CYCLE84).
"""

from __future__ import annotations

from polycnc.cycles.count import checked
from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from polycnc.cycles.drilling.holes import Hole

#: Depths closer than this are the same, mm.
SAME_MM = 1e-6
#: A stroke never becomes shorter than this, mm: a factor alone would never come to the bottom.
SHORTEST_MM = 0.1
#: Distance in front of the last depth up to which the tool returns at rapid: up to this depth the first value, mm.
SHALLOW_MM, SHALLOW_LIMIT_MM, DEEP_PART, LONGEST_LIMIT_MM = 30.0, 0.6, 50.0, 7.0


def degressive_depths(first: float, total: float, by: float, shortest: float = 0.0) -> list[float]:
    """Depths of the strokes below the reference plane, the last one exactly the whole depth; all in mm.

    Args:
        first: Depth of the first stroke.
        total: Depth of the hole.
        by: Above 0, each stroke is shorter by this amount and never shorter than it; below 0, each is the former
            one times its size; 0 for equal strokes. The last two strokes share what is left, so that none is a
            sliver.
        shortest: Least stroke under a factor.

    Raises:
        AlarmError: PC0002, there are more strokes than a program can mean.
    """
    depths = [total if first >= total - SAME_MM else first]
    nominal = first
    while total - depths[-1] > SAME_MM:
        rest = total - depths[-1]
        if by > 0.0:
            nominal = max(nominal - by, by)
            step = _by_amount(rest, nominal, by)
        else:
            least = max(shortest, SHORTEST_MM) if by < 0.0 else first
            nominal = max(nominal * abs(by), least) if by < 0.0 else first
            step = _by_factor(rest, nominal, least)
        depths.append(total if rest - step <= SAME_MM else depths[-1] + step)
        checked(len(depths))
    return depths


def _by_amount(rest: float, nominal: float, amount: float) -> float:
    """The next stroke where strokes shrink by an amount."""
    if rest <= nominal + SAME_MM:
        return rest
    if rest > 2.0 * amount + SAME_MM:
        return min(nominal, rest - amount)
    return rest / 2.0


def _by_factor(rest: float, nominal: float, least: float) -> float:
    """The next stroke where strokes shrink by a factor, or stay equal."""
    if rest <= nominal + SAME_MM:
        return rest
    return nominal if rest - nominal >= least - SAME_MM else rest / 2.0


def automatic_limit(depth: float) -> float:
    """How far in front of a depth (mm below the reference plane) the tool stops its rapid return, mm."""
    if depth <= SHALLOW_MM:
        return SHALLOW_LIMIT_MM
    return min(depth / DEEP_PART, LONGEST_LIMIT_MM)


class Stage(NamedTuple):
    """A part of a hole that is drilled at a feed of its own: its length, mm, and the factor on the feed."""

    way: float
    factor: float


def drill_in_stages(
    hole: Hole, reference: float, before: Stage | None, last: Stage | None
) -> Iterator[Stroke]:
    """Drilling with a first part (predrilling) or a last one (where the drill comes through) at another feed."""
    up = 1.0 if hole.r > hole.bottom else -1.0
    yield Stroke(Action.RAPID, hole.r)
    if before is not None:
        yield Stroke(Action.FEED, reference - up * before.way, before.factor)
    if last is not None:
        yield Stroke(Action.FEED, hole.bottom + up * last.way)
    yield Stroke(Action.FEED, hole.bottom, 1.0 if last is None else last.factor)
    yield Stroke(Action.DWELL, hole.dwell_s)
    yield Stroke(Action.RAPID, hole.back)


def peck(
    levels: Sequence[float],
    clearance: float,
    back: float,
    *,
    first_factor: float = 1.0,
    dwell: float = 0.0,
    dwell_at_bottom: float = 0.0,
    retract: float | None = None,
    breaks: int = 0,
    dwell_at_clearance: float = 0.0,
    limits: Sequence[float] = (),
) -> Iterator[Stroke]:
    """Deep hole drilling.

    Args:
        levels: Levels of the strokes, the last one the bottom, mm.
        clearance: Level of the safety distance.
        back: Level at which the cycle ends.
        first_factor: Factor on the feed of the first stroke.
        dwell: At every depth but the last; seconds, or revolutions below 0.
        dwell_at_bottom: At the last depth.
        retract: Way back between strokes for breaking chips; None to clear chips at `clearance`.
        breaks: After so many strokes that broke chips, one clears them; 0 for none.
        dwell_at_clearance: There.
        limits: For each level the distance in front of it at which the rapid return ends.
    """
    up = 1.0 if clearance > levels[-1] else -1.0
    yield Stroke(Action.RAPID, clearance)
    for number, level in enumerate(levels):
        yield Stroke(Action.FEED, level, first_factor if number == 0 else 1.0)
        if number == len(levels) - 1:
            yield Stroke(Action.DWELL, dwell_at_bottom)
            break
        yield Stroke(Action.DWELL, dwell)
        if retract is not None and (not breaks or (number + 1) % (breaks + 1)):
            yield Stroke(Action.FEED, level + up * retract)
            continue
        yield Stroke(Action.RAPID, clearance)
        yield Stroke(Action.DWELL, dwell_at_clearance)
        yield Stroke(Action.RAPID, level + up * limits[number])
    yield Stroke(Action.RAPID, back)


class Zone(NamedTuple):
    """The part of a hole down to a level, and the factor on the feed there."""

    level: float
    factor: float


#: A feed that rises evenly is cut into so many parts.
SLICES = 8


def rising(start: float, way: float, factor: float) -> list[Zone]:
    """Parts of a hole over which the feed rises from a factor to the whole one.

    Args:
        start: Level at which they begin.
        way: With its sign, to where the feed is the whole one.
        factor: At the start.
    """
    return [
        Zone(start + way * (k + 1) / SLICES, factor + (1.0 - factor) * (k + 0.5) / SLICES)
        for k in range(SLICES)
    ]


def in_zones(strokes: Iterable[Stroke], start: float, zones: Sequence[Zone], down: float) -> Iterator[Stroke]:
    """The strokes with those at feed into the hole divided where it has another feed.

    Args:
        strokes: Levels as they stand.
        start: Level of the tool in front of them.
        zones: In their order from the top; below the last one the feed is the whole one.
        down: Direction of drilling, 1 or -1.
    """
    at = start
    for stroke in strokes:
        action, end, factor, _ = stroke
        if action is Action.FEED and (end - at) * down > 0.0:
            for zone in zones:
                if (zone.level - at) * down <= SAME_MM:
                    continue
                reached = zone.level if (end - zone.level) * down > SAME_MM else end
                yield stroke._replace(value=reached, factor=factor * zone.factor)
                at = reached
                if reached == end:
                    break
            if at != end:
                yield stroke
        else:
            yield stroke
        if action in (Action.FEED, Action.RAPID):
            at = end


def tap_in_steps(
    levels: Sequence[float],
    clearance: float,
    back: float,
    *,
    dwell: float = 0.0,
    retract: float | None = None,
    limit: float = 0.0,
) -> Iterator[Stroke]:
    """Rigid tapping; `SPINDLE` 1 turns into the hole, -1 out of it, and 0 ends the synchronism.

    Args:
        levels: Levels of the steps, the last one the bottom, mm.
        clearance: Level of the safety distance.
        back: Level at which the cycle ends.
        dwell: At every depth, seconds.
        retract: Way back between steps for breaking chips; None to clear chips at `clearance`.
        limit: Distance in front of the last depth at which a return from `clearance` ends.
    """
    up = 1.0 if clearance > levels[-1] else -1.0
    yield Stroke(Action.RAPID, clearance)
    yield Stroke(Action.SPINDLE, 1.0)
    for level in levels:
        yield Stroke(Action.TAP, level)
        yield Stroke(Action.DWELL, dwell)
        yield Stroke(Action.SPINDLE, -1.0)
        if level == levels[-1]:
            break
        yield Stroke(Action.TAP, clearance if retract is None else level + up * retract)
        yield Stroke(Action.SPINDLE, 1.0)
        if retract is None:
            yield Stroke(Action.DWELL, dwell)
            yield Stroke(Action.TAP, level + up * limit)
    yield Stroke(Action.TAP, clearance)
    yield Stroke(Action.SPINDLE, 0.0)
    yield Stroke(Action.RAPID, back)
