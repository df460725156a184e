"""Couplings of axes as a transformation: points of the path are the ways that the axes go by themselves.

What leading axes add makes positions of the axes of them. So limits of travel, speeds and accelerations of following
axes count all along the path, and every display, plan and sample has them where they are.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged
from polycnc.transformation.couplings.graph import in_order

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.transformation.contract import Geometry, Transformation
    from polycnc.transformation.couplings.laws import Law
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class Following:
    """A following axis: its column, and the laws by which others lead it."""

    column: int
    laws: tuple[Law, ...]


@dataclass(frozen=True, slots=True)
class Coupled(OneToOne):
    """The couplings that act.

    Attributes:
        following: The following axes, each behind those that lead it.
        geometry: Columns of X, Y and Z.
    """

    following: tuple[Following, ...]
    geometry: Geometry

    @classmethod
    def of(cls, laws: Mapping[int, Sequence[Law]], geometry: Geometry) -> Coupled:
        """Couplings in their order.

        Raises:
            CircularCouplingError: An axis leads itself.
        """
        return cls(tuple(Following(column, tuple(laws[column])) for column in in_order(laws)), geometry)

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Every axis with what others add to it."""
        axes = list(work)
        for each in self.following:
            for law in each.laws:
                axes[each.column] = axes[each.column] + law.share(axes[law.leading])
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """What every axis has gone by itself."""
        work = list(axes)
        for each in self.following:
            for law in each.laws:
                work[each.column] = work[each.column] - law.share(axes[law.leading])
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """The slopes of the laws, from axis to axis."""
        slopes, axes = unchanged(work), self.to_machine(work)
        for each in self.following:
            row = slopes[each.column]
            for law in each.laws:
                slope = law.slope(axes[law.leading])
                for k, led in enumerate(slopes[law.leading]):
                    row[k] = row[k] + slope * led
        return slopes


@dataclass(frozen=True, slots=True)
class Shown(OneToOne):
    """Displays show following axes where they are, not what they have gone by themselves, and the tip off the table.

    Attributes:
        led: From the work to the machine, with couplings (turns of the table).
        bare: The same without them.
        beside: What is added to each axis while a point goes through both; empty for nothing.
    """

    led: Transformation
    bare: Transformation
    beside: tuple[float, ...] = ()

    @property
    def geometry(self) -> Geometry:
        """Columns of X, Y and Z."""
        return self.bare.geometry

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """The ways of the axes by themselves at a point that is shown."""
        return self._moved(self.led.to_work(self.bare.to_machine(self._moved(work, 1.0))), -1.0)

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point that is shown for the ways of the axes."""
        return self._moved(self.bare.to_work(self.led.to_machine(self._moved(axes, 1.0))), -1.0)

    def _moved(self, point: Sequence[N], sense: float) -> list[N]:
        if not self.beside:
            return list(point)
        return [value + sense * way for value, way in zip(point, self.beside, strict=True)]

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Nobody plans by what is shown."""
        raise NotImplementedError
