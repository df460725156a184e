"""A workpiece that lies on the table beside where the program has it (FANUC G54.4)."""

from __future__ import annotations

from math import asin, atan2, degrees

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, translation
from polycnc.transformation.planes.tilted import by_fixed_axes

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector


@dataclass(frozen=True, slots=True)
class Misplaced:
    """How a workpiece lies.

    Attributes:
        errors: From where the work should lie to where it lies, seen from the work zero, along the axes of the machine,
            each with how the table had turned when that was measured, machine coordinates. Several are added as they
            are with the table at zero (A-79634E, page 10).
        turn: How the table has turned now.
        told: How words tell it to have turned, where the tool stands on the work as it lies; None for the same.
    """

    errors: tuple[tuple[Frame, Frame], ...]
    turn: Frame
    told: Frame | None = None

    @property
    def turns(self) -> bool:
        """Whether it lies turned, not shifted alone."""
        return any(error.m != IDENTITY.m for error, _ in self.errors)

    def on_table(self, zero: Vector) -> Frame:
        """The error seen from the work zero (machine coordinates, mm) with the table at zero: it goes along with it."""
        turns = ((error, _about(zero, measured)) for error, measured in self.errors)
        frames = [before.inverse() @ error @ before for error, before in turns]
        return frames[0] if len(frames) == 1 else _sum(frames)

    def seen(self, zero: Vector) -> Frame:
        """The same with the table as it has turned: what positions along the axes of the machine are led by."""
        now, told = _about(zero, self.turn), self.turn if self.told is None else self.told
        return now @ self.on_table(zero) @ _about(zero, told).inverse()


def _sum(frames: list[Frame]) -> Frame:
    """The frame whose shifts and turns about X, Y, Z are the sums of those of others."""
    shifts, turns = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for frame in frames:
        m = frame.m
        about = (atan2(m[2][1], m[2][2]), asin(max(-1.0, min(1.0, -m[2][0]))), atan2(m[1][0], m[0][0]))
        shifts = [a + b for a, b in zip(shifts, frame.t, strict=True)]
        turns = [a + degrees(b) for a, b in zip(turns, about, strict=True)]
    return translation(*shifts) @ by_fixed_axes((0, 1, 2), turns)


def _about(zero: Vector, turn: Frame) -> Frame:
    shift = translation(*zero)
    return shift.inverse() @ turn @ shift
