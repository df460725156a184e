"""Velocities of jog by machine and setting data (job planning 6.2.7; MD32010, MD32020 and SD41110: general knowledge).

Of a rotary axis they are rpm. What nobody has written does not count: the machine knows its rapid traverse, and
geometry and orientation axes are as fast as any other axis then.
"""

from __future__ import annotations

from polycnc.control.sinumerik import tables
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.interface import HandMotion
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Degrees of a turn.
TURN_DEG = 360.0
#: Velocities of the channel by what moves: plain, rapid.
_OF_CHANNEL = {
    "geometry": ("$MC_JOG_VELO_GEO", "$MC_JOG_VELO_RAPID_GEO"),
    "orientation": ("$MC_JOG_VELO_ORI", "$MC_JOG_VELO_RAPID_ORI"),
}
#: Setting data for all axes: linear, rotary; 0 for none.
_SET = ("$SN_JOG_SET_VELO", "$SN_JOG_ROT_AX_SET_VELO")


def speed(
    channel: SinumerikChannel, column: int, what: HandMotion, place: int, *, rapid: bool
) -> float | None:
    """How fast an axis is moved by hand, mm/s or degrees/s; None for its rapid traverse.

    Args:
        channel: The channel.
        column: The axis.
        what: What it is while it moves.
        place: Which of the geometry or orientation axes it is, from 0.
        rapid: With the rapid key.
    """
    data, name = channel.memory.data, channel.axes[column]
    is_rotary = channel.axis_data[column].rotary
    unit = (TURN_DEG if is_rotary else 1.0) / tables.MINUTE
    datum = _OF_CHANNEL[what][rapid] if what in _OF_CHANNEL else ""
    if datum and (data.is_set(datum, place) or data.is_set(datum)):
        return data.number(datum, place) * unit
    if rapid:
        return (
            data.number("$MA_JOG_VELO_RAPID", name) * unit
            if data.is_set("$MA_JOG_VELO_RAPID", name)
            else None
        )
    if setting := data.number(_SET[is_rotary]):
        return setting * unit
    own = data.number("$MA_JOG_VELO", name)
    return own * (unit if data.is_set("$MA_JOG_VELO", name) else 1.0 / tables.MINUTE)
