"""Machine data that say what the machine is: as its file tells it, unless the setup or a program names others."""

from __future__ import annotations

from math import isfinite

from polycnc.control.sinumerik.tables import MM_PER_M
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.channel import Channel

Key = tuple[str, tuple[int | str, ...]]


def built(channel: Channel) -> dict[Key, object]:
    """The data, by name and index; of an axis by the channel's name of it (machine data of the axis configuration)."""
    return dict((*_of_names(channel), *_of_axes(channel)))


def _of_names(channel: Channel) -> Iterator[tuple[Key, object]]:
    machine = channel.machine
    for number, axis in enumerate(machine.axes):
        yield ("$MN_AXCONF_MACHAX_NAME_TAB", (number,)), axis.machine_name
    for column, axis in enumerate(channel.axis_data):
        yield ("$MC_AXCONF_CHANAX_NAME_TAB", (column,)), channel.axes[column]
        yield ("$MC_AXCONF_MACHAX_USED", (column,)), machine.axis_number(axis.name)
    geometry = machine.geometry_indices(channel.number)
    for place, (letter, column) in enumerate(zip(GEOMETRY_AXES, geometry, strict=True)):
        yield ("$MC_AXCONF_GEOAX_NAME_TAB", (place,)), letter
        yield ("$MC_AXCONF_GEOAX_ASSIGN_TAB", (place,)), column + 1


def _of_axes(channel: Channel) -> Iterator[tuple[Key, object]]:
    for name, axis in zip(channel.axes, channel.axis_data, strict=True):
        yield ("$MA_IS_ROT_AX", (name,)), axis.rotary
        yield ("$MA_ROT_IS_MODULO", (name,)), axis.modulo
        if isfinite(axis.limit_minus):
            yield ("$MA_POS_LIMIT_MINUS", (name,)), axis.limit_minus
        if isfinite(axis.limit_plus):
            yield ("$MA_POS_LIMIT_PLUS", (name,)), axis.limit_plus
        if axis.rapid > 0.0:
            yield ("$MA_MAX_AX_VELO", (name,)), axis.rapid * 60.0
        if axis.acceleration > 0.0:
            yield ("$MA_MAX_AX_ACCEL", (name,)), axis.acceleration / MM_PER_M
