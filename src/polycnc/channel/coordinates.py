"""Where a channel is, in every coordinate system that matters.

    programmed --(programming frame)--> named --(naming)--> position --(zero frame + offsets)--> machine

`programmed` is what words name (after units and diameters). The programming frame is what the control puts *before* its
absolute display: on the word-address controls scaling, mirror, rotation and, on lathes, tool offsets that move the
programmed point; on SINUMERIK nothing. Axes beside the geometry have a shift of their own for that. `position` is a
X
system, which turns against that of the path with the rotary axes. The zero frame and the offsets lead to the machine's
axes: work offsets, shifts, tool.

When offsets change, the machine stays where it is and the other positions follow. Whether a later *incremental* word
travels the change as well differs: a tool length does, a work offset does not. `pending` holds what is still owed to
incremental words; `owes` says whether there is any.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.tolerances import FARTHEST

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.transformation.contract import Transformation


class Coordinates:
    """Positions and frames of one channel; all lists have one number for each channel axis (mm, radius, degrees).

    Args:
        axes: Channel axis names, in column order.
        geometry: For X, Y, Z of the geometry the index of the channel axis, or -1.
    """

    def __init__(self, axes: tuple[str, ...], geometry: tuple[int, int, int], machine: list[float]) -> None:
        self.axes = axes
        self.geometry = geometry
        self.programming = IDENTITY
        self.shift: list[float] | None = None
        self.direct = True
        self.naming: Transformation | None = None
        self.transformation: Transformation | None = None
        self.zero = IDENTITY
        self.offsets = [0.0] * len(axes)
        self.pending = [0.0] * len(axes)
        self.owes = False
        self.position = list(machine)
        self.programmed = self.position

    def image(self, frame: Frame, point: list[float]) -> list[float]:
        """A point of all axes mapped by a frame of the geometry axes; axes that do not exist count as zero."""
        if frame is IDENTITY or frame.is_identity:
            return point
        mapped = frame.apply(*(point[i] if i >= 0 else 0.0 for i in self.geometry))
        result = list(point)
        for i, value in zip(self.geometry, mapped, strict=True):
            if i >= 0:
                result[i] = value
        return result

    def to_position(self, programmed: list[float]) -> list[float]:
        """Programmed point to one of the path."""
        position = self.image(self.programming, programmed)
        if self.shift is not None:
            position = [value + shift for value, shift in zip(position, self.shift, strict=True)]
        return position if self.naming is None else self.naming.to_machine(position)

    def named(self, position: list[float]) -> list[float]:
        """Point of the path to absolute display."""
        return position if self.naming is None else self.naming.to_work(position)

    def to_programmed(self, position: list[float]) -> list[float]:
        """Point of the path to programmed point."""
        position = self.named(position)
        if self.shift is not None:
            position = [value - shift for value, shift in zip(position, self.shift, strict=True)]
        return position if self.programming is IDENTITY else self.image(self.programming.inverse(), position)

    def to_machine(self, position: list[float]) -> list[float]:
        """Absolute display to machine axes."""
        if self.transformation is not None:
            position = self.transformation.to_machine(position)
        return [
            value + offset
            for value, offset in zip(self.image(self.zero, position), self.offsets, strict=True)
        ]

    def from_machine(self, machine: list[float]) -> list[float]:
        """Machine axes to absolute display."""
        inner = [value - offset for value, offset in zip(machine, self.offsets, strict=True)]
        position = self.image(self.zero.inverse(), inner)
        return position if self.transformation is None else self.transformation.to_work(position)

    @property
    def machine(self) -> list[float]:
        """Position of the machine's axes."""
        return self.to_machine(self.position)

    def arrive(self, position: list[float], programmed: list[float] | None = None) -> None:
        """The channel has moved to a position of the absolute display."""
        self.position = position
        if programmed is not None:
            self.programmed = programmed
        elif self.direct:
            self.programmed = position
        else:
            self.programmed = self.to_programmed(position)

    def arrive_machine(self, machine: list[float]) -> None:
        """The channel has moved to a machine position."""
        self.arrive(self.from_machine(machine))

    def transform(
        self,
        transformation: Transformation | None,
        geometry: tuple[int, int, int] | None = None,
        zero: tuple[Frame, list[float]] | None = None,
        naming: Transformation | None = None,
    ) -> None:
        """Let axes stand for others, or (None) for themselves again. The machine stays, the display follows.

        Args:
            transformation: How the real axes follow the displayed position.
            geometry: New columns of X, Y and Z in displayed positions; None keeps them.
            zero: What lies between it and the machine from here on, as for `set_zero`; None keeps it.
            naming: From what words name to points of the path; None where these are the same.
        """
        machine = self.machine
        self.transformation = transformation
        self._name(naming)
        self.geometry = geometry or self.geometry
        if zero is not None:
            self.zero, self.offsets = zero
        self.arrive_machine(machine)

    def name(self, naming: Transformation | None) -> None:
        """Let words name points of another system, or (None) those of the path again, which stays."""
        self._name(naming)
        self.arrive(self.position)

    def _name(self, naming: Transformation | None) -> None:
        self.naming = naming
        self.direct = self.programming is IDENTITY and self.shift is None and naming is None

    def set_programming(self, frame: Frame, shift: list[float] | None = None, *, stays: bool = True) -> None:
        """Choose the frame before the display.

        Args:
            frame: Frame of the geometry axes.
            shift: Shift of every axis, for those beside the geometry.
            stays: The position stays and the programmed point follows; else the programmed point stays, and the
                next move goes where it now lies.

        Raises:
            OverflowError: It leads beyond all machines.
        """
        _check(frame, shift or ())
        self.programming = frame
        self.shift = shift
        self.direct = frame is IDENTITY and shift is None and self.naming is None
        if stays:
            self.arrive(self.position)
        else:
            self.direct = self.direct and self.programmed == self.position

    def set_zero(self, frame: Frame, offsets: list[float], *, travelled: bool = False) -> None:
        """Choose the way from the display to the machine. The machine stays, the display follows.

        Args:
            frame: Zero frame of the geometry axes.
            offsets: Shift of every axis, tool included.
            travelled: The next incremental word of an axis travels the change as well (tool lengths).

        Raises:
            OverflowError: It leads beyond all machines; everything stays as it was.
        """
        if self.direct and frame == self.zero and offsets == self.offsets:
            return  # or the way to the machine and back would leave rounding noise
        _check(frame, offsets)
        machine = self.machine
        before = self.position
        self.zero = frame
        self.offsets = offsets
        self.arrive(self.from_machine(machine))
        if travelled:
            self.pending = [
                owed + old - new for owed, old, new in zip(self.pending, before, self.position, strict=True)
            ]
            self.owes = any(self.pending)


def _check(frame: Frame, shifts: Iterable[float]) -> None:
    """Whether what lies behind a frame and shifts is on a machine that can be.

    Raises:
        OverflowError: It is not.
    """
    if frame is not IDENTITY:
        shifts = (*shifts, *frame.t, *frame.m[0], *frame.m[1], *frame.m[2])
    if not all(-FARTHEST < shift < FARTHEST for shift in shifts):
        raise OverflowError("a shift that no machine has")
