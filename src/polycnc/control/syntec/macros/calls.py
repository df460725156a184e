"""Calls: macros by G65, G66 and by G, M and T codes, subprograms by M98 and M198, and the ways back.

A macro called by a code takes words of its block by reading them; the words that it left alone act as usual
when it is over (macro language reference, sections 4.2 and 7).
"""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.channel.states.state import Lifetime, State
from polycnc.control.machine_words import refuse
from polycnc.control.syntec.axis_groups import groups
from polycnc.control.syntec.builder import CALLS, SyntecBuilder, macro_program, may_call_by_g
from polycnc.control.syntec.macros import interrupts
from polycnc.control.syntec.macros.variables import INDEXED_LETTERS, Locals
from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.syntec.blocks import FORMS
from polycnc.language.syntec.values import Text, Value
from polycnc.language.word_address import WordBlock

with loaded_when_called():
    from polycnc.control.word_address.macro_b import macro_calls, subprograms

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.program import Program

#: Macros are called inside each other to this depth at most; the manual states none.
MAX_LEVELS = 64
#: Pr3701 to Pr3710: value of the parameter to the G code that a macro replaces.
REGISTERED_G = {
    -1: "G0", 1: "G1", 2: "G2", 3: "G3", 4: "G53", 5: "G40", 6: "G41", 7: "G42", 8: "G43", 9: "G44",
    10: "G49", 11: "G4", 12: "G2.4", 13: "G3.4",
}  # fmt: skip
#: M codes that cannot be registered as macros.
NEVER_REGISTERED = frozenset({0, 1, 2, 30, 96, 97, 98, 99})


#: Levels of programs that a registered code calls.
CODE_KINDS = (LevelKind.G_MACRO, LevelKind.M_MACRO, LevelKind.T_MACRO)


@dataclass(frozen=True, slots=True)
class CodeMacro:
    """A program that a code calls.

    Attributes:
        program: The program.
        kind: Kind of its level; inside that of a registered code the code is plain.
        takes: Addresses that it takes whether it reads them or not.
        shares: It shares the caller's local variables.
        word: What the machine is asked for in front of the call; empty for nothing.
    """

    program: Program
    kind: LevelKind
    takes: frozenset[str] = frozenset()
    shares: bool = False
    word: str = ""


@dataclass(slots=True)
class ModalMacro:
    """G66 or G66.1: the macro that follows every block that moves, or every block."""

    program: Program
    repeats: int
    local: Locals
    each_block: bool


@dataclass(slots=True)
class ModalMacroState(State, lifetime=Lifetime.RESET):
    """The macro of G66 or G66.1 while one follows the blocks, else nothing; `due` follows the block that runs."""

    calls: list[ModalMacro] = field(default_factory=list)
    due: ModalMacro | None = None


# ---- words of a call -------------------------------------------------------------------------------------


def words_of(builder: SyntecBuilder, values: list[Any]) -> dict[str, Value]:
    """The words of a block as a macro sees them: an integer is a Long, a number with a point a Double."""
    words: dict[str, Value] = {}
    for address, slot, form in builder.typed:
        if len(address) > 1 and address[0] != "," and address[0] not in INDEXED_LETTERS:
            raise builder.control.fail("argument", address=address)
        value = values[slot]
        words[address] = int(value) if form == "" and not isinstance(value, Text) else value
    if builder.m_codes:
        words["M"] = builder.m_codes[0]
    return words


def _count(words: dict[str, Value], builder: SyntecBuilder) -> int:
    """L: how often."""
    count = words.get("L", 1)
    if isinstance(count, Text) or not isinstance(count, int | float) or count != int(count) or count < 0:
        raise builder.control.fail("repeat_count", address="L")
    return int(count)


# ---- G65, G66 --------------------------------------------------------------------------------------------


def _plan_call(builder: Builder, plan: Plan) -> Step | None:
    """The step of a block that calls a macro; None for any other block."""
    assert isinstance(builder, SyntecBuilder)  # the control makes no other
    if any(row.code in CALLS for row in builder.codes):
        return _plan_g65(builder, plan)
    macro = _code_macro(builder)
    return None if macro is None else _plan_code_macro(builder, plan, macro)


