"""Where a machine changes tools: at the reference points that `magazine.change_at` of its file names."""

from __future__ import annotations

from math import nan

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.channel.channel import Channel

#: How close to a reference point an axis must stand, mm or degrees.
WINDOW = 0.01


def stands_at(channel: Channel, axis: int, points: Iterable[int], position: Sequence[float]) -> bool:
    """Whether an axis stands at one of its reference points (1 to 4) while the machine position is this."""
    reference = channel.control.reference_point
    return any(abs(position[axis] - reference(channel, axis, number)) <= WINDOW for number in points)


def z_stands_at_change_point(channel: Channel) -> bool:
    """Whether Z stands now where tools are changed, or the change leads it there, or may be anywhere."""
    z, magazine = channel.coordinates.geometry[2], channel.machine.magazine
    points = magazine.change_at.get(channel.axis_data[z].name) if z >= 0 else None
    return points is None or magazine.retracts or stands_at(channel, z, points, channel.actual.machine)


def stands_at_reference(channel: Channel, axis: int) -> bool:
    """Whether an axis stands at its first reference point now."""
    return stands_at(channel, axis, (1,), channel.actual.machine)


def way_to_change(channel: Channel) -> list[list[float]]:
    """Machine positions through which a tool change leads the axes, one axis after the other; none where they stand.

    Raises:
        AlarmError: PC0012 for an axis that the program should have brought there, unless the machine's own controller
            has an alarm for it.
    """
    magazine = channel.machine.magazine
    columns = {data.name: axis for axis, data in enumerate(channel.axis_data)}
    asks_for_z = "Z_AT_CHANGE_POINT" in channel.machine.plc(channel.control.id).asked
    machine = channel.coordinates.machine
    way: list[list[float]] = []
    for name, points in magazine.change_at.items():
        axis = columns.get(name, -1)
        if axis < 0 or stands_at(channel, axis, points, machine):
            continue
        if magazine.retracts:
            machine = machine.copy()
            machine[axis] = channel.control.reference_point(channel, axis, points[0])
            way.append(machine)
        elif axis != channel.coordinates.geometry[2] or not asks_for_z:
            raise AlarmError("PC0012", axis=channel.axes[axis])
    return way


def follow(channel: Channel, way: list[list[float]]) -> None:
    """Lead the axes through machine positions at rapid."""
    for machine in way:
        channel.straight(Kind.RAPID, channel.coordinates.from_machine(machine), nan)
