"""Parallel axes: others than those of the machine file are X, Y and Z (G17 to G19 with U, V, W)."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.transformation.contract import OneToOne, unchanged

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N


@dataclass(frozen=True, slots=True)
class ParallelAxes(OneToOne):
    """Every axis moves as it is named; `geometry` has the columns of X, Y and Z."""

    geometry: Geometry

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """The axes where the path is."""
        return list(work)

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The path where the axes are."""
        return list(axes)

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Every axis goes its own way."""
        return unchanged(work)