def _plan_g65(builder: SyntecBuilder, plan: Plan) -> Step:
    """G65 P L arguments, G66 and G66.1: the modal codes of the block act first."""
    code = next(row.code for row in builder.codes if row.code in CALLS)
    settings = _settings(builder, plan.without(builder.slots))
    mode = builder.mode

    def call(channel: SyntecChannel, values: list[Any]) -> None:
        channel.mode = mode
        for step in settings:
            step(channel, values)
        words = words_of(builder, values)
        program = _program(channel, words.pop("P", None))
        count = _count(words, builder)
        channel.off_path = True
        if code == "G65":
            macro_calls.enter_macro(channel, program, Locals(words), count)
        else:
            ModalMacroState.of(channel).calls[:] = [
                ModalMacro(program, count, Locals(words), code == "G66.1")
            ]

    return call


def _program(channel: SyntecChannel, number: Value | None) -> Program:
    """The program that P names, by number or text."""
    control = channel.control
    if isinstance(number, Text):
        program = channel.store.find_name(str(number))
        if program is None:
            raise control.fail("no_program", address="P", number=str(number))
        return program
    if not isinstance(number, int | float) or number != int(number) or number < 0:
        raise control.fail("program_number", address="P")
    return groups.section(channel, control.find_program(channel, int(number)))


def _plan_modal_call(builder: Builder, plan: Plan) -> Step | None:
    """What finds the macro behind a block while G66 or G66.1 is active; None for a block that calls nothing."""
    assert isinstance(builder, SyntecBuilder)  # the control makes no other
    each = builder.mode["macro"] == "G66.1"
    if builder.mode["macro"] == "G67" or not (each or builder.moves(plan)):
        return None

    def find(channel: SyntecChannel, values: list[Any]) -> None:
        state = ModalMacroState.of(channel)
        if not state.calls or any(level.kind is LevelKind.MODAL for level in channel.stack):
            state.due = None
            return
        state.due = state.calls[-1]
        state.due.local.trapped = words_of(builder, values)

    return find


def _plan_following(builder: Builder, plan: Plan) -> Step | None:
    """The macro begins when all of its block is done: an M99 of the block has left its program by then."""
    return None if _plan_modal_call(builder, plan) is None else _follow


def _follow(channel: SyntecChannel, _values: list[Any]) -> None:
    state = ModalMacroState.of(channel)
    modal, state.due = state.due, None
    if modal is not None and not channel.finished:
        macro_calls.enter_macro(channel, modal.program, modal.local, modal.repeats, kind=LevelKind.MODAL)


def end_modal_call(channel: SyntecChannel, _words: Words) -> None:
    """G67: all modal calls end."""
    ModalMacroState.of(channel).calls.clear()


# ---- macros by code --------------------------------------------------------------------------------------


def _code_macro(builder: SyntecBuilder) -> CodeMacro | None:
    """The macro that the codes of a block call: the last G macro, else a registered G, M or T code."""
    if builder.g_macros:
        code, program = builder.g_macros[-1]
        return CodeMacro(program, LevelKind.MACRO, frozenset("L"), word=code)
    if code := builder.repeated_macro:
        return CodeMacro(_repeated(builder, code), LevelKind.MACRO, frozenset("L"), word=code)
    return _registered_g(builder) or _registered_m(builder) or _registered_t(builder)


def _repeated(builder: SyntecBuilder, code: str) -> Program:
    """The program of the code in #1000 (macro language reference, section 5)."""
    program = macro_program(builder.channel, code)
    return builder.code_program(code) if program is None else program


