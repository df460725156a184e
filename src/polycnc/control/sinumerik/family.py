"""The channel that handlers of SINUMERIK work with, as a type checker knows it."""

from __future__ import annotations

from polycnc.control.interface import Control
from polycnc.deferred.typing import TYPE_CHECKING, Protocol, TypeAlias
from polycnc.language.sinumerik.interface import LanguageControl

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.memory import Memory
    from polycnc.language.sinumerik.interface import NcExecutable


class HandlersControl(Control, LanguageControl, Protocol):
    """What handlers ask of the control; so they need not know the class that knows all of them."""


SinumerikChannel: TypeAlias = "Channel[HandlersControl, Memory, NcExecutable]"
