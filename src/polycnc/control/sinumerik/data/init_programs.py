"""Initialisation programs: those of the workpiece, and those that an archive puts into the working memory.

On the first start of a selected program the init program of its workpiece runs once in front of it: `<workpiece>_INI`,
or with MD11280 = 1 the files that have the name of the program. Init files of an archive that name no directory belong
to the working memory and are read in at power-on; what `_N_INITIAL_INI` does not contain takes its standard value,
machine data excepted (job planning 2.1, 2.2).
"""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.frame import NEUTRAL
from polycnc.program.names import WORKING_MEMORY, WORKPIECE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.program import Program

INITIAL = "_N_INITIAL_INI"
#: Types of files with the name of the program that MD11280 = 1 runs.
TYPES = ("INI", "SEA", "GUD", "RPA", "UFR", "TOA")


@dataclass(slots=True)
class InitialisedState(State, lifetime=Lifetime.POWER):
    """What init programs have run for.

    Attributes:
        memory: The working memory has taken in its files.
        main: Directory and name of the main program that those of its workpiece have run for.
    """

    memory: bool = False
    main: tuple[str, str] | None = None


def call(channel: SinumerikChannel) -> None:
    """Let the init programs run in front of the main program, those of the working memory first.

    Each runs once: in front of the first program, and at the first start of another program of a workpiece. What is
    typed in is no such program.
    """
    state, main = InitialisedState.of(channel), channel.stack[0].code.program
    if not main.directory:
        return
    programs: list[Program] = []
    if not state.memory:
        programs += channel.store.programs_in(WORKING_MEMORY)
        state.memory = bool(programs)
    if main.directory.endswith(WORKPIECE) and state.main != (main.directory, main.name):
        state.main = (main.directory, main.name)
        programs += _of_workpiece(channel, main)
    if any(program.name == INITIAL for program in programs):
        _standard_values(channel)
    for program in reversed(programs):
        channel.push(program, kind=LevelKind.SUBPROGRAM, local=[])


def _of_workpiece(channel: SinumerikChannel, main: Program) -> Iterator[Program]:
    memory = channel.memory
    if memory.data.integer("$MN_WPD_INI_MODE"):
        names = [f"{main.name.rpartition('_')[0]}_{type_}" for type_ in TYPES]
    else:
        names = [main.directory.rpartition("/")[2].removesuffix(WORKPIECE) + "_INI"]
    found = (channel.store.find_in(main.directory, name) for name in names)
    yield from (program for program in found if program is not None)


def _standard_values(channel: SinumerikChannel) -> None:
    """Before INITIAL_INI: no tools, no zero offsets, delivered setting data; machine data stay."""
    memory = channel.memory
    frames = memory.frames
    frames.settable[:] = [NEUTRAL] * len(frames.settable)
    frames.base[:] = [NEUTRAL] * len(frames.base)
    memory.tools.tools.clear()
    memory.data.forget_settings()
