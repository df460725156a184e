"""A programmed path, written row by row: what `laying/rows.py` must make of rows, worked out apart from it."""

from __future__ import annotations

from array import array
from dataclasses import dataclass
from math import ceil, cos, inf, pi, sin, sqrt
from typing import TYPE_CHECKING

from polycnc.geometry.vectors import cross, dot
from polycnc.motion.third_order.bends.stretches import ARC, CHORD, LINE, Stretches

if TYPE_CHECKING:
    from collections.abc import Sequence

#: An arc's stretches turn by no more (7.5°), and leave it by no more than this part of the tolerance.
ARC_TURN, ARC_PART = pi / 24.0, 0.02
#: A cubic over an angle leaves a circle of radius 1 by so much of the angle's fourth power.
ARC_OFF = 1.0 / 384.0


@dataclass(frozen=True)
class Bounds:
    """What holds along a row.

    Attributes:
        tolerance: How far the linear axes may leave it, mm.
        speed: Highest speed along it, mm/s.
        turn_tolerance: How far the rotary axes may leave it, degrees; as many as the tolerance has mm if left out.
        ease: Part of acceleration and jerk that the axes may use.
    """

    tolerance: float
    speed: float = inf
    turn_tolerance: float | None = None
    ease: float = 1.0


class ProgrammedPath:
    """The programmed path of a run, row by row, in machine coordinates.

    The way of a row is that of its linear axes, where none of them moves that of its rotary ones.

    Args:
        start: Positions of the n axes.
        tops: Highest speeds of the axes.
        rotary: Which of them are rotary; none where it is left out.
        plane: The columns of X, Y and Z, in which arcs lie.
    """

    def __init__(
        self,
        start: Sequence[float],
        tops: Sequence[float],
        rotary: Sequence[bool] = (),
        plane: tuple[int, int, int] = (0, 1, 2),
    ) -> None:
        self._n, self._plane = len(start), plane
        turns = array("d", [1.0 if turn else 0.0 for turn in rotary] or [0.0] * self._n)
        empty = (array("d") for _ in range(9))
        self.path = Stretches(
            way=array("d", (0.0,)),
            place=array("d", start),
            leave=next(empty),
            arrive=next(empty),
            form=array("q"),
            tolerance=next(empty),
            turn_tolerance=next(empty),
            cap2=next(empty),
            step2=next(empty),
            spread2=next(empty),
            left2=next(empty),
            ease=next(empty),
            row=array("q"),
            rotary=turns,
            top=array("d", tops),
        )

    @property
    def position(self) -> list[float]:
        """Where the last row has led to."""
        return list(self.path.place[-self._n :])

    def line(self, end: Sequence[float], row: int, bounds: Bounds) -> None:
        """A straight row."""
        self._straight(end, LINE, row, bounds)

    def chord(self, end: Sequence[float], row: int, bounds: Bounds) -> None:
        """A row that is the chord of a spline: the next one goes on with it smoothly."""
        self._straight(end, CHORD, row, bounds)

    def arc(
        self,
        end: Sequence[float],
        centre: tuple[float, float, float],
        normal: tuple[float, float, float],
        sweep: float,
        row: int,
        bounds: Bounds,
    ) -> None:
        """An arc, helix or spiral about an axis, by an angle (radians, positive to the right about the normal).

        Its radius grows in proportion to the angle, and so do the ways along the normal and of the other axes.
        """
        start, plane = self.position, self._plane
        size = sqrt(dot(normal, normal))
        axis = (normal[0] / size, normal[1] / size, normal[2] / size)
        first, before = _across([start[i] for i in plane], centre, axis)
        last, behind = _across([end[i] for i in plane], centre, axis)
        radius, growth, rise = (
            sqrt(dot(first, first)),
            (sqrt(dot(last, last)) - sqrt(dot(first, first))) / sweep,
            (behind - before) / sweep,
        )
        out = (first[0] / radius, first[1] / radius, first[2] / radius)
        forth = cross(axis, out)
        largest = max(radius, radius + growth * sweep)
        step = min(ARC_TURN, (ARC_PART * bounds.tolerance / (ARC_OFF * largest)) ** 0.25)
        count = ceil(abs(sweep) / step - 1e-9)
        rates = [(b - a) / sweep for a, b in zip(start, end, strict=True)]

        def at(angle: float) -> tuple[list[float], list[float], float]:
            """Place, derivative by the angle, and the way by the angle."""
            c, s, r = cos(angle), sin(angle), radius + growth * angle
            place, slope = [a + rate * angle for a, rate in zip(start, rates, strict=True)], list(rates)
            for j, i in enumerate(plane):
                e, f = c * out[j] + s * forth[j], c * forth[j] - s * out[j]
                place[i] = centre[j] + r * e + (before + rise * angle) * axis[j]
                slope[i] = growth * e + r * f + rise * axis[j]
            return place, slope, self._length(slope)

        _, leave, fast = at(0.0)
        for k in range(count):
            _, _, middle = at((k + 0.5) * sweep / count)
            place, arrive, faster = at((k + 1.0) * sweep / count)
            way = abs(sweep) / count * (fast + 4.0 * middle + faster) / 6.0
            sense = 1.0 if sweep > 0.0 else -1.0
            self._add(
                way,
                place if k + 1 < count else end,
                [sense * slope / fast for slope in leave],
                [sense * slope / faster for slope in arrive],
                (ARC, row, bounds),
            )
            leave, fast = arrive, faster

    def _straight(self, end: Sequence[float], form: int, row: int, bounds: Bounds) -> None:
        delta = [b - a for a, b in zip(self.position, end, strict=True)]
        way = self._length(delta)
        if way > 0.0:
            unit = [step / way for step in delta]
            self._add(way, end, unit, unit, (form, row, bounds))

    def _length(self, vector: Sequence[float]) -> float:
        """Of what the linear axes do, where they do nothing of what the rotary ones do."""
        rotary = self.path.rotary
        linear = sqrt(sum(v * v for v, turns in zip(vector, rotary, strict=True) if turns == 0.0))
        return linear if linear > 0.0 else sqrt(sum(v * v for v in vector))

    def _add(
        self,
        way: float,
        end: Sequence[float],
        leave: Sequence[float],
        arrive: Sequence[float],
        of: tuple[int, int, Bounds],
    ) -> None:
        path, (form, row, bounds) = self.path, of
        path.way.append(path.way[-1] + way)
        path.place.extend(end)
        path.leave.extend(leave)
        path.arrive.extend(arrive)
        path.form.append(form)
        path.tolerance.append(bounds.tolerance)
        turns = bounds.turn_tolerance
        path.turn_tolerance.append(bounds.tolerance if turns is None else turns)
        path.cap2.append(bounds.speed * bounds.speed)
        path.step2.append(inf)
        path.spread2.append(inf)
        path.left2.append(inf)
        path.ease.append(bounds.ease)
        path.row.append(row)


def _across(
    place: Sequence[float], centre: Sequence[float], axis: tuple[float, float, float]
) -> tuple[tuple[float, float, float], float]:
    """The part of the way from a centre to a place that lies across an axis, and how long that along it is."""
    away = (place[0] - centre[0], place[1] - centre[1], place[2] - centre[2])
    along = dot(away, axis)
    return (away[0] - along * axis[0], away[1] - along * axis[1], away[2] - along * axis[2]), along
