"""Axes and spindles that several channels use: RELEASE, GET, GETD, AXTOCHAN (job planning 1.15, 1.16).

Who owns an axis is known once for all channels. A channel that programs an axis which is free takes it without GET;
it waits where another channel has it. At power-on an axis belongs to the first channel that the machine names for it.
"""

from __future__ import annotations

from polycnc.channel.waits import Wait, Why
from polycnc.control.sinumerik.block.arguments import Arguments, Procedure
from polycnc.control.sinumerik.channels.coordination import group_of
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.actions import axes as action_axes
    from polycnc.control.sinumerik.block import arguments

with loaded_when_called():
    from polycnc.control.sinumerik.tools import stages

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.sinumerik.family import SinumerikChannel

NOBODY = 0


def _owners(channel: SinumerikChannel) -> dict[str, int]:
    """Number of the channel that owns an axis or a spindle, by names of the machine."""
    owners = group_of(channel).owner
    if "S1" not in owners:
        for each in channel.machine.channels:
            for number in each.spindles:
                owners.setdefault(f"S{number}", each.number)
    return owners


def shares_axes(channel: SinumerikChannel) -> bool:
    """Whether any axis of the channel can be used by another one."""
    own = set(channel.machine.channel(channel.number).axes)
    return any(own & set(each.axes) for each in channel.machine.channels if each.number != channel.number)


def name_on_machine(channel: SinumerikChannel, column: int) -> str:
    """What the machine calls an axis of a channel."""
    return channel.machine.channel(channel.number).axes[column]


def _named(channel: SinumerikChannel, args: Iterable[Any]) -> list[str]:
    """The axes and spindles of arguments, by names of the machine."""
    found = []
    for value in args:
        if isinstance(value, Axis) and value.name in _owners(channel) and value.name[0] == "S":
            found.append(value.name)
        else:
            found.append(name_on_machine(channel, arguments.column(channel, value)))
    return found


# ---- taking


def ready(channel: SinumerikChannel, columns: Iterable[int]) -> bool:
    """Whether a block may move these axes now; else the channel waits and runs the block again.

    A block that only describes a contour moves none.
    """
    if channel.path.is_diverted:
        return True
    columns = tuple(columns)
    if action_axes.may_be_away(channel, columns):
        stages.end_blocks(channel)
        action_axes.give_back(channel, columns)
    axes = [name_on_machine(channel, column) for column in columns]
    if all(_is_free(channel, axis) for axis in axes):
        moved_by = group_of(channel).moved_by
        if any(moved_by.get(axis, channel.number) != channel.number for axis in axes):
            channel.flush()
            channel.synchronise()
        take(channel, axes)
        return True
    channel.level.index = channel.level.current
    channel.wait = Wait(Why.CHANNEL, until=lambda: all(_is_free(channel, axis) for axis in axes))
    return False


def _is_free(channel: SinumerikChannel, axis: str) -> bool:
    return _owners(channel)[axis] in (NOBODY, channel.number)


def take(channel: SinumerikChannel, axes: Iterable[str]) -> None:
    """Own axes from now on, where they stand now."""
    owners, moved_by = _owners(channel), group_of(channel).moved_by
    names = channel.machine.channel(channel.number).axes
    places: dict[int, float] = {}
    for axis in axes:
        owners[axis] = channel.number
        if moved_by.get(axis, channel.number) != channel.number:
            if not places:
                channel.flush()
            places[names.index(axis)] = position(channel, axis)
            moved_by[axis] = channel.number
    if places:
        action_axes.call(channel, "GET", places)


def position(channel: SinumerikChannel, axis: str) -> float:
    """Where an axis stands on the machine, as the channel knows that moved it last."""
    group_of(channel).channel(group_of(channel).moved_by[axis]).flush()
    return standing(channel, axis)


def standing(channel: SinumerikChannel, axis: str) -> float:
    """The same of an axis that the channel has nothing to do with any more; what its actions have moved counts."""
    mover: SinumerikChannel = group_of(channel).channel(group_of(channel).moved_by[axis])
    column, clocked = column_of(mover, axis), mover.actual.clocked
    if clocked is not None and action_axes.may_be_away(mover, (column,)):
        return clocked.take_back(column)
    return mover.coordinates.machine[column]


def column_of(channel: SinumerikChannel, axis: str) -> int:
    """The column that an axis of the machine has in a channel."""
    return channel.machine.channel(channel.number).axes.index(axis)


# ---- procedures


def release(channel: SinumerikChannel, args: Arguments) -> None:
    """RELEASE(axis, …): other channels may have them; what the channel does not own stays where it is."""
    channel.flush()
    channel.synchronise()
    owners = _owners(channel)
    for axis in _named(channel, _some(args, "RELEASE")):
        if owners[axis] == channel.number:
            owners[axis] = NOBODY
            action_axes.forget(channel, axis)


def get(channel: SinumerikChannel, args: Arguments) -> None:
    """GET(axis, …): wait until nobody else has them, then take them."""
    channel.flush()
    channel.synchronise()
    axes = _named(channel, _some(args, "GET"))

    def taken() -> bool:
        free = all(_is_free(channel, axis) for axis in axes)
        if free:
            take(channel, axes)
        return free

    if not taken():
        channel.wait = Wait(Why.CHANNEL, until=taken)


def get_directly(channel: SinumerikChannel, args: Arguments) -> None:
    """GETD(axis, …): take them from whatever channel has them."""
    channel.flush()
    channel.synchronise()
    take(channel, _named(channel, _some(args, "GETD")))


def to_channel(channel: SinumerikChannel, args: Arguments) -> None:
    """AXTOCHAN(axis, n, …): give axes to channels; to the calling one as GET does."""
    if not args or len(args) % 2:
        raise AlarmError("14020", text="AXTOCHAN")
    channel.flush()
    channel.synchronise()
    own: list[Any] = []
    for axis, value in zip(args[::2], args[1::2], strict=True):
        number = arguments.whole(value)
        if not group_of(channel).has(number):
            raise AlarmError("14020", text=f"AXTOCHAN({number})")
        if number == channel.number:
            own.append(axis)
        else:
            (name,) = _named(channel, (axis,))
            _owners(channel)[name] = number
    if own:
        get(channel, tuple(own))


def _some(args: Arguments, name: str) -> Arguments:
    if not args:
        raise AlarmError("14020", text=name)
    return args


PROCEDURES: dict[str, Procedure] = {
    "RELEASE": release,
    "GET": get,
    "GETD": get_directly,
    "AXTOCHAN": to_channel,
}
