"""Radius compensation in space where nothing leads the axes: words name them as the table stands at the end of a block.

The corner of two blocks is that of the work, so points are seen from the table: with its turn `M` at a point `P` the
work sees `M⁻¹ P`. There the vector is found as under tip control (`compensation.spatial`), and `M` of the block's end
leads it back to the axes (FANUC 15i, B-63324EN, page 559: `P1' = M2 M1⁻¹ (P1 - P0) + P0`). Between two ends the axes go
straight.
"""

from __future__ import annotations

from polycnc.compensation.spatial.chords import Directions
from polycnc.compensation.spatial.stage import SpatialStage
from polycnc.deferred.typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.moves.path import Move
    from polycnc.compensation.spatial.rules import Corners, Rules
    from polycnc.geometry.frames import Vector


class Table(Directions, Protocol):
    """What says how the tool stands, and how the table has turned the work."""

    def on_table(self, position: Sequence[float]) -> Vector:
        """The point of the work at a position of the axes, as the table sees it at zero."""

    def from_table(self, position: Sequence[float], way: Vector) -> Vector:
        """A way on the work as the axes go it, with the table at a position."""


class AxesStage(SpatialStage):
    """The stage for axes that nothing leads.

    Args:
        geometry: Columns of X, Y, Z.
        table: How the tool stands on the work, and how the table turns that.
        radius: Offset, mm.
        side: 1 left, -1 right.
        corners: What happens at outer corners.
        rules: How the control does it.
        join: As for `SpatialStage`.
    """

    def __init__(
        self,
        geometry: tuple[int, int, int],
        table: Table,
        radius: float,
        side: int,
        corners: Corners,
        rules: Rules,
        join: Callable[[list[Move]], object] = len,
    ) -> None:
        super().__init__(geometry, table, radius, side, corners, rules, join)
        self._table = table

    def _point(self, position: list[float]) -> Vector:
        return self._table.on_table(position)

    def _shifted(self, position: list[float], shift: Vector) -> list[float]:
        return super()._shifted(position, self._table.from_table(position, shift))
