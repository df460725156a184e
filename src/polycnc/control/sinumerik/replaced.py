"""Programs in place of M functions and of T: MD10715 to MD10718, and `calls` of the machine file.

The program is called at the end of the block. That of the M function which MD10718 names gets T and D of the block,
and so does that of T (MD10717): they are not executed, and the program reads them as `$C_T`, `$C_D` and so on. Within
such a program M functions, T and D are themselves.

Source: list of machine data, and of system variables by name.
"""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.machine_words import refuse
from polycnc.control.sinumerik.m_functions import NEVER_CALL, PROGRAM_ENDS
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.language.sinumerik.statements.calls import call_without_arguments, named_program
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, Row


@dataclass(slots=True)
class Handed(State, lifetime=Lifetime.RESET):
    """Words that a program gets in place of the block.

    Attributes:
        block: Of the block that is read now, by address.
        program: Of the block that has called the program.
    """

    block: dict[str, int | str] = field(default_factory=dict)
    program: dict[str, int | str] = field(default_factory=dict)


def _in_replacement(channel: SinumerikChannel) -> bool:
    return any(level.kind is LevelKind.M_SUBPROGRAM for level in channel.stack)


def program_of(channel: SinumerikChannel, code: int) -> str:
    """The program that an M function calls, by MD10715 and MD10716 or by the machine file; empty for none."""
    data = channel.memory.data
    element = data.element_with("$MN_M_NO_FCT_CYCLE", code)
    name = str(data.read("$MN_M_NO_FCT_CYCLE_NAME", element)) if element is not None else ""
    if not name:
        function = channel.machine.m_functions.get(code)
        name = function.calls if function is not None else ""
    if not name or _in_replacement(channel):
        return ""
    if code in NEVER_CALL:
        raise AlarmError("4150", text=f"M{code}")
    return name


def program_of_tool(channel: SinumerikChannel) -> str:
    """The program that T calls (MD10717); empty for none."""
    name = str(channel.memory.data.read("$MN_T_NO_FCT_CYCLE_NAME"))
    return "" if name and _in_replacement(channel) else name


def hands_on(channel: SinumerikChannel, codes: Collection[int]) -> bool:
    """Whether one of the M functions of a block gives its program the words beside it (MD10718)."""
    data = channel.memory.data
    element = data.integer("$MN_M_NO_FCT_CYCLE_PAR")
    if element < 0:
        return False
    code = data.integer("$MN_M_NO_FCT_CYCLE", element)
    return code in codes and bool(program_of(channel, code))


def takes(channel: SinumerikChannel, codes: Collection[int], *, beside_tool: bool) -> bool:
    """Whether T or D of a block goes to a program, and is not executed."""
    return hands_on(channel, codes) or (beside_tool and bool(program_of_tool(channel)))


def hand(channel: SinumerikChannel, address: str, value: int | str) -> None:
    """A word of the block for the program that it calls."""
    Handed.of(channel).block[address] = value


def call_for_tool(channel: SinumerikChannel, codes: Sequence[int]) -> None:
    """At the end of a block with T: go on with the program of MD10717, unless that of an M function gets T.

    Raises:
        AlarmError: 14016 beside another call or the end of a program, and while MCALL is active.
    """
    name = program_of_tool(channel)
    if not name or hands_on(channel, codes):
        return
    if any(code in PROGRAM_ENDS or program_of(channel, code) for code in codes):
        raise AlarmError("14016", text="T")
    _call(channel, name, "T")


def call_programs(channel: SinumerikChannel, codes: Sequence[int]) -> bool:
    """At the end of a block: go on with the program that one of its M functions calls; whether there is one.

    Raises:
        AlarmError: 14016 for two calls, for a call beside the end of a program, and while MCALL is active.
    """
    calls = [(code, name) for code in codes if (name := program_of(channel, code))]
    if not calls:
        return False
    code, name = calls[0]
    if len(calls) > 1 or any(each in PROGRAM_ENDS for each in codes):
        raise AlarmError("14016", text=f"M{code}")
    function = channel.machine.m_functions.get(code)
    if function is not None and function.calls == name:
        refuse(channel, f"M{code}", calls=True)
    hand(channel, "M", code)
    _call(channel, name, f"M{code}")
    return True


def _call(channel: SinumerikChannel, name: str, word: str) -> None:
    if channel.memory.language.modal_call is not None:
        raise AlarmError("14016", text=word)
    handed = Handed.of(channel)
    handed.program, handed.block = handed.block, {}
    program = named_program(channel, name)
    channel.flush()
    call_without_arguments(channel, program, LevelKind.M_SUBPROGRAM)


# ---- what the program reads


def _number(address: str) -> Reader:
    def read(channel: SinumerikChannel, _indices: Indices) -> Any:
        value = Handed.of(channel).program.get(address, 0)
        return 0 if isinstance(value, str) else value

    return read


def _name(channel: SinumerikChannel, _indices: Indices) -> Any:
    value = Handed.of(channel).program.get("T", "")
    return value if isinstance(value, str) else ""


def _is_given(address: str, kind: type) -> Reader:
    def read(channel: SinumerikChannel, _indices: Indices) -> Any:
        return isinstance(Handed.of(channel).program.get(address), kind)

    return read


#: What a program reads that stands for a function.
REPLACED_VARIABLES: dict[str, Row] = {
    **{f"$C_{address}": (Type.INT, _number(address), None) for address in ("T", "D", "M")},
    **{f"$C_{address}_PROG": (Type.BOOL, _is_given(address, int), None) for address in ("T", "D", "M")},
    "$C_TS": (Type.STRING, _name, None),
    "$C_TS_PROG": (Type.BOOL, _is_given("T", str), None),
}
