"""What the path, the planner and the displays ask of a transformation.

Points of the path and positions of the axes are lists with one number for each channel axis (mm, degrees), or with one
column of numbers for each: the formulas are the same, and so are the bits. Both count from the work zero; what lies
between that and the machine's own zero (frame, offsets) comes after the transformation.

Where a transformation leaves an axis alone, its number is the same on both sides.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.numbers import N
    from polycnc.transformation.pole import Pole

#: Columns of X, Y and Z, or -1.
Geometry = tuple[int, int, int]


class Transformation(Protocol):
    """How the axes follow the points of a path."""

    @property
    def geometry(self) -> Geometry:
        """Columns of X, Y and Z in points of the path."""

    @property
    def pole(self) -> Pole | None:
        """Where an axis has no direction: there the path rests while that axis turns. None for no such place."""

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Positions of the axes at a point of the path."""

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """The point of the path for positions of the axes."""

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """Derivatives at a point of the path: those of an axis (row) by the numbers of the point (columns)."""

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """All positions of the axes at a point, but for whole turns; what `to_machine` gives is the first one."""


class OneToOne:
    """What a transformation without a pole has in common with its like: one position of the axes for each point."""

    __slots__ = ()

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Positions of the axes at a point of the path."""
        raise NotImplementedError

    @property
    def pole(self) -> Pole | None:
        """No axis is ever without a direction."""
        return None

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """The one position of the axes."""
        return [self.to_machine(work)]


def unchanged(work: Sequence[N]) -> list[list[N | float]]:
    """The Jacobian of axes that all go their own way, to be written into."""
    slopes: list[list[N | float]] = [[0.0] * len(work) for _ in work]
    for i, row in enumerate(slopes):
        row[i] = 1.0
    return slopes


def product(outer: list[list[N | float]], inner: list[list[N | float]]) -> list[list[N | float]]:
    """Two Jacobians, multiplied: of what comes behind, and of what comes in front."""
    count = len(inner)
    rows: list[list[N | float]] = []
    for row in outer:
        sums: list[N | float] = [0.0] * count
        for k, factor in enumerate(row):
            for j in range(count):
                sums[j] = sums[j] + factor * inner[k][j]
        rows.append(sums)
    return rows
