"""Programs called by G, M and T codes that parameters register (FANUC macro B §5.1).

A family says which codes are registered (`CustomMacroControl.code_calls`). Inside a program that such a code
called, codes are ordinary codes; the modal group `calls` holds the letters that may still call, so that plans
of blocks differ inside and outside.
"""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.control.machine_words import refuse
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.auxiliary.interlocks import note_tool_number
from polycnc.control.word_address.block.codes import GCode, MCode, Order
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.words import Words
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.model import program_called

with loaded_when_called():
    from polycnc.control.word_address.macro_b import macro_calls, subprograms

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.machine.model import Machine

#: Letters of codes that may call programs, outside of any program that was called so; B stands for blocks (G66.1).
ALL_CALLS = "GMTB"
#: The common variable that hands a T code to its program.
TOOL_VARIABLE = 149


@dataclass(frozen=True, slots=True)
class CodeCall:
    """A registered code: the program that it calls, and how.

    Attributes:
        program: Program number, or the name of a program that the machine file names so.
        kind: `sub` as M98, `macro` as G65, `modal` as G66, `each` as G66.1.
        word: What the machine is asked for in front of the call; empty for nothing, as a registered M code does not
            go out to it.
    """

    program: int | str
    kind: str = "macro"
    word: str = ""


@dataclass(frozen=True, slots=True)
class CodeCalls:
    """The registered codes of a control: by G code as written, by M number, and for T."""

    g: Mapping[str, CodeCall] = field(default_factory=dict)
    m: Mapping[int, CodeCall] = field(default_factory=dict)
    t: CodeCall | None = None

    def over(self, other: CodeCalls) -> CodeCalls:
        """These calls laid over others."""
        return CodeCalls({**other.g, **self.g}, {**other.m, **self.m}, self.t or other.t)

    def g_rows(self) -> dict[str, GCode]:
        """Rows of the registered G codes for a G table."""
        return {code: _g_row(code, call) for code, call in self.g.items()}


def of_machine(machine: Machine) -> CodeCalls:
    """The codes that a machine file lets call programs, as macros with the words of their block as arguments."""
    g = machine.g_functions.items()
    m = machine.m_functions.items()
    return CodeCalls(
        {code: CodeCall(program_called(each.calls), word=code) for code, each in g if each.calls},
        {code: CodeCall(program_called(each.calls), word=f"M{code}") for code, each in m if each.calls},
    )


def _g_row(code: str, call: CodeCall) -> GCode:
    def act(channel: MacroChannel, words: Words) -> None:
        channel.off_path = True
        refuse(channel, code, calls=True)
        macro_calls.refuse_g_behind(words, code)
        repeats = subprograms.repeats_of(words)
        program = channel.control.find_program(channel, call.program)
        if call.kind == "sub":
            subprograms.enter_subprogram(channel, program, repeats, None, kind=LevelKind.G_SUBPROGRAM)
        elif call.kind == "macro":
            macro_calls.enter_macro(
                channel, program, macro_calls.arguments_of(words, "LG"), repeats, kind=LevelKind.G_MACRO
            )
        else:
            macro_calls.start_modal(
                channel,
                program,
                repeats,
                macro_calls.arguments_of(words, "LG"),
                each=call.kind == "each",
            )
        macro_calls.note_level(channel)

    return GCode(code, handler=act, takes="*", axis_words=True, order=Order.CALL)


def _calls(builder: Builder) -> CodeCalls:
    channel: MacroChannel = builder.channel
    return channel.control.called_codes(channel)


def may_call(builder: Builder, letter: str) -> bool:
    """Whether codes of a letter call programs here."""
    return letter in builder.before.codes.get("calls", "")


def m_row(builder: Builder, number: int) -> MCode | None:
    """The row of an M code that is registered as a subprogram call; its block's other words act as usual."""
    call = _calls(builder).m.get(number) if may_call(builder, "M") else None
    if call is None or call.kind != "sub":
        return None

    def act(channel: MacroChannel, words: Words) -> None:
        subprograms.note_call(channel, words, f"M{number}")
        program = channel.control.find_program(channel, call.program)
        subprograms.enter_subprogram(channel, program, 1, None, kind=LevelKind.M_SUBPROGRAM)
        macro_calls.note_level(channel)

    return MCode(number, after=True, handler=act, silent=True)


def registered_row(builder: Builder, number: int) -> MCode | None:
    """The row of a registered M code where it calls nothing: whoever registers a code gives it a meaning."""
    channel: MacroChannel = builder.channel
    registered = channel.control.code_calls(channel).m
    return (
        MCode(number, open=True) if number in registered and number not in channel.control.m_codes else None
    )


def plan_m_macro(builder: Builder, plan: Plan) -> Step | None:
    """A block whose first word is an M code registered as a macro: the other words are its arguments."""
    first = builder.order[0] if builder.order else ""
    if first[:1] != "M" or not first[1:].isdigit() or not may_call(builder, "M"):
        return None
    number = int(first[1:])
    call = _calls(builder).m.get(number)
    if call is None or call.kind == "sub":
        return None

    def act(channel: MacroChannel, values: list[float]) -> None:
        words = Words(plan, values)
        channel.off_path = True
        if call.word:
            refuse(channel, call.word, calls=True)
        macro_calls.refuse_g_behind(words, first)
        if "T" in words:
            note_tool_number(channel)
        repeats = subprograms.repeats_of(words)
        arguments = macro_calls.arguments_of(words, "LG", without_m=number)
        program = channel.control.find_program(channel, call.program)
        macro_calls.enter_macro(channel, program, arguments, repeats, kind=LevelKind.M_MACRO)
        macro_calls.note_level(channel)

    return act


def plan_tool_or_call(builder: Builder) -> Step | None:
    """T: selects the next tool, or calls a program behind the motion of its block."""
    return None if calls_by_tool(builder) else functions.plan_tool(builder)


def plan_tool_call(builder: Builder, plan: Plan) -> Step | None:
    """The call of the program registered for T."""
    if not builder.has("T") or not calls_by_tool(builder):
        return None
    slot = builder.slots["T"][0]
    call = _calls(builder).t

    def act(channel: MacroChannel, values: list[float]) -> None:
        assert call is not None
        subprograms.note_call(channel, Words(plan, values), "T")
        channel.memory.write(TOOL_VARIABLE, values[slot])
        program = channel.control.find_program(channel, call.program)
        subprograms.enter_subprogram(channel, program, 1, None, kind=LevelKind.T_SUBPROGRAM)
        macro_calls.note_level(channel)

    return act


def calls_by_tool(builder: Builder) -> bool:
    """Whether T calls a program here."""
    return _calls(builder).t is not None and may_call(builder, "T")


#: Programs that M codes and T call.
RULE = Rule(
    "programs called by M and T codes", words=("T",), m_codes=True, replace=plan_m_macro, after=plan_tool_call
)
