"""What a program reads of its couplings (job planning 9.1, 9.3, 9.4)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.positions import shown
from polycnc.control.sinumerik.couplings import masters
from polycnc.control.sinumerik.couplings.links import Couplings, Kind
from polycnc.control.sinumerik.couplings.spindle_pairs import SYNCHRONOUS, SpindlePairs
from polycnc.control.sinumerik.tables import MINUTE
from polycnc.control.sinumerik.tangential.definitions import coupling_state
from polycnc.language.sinumerik.names.spindles import spindle_number
from polycnc.language.sinumerik.names.values import Axis, Type
from polycnc.transformation.couplings.laws import ByCurve

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, RowWithStop


def _acts(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_COUP_ACT[following]`: 4 synchronous spindle, 8 coupled motion, 16 master value, 32 gear; 0 none.

    Tangential control adds what `coupling_state` says.
    """
    named = indices[0] if indices else None
    number = spindle_number(named) if isinstance(named, Axis) else None
    if number is not None:
        pair = SpindlePairs.of(channel).acting(channel.memory.spindles.get(number).number)
        return 0 if pair is None or pair.is_slave else SYNCHRONOUS
    column = arguments.column(channel, named)
    kinds = {link.kind for link in Couplings.of(channel).links.get(column, ())}
    clocked = channel.actual.clocked
    if clocked is not None:
        kinds |= {Kind.LEAD if isinstance(law, ByCurve) else Kind.TRAIL for law in clocked.led_by(column)}
    return sum(kinds) + coupling_state(channel, column)


def _master_place(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_LEAD_P[leading]`: the place of a leading axis by which others are led."""
    column = arguments.column(channel, indices[0] if indices else None)
    return shown(channel, column, channel.actual.machine[column], work=False)


def _master_speed(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_LEAD_V[leading]`: its speed, mm/min or degrees/min; a program that reads it has waited for the axis."""
    column = arguments.column(channel, indices[0] if indices else None)
    clocked = channel.actual.clocked
    return 0.0 if clocked is None else clocked.speed(column) * MINUTE


def _offset(channel: SinumerikChannel, indices: Indices) -> float:
    """`$AA_COUP_OFFS[spindle]` and the like: from its leading spindle, degrees; 0 without a coupling."""
    number = arguments.spindle(indices[0]) if indices else None
    pair = SpindlePairs.of(channel).acting(channel.memory.spindles.get(number).number)
    return 0.0 if pair is None else pair.offset


def _master(channel: SinumerikChannel, indices: Indices) -> int:
    """`$AA_MASL_STAT[slave]`: number of the machine axis or spindle that leads it now, 0 for none."""
    return masters.master_of(channel, indices[0] if indices else None)


COUPLING_VARIABLES: dict[str, RowWithStop] = {
    "$AA_COUP_ACT": (Type.INT, _acts, None, True),
    "$AA_COUP_OFFS": (Type.REAL, _offset, None, True),
    "$VA_COUP_OFFS": (Type.REAL, _offset, None, True),
    "$AA_MASL_STAT": (Type.INT, _master, None, True),
    "$AA_LEAD_P": (Type.REAL, _master_place, None, True),
    "$AA_LEAD_V": (Type.REAL, _master_speed, None, True),
}
