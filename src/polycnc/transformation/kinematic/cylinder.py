"""Surface of a cylinder: a rotary axis becomes a length on the unrolled surface (G07.1, TRACYL)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged
from polycnc.transformation.numbers import RADIAN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class Cylinder(OneToOne):
    """An unrolled cylinder.

    Attributes:
        axis: Column of the rotary axis.
        mm_per_degree: Length of a degree on the surface.
        geometry: Columns of X, Y and Z while the cylinder is unrolled.
        virtual: Column of the length where it has one of its own, beside the rotary axis; else -1. In points of the
            path the column of the rotary axis says then where the machine's axis of that column stands.
    """

    axis: int
    mm_per_degree: float
    geometry: Geometry
    virtual: int = -1

    @classmethod
    def of_radius(cls, axis: int, radius_mm: float, geometry: Geometry, virtual: int = -1) -> Cylinder:
        """The cylinder of a radius."""
        return cls(axis, radius_mm * RADIAN, geometry, virtual)

    @property
    def along(self) -> int:
        """Column of the length on the surface."""
        return self.axis if self.virtual < 0 else self.virtual

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Degrees for a length on the surface."""
        axes, length = list(work), work[self.along]
        if self.virtual >= 0:
            axes[self.virtual] = work[self.axis]
        axes[self.axis] = length * (1.0 / self.mm_per_degree)
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """Length on the surface for degrees."""
        work, angle = list(axes), axes[self.axis]
        if self.virtual >= 0:
            work[self.axis] = axes[self.virtual]
        work[self.along] = angle * self.mm_per_degree
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Degrees of a millimetre."""
        slopes = unchanged(work)
        if self.virtual >= 0:
            slopes[self.axis][self.axis] = slopes[self.virtual][self.virtual] = 0.0
            slopes[self.virtual][self.axis] = 1.0
        slopes[self.axis][self.along] = 1.0 / self.mm_per_degree
        return slopes
