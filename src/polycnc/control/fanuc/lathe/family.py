"""The lathe's channel, as its handlers know it."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.fanuc.lathe.control import FanucTurning
    from polycnc.control.fanuc.lathe.memory import TurningMemory

LatheChannel: TypeAlias = "Channel[FanucTurning, TurningMemory]"
