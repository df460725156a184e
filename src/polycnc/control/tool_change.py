"""Where a machine changes tools: at the reference points that `magazine.change_at` of its file names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.channel.channel import Channel

#: How close to a reference point an axis must stand, mm or degrees.
WINDOW = 0.01
#: Reference points of Z where machines change tools whose file does not say.
USUAL_POINTS = (1, 2)


def stands_at(channel: Channel, axis: int, points: Iterable[int], position: Sequence[float]) -> bool:
    """Whether an axis stands at one of its reference points (1 to 4) while the machine position is this."""
    reference = channel.control.reference_point
    return any(abs(position[axis] - reference(channel, axis, number)) <= WINDOW for number in points)


def z_stands_at_change_point(channel: Channel) -> bool:
    """Whether Z stands now where tools are changed, or there is none."""
    z = channel.coordinates.geometry[2]
    return z < 0 or stands_at(channel, z, change_points(channel, z), channel.actual.machine)


def stands_at_reference(channel: Channel, axis: int) -> bool:
    """Whether an axis stands at its first reference point now."""
    return stands_at(channel, axis, (1,), channel.actual.machine)


def change_points(channel: Channel, axis: int) -> tuple[int, ...]:
    """The reference points at which the axis Z stands for a change."""
    return channel.machine.magazine.change_at.get(channel.axis_data[axis].name, USUAL_POINTS)


def check_change_points(channel: Channel) -> None:
    """Refuse a tool change while an axis stands elsewhere than the machine file asks for.

    Raises:
        AlarmError: PC0012. Machines whose own controller has an alarm for it give that one before (`plc.toml`).
    """
    for axis, data in enumerate(channel.axis_data):
        points = channel.machine.magazine.change_at.get(data.name)
        if points is not None and not stands_at(channel, axis, points, channel.coordinates.machine):
            raise AlarmError("PC0012", axis=channel.axes[axis])
