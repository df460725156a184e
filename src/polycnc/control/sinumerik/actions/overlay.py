"""`$AA_OFF[axis]`: a motion that an action lays over an axis, within the limit of SD43350 (10.4.8).

MD36750 bit 0 says whether what is written is the shift, or is added to it in every cycle. It moves no faster than
MD32020, and coordinates do not know of it. CORROF takes it away: the axis stays, coordinates know of it then.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block import arguments
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop

_INTEGRAL = 1
NAME = "AA_OFF"


@dataclass(slots=True)
class Overlays(State, lifetime=Lifetime.POWER):
    """Shifts that actions have asked for, by column, within their limits: mm or degrees."""

    values: dict[int, float] = field(default_factory=dict)


def _column(channel: SinumerikChannel, indices: Indices) -> int:
    return arguments.column(channel, indices[0] if indices else None)


def _limit(channel: SinumerikChannel, column: int) -> float:
    return channel.memory.data.number("$SA_AA_OFF_LIMIT", channel.axes[column])


def _write(channel: SinumerikChannel, indices: Indices, value: float) -> None:
    column, overlays = _column(channel, indices), Overlays.of(channel).values
    name, data = channel.axes[column], channel.memory.data
    if data.integer("$MA_AA_OFF_MODE", name) & _INTEGRAL:
        value += overlays.get(column, 0.0)
    limit = _limit(channel, column)
    overlays[column] = value = min(max(value, -limit), limit)
    clocked = channel.actual.clocked
    if clocked is not None:
        clocked.overlay(column, value, data.number("$MA_JOG_VELO", name) / tables.MINUTE)


def _read(channel: SinumerikChannel, indices: Indices) -> float:
    return Overlays.of(channel).values.get(_column(channel, indices), 0.0)


def _at_limit(channel: SinumerikChannel, indices: Indices) -> int:
    """1 or -1 where the shift has reached its limit."""
    column = _column(channel, indices)
    value, limit = Overlays.of(channel).values.get(column, 0.0), _limit(channel, column)
    return (value >= limit) - (value <= -limit)


def take_away(channel: SinumerikChannel, args: Arguments) -> None:
    """CORROF(axis,"AA_OFF",…): the shift is no more; the axis stays where it is, and the program knows it there."""
    pairs = list(zip(args[::2], args[1::2], strict=False))
    if len(args) % 2 or any(
        not isinstance(axis, Axis) or str(what).upper() not in (NAME, "DRF") for axis, what in pairs
    ):
        raise AlarmError("14020", text="CORROF")
    columns = [arguments.column(channel, axis) for axis, what in pairs if str(what).upper() == NAME]
    clocked = channel.actual.clocked
    if clocked is None or not columns:
        return
    channel.flush()
    channel.synchronise()
    machine = channel.coordinates.machine
    for column in columns:
        Overlays.of(channel).values.pop(column, None)
        machine[column] = clocked.take_in_overlay(column)
    channel.coordinates.arrive_machine(machine)


OVERLAY_VARIABLES: dict[str, RowWithStop] = {
    "$AA_OFF": (Type.REAL, _read, _write, True),
    "$AA_OFF_VAL": (Type.REAL, _read, None, True),
    "$AA_OFF_LIMIT": (Type.INT, _at_limit, None, True),
}
