"""Stored stroke check: G22 forbids a part of the machine's travel, G23 frees it again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel


@dataclass(frozen=True, slots=True)
class StrokeZone:
    """A box in machine coordinates that the tool must not enter (`inside`) or not leave: stored stroke check 2 or 3."""

    low: tuple[float, ...]
    high: tuple[float, ...]
    axes: tuple[int, ...]
    inside: bool
    number: int = 2

    def check(self, channel: WordAddressChannel, machine: list[float], *, straight: bool) -> None:
        """The control's alarm for a way into the zone, or out of it; of a curve the end and points on it."""
        start = channel.coordinates.machine if straight else machine
        axis = self._entered(start, machine) if self.inside else self._left(machine)
        if axis >= 0:
            direction = 1 if machine[axis] >= channel.coordinates.machine[axis] else -1
            raise channel.control.forbidden_zone(channel.axes[axis], direction, self.number)

    def check_point(self, channel: WordAddressChannel, machine: list[float]) -> None:
        """The control's alarm for a point of a curve."""
        self.check(channel, machine, straight=False)

    def _left(self, end: list[float]) -> int:
        """The first axis that stands outside, or -1."""
        within = zip(self.axes, self.low, self.high, strict=True)
        return next((axis for axis, low, high in within if not low <= end[axis] <= high), -1)

    def _entered(self, start: list[float], end: list[float]) -> int:
        """The axis by which a straight way comes into the box last, or -1 where it stays outside."""
        first, last, blamed = 0.0, 1.0, self.axes[0]
        for axis, low, high in zip(self.axes, self.low, self.high, strict=True):
            way = end[axis] - start[axis]
            if way == 0.0:
                if not low <= start[axis] <= high:
                    return -1
                continue
            enter, leave = sorted(((low - start[axis]) / way, (high - start[axis]) / way))
            if enter > first:
                first, blamed = enter, axis
            last = min(last, leave)
        return blamed if first <= last else -1


def stroke_check_on(channel: WordAddressChannel, words: Words) -> None:
    """G22 X Y Z I J K: stored stroke check 2; X Y Z the upper corner, I J K the lower, machine coordinates."""
    upper = {axis: value for axis, value, _ in words.axes()}
    named: list[tuple[int, float, float]] = []
    for letter, axis in zip("IJK", channel.coordinates.geometry, strict=True):
        low = words.length(letter)
        if (low is None) != (axis not in upper):
            raise words.fail("address", letter)
        if low is not None:
            named.append((axis, min(low, upper[axis]), max(low, upper[axis])))
    if named:
        axes, lows, highs = zip(*named, strict=True)
        inside = not channel.memory.parameters.bit(1300, 0)
        channel.stroke_zone = StrokeZone(tuple(lows), tuple(highs), tuple(axes), inside)


def stroke_check_off(channel: WordAddressChannel, _words: Words) -> None:
    """G23: the zone of G22 may be entered again."""
    channel.stroke_zone = None
