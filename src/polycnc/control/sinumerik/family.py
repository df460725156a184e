"""The channel that handlers of SINUMERIK work with, as a type checker knows it."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.control import Sinumerik
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.language.sinumerik.interface import NcExecutable

SinumerikChannel: TypeAlias = "Channel[Sinumerik, Memory, NcExecutable]"
