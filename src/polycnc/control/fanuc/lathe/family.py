"""The lathe's channel, as its handlers know it."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.fanuc.lathe.control import FanucTurning
    from polycnc.control.fanuc.lathe.memory import TurningMemory
    from polycnc.language.word_address import WordAddressProgram

LatheChannel: TypeAlias = "Channel[FanucTurning, TurningMemory, WordAddressProgram]"
