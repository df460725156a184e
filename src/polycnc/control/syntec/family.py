"""The channel that handlers of SYNTEC work with, as a type checker knows it."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.control import SyntecMill
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.language.syntec.layout import NumberedProgram

SyntecChannel: TypeAlias = "Channel[SyntecMill, SyntecMemory, NumberedProgram]"
