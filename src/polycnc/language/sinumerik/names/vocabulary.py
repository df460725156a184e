"""What a name is: STRINGIS and ISVAR (job planning 14.4, 14.5)."""

from __future__ import annotations

import re

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.statements.calls import find_program
from polycnc.messages import AlarmError
from polycnc.program.names import CYCLE_DIRS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.language.sinumerik.interface import NcChannel
    from polycnc.language.sinumerik.names.scope import Scope

#: Results of STRINGIS.
UNKNOWN, ADDRESS, G_FUNCTION, FUNCTION, PROCEDURE, KEYWORD = 0, 201, 202, 203, 204, 205
MACHINE_DATUM, SYSTEM_VARIABLE, CYCLE, GLOBAL_VARIABLE, MACRO, LOCAL_VARIABLE, FIXED_ADDRESS = (
    206, 207, 208, 209, 210, 211, 400,
)  # fmt: skip

_AXIS_LETTERS = regex(r"[ABCEI-KQU-Z]\d*", re.ASCII)
_FIXED_LETTERS = frozenset("DFGHLMNOPST")
_G = regex(r"G(\d+)", re.ASCII)
_R = regex(r"\$?R\d*", re.ASCII)
_DATUM = regex(r"\$\$?[MSO][NCA]?_?", re.ASCII)
_VARIABLE = regex(r"\s*(\$?\$?\w+)\s*(?:\[([^\[\]]*)\])?\s*", re.ASCII)

#: Alarms for indices that a variable does not take.
_INDEX_ALARMS = frozenset({"12400", "17020", "17030", "17035"})

_KEYWORDS = (
    keywords.MODIFIERS
    | keywords.PARTS
    | keywords.DEFINITIONS
    | keywords.STRUCTURE
    | keywords.OPERATORS
    | keywords.CALLS
    | keywords.SYNCHRONOUS
    | {"AP", "RP", "SETMS"}
)
_FUNCTIONS = frozenset(
    {
        *keywords.FUNCTIONS,
        *keywords.SAME_TYPE_FUNCTIONS,
        *keywords.FRAME_FUNCTIONS,
        *keywords.CONTROL_FUNCTIONS,
        *keywords.NAME_FUNCTIONS,
        *keywords.FILE_FUNCTIONS,
    }
)
_PROCEDURES = frozenset({*keywords.PROCEDURES, *keywords.FILE_PROCEDURES, *keywords.SINGLE_BLOCK, "SETINT"})


def string_is(channel: Channel, scope: Scope, name: str) -> int:
    """STRINGIS: the kind of name, as the numbers of the manual's table."""
    name = name.strip().upper()
    if name in scope.variables:
        return LOCAL_VARIABLE
    if name in scope.memory.global_variables:
        return GLOBAL_VARIABLE
    if scope.macro(name) is not None:
        return MACRO
    if name.startswith("$"):
        return _system_kind(scope, name)
    return _word_kind(channel, scope, name)


def _word_kind(channel: Channel, scope: Scope, name: str) -> int:
    g = _G.fullmatch(name)
    if name in scope.control.g_groups or (g and f"G{int(g[1])}" in scope.control.g_groups):
        return G_FUNCTION
    if _R.fullmatch(name):
        return SYSTEM_VARIABLE
    if name in _FIXED_LETTERS:
        return FIXED_ADDRESS
    kinds = (
        (name in _KEYWORDS, KEYWORD),
        (bool(_AXIS_LETTERS.fullmatch(name)) or name in keywords.ADDRESSES, ADDRESS),
        (name in _FUNCTIONS, FUNCTION),
        (name in _PROCEDURES or name in keywords.INDEXED_WORDS, PROCEDURE),
    )
    kind = next((kind for applies, kind in kinds if applies), UNKNOWN)
    if kind or len(name) < 2:
        return kind
    program = find_program(channel, name)
    loaded = program is not None and program.directory in CYCLE_DIRS
    return CYCLE if loaded or name in keywords.CYCLES else UNKNOWN


def _system_kind(scope: Scope, name: str) -> int:
    if name.startswith("$TC_MP") or not _is_system_variable(scope, name):
        return UNKNOWN  # magazine data exist only under magazine management
    return MACHINE_DATUM if _DATUM.match(name) else SYSTEM_VARIABLE


def _is_system_variable(scope: Scope, name: str) -> bool:
    if _R.fullmatch(name):
        return True
    try:
        scope.control.system_variable(name)
    except AlarmError as alarm:
        return alarm.code != "12550"
    return True


def is_variable(channel: Channel, scope: Scope, text: str) -> bool:
    """ISVAR: a variable with the right number of indices, each inside its dimension where it is written."""
    found = _VARIABLE.fullmatch(text)
    if found is None:
        return False
    name = found[1].upper()
    indices = None if found[2] is None else [index.strip() for index in found[2].split(",")]
    variable = scope.find(name)
    if variable is None and name[0] == "R" and (name[1:].isdecimal() or (name == "R" and indices)):
        number = name[1:] or (indices or [""])[0]
        return number.isdecimal() and int(number) < len(scope.memory.r)
    if variable is None:
        return (
            name.startswith("$")
            and _is_system_variable(scope, name)
            and _takes(channel, scope, name, indices)
        )
    if indices is None:
        return True
    return len(indices) == len(variable.dims) and all(
        not index or (index.isdecimal() and int(index) < size)
        for index, size in zip(indices, variable.dims, strict=True)
    )


def _takes(channel: Channel, scope: Scope, name: str, indices: list[str] | None) -> bool:
    """Whether a system variable takes these indices; names of axes are not checked (job planning 14.5)."""
    places = [
        int(index) if index.isdecimal() else scope.memory.axes.get(index.upper()) for index in indices or ()
    ]
    if not places or None in places:  # an index is left out, or names no axis
        return True
    try:
        variable = scope.control.system_variable(name)
        if not variable.timed:
            variable.read(channel, tuple(places))
    except AlarmError as alarm:
        return alarm.code not in _INDEX_ALARMS
    return True


def name_function(channel: NcChannel, name: str, args: tuple[Any, ...]) -> int | bool:
    """The value of STRINGIS or ISVAR where the channel stands."""
    scope = channel.level.code.whole.scope_of(channel)
    return string_is(channel, scope, args[0]) if name == "STRINGIS" else is_variable(channel, scope, args[0])
