"""Surface of a cylinder with groove walls that a linear axis keeps square (TRACYL, types 513 and 514).

A groove is cut along one of its walls, away from its centre line. If the rotary axis alone did that, the tool would
lean in the groove. So the part of the way round that leads from the centre line to the wall is gone by a linear axis
beside the work, and the rotary axis stands where the centre line is.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class GrooveCylinder(OneToOne):
    """An unrolled cylinder, and how far the tool is from the centre line round it.

    In points of the path the column of the linear axis is the length round the cylinder, that of the rotary axis the
    part of it (mm) that the linear axis goes.

    Attributes:
        axis: Column of the rotary axis.
        beside: Column of the linear axis.
        mm_per_degree: Length of a degree on the surface.
        geometry: Columns of X, Y and Z while the cylinder is unrolled.
    """

    axis: int
    beside: int
    mm_per_degree: float
    geometry: Geometry

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """The linear axis off the centre line, and degrees of the centre line."""
        axes, wall = list(work), work[self.axis]
        axes[self.beside] = wall
        axes[self.axis] = (work[self.beside] - wall) * (1.0 / self.mm_per_degree)
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """Length on the surface."""
        work, wall = list(axes), axes[self.beside]
        work[self.beside] = axes[self.axis] * self.mm_per_degree + wall
        work[self.axis] = wall
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Degrees of a millimetre, on the surface and off the centre line."""
        slopes, degrees = unchanged(work), 1.0 / self.mm_per_degree
        slopes[self.beside][self.beside], slopes[self.beside][self.axis] = 0.0, 1.0
        slopes[self.axis][self.beside], slopes[self.axis][self.axis] = degrees, -degrees
        return slopes
