"""Stored stroke check: G22 forbids a part of the machine's travel, G23 frees it again."""

from __future__ import annotations

from itertools import pairwise

from polycnc.channel.moves.travel import SLACK, machine_walls
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.channel.moves.travel import Travel, Wall
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.toolpath.context import Context


@dataclass(frozen=True, slots=True)
class StrokeZone:
    """A box in machine coordinates that the tool must not enter (`inside`) or not leave: stored stroke check 2 or 3."""

    low: tuple[float, ...]
    high: tuple[float, ...]
    axes: tuple[int, ...]
    inside: bool
    number: int = 2

    def check(self, channel: WordAddressChannel, travel: Travel) -> None:
        """The control's alarm for a way into the zone, or out of it."""
        points = travel.closely() if self.inside and self.axes else travel.machine
        for start, end in pairwise(points):
            axis = self._entered(start, end) if self.inside else self._left(end)
            if axis >= 0:
                direction = 1 if end[axis] >= start[axis] else -1
                raise channel.control.forbidden_zone(channel.axes[axis], direction, self.number)

    def walls(self, channel: WordAddressChannel, context: Context) -> Iterable[Wall]:
        """Those of a box that the tool must not leave."""
        sides = () if self.inside else zip(self.axes, self.low, self.high, strict=True)
        return machine_walls(channel, context, sides)

    def comes_near(
        self, _channel: WordAddressChannel, start: list[float], end: list[float], distance: float
    ) -> bool:
        """Whether a straight way comes near a box that the tool must not enter."""
        return self.inside and self._entered(start, end, distance) >= 0

    def _left(self, end: list[float]) -> int:
        """The first axis that stands outside, or -1."""
        within = zip(self.axes, self.low, self.high, strict=True)
        outside = (axis for axis, low, high in within if not low - SLACK <= end[axis] <= high + SLACK)
        return next(outside, -1)

    def _entered(self, start: list[float], end: list[float], beside: float = 0.0) -> int:
        """The axis by which a straight way comes into the box last, or -1 where it stays outside.

        The box may count as larger, by some mm `beside` it on all sides.
        """
        first, last, blamed = 0.0, 1.0, next(iter(self.axes), -1)
        for axis, lowest, highest in zip(self.axes, self.low, self.high, strict=True):
            way, low, high = end[axis] - start[axis], lowest - beside, highest + beside
            if way == 0.0:
                if not low <= start[axis] <= high:
                    return -1
                continue
            enter, leave = sorted(((low - start[axis]) / way, (high - start[axis]) / way))
            if enter > first:
                first, blamed = enter, axis
            last = min(last, leave)
        return blamed if first <= last else -1


#: A zone that forbids nothing.
NOTHING = StrokeZone((), (), (), inside=False)


def zone_between(named: Sequence[tuple[int, float, float]], *, inside: bool) -> StrokeZone:
    """The zone between two points, given by column and both coordinates; two equal points forbid nothing."""
    axes = tuple(axis for axis, _, _ in named)
    lows, highs = tuple(min(a, b) for _, a, b in named), tuple(max(a, b) for _, a, b in named)
    if lows == highs:
        return NOTHING
    return StrokeZone(lows, highs, axes, inside)


def refuse_others(channel: WordAddressChannel, words: Words) -> None:
    """A zone has edges along X, Y and Z: another axis would not be watched."""
    geometry = channel.coordinates.geometry
    beside = next((word for word in words.plan.axis_words if word.axis not in geometry), None)
    if beside is not None:
        raise words.fail("address", beside.address)


def stroke_check_on(channel: MacroChannel, words: Words) -> None:
    """G22 X Y Z I J K: stored stroke check 2; X Y Z the upper corner, I J K the lower, machine coordinates."""
    refuse_others(channel, words)
    upper = {axis: value for axis, value, _ in words.axes()}
    named: list[tuple[int, float, float]] = []
    for letter, axis in zip("IJK", channel.coordinates.geometry, strict=True):
        low = words.length(letter)
        if (low is None) != (axis not in upper):
            raise words.fail("address", letter)
        if low is not None:
            named.append((axis, low, upper[axis]))
    if named:
        channel.boundary = zone_between(named, inside=not channel.memory.parameters.OUT)


def stroke_check_off(channel: WordAddressChannel, _words: Words) -> None:
    """G23: the zone of G22 may be entered again."""
    channel.boundary = None
