"""Cuts under a transformation that are led beside their ends: which ones may be, and what keeps their axes in bounds.

The path is displaced as the transformation's points are; what that moves the axes behind it by depends on the place.
So a cut stays as it is programmed where an axis could come to a limit, or into something forbidden, and where it passes
near a pole: there a rotary axis turns by much for a small way.
"""

from __future__ import annotations

from math import ceil, dist, hypot, inf

from polycnc.channel.moves.travel import CHORD_ERROR_MM, Travel
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import is_even
from polycnc.messages import AlarmError
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.orientation.linked import linkage_of
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move
    from polycnc.geometry.frames import Frame
    from polycnc.transformation.contract import Transformation
    from polycnc.transformation.pole import Pole

#: A way that comes nearer to a pole than so many times what ends are moved by stays: a degree of the rotary axis there.
CLEAR = 60.0
#: A way is looked at wherever its rotary axes have turned by so much, degrees; one that asks for more looks stays.
LOOK_DEG, LEAST_LOOKS, MOST_LOOKS = 0.5, 2, 32
#: So much may a frame change lengths by where none are changed.
UNCHANGED = 1e-9


def is_led_evenly(made: Transformation) -> bool:
    """Whether lengths on the path are those on the work, and the axes follow the path alone."""
    if isinstance(made, Seated):
        (a, _, _), (b, _, _), (c, _, _) = made.frame.m
        if made.is_coupled or not is_even(made.frame) or abs(hypot(a, b, c) - 1.0) > UNCHANGED:
            return False
    inner = made.inner if isinstance(made, Seated) else made
    if isinstance(inner, (Cylinder, InclinedAxis, PolarPlane)):
        return inner.pole is None or made.pole is not None
    return len(linkage_of(made)) > 0


class Around(Travel):
    """Where a straight move may lead that is led beside its ends: around places along it, as far as these are moved.

    Args:
        channel: The channel that moves.
        move: The move.
        by: How far the ends of rows may be moved, a number for each column.
        looks: How many places along the move are looked at behind its start.
    """

    def __init__(self, channel: Channel, move: Move, by: Sequence[float], looks: int) -> None:
        super().__init__(channel, move)
        self._places = [self._between(k / looks) for k in range(looks + 1)]
        moved = [column for column, way in enumerate(by) if way > 0.0]
        # What several columns add up to is no more than so many times what one of them makes.
        self._steps = [(column, side * by[column] * len(moved)) for column in moved for side in (-1.0, 1.0)]

    @property
    def machine(self) -> list[list[float]]:
        """Machine positions around the way."""
        if not self._machine:
            self._machine = [self.to_machine(place) for place in self.positions()]
        return self._machine

    def positions(self) -> list[list[float]]:
        """The same in the absolute display."""
        found = list[list[float]]()
        for place in self._places:
            found.append(place)
            for column, step in self._steps:
                moved = place.copy()
                moved[column] += step
                found.append(moved)
        return found

    def turns(self, frame: Frame) -> list[list[float]]:  # noqa: ARG002 - a line turns back nowhere
        """The same again."""
        return self.positions()

    def chords(self) -> list[tuple[list[float], list[float], float]]:
        """Straight ways of machine positions along the move, and how far beside them it may lead."""
        width, machine = 1 + len(self._steps), self.machine
        places = [machine[k : k + width] for k in range(0, len(machine), width)]
        beside = [max(dist(points[0], point) for point in points) for points in places]
        return [
            (a[0], b[0], CHORD_ERROR_MM + max(one, two))
            for a, b, one, two in zip(places, places[1:], beside, beside[1:], strict=False)
        ]

    def _between(self, share: float) -> list[float]:
        start, end = self.move.start, self.move.end
        return [a + (b - a) * share for a, b in zip(start, end, strict=True)]


def around(channel: Channel, move: Move, made: Transformation, by: Sequence[float]) -> Around | None:
    """Where a straight move under a transformation may lead; None where it is not known well enough.

    `by` is how far ends of rows may be moved, a number for each column.
    """
    pole, looks = made.pole, LEAST_LOOKS
    if pole is not None:
        looks = MOST_LOOKS
        if _passes(pole, move, max(by)):
            return None
    ways = zip(channel.axis_data, move.start, move.end, strict=True)
    turned = sum(abs(end - start) for axis, start, end in ways if axis.rotary)
    looks = max(ceil(turned / LOOK_DEG), looks)
    return Around(channel, move, by, looks) if looks <= MOST_LOOKS else None


def _passes(pole: Pole, move: Move, by: float) -> bool:
    """Whether a straight move comes so near to a pole that a rotary axis turns by much for what it is moved by."""
    (a, b), (c, d) = pole.away(move.start), pole.away(move.end)
    square = (c - a) ** 2 + (d - b) ** 2
    share = min(max((a * (a - c) + b * (b - d)) / square, 0.0), 1.0) if square > 0.0 else 0.0
    return hypot(a + share * (c - a), b + share * (d - b)) < CLEAR * by


def is_within(channel: Channel, around: Around) -> bool:
    """Whether nothing around a move is beyond a limit of travel, of the setup or of the program."""
    limits = channel.limits or ((-inf, inf),) * len(channel.axes)
    for machine in around.machine:
        if not all(low <= at <= high for at, (low, high) in zip(machine, limits, strict=True)):
            return False
    try:
        if channel.boundary is not None:
            channel.boundary.check(channel, around)
    except AlarmError:
        return False
    return True
