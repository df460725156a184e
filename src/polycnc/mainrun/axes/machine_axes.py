"""The axes of the machine, and which channel leads each: the one that has moved it last."""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.axes.axis import Axis
from polycnc.motion.standing.positioning import own_ramp_s

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from polycnc.channel.group import ChannelGroup
    from polycnc.machine.model import Axis as AxisData
    from polycnc.machine.model import Machine
    from polycnc.toolpath.motion_settings import MotionSettings


class Leader(Protocol):
    """A channel whose programs lead axes; positions of all of them, mm (radius) and degrees."""

    @property
    def path(self) -> list[float]:
        """Where programs have led them, of the channel that moved each last."""

    @property
    def own_path(self) -> list[float]:
        """Where its own program has led them."""

    @property
    def prepared_path(self) -> list[float]:
        """Where everything prepared leads them."""


class LedPath:
    """The path of an axis: where programs have led it by now.

    Args:
        leaders: The channels by number.
        number: One that names the axis.
        column: Its place there.
    """

    __slots__ = ("_column", "_leaders", "_number")

    due = inf  # a program says itself when something happens to it

    def __init__(self, leaders: Mapping[int, Leader], number: int, column: int) -> None:
        self._leaders, self._number, self._column = leaders, number, column

    def at(self, _time: float) -> float:
        """Its share of the setpoint; of this moment alone."""
        return self._leaders[self._number].path[self._column]

    def arrive(self, time: float) -> None:
        """A program goes on by itself."""


class MachineAxes:
    """Every axis once, however many channels name it.

    Args:
        machine: The machine.
        leaders: The channels by number; they may come later.
    """

    def __init__(self, machine: Machine, leaders: Mapping[int, Leader]) -> None:
        self._leaders = leaders
        self._axes: dict[str, Axis] = {}
        named = [name for channel in machine.channels for name in channel.axes]
        self._shared = {
            channel.number: {name: i for i, name in enumerate(channel.axes) if named.count(name) > 1}
            for channel in machine.channels
        }
        self._led_by = {name: machine.owner(name) for columns in self._shared.values() for name in columns}

    def of(self, number: int, axis_data: Sequence[AxisData], settings: MotionSettings) -> tuple[Axis, ...]:
        """The axes of a channel; those that nobody has named yet are made."""
        for column, data in enumerate(axis_data):
            if data.name not in self._axes:
                path = LedPath(self._leaders, number, column)
                self._axes[data.name] = Axis(data, own_ramp_s(data, settings), path)
        return tuple(self._axes[data.name] for data in axis_data)

    def led_by_others(self, number: int, group: ChannelGroup | None) -> Iterator[tuple[int, float]]:
        """The axes of a channel that another one leads: their columns, and where that has led them."""
        if group is None:
            return
        for name, column in self._shared[number].items():
            mover = group.moved_by[name]
            if mover != number:
                yield column, self._leaders[mover].own_path[self._shared[mover][name]]

    def taken_over(self, number: int, group: ChannelGroup | None) -> Iterator[tuple[int, float]]:
        """The axes that a channel leads from now on, and where the path of the other one has left them."""
        if group is None:
            return
        for name, column in self._shared[number].items():
            before = self._led_by[name]
            if group.moved_by[name] == number != before:
                self._led_by[name] = number
                yield column, self._leaders[before].prepared_path[self._shared[before][name]]
