"""Measured input B: a sensor sets tool offsets and the work shift by touch (0i-TF Plus III.2.1.3).

The machine's signals lead: GOQSM opens the list of geometry offsets for writing, WOQSM the work shift. In between a
touch writes the offset of the chosen number, and the axis is locked in the direction of the touch until it ends.
"""

from __future__ import annotations

from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.tools import screens
from polycnc.control.fanuc.lathe.tools.files import shown
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import OffsetState
from polycnc.control.fanuc.lathe.tools.screens import Page, ScreenRefusal
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel

#: Contacts: axis, direction of the touch, parameter with the machine coordinate of the sensor's face.
CONTACTS = {
    "+MIT1": ("X", 1, LatheParameters.sensor_x_plus),
    "-MIT1": ("X", -1, LatheParameters.sensor_x_minus),
    "+MIT2": ("Z", 1, LatheParameters.sensor_z_plus),
    "-MIT2": ("Z", -1, LatheParameters.sensor_z_minus),
}
OFFSETS, SHIFT = "OFST", "WSFT"


class MeasuredInputB:
    """The state of the measuring.

    Args:
        channel: The lathe.

    Attributes:
        status: What blinks in the status line: `OFST`, `WSFT`, or nothing.
        number: Offset number that the next touch writes.
        spindle: Spindle of the measured tool, 1 or 2 (S2TLS).
        locked: Axes and directions that an active contact locks.
    """

    def __init__(self, channel: LatheChannel) -> None:
        self._channel = channel
        self.status = ""
        self.number = 1
        self.spindle = 1
        self.locked: set[tuple[str, int]] = set()

    @property
    def outputs(self) -> dict[str, bool]:
        """S1MES and S2MES: which spindle is being measured at."""
        return {f"S{n}MES": self.status == OFFSETS and self.spindle == n for n in (1, 2)}

    def signal(self, name: str, *, on: bool) -> None:
        """A signal of the machine: GOQSM, WOQSM, S2TLS, WOSET, or a contact."""
        if name in ("GOQSM", "WOQSM"):
            self._open(OFFSETS if name == "GOQSM" else SHIFT, on=on)
        elif name == "S2TLS":
            if self.status != OFFSETS:
                self.spindle = 2 if on else 1
        elif name == "WOSET":
            if on:
                self._set_shift()
        elif not on:
            axis, direction, _ = CONTACTS[name]
            self.locked.discard((axis, direction))
        else:
            self._touch(name)

    def choose(self, number: int) -> None:
        """The cursor; refused where signals choose the number (5005#5 QNI)."""
        if self._channel.memory.parameters.QNI:
            raise ScreenRefusal("protected")
        self.choose_by_signal(number)

    def choose_by_signal(self, number: int) -> None:
        """OFN0 to OFN9."""
        self.number = number

    def _open(self, status: str, *, on: bool) -> None:
        if on and not self.status:
            self.status = status
            if status == SHIFT and not self._channel.memory.parameters.QNI:
                self.number = self._channel.memory.parameters.work_shift_offset or self.number
        elif not on and self.status == status:
            self.status = ""
            self.locked.clear()

    def _touch(self, contact: str) -> None:
        """The tool touches a face of the sensor: its geometry offset is the machine coordinate less the face."""
        if self.status != OFFSETS:
            raise ScreenRefusal("no-measuring")
        channel = self._channel
        if channel.memory.parameters.TS1 and contact != "+MIT1":
            return  # TS1 = 1: one contact for all directions
        axis, direction, face = CONTACTS[contact]
        self.locked.add((axis, direction))
        machine = channel.actual.machine[channel.axis_index[axis]]  # also while it is moved by hand
        value = shown(channel, axis, machine) - channel.memory.parameters.value(face)
        screens.set_offset(channel, Page.GEOMETRY, self.number, axis, value)

    def _set_shift(self) -> None:
        """WOSET: the face that the tool touches becomes Z 0 of the work coordinates."""
        if self.status != SHIFT:
            raise ScreenRefusal("no-measuring")
        channel = self._channel
        z = channel.axis_index["Z"]
        moved = channel.actual.machine[z] - channel.coordinates.machine[z]  # by hand, right now
        without_tool = channel.coordinates.position[z] + moved + OffsetState.of(channel).shift[z]
        geometry = OffsetMemory.of(channel).at(self.number).geometry.get("Z", 0.0)
        screens.add_work_shift(channel, "Z", shown(channel, "Z", without_tool - geometry, work=True))