def _registered_g(builder: SyntecBuilder) -> CodeMacro | None:
    memory = builder.channel.memory
    registered = {REGISTERED_G[value] for value in memory.parameters.g_macros if value in REGISTERED_G}
    if not registered:
        return None
    own = [row.code for row in builder.codes if row.code in registered]
    motion = builder.mode["motion"]
    if not own and motion in registered and builder.moves_by_words():
        own = [motion]
    return None if not own else CodeMacro(builder.code_program(_file_of(own[-1])), LevelKind.G_MACRO)


def _file_of(code: str) -> str:
    """The file of a registered G code: G0000, G0053, G2004 for G02.4."""
    whole, _, fraction = code[1:].partition(".")
    return f"G{whole}{int(fraction):03d}" if fraction else f"G{int(whole):04d}"


def _registered_m(builder: SyntecBuilder) -> CodeMacro | None:
    memory = builder.channel.memory
    by_parameter = {code: f"M{code:04d}" for code in memory.parameters.m_macros if code}
    functions = builder.channel.machine.m_functions.values()
    declared = {each.code: each.calls for each in functions if each.calls}
    code = next((code for code in builder.m_codes if code in by_parameter or code in declared), None)
    if code is None:
        return None
    builder.called_m = code
    takes = frozenset(address for address, _, _ in builder.typed if address != "T") | {"M"}
    if code in by_parameter:
        return CodeMacro(builder.code_program(by_parameter[code]), LevelKind.M_MACRO, takes)
    program = builder.declared_program(declared[code])
    return CodeMacro(program, LevelKind.M_MACRO, takes, word=f"M{code}")


def _registered_t(builder: SyntecBuilder) -> CodeMacro | None:
    how = builder.channel.memory.parameters.t_macro
    if how not in (1, 2) or not builder.has("T"):
        return None
    return CodeMacro(builder.code_program("T0000"), LevelKind.T_MACRO, frozenset("T"), shares=how == 1)


def _plan_code_macro(builder: SyntecBuilder, plan: Plan, macro: CodeMacro) -> Step:
    """A block whose code calls a macro; inside a macro of a registered code these codes are plain."""
    settings = _settings(builder, plan)
    mode = builder.mode if macro.kind is not LevelKind.G_MACRO else builder.before
    first = builder.called_m if macro.kind is LevelKind.M_MACRO else next(iter(builder.m_codes), None)
    others = tuple(f"M{code}" for code in builder.m_codes if code != first)

    def call(channel: SyntecChannel, values: list[Any]) -> None:
        if macro.kind in CODE_KINDS and any(level.kind is macro.kind for level in channel.stack):
            builder.plain_plan(channel).run(channel, values)
            return
        if macro.word:
            refuse(channel, macro.word, calls=True)
        channel.mode = mode
        for step in settings:
            step(channel, values)
        words = words_of(builder, values)
        count = _count(words, builder) if macro.kind is LevelKind.MACRO else 1
        channel.off_path = True
        local = Locals(words, returns_words=True)
        local.taken |= macro.takes
        local.other_codes = others
        if macro.shares:
            enter_shared(channel, macro.program, macro.kind)
            channel.level.data["rest"] = local
        else:
            macro_calls.enter_macro(channel, macro.program, local, count, kind=macro.kind)

    return call


def _settings(builder: SyntecBuilder, plan: Plan) -> list[Step]:
    """Handlers of the modal codes that stand in a block beside its call, P of G54 left to the call."""
    rows = [
        row
        for row in builder.codes
        if row.handler and row.group and row.group != "macro" and not row.axis_words
    ]
    return [builder.handled(row.handler, builder.words_of(row, plan)) for row in rows if row.handler]


def finish_macro(channel: SyntecChannel, ended: Level) -> None:
    """What a macro has left of its block acts now, in the caller."""
    local = ended.data.get("rest", ended.locals)
    if (
        ended.kind not in (LevelKind.MACRO, *CODE_KINDS)
        or not isinstance(local, Locals)
        or not local.returns_words
    ):
        return
    words = {address: value for address, value in local.remaining().items() if address not in "NO"}
    codes = list(local.other_codes)
    if "M" in words:
        codes.append(f"M{words.pop('M')}")
    if words or codes:
        signature = (*codes, *(address + FORMS[type(value)] for address, value in words.items()))
        WordBlock(signature, list(words.values()))(channel)  # type: ignore[arg-type]


