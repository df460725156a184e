"""How the tool stands on the work, and where its tip is there, while words name the axes and nothing leads them."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles, Kinematics
    from polycnc.transformation.contract import Geometry


@dataclass(frozen=True, slots=True)
class Unled:
    """The work under axes that nothing leads, by positions of the path.

    Attributes:
        kinematics: The machine's rotary joints.
        axes: Names of the columns.
        offsets: From the work zero to that of the machine, for every axis (mm, degrees).
        geometry: Columns of X, Y and Z; all three exist.
        zero: From the work zero to that of the machine without the tool, X, Y, Z, mm: table joints turn the tip.
    """

    kinematics: Kinematics
    axes: tuple[str, ...]
    offsets: tuple[float, ...]
    geometry: Geometry
    zero: Vector

    def tool_at(self, position: Sequence[float]) -> Vector:
        """Direction from the tip along the tool at a position, as the work sees it."""
        return self.kinematics.tool_on_work(self._angles(position))

    def on_table(self, position: Sequence[float]) -> Vector:
        """The point of the work under the tip at a position, as it lies with the table at zero, mm."""
        x, y, z = (position[axis] + zero for axis, zero in zip(self.geometry, self.zero, strict=True))
        return self.kinematics.work_turn(self._angles(position)).inverse().apply(x, y, z)

    def from_table(self, position: Sequence[float], way: Vector) -> Vector:
        """A way on the work as the axes go it, with the table at a position."""
        return self.kinematics.work_turn(self._angles(position)).direct(*way)

    def _angles(self, position: Sequence[float]) -> Angles:
        return {
            name: value + zero for name, value, zero in zip(self.axes, position, self.offsets, strict=True)
        }
