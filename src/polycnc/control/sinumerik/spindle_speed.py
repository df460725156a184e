"""Constant cutting speed: what G96 needs, and the speed that G97 keeps.

Source: Fundamentals (G96, G961, G97, G971, LIMS).
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.memory import Memory

MM_PER_M = 1000.0
KEEPS_SPEED = frozenset(("G97", "G971", "G973"))


def change_of_feed_type(channel: Channel, surface_speed: bool, code: str) -> None:
    """Enter or leave constant cutting speed; alarm 10870 for a channel without transverse axis."""
    memory: Memory = channel.memory
    if surface_speed and memory.transverse < 0:
        raise AlarmError("10870")
    spindle = memory.spindles.all.get(memory.spindles.master)
    if spindle is not None and code in KEEPS_SPEED and spindle.cutting_speed:
        spindle.speed = speed_at(channel, spindle.cutting_speed, spindle.limit)


def is_settled(channel: Channel, surface_speed: bool, code: str) -> bool:
    """Whether the kind of feed that is in force would change nothing and not alarm when it is written again.

    S words under G97 do not change a cutting speed, so what holds stays.
    """
    memory: Memory = channel.memory
    if surface_speed:
        return memory.transverse >= 0
    spindle = memory.spindles.all.get(memory.spindles.master)
    return code not in KEEPS_SPEED or spindle is None or not spindle.cutting_speed


def speed_at(channel: Channel, cutting_speed: float, limit: float) -> float:
    """Speed (rpm) for a cutting speed (m/min) where the transverse axis stands, at most the limit."""
    diameter = 2.0 * abs(channel.coordinates.position[channel.memory.transverse])
    return min(limit, MM_PER_M * cutting_speed / (pi * diameter)) if diameter > 0.0 else limit
