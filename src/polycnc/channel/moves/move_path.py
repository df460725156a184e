"""The way of a move, point by point: where it is after some part, how long it is, and the move that is a piece of it.

A part of the way is a number from 0 (start) to 1 (end): of the length on a line, of the angle on an arc.
"""

from __future__ import annotations

from math import asin, atan2, cos, floor, hypot, pi, sin

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.vectors import cross, dot
from polycnc.toolpath.kinds import CCW_KINDS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.channel.moves.path import Move
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.orientation.turning import Turning

#: Positions that differ by less (mm, degrees) are the same.
SAME = 1e-6
#: Pieces in which crossings and nearest points are looked for before they are narrowed down.
PIECES = 720
_NARROWINGS = 60


class MovePath:
    """The way of one move.

    Args:
        move: A line, an arc, a helix or a spiral.
        geometry: Columns of X, Y, Z among the axes, -1 for none.
        in_chords: The move becomes chords, in each of which rotary axes go evenly: their turning is smooth, so that
            its knots are no corners.
    """

    def __init__(self, move: Move, geometry: tuple[int, int, int], *, in_chords: bool = False) -> None:
        self.move = move
        self._geometry = geometry
        self._in_chords = in_chords
        self._sweep = 0.0
        if move.center is not None:
            self._lay_out()
        self._places: tuple[float, ...] = ()
        self._turning = move.turning
        if move.turning is not None:
            self._places = tuple(move.start[column] for column in move.turning.columns)
            turning = move.turning.smoothed(self._places) if in_chords else move.turning
            self._turning = turning.paced(self._places, self.length)

    def _lay_out(self) -> None:
        """An arc as start direction, direction of travel, angle, radii and rise along its normal."""
        move, normal = self.move, self.move.normal
        center = move.center or (0.0, 0.0, 0.0)
        a = [value - c for value, c in zip(self._geometric(move.start), center, strict=True)]
        b = [value - c for value, c in zip(self._geometric(move.end), center, strict=True)]
        height, top = dot(a, normal), dot(b, normal)
        a = [value - height * n for value, n in zip(a, normal, strict=True)]
        b = [value - top * n for value, n in zip(b, normal, strict=True)]
        sign = 1.0 if move.kind in CCW_KINDS else -1.0
        angle = sign * atan2(dot(cross(a, b), normal), dot(a, b))
        if angle < 1e-12:
            angle += 2.0 * pi
        self._radius = hypot(*a)
        self._growth = hypot(*b) - self._radius
        self._sweep = sign * (angle + 2.0 * pi * move.turns)
        self._out = [value / self._radius for value in a] if self._radius else [0.0, 0.0, 0.0]
        self._on = cross(normal, self._out)
        self._foot = [c + height * n for c, n in zip(center, normal, strict=True)]
        self._rise = top - height

    def _geometric(self, position: list[float]) -> list[float]:
        return [position[column] if column >= 0 else 0.0 for column in self._geometry]

    def at(self, part: float) -> list[float]:
        """The position of all axes after a part of the way."""
        move = self.move
        if part >= 1.0:
            return move.end.copy()
        point = [a + (b - a) * part for a, b in zip(move.start, move.end, strict=True)]
        if self._turning is not None:
            for column, place in zip(
                self._turning.columns, self._turning.at(self._places, part), strict=True
            ):
                point[column] = place
        if move.center is None:
            return point
        angle, radius = self._sweep * part, self._radius + self._growth * part
        c, s, rise = radius * cos(angle), radius * sin(angle), self._rise * part
        for k, column in enumerate(self._geometry):
            if column >= 0:
                turned = c * self._out[k] + s * self._on[k] + rise * move.normal[k]
                point[column] = self._foot[k] + turned
        return point

    def chords(self, error: float) -> Iterator[list[float]]:
        """End points of equal chords that stay within `error` (mm) of an arc; the last one is its end."""
        count = arcs.parts_for_chord_error(self.radius, self.sweep, error)
        return (self.at(k / count) for k in range(1, count + 1))

    @property
    def sweep(self) -> float:
        """Angle of an arc with its full turns, radians, positive counter-clockwise; 0 for a line."""
        return self._sweep

    @property
    def radius(self) -> float:
        """Greatest radius of an arc, mm."""
        return max(self._radius, self._radius + self._growth)

    @property
    def length(self) -> float:
        """Length on the geometry axes, mm; of the longest way of another axis where those stand."""
        move = self.move
        if move.center is not None:
            mean = self._radius + 0.5 * self._growth
            return hypot(mean * self._sweep, self._growth, self._rise)
        start, end = self._geometric(move.start), self._geometric(move.end)
        way = hypot(*(b - a for a, b in zip(start, end, strict=True)))
        return way or max(abs(b - a) for a, b in zip(move.start, move.end, strict=True))

    def direction(self, part: float) -> Vector:
        """Unit vector of travel on the geometry axes; zero where they stand."""
        if self.move.center is None:
            start, end = self._geometric(self.move.start), self._geometric(self.move.end)
            return _unit([b - a for a, b in zip(start, end, strict=True)])
        angle, radius = self._sweep * part, self._radius + self._growth * part
        c, s = cos(angle), sin(angle)
        return _unit(
            [
                self._sweep * radius * (c * on - s * out) + self._growth * (c * out + s * on) + self._rise * n
                for out, on, n in zip(self._out, self._on, self.move.normal, strict=True)
            ]
        )

    def turning_parts(self, direction: Vector) -> Iterator[float]:
        """The parts of an arc at which its coordinate along a direction turns from growing to shrinking, or back.

        With angle a, radius r and the rise h for each radian the coordinate changes by
        `r·(cos(a)·(d·on) - sin(a)·(d·out)) + h·(d·normal)`, which is zero where `sin(b - a)` has one known value.
        A line has none; of a spiral the radius at its middle counts.
        """
        if not self._sweep:
            return
        out, on = dot(direction, self._out), dot(direction, self._on)
        reach = hypot(out, on) * (self._radius + 0.5 * self._growth)
        if reach <= SAME:
            return
        share = self._rise / self._sweep * dot(direction, self.move.normal) / reach
        if abs(share) >= 1.0:
            return
        ahead = atan2(on, out)
        for angle in (ahead + asin(share), ahead + pi - asin(share)):
            first = angle if self._sweep > 0.0 else -angle
            first -= floor(first / (2.0 * pi)) * 2.0 * pi
            while first < abs(self._sweep):
                yield first / abs(self._sweep)
                first += 2.0 * pi

    def part_at(self, wanted: Mapping[int, float]) -> float | None:
        """The first part of the way at which every named axis (by column) has its value; None for never."""
        if not wanted:
            return None
        column, value = next(iter(wanted.items()))
        for part in self._crossings(column, value):
            point = self.at(part)
            if all(abs(point[at] - target) <= 1e3 * SAME for at, target in wanted.items()):
                return part
        return None

    def _crossings(self, column: int, value: float) -> list[float]:
        """Parts at which an axis has a value, in order."""
        start, end = self.move.start[column], self.move.end[column]
        if self.move.center is None or column not in self._geometry:
            if abs(end - start) < SAME:
                return [0.0] if abs(start - value) < SAME else []
            part = (value - start) / (end - start)
            return [min(max(part, 0.0), 1.0)] if -SAME <= part <= 1.0 + SAME else []
        found, before = [], self.at(0.0)[column] - value
        if abs(before) < SAME:
            found.append(0.0)
        for k in range(1, PIECES + 1):
            after = self.at(k / PIECES)[column] - value
            if abs(after) < SAME:
                found.append(k / PIECES)
            elif before * after < 0.0 and abs(before) >= SAME:
                found.append(self._narrowed(column, value, (k - 1) / PIECES, k / PIECES))
            before = after
        return found

    def _narrowed(self, column: int, value: float, low: float, high: float) -> float:
        below = self.at(low)[column] < value
        for _ in range(_NARROWINGS):
            middle = 0.5 * (low + high)
            if (self.at(middle)[column] < value) == below:
                low = middle
            else:
                high = middle
        return 0.5 * (low + high)

    def nearest(self, position: list[float]) -> float:
        """The part of the way that is nearest to a position on the geometry axes."""
        target = self._geometric(position)

        def distance(part: float) -> float:
            return hypot(*(a - b for a, b in zip(self._geometric(self.at(part)), target, strict=True)))

        best = min(range(PIECES + 1), key=lambda k: distance(k / PIECES)) / PIECES
        low, high = max(best - 1.0 / PIECES, 0.0), min(best + 1.0 / PIECES, 1.0)
        for _ in range(_NARROWINGS):
            third = (high - low) / 3.0
            if distance(low + third) <= distance(high - third):
                high -= third
            else:
                low += third
        middle = 0.5 * (low + high)
        return min((0.0, 1.0, middle), key=lambda part: (round(distance(part), 9), part != middle))

    def until(self, part: float) -> Move:
        """The move as far as a part of its way."""
        return self._piece(self.move.start, self.at(part), 0.0, part)

    def between(self, first: float, last: float) -> Move:
        """The piece between two parts of the way."""
        return self._piece(self.at(first), self.at(last), first, last)

    def beyond(self, part: float, start: list[float] | None = None) -> Move:
        """The rest of the move from a part of its way on; `start` where axes beside its way stand elsewhere."""
        return self._piece(self.at(part) if start is None else start, self.move.end, part, 1.0)

    def _piece(self, start: list[float], end: list[float], first: float, last: float) -> Move:
        share = last - first
        turns = max(int(abs(self._sweep) * share / (2.0 * pi) - 1e-12), 0) if self.move.turns else 0
        turning = self.turned(first, last)
        return replace(self.move, start=start, end=end, turns=float(turns), turning=turning)

    def turned(self, first: float, last: float) -> Turning | None:
        """How the rotary axes turn between two parts of the way."""
        turning = self._turning
        if turning is None or last <= first or self._in_chords:
            return None
        return turning.part(self._places, first, last)


def _unit(vector: list[float]) -> Vector:
    size = hypot(*vector)
    if size < SAME:
        return (0.0, 0.0, 0.0)
    return (vector[0] / size, vector[1] / size, vector[2] / size)
