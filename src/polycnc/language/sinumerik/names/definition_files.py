"""Definition files: global user variables and macros, read when a channel starts (1.1.5, 1.26).

Macros come first, so that files of user data can use them; rights (ACCESS files) come last, as they are about names
that exist. Siemens' own files come before those of the builder, and these before the user's and GUD4 to GUD9.
"""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.initialisation import remember_first_values
from polycnc.language.sinumerik.names.variables import Array
from polycnc.messages import AlarmError
from polycnc.program.names import DEF_DIR

if TYPE_CHECKING:
    from polycnc.language.sinumerik.executable import SinumerikProgram
    from polycnc.language.sinumerik.interface import LanguageMemory, NcChannel
    from polycnc.language.sinumerik.names.variables import Variable
    from polycnc.program import Program

_NAME = regex(r"_N_(?P<owner>[A-Z]?)(?P<kind>MAC|GUD|ACCESS)(?P<number>\d?)_DEF")
_KINDS = ("MAC", "GUD", "ACCESS")
_OWNERS = "SPMIU"
_ENDS = frozenset({"M30", "M17", "M2", "M02", "RET"})


def load_definitions(channel: NcChannel) -> None:
    """Run the blocks of every definition file, once compiled; an alarm in one stands in that file."""
    for program in sorted(channel.store.programs_in(DEF_DIR), key=_rank):
        _run(channel.executable(program).whole, channel)
    memory: LanguageMemory = channel.memory.language
    remember_first_values(memory)
    for name, variable in memory.global_variables.items():
        if variable.range != "NCK":
            _keep(variable, memory.user_variables)
        elif name in memory.nck_variables:
            memory.global_variables[name] = memory.nck_variables[name]
        else:
            memory.nck_variables[name] = variable
            _keep(variable, memory.nck_user_variables)


def _keep(variable: Variable, table: dict[str, list[Any]]) -> None:
    """A variable has the values that are retained, where there are such of its type and size.

    Those with INIPO begin with the power (1.1.7).
    """
    if variable.init_time == "INIPO" or variable.store is None:
        table.pop(variable.name, None)
        return
    held = variable.store[0]
    values = held.items if isinstance(held, Array) else variable.store
    kept = table.get(variable.name, [])
    if list(map(type, kept)) != list(map(type, values)):
        table[variable.name] = values
    elif isinstance(held, Array):
        held.items = kept
    else:
        variable.store = kept


def _rank(program: Program) -> tuple[int, str, str]:
    """When a file is read: macros, user data, rights; each by owner. A file of another name counts by its text."""
    found = _NAME.fullmatch(program.name)
    if found is None:
        defines = any(line.split(maxsplit=1)[:1] == ["DEFINE"] for line in map(str.upper, program.lines))
        return _KINDS.index("MAC" if defines else "GUD"), "~", program.name
    owner = found["owner"]
    place = str(_OWNERS.index(owner)) if owner and owner in _OWNERS else "5" + found["number"]
    return _KINDS.index(found["kind"]), place, program.name


def _run(code: SinumerikProgram, channel: NcChannel) -> None:
    for index in range(len(code)):
        try:
            tokens = code.tokens(index, channel)
            if tokens[0].text in _ENDS:
                return
            code.compiled(index, channel).step(channel)
        except AlarmError as error:
            error.line = code.line(index)
            error.program = channel.toolpath.program_number(code.program.name)
            raise
