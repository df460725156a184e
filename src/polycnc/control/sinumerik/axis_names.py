"""Names of axes: of the channel, of the geometry, and of the machine."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import GEOMETRY_AXES
from polycnc.language.sinumerik.names.values import Axis

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


def identifiers(channel: Channel) -> dict[str, Axis]:
    """Every axis and spindle identifier that programs of the channel may use, with the axis it means."""
    names = {name: Axis(name) for name in channel.axes}
    virtual = channel.machine.channel(channel.number).virtual
    for letter, column in zip(GEOMETRY_AXES, channel.coordinates.geometry, strict=True):
        if column >= 0 or letter in virtual:
            names.setdefault(letter, Axis(letter))
    for axis in channel.axis_data:
        for alias in axis.aliases:
            names.setdefault(alias, Axis(alias))
        for name in (axis.machine_name, f"AX{channel.machine.axis_number(axis.name)}"):
            if name:
                names.setdefault(name.upper(), Axis(name.upper()))
    for spindle in channel.machine.spindles:
        names.setdefault(f"S{spindle.number}", Axis(f"S{spindle.number}"))
    return names


def columns(channel: Channel) -> dict[str, int]:
    """Columns by channel and geometry names."""
    found = {name: i for i, name in enumerate(channel.axes)}
    for i, axis in enumerate(channel.axis_data):
        for alias in axis.aliases:
            found.setdefault(alias, i)
    for letter, column in zip(GEOMETRY_AXES, channel.coordinates.geometry, strict=True):
        if column >= 0:
            found.setdefault(letter, column)
    return found


def machine_columns(channel: Channel) -> dict[str, int]:
    """Columns by machine axis names: of the machine, of its machine data, and AX1 and so on."""
    found = {f"AX{channel.machine.axis_number(axis.name)}": i for i, axis in enumerate(channel.axis_data)}
    found.update({axis.machine_name.upper(): i for i, axis in enumerate(channel.axis_data)})
    return found