# ---- subprograms -----------------------------------------------------------------------------------------


def enter_shared(
    channel: SyntecChannel, program: Program, kind: LevelKind, count: int = 1, sequence: int | None = None
) -> None:
    """Put a program on the stack that works on the caller's local variables."""
    channel.control.check_nesting(channel, kind)
    code = channel.executable(program)
    index = 0 if sequence is None else code.find_sequence(sequence)
    channel.push(program, kind=kind, repeats=count - 1, index=index, local=channel.level.locals)


def call_subprogram(channel: SyntecChannel, words: Words) -> None:
    """M98 P H L: program P (without P the running one), from N number H, L times."""
    subprograms.note_call(channel, words, "M98")
    program = channel.level.code.program
    if "P" in words:
        program = channel.control.find_program(channel, _whole(words, "P", "subprogram_number"))
    _enter_subprogram(channel, words, program)


def call_external_subprogram(channel: SyntecChannel, words: Words) -> None:
    """M198 P H L: as M98, the file read anew at each call; P must be there."""
    if "P" not in words:
        raise words.fail("subprogram_number", "M198")
    subprograms.note_call(channel, words, "M198")
    number = _whole(words, "P", "subprogram_number")
    program = channel.store.find_external_number(number)
    if program is None:
        raise channel.control.fail("no_program", address="P", number=number)
    _enter_subprogram(channel, words, program)


def _enter_subprogram(channel: SyntecChannel, words: Words, program: Program) -> None:
    count = _whole(words, "L", "repeat_count") if "L" in words else 1
    sequence = _whole(words, "H", "program_number") if "H" in words else None
    if count > 0:
        enter_shared(channel, groups.section(channel, program), LevelKind.SUBPROGRAM, count, sequence)


def _whole(words: Words, address: str, mistake: str) -> int:
    value: Any = words.typed(address)
    if value is None or isinstance(value, str) or value != int(value) or value < 0:
        raise words.fail(mistake, address)
    return int(value)


def return_from_program(channel: SyntecChannel, words: Words) -> None:
    """M99: back behind the call, P to an N number, Q to a line of the caller; in the main program to its top.

    P and Q end all passes of the call.
    """
    subprograms.note_call(channel, words, "M99")
    sequence = _whole(words, "P", "program_number") if "P" in words else None
    line = _whole(words, "Q", "program_number") if "Q" in words else None
    is_main = len(channel.stack) == 1
    leave_program(channel, jumps=sequence is not None or line is not None)
    level = channel.level
    if sequence is not None:
        level.index = level.code.find_sequence(sequence)
    elif line is not None:
        level.index = level.code.find_line(line)
    if is_main:
        channel.begin_again()


def leave_program(channel: SyntecChannel, *, jumps: bool = False) -> None:
    """The end of a pass: the next one begins, or the caller goes on; a main program begins again."""
    level = channel.level
    if len(channel.stack) == 1:
        level.index = level.entry
    elif level.repeats > 0 and not jumps:
        level.repeats -= 1
        level.index = level.entry
        if isinstance(level.locals, Locals) and level.kind is LevelKind.MACRO:
            level.locals.fill()
    else:
        channel.control.leave(channel)
        if not jumps:
            interrupts.go_back(channel, level)


def end_program(channel: SyntecChannel, _words: Words) -> None:
    """M02, M30: the end; in a subprogram a return (manual, chapter 3)."""
    if len(channel.stack) > 1:
        leave_program(channel)
    else:
        channel.control.finish(channel)


#: Programs that codes call.
RULE = Rule("macro calls", codes=CALLS, words=("T",), m_codes=True, where=may_call_by_g, replace=_plan_call)
#: The macro that follows blocks.
MODAL_RULE = Rule("modal macro calls", unless={"macro": "G67"}, after=_plan_modal_call, last=_plan_following)
