"""A transformation with what lies before and behind it: frames in front, tools behind (SINUMERIK).

There programmed frames belong to the work, in front of the transformation: `work --(frame, shifts, led)--> basic system
--(transformation)--> --(offsets, driven)--> machine`. While it acts nothing else lies between the display and the
machine. Couplings stand on both sides: `led` are those of the basic system, `driven` those of the machine's axes.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.transformation.contract import product

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry, Transformation
    from polycnc.transformation.couplings.coupled import Coupled
    from polycnc.transformation.numbers import N
    from polycnc.transformation.pole import Pole

#: A frame that takes the plane of a pole out of itself by more than this has no pole at a fixed place.
IN_PLANE = 1e-12


@dataclass(frozen=True, slots=True)
class Seated:
    """A transformation in its seat.

    Attributes:
        inner: From the basic system to the axes.
        frame: From the work to the basic system, geometry axes.
        shifts: The same for every axis beside it (rotary axes, and lengths of a tool that counts in front).
        offsets: What is added to the axes behind the transformation: lengths of a tool that counts there.
        led: Axes that follow others in the basic system; none of them is one of the pole's.
        driven: Axes that follow others as axes of the machine.
    """

    inner: Transformation
    frame: Frame = IDENTITY
    shifts: tuple[float, ...] = ()
    offsets: tuple[float, ...] = ()
    led: Coupled | None = None
    driven: Coupled | None = None

    @property
    def geometry(self) -> Geometry:
        """Columns of X, Y and Z in points of the path."""
        return self.inner.geometry

    @property
    def pole(self) -> Pole | None:
        """That of the transformation, where the frame sees it; None where it tilts the pole's plane."""
        pole = self.inner.pole
        if pole is None:
            return None
        rows, back = self.frame.m, self.frame.inverse()
        i, j = (self.geometry.index(column) for column in pole.columns)
        k = 3 - i - j
        if max(abs(rows[k][i]), abs(rows[k][j]), abs(rows[i][k]), abs(rows[j][k])) > IN_PLANE:
            return None
        place = [0.0, 0.0, 0.0]
        for at, column, value in zip((i, j), pole.columns, pole.place, strict=True):
            place[at] = value - (self.shifts[column] if self.shifts else 0.0)
        centre = back.apply(place[0], place[1], place[2])
        zero = pole.zero + (self.offsets[pole.linear] if self.offsets else 0.0)
        return replace(pole, place=(centre[i], centre[j]), zero=zero)

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Positions of the machine's axes at a point of the work."""
        return self._drive(_added(self.inner.to_machine(self.basic(work)), self.offsets))

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the work for positions of the machine's axes."""
        point = _added(self.inner.to_work(self.behind(axes)), ())
        if self.led is not None:
            point = self.led.to_work(point)
        return self._mapped(self.frame.inverse(), _taken(point, self.shifts))

    def basic(self, work: Sequence[N]) -> list[N]:
        """The point of the basic system for one of the work."""
        point = self._shifted(work)
        return point if self.led is None else self.led.to_machine(point)

    def behind(self, axes: Sequence[N]) -> list[N]:
        """Positions of the axes as the transformation makes them: those of the machine without tool and slaves."""
        return _taken(axes if self.driven is None else self.driven.to_work(axes), self.offsets)

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """That of the transformation, seen through the frame and with the axes that follow others."""
        basic = self.basic(work)
        slopes = self.inner.jacobian(basic)
        if self.led is not None:
            slopes = product(slopes, self.led.jacobian(self._shifted(work)))
        if not self.frame.is_identity:
            self._turn(slopes)
        if self.driven is None:
            return slopes
        own = _added(self.inner.to_machine(basic), self.offsets)
        return product(self.driven.jacobian(own), slopes)

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """All positions of the machine's axes at a point."""
        return [self._drive(_added(found, self.offsets)) for found in self.inner.solutions(self.basic(work))]

    @property
    def is_coupled(self) -> bool:
        """Whether axes follow others."""
        return self.led is not None or self.driven is not None

    def carried(self, axes: Sequence[float], column: int, way: float) -> list[float]:
        """Where the machine's axes are when one of them is moved by a way, and takes along those that follow it."""
        own = list(axes) if self.driven is None else self.driven.to_work(axes)
        moved = own.copy()
        moved[column] += way
        if self.led is not None:
            before, after = (
                self.led.to_work(self.inner.to_work(_taken(each, self.offsets))) for each in (own, moved)
            )
            for each in self.led.following:
                if each.column != column:
                    after[each.column] = before[each.column]
            moved = _added(self.inner.to_machine(self.led.to_machine(after)), self.offsets)
        return self._drive(moved)

    def _shifted(self, work: Sequence[N]) -> list[N]:
        """The point of the basic system without what others lead."""
        return _added(self._mapped(self.frame, work), self.shifts)

    def _drive(self, axes: list[N]) -> list[N]:
        return axes if self.driven is None else self.driven.to_machine(axes)

    def _turn(self, slopes: list[list[N | float]]) -> None:
        """Slopes by the basic system become those by the work."""
        columns = self.geometry
        for row in slopes:
            old = [row[column] if column >= 0 else 0.0 for column in columns]
            for j, column in enumerate(columns):
                if column >= 0:
                    a, b, c = (self.frame.m[i][j] for i in range(3))
                    row[column] = old[0] * a + old[1] * b + old[2] * c

    def _mapped(self, frame: Frame, point: Sequence[N]) -> list[N]:
        mapped = list(point)
        if frame.is_identity:
            return mapped
        values = [point[column] if column >= 0 else 0.0 for column in self.geometry]
        for column, (a, b, c), shift in zip(self.geometry, frame.m, frame.t, strict=True):
            if column >= 0:
                mapped[column] = a * values[0] + b * values[1] + c * values[2] + shift  # type: ignore[assignment]  # one of the three is a column
        return mapped


def _added(point: Sequence[N], shifts: tuple[float, ...]) -> list[N]:
    if not shifts:
        return list(point)
    return [value + shift for value, shift in zip(point, shifts, strict=True)]


def _taken(point: Sequence[N], shifts: tuple[float, ...]) -> list[N]:
    if not shifts:
        return list(point)
    return [value - shift for value, shift in zip(point, shifts, strict=True)]
