"""Hypothetical axes: the path moves them, they stand (G07)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged
from polycnc.transformation.numbers import constant

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class StandingAxes(OneToOne):
    """Axes that stand while the path moves them.

    Attributes:
        places: Column and position of each.
        geometry: Columns of X, Y and Z.
    """

    places: tuple[tuple[int, float], ...]
    geometry: Geometry

    @property
    def columns(self) -> frozenset[int]:
        """Columns of the axes that stand."""
        return frozenset(axis for axis, _ in self.places)

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Where the axes are when the path is at a point."""
        axes = list(work)
        for axis, place in self.places:
            axes[axis] = constant(place, work[axis])
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the path at which it begins anew."""
        return list(axes)

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """An axis that stands follows nothing."""
        slopes = unchanged(work)
        for axis, _ in self.places:
            slopes[axis][axis] = 0.0
        return slopes
