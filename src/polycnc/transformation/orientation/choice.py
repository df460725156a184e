"""Which of several positions of rotary axes: those on the turn that is nearest, within reach, in a direction.

Positions are degrees by axis name; several solutions are lists of them.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.angles import TURN_DEG, nearest_turn

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    Angles = Mapping[str, float]

HALF_TURN = 0.5 * TURN_DEG
#: What an angle may lie outside of a range.
AT_LIMIT = 1e-9
#: Digits behind the point of angles: what is finer is noise of the arcs that they come from.
DIGITS = 10


def on_nearest_turn(angle: float, near: float) -> float:
    """The same direction, on the turn nearest to where the axis is."""
    return round(nearest_turn(angle, near), DIGITS) + 0.0


def signed(angle: float) -> float:
    """The same direction, from -180 to below 180 degrees."""
    return (angle + HALF_TURN) % TURN_DEG - HALF_TURN


def way(solution: Angles, near: Angles) -> float:
    """How far the axes turn together; an axis that is not told stands at zero."""
    return sum(abs(angle - near.get(axis, 0.0)) for axis, angle in solution.items())


def nearest(solutions: Iterable[dict[str, float]], near: Angles) -> dict[str, float] | None:
    """The solution with the shortest way, of equal ones the first; None where there is none."""
    return min(solutions, key=lambda solution: way(solution, near), default=None)


def by_way_of(solutions: Iterable[dict[str, float]], near: Angles, first: str) -> list[dict[str, float]]:
    """Solutions in order of the way of one axis, those with the same way in order of the whole."""
    return sorted(solutions, key=lambda s: (round(abs(s[first] - near[first]), 6), way(s, near)))


def led(solution: dict[str, float], near: Angles, axis: str, sense: int) -> dict[str, float]:
    """The solution with one axis on the turn that it reaches in a direction: 1 or -1; 0 leaves it."""
    ahead = solution[axis] - near[axis]
    if sense == 0 or ahead * sense >= 0.0:
        return solution
    return {**solution, axis: near[axis] + (ahead + sense * TURN_DEG)}


def is_within(angle: float, low: float, high: float) -> bool:
    """Whether an axis reaches an angle."""
    return low - AT_LIMIT <= angle <= high + AT_LIMIT


def on_turns_within(
    solution: dict[str, float], near: Angles, ranges: Mapping[str, tuple[float, float]]
) -> dict[str, float] | None:
    """The solution on turns within the ranges of its axes, each the one nearest to `near`; None for none of three."""
    placed = dict(solution)
    for axis, (low, high) in ranges.items():
        if axis not in solution:
            continue
        turns = [solution[axis] + turn for turn in (0.0, TURN_DEG, -TURN_DEG)]
        reached = [angle for angle in turns if is_within(angle, low, high)]
        if not reached:
            return None
        placed[axis] = min(reached, key=lambda angle: abs(angle - near.get(axis, 0.0)))
    return placed


def all_within(solution: Angles, ranges: Mapping[str, tuple[float, float]]) -> bool:
    """Whether all axes of a solution lie within their ranges."""
    return all(is_within(solution[axis], *span) for axis, span in ranges.items() if axis in solution)


def on_reachable_turn(angle: float, low: float, high: float) -> float | None:
    """The same direction on a turn within reach, the one nearest to zero; None for none of three."""
    turns = sorted((angle + turn for turn in (0.0, TURN_DEG, -TURN_DEG)), key=abs)
    return next((turned for turned in turns if is_within(turned, low, high)), None)
