"""The way of a curve that is written as chords: polynomials, involutes, arcs that a scale has bent."""

from __future__ import annotations

from bisect import bisect_left
from itertools import pairwise
from math import hypot

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.orientation.turning import Turning

    #: A share of the way, and the position there.
    Chord = tuple[float, list[float]]


class ChordPath:
    """The way along chords, point by point; a part of it is a number from 0 (start) to 1 (end).

    Args:
        start: Position where it begins.
        chords: Part and position at the end of each chord, the last one the end.
        toward: Unit vector of travel of the curve itself after a part, on the geometry axes.
        geometry: Columns of X, Y, Z among the axes, -1 for none.
    """

    def __init__(
        self,
        start: list[float],
        chords: Sequence[Chord],
        toward: Callable[[float], Vector],
        geometry: tuple[int, int, int],
    ) -> None:
        self._points: list[Chord] = [(0.0, start), *chords]
        self._parts = [part for part, _ in self._points]
        self._toward = toward
        self._geometry = geometry

    def at(self, part: float) -> list[float]:
        """The position of all axes after a part of the way."""
        after = bisect_left(self._parts, part)
        if not after or part >= 1.0:
            return self._points[-1 if after else 0][1].copy()
        (first, a), (last, b) = self._points[after - 1], self._points[after]
        share = (part - first) / (last - first)
        return [x + (y - x) * share for x, y in zip(a, b, strict=True)]

    def direction(self, part: float) -> Vector:
        """Unit vector of travel on the geometry axes."""
        return self._toward(part)

    @property
    def length(self) -> float:
        """Length on the geometry axes, mm."""
        columns = [column for column in self._geometry if column >= 0]
        ways = (hypot(*(b[i] - a[i] for i in columns)) for (_, a), (_, b) in pairwise(self._points))
        return sum(ways)

    def led(self, channel: Channel) -> Iterable[list[float]]:
        """The ends of the chords, with rotary axes as the block that runs turns them."""
        turning, channel.turning = channel.turning, None
        return [point for _, point in self._points[1:]] if turning is None else self.turned(turning)

    def turned(self, turning: Turning) -> Iterator[list[float]]:
        """The ends of the chords with rotary axes that turn along them; their knots end chords as well."""
        start = [self._points[0][1][column] for column in turning.columns]
        paced = turning.smoothed(start).paced(start, self.length)
        for part in sorted({*self._parts[1:], *paced.shares}):
            position = self.at(part)
            for column, place in zip(paced.columns, paced.at(start, part), strict=True):
                position[column] = place
            yield position
