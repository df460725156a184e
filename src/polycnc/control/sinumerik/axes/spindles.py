"""Spindles that are axes as well: where the spindle is positioned, the axis stands (job planning 6.8).

The examples of TRANSMIT and TRACYL begin with SPOS for that reason: the path goes on from there.
"""

from __future__ import annotations

from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.actions import axes as action_axes
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle


def axis_of(channel: SinumerikChannel, number: int) -> int:
    """Column of the axis that a spindle is; -1 where it is none of the channel's."""
    spindle = channel.machine.spindle.get(number)
    names = [axis.name for axis in channel.axis_data]
    return names.index(spindle.axis) if spindle is not None and spindle.axis in names else -1


def all_of(channel: SinumerikChannel) -> list[int]:
    """Columns of the axes that are spindles as well."""
    found = (axis_of(channel, number) for number in sorted(channel.machine.spindle))
    return [column for column in found if column >= 0]


def follow_axis(channel: SinumerikChannel, spindle: Spindle) -> None:
    """A spindle that does not turn is where its axis has gone since."""
    column = axis_of(channel, spindle.number)
    if column >= 0 and spindle.direction == 0:
        spindle.position = channel.coordinates.machine[column] % tables.TURN


def stand(channel: SinumerikChannel, spindle: Spindle, *, awaited: bool) -> None:
    """The axis of a spindle stands where that has been positioned; the block of SPOS waits for it.

    Raises:
        AlarmError: 17610 for an axis that a transformation uses up.
    """
    column = axis_of(channel, spindle.number)
    if column < 0:
        return
    seat.refuse_transformed(channel, (column,), "17610")
    coordinates = channel.coordinates
    machine = coordinates.machine
    if machine[column] % tables.TURN == spindle.position % tables.TURN:
        return
    machine[column] = spindle.position
    end = coordinates.from_machine(machine)
    action_axes.position_beside(channel, column, end)
    coordinates.arrive(end)
    if awaited:
        action_axes.await_positioned(channel, column)


def orient(channel: SinumerikChannel, spindle: Spindle, angle: float) -> None:
    """M19, and SPOS of a cycle: the spindle stops and stands at an angle, degrees; its axis stands there too."""
    spindle.position, spindle.direction, spindle.controlled = angle % tables.TURN, 0, True
    channel.context_changed()
    stand(channel, spindle, awaited=True)


def wait(channel: SinumerikChannel, number: int) -> None:
    """WAITS: the block ends when the axis of a spindle stands that SPOSA has positioned."""
    column = axis_of(channel, number)
    if column >= 0:
        action_axes.await_positioned(channel, column)
