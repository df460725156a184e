"""A workpiece that lies on the table beside where the program has it (FANUC G54.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.deferred.records import dataclass
from polycnc.geometry.frames import Frame, translation

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector


@dataclass(frozen=True, slots=True)
class Misplaced:
    """How a workpiece lies.

    Attributes:
        error: From where the work should lie to where it lies, seen from the work zero, along the axes of the machine.
        measured: How the table had turned when that was measured, machine coordinates.
        turn: How the table has turned now.
    """

    error: Frame
    measured: Frame
    turn: Frame

    def on_table(self, zero: Vector) -> Frame:
        """The error seen from the work zero (machine coordinates, mm) with the table at zero: it goes along with it."""
        before = _about(zero, self.measured)
        return before.inverse() @ self.error @ before

    def seen(self, zero: Vector) -> Frame:
        """The same with the table as it has turned: what positions along the axes of the machine are led by."""
        now = _about(zero, self.turn)
        return now @ self.on_table(zero) @ now.inverse()


def _about(zero: Vector, turn: Frame) -> Frame:
    shift = translation(*zero)
    return shift.inverse() @ turn @ shift
