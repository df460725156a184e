"""Inclined axis: a machine whose infeed axis is not square on the other one is programmed as if it were (TRAANG).

With α from the Cartesian axis X towards Z the inclined axis moves the tool by (cos α, sin α) in X and Z, so that the
other axis must take back what it adds along Z: `U = X / cos α`, `W = Z - X·tan α`.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import cos_sin_deg
from polycnc.transformation.contract import OneToOne, unchanged
from polycnc.transformation.numbers import constant

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N

#: An axis that stands nearer to the other one than this (cosine) does not span a plane with it.
FLAT = 1e-6


@dataclass(frozen=True, slots=True)
class InclinedAxis(OneToOne):
    """An axis at an angle, and the one that it is inclined to.

    Attributes:
        inclined: Column of the inclined axis.
        other: Column of the axis that it is inclined to.
        angle_deg: From the Cartesian axis to the inclined one, positive towards the other axis.
        geometry: Columns of X, Y and Z.
        virtual: Column of the Cartesian axis where it has one of its own, beside the inclined axis; else -1. In points
            of the path the inclined axis is zero then, in positions of the axes the column is.

    Raises:
        ValueError: The two axes are parallel.
    """

    inclined: int
    other: int
    angle_deg: float
    geometry: Geometry
    virtual: int = -1

    def __post_init__(self) -> None:
        if abs(cos_sin_deg(self.angle_deg)[0]) < FLAT:
            raise ValueError(f"an axis inclined by {self.angle_deg} degrees is parallel to the other one")

    @property
    def cartesian(self) -> int:
        """Column of the axis that is programmed in place of the inclined one."""
        return self.inclined if self.virtual < 0 else self.virtual

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """The way of the inclined axis, and what the other one does beside it."""
        cos, sin = cos_sin_deg(self.angle_deg)
        axes, square = list(work), work[self.cartesian]
        if self.virtual >= 0:
            axes[self.virtual] = constant(0.0, square)
        axes[self.inclined] = square / cos
        axes[self.other] = work[self.other] - square * (sin / cos)
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The Cartesian point."""
        cos, sin = cos_sin_deg(self.angle_deg)
        work, way = list(axes), axes[self.inclined]
        if self.virtual >= 0:
            work[self.inclined] = constant(0.0, way)
        work[self.cartesian] = way * cos
        work[self.other] = axes[self.other] + way * sin
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """The same everywhere."""
        cos, sin = cos_sin_deg(self.angle_deg)
        slopes = unchanged(work)
        if self.virtual >= 0:
            slopes[self.inclined][self.inclined] = slopes[self.virtual][self.virtual] = 0.0
        slopes[self.inclined][self.cartesian] = 1.0 / cos
        slopes[self.other][self.cartesian] = -sin / cos
        return slopes
