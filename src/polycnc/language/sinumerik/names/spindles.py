"""Identifiers of spindles, `S1` and so on, and the axes that spindles are as well (job planning 14.1)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


def spindle_number(axis: Axis) -> int | None:
    """Number of the spindle that an identifier means; None for an axis."""
    number = axis.name[1:]
    return int(number) if axis.name[:1] == "S" and number.isdecimal() else None


def axis_of_spindle(channel: Channel, axis: Axis) -> Axis:
    """The channel's axis that a spindle is in axis mode; the identifier itself where it is none."""
    number = spindle_number(axis)
    spindle = None if number is None else channel.machine.spindle.get(number)
    return Axis(spindle.axis) if spindle is not None and spindle.axis in channel.axes else axis
