"""The channels that handlers of the word-address base work with, as a type checker knows them."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.stack import Executable
    from polycnc.control.word_address.control import WordAddressControl
    from polycnc.control.word_address.machining_centre import MillingControl
    from polycnc.control.word_address.macro_b.custom_macro import CustomMacroControl
    from polycnc.control.word_address.macro_b.variables import MacroMemory
    from polycnc.control.word_address.memory import Memory
    from polycnc.language.word_address import WordAddressProgram

#: Of every word-address control.
WordAddressChannel: TypeAlias = "Channel[WordAddressControl, Memory, Executable]"
#: Of mills with custom macro B.
MillingChannel: TypeAlias = "Channel[MillingControl, MacroMemory, WordAddressProgram]"
#: Of all controls with custom macro B.
MacroChannel: TypeAlias = "Channel[CustomMacroControl, MacroMemory, WordAddressProgram]"
