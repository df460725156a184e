"""Feature frame: a plane of the work is programmed as if it lay in X and Y (G68.2, CYCLE800, TRANS and ROT)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Frame
    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class FeatureFrame(OneToOne):
    """An affine map of the geometry axes. As a link of a chain it comes before what leads to the axes.

    Attributes:
        frame: From the feature to the work.
        geometry: Columns of X, Y and Z; all three exist.
    """

    frame: Frame
    geometry: Geometry

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """The point of the work for one of the feature."""
        return self._mapped(self.frame, work)

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the feature for one of the work."""
        return self._mapped(self.frame.inverse(), axes)

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """The matrix of the frame."""
        slopes = unchanged(work)
        for row, i in zip(self.frame.m, self.geometry, strict=True):
            for slope, j in zip(row, self.geometry, strict=True):
                slopes[i][j] = slope
        return slopes

    def _mapped(self, frame: Frame, point: Sequence[N]) -> list[N]:
        mapped = list(point)
        x, y, z = (point[i] for i in self.geometry)
        for i, (a, b, c), shift in zip(self.geometry, frame.m, frame.t, strict=True):
            mapped[i] = a * x + b * y + c * z + shift
        return mapped
