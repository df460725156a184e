"""In how many chords the tip of a tool that turns follows its way.

Where what lies beside the programmed path bends, and where the tool turns, a chord may be so far off.
"""

from __future__ import annotations

from math import dist, radians

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.moves.move_path import MovePath
    from polycnc.geometry.frames import Vector

#: Chords may be this far off the way of the tip, mm, and leave the tool this far off its direction, radians.
CHORD_ERROR_MM, DIRECTION_ERROR = 0.001, radians(0.02)
#: A block is not cut into more chords near a pole.
MOST_CHORDS = 1024


class Directions(Protocol):
    """What says how the tool stands."""

    def tool_at(self, position: Sequence[float]) -> Vector:
        """Direction along the tool at a position of the path, of length 1."""


def doubled(count: int, are_coarse: Callable[[int], bool]) -> int:
    """As many chords as `count`, or twice as many until they are fine enough."""
    while count < MOST_CHORDS and are_coarse(count):
        count *= 2
    return count


def bends(beside: Callable[[float], Vector], count: int) -> bool:
    """Whether a vector along a block leaves so many chords of it by more than they may."""
    places = [beside(0.5 * k / count) for k in range(2 * count + 1)]
    return any(
        dist(middle, [0.5 * (a + b) for a, b in zip(first, last, strict=True)]) > CHORD_ERROR_MM
        for first, middle, last in zip(places[::2], places[1::2], places[2::2], strict=False)
    )


def strays(path: MovePath, posture: Directions, count: int) -> bool:
    """Whether a tool that turns along a way leaves its direction by more than it may where its axes go evenly."""
    if path.move.turning is None:
        return False
    places = [path.at(0.5 * k / count) for k in range(2 * count + 1)]
    return any(
        dist(
            posture.tool_at(middle),
            posture.tool_at([0.5 * (a + b) for a, b in zip(first, last, strict=True)]),
        )
        > DIRECTION_ERROR
        for first, middle, last in zip(places[::2], places[1::2], places[2::2], strict=False)
    )
