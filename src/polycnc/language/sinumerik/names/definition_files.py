"""Definition files: global user variables and macros, read when a channel starts (1.1.5, 1.26)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.language.sinumerik.names.initialisation import remember_first_values
from polycnc.messages import AlarmError
from polycnc.program.names import DEF_DIR

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.interface import LanguageMemory
    from polycnc.program import Program

_ENDS = frozenset({"M30", "M17", "M2", "M02", "RET"})


def load_definitions(channel: Channel, compiled: Callable[[Program], SinumerikProgram]) -> None:
    """Run the blocks of every definition file, once compiled; an alarm in one stands at the program's start."""
    for program in channel.store.programs_in(DEF_DIR):
        try:
            _run(compiled(program), channel)
        except AlarmError as error:
            error.column = 0
            raise
    memory: LanguageMemory = channel.memory.language
    remember_first_values(memory)
    for name, variable in memory.global_variables.items():
        if variable.range == "NCK":
            memory.global_variables[name] = memory.nck_variables.setdefault(name, variable)


def _run(code: SinumerikProgram, channel: Channel) -> None:
    for index in range(len(code)):
        tokens = code.tokens(index, channel)
        if tokens[0].text in _ENDS:
            return
        code.compiled(index, channel).step(channel)
