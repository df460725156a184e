"""Macro calls: G65, G66, G66.1, G67, and programs called by G, M and T codes (FANUC macro B §5)."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.control.word_address.block.numbers import length_converter
from polycnc.control.word_address.block.plan import Arguments
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.macro_b import calls_as_data, subprograms
from polycnc.control.word_address.macro_b.variables import LOCALS
from polycnc.control.word_address.states import ModalCall, ModalCallState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.language.bulk import declare

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import MacroChannel
    from polycnc.program import Program

#: Argument assignment I.
ARGUMENTS = {
    "A": 1, "B": 2, "C": 3, "I": 4, "J": 5, "K": 6, "D": 7, "E": 8, "F": 9, "H": 11, "M": 13, "Q": 17,
    "R": 18, "S": 19, "T": 20, "U": 21, "V": 22, "W": 23, "X": 24, "Y": 25, "Z": 26,
}  # fmt: skip
#: Further arguments of G66.1 and of blocks that it takes as argument lists.
FURTHER_ARGUMENTS = {"G": 10, "L": 12, "N": 14, "P": 16}
_LENGTHS = frozenset("ABCIJKQRUVWXYZ")
_SETS = 10


def arguments_of(words: Words, skip: str = "", *, without_m: int | None = None) -> list[float | None]:
    """Local variables that the words of a block set; `without_m` is the M code that calls.

    Assignment I gives each letter its variable. I, J, K may repeat, up to ten sets (assignment II): a set
    closes when a letter comes that is not behind the last one. Of two words for one variable the later one
    counts.
    """
    arguments = _arguments(words, skip, without_m)
    local: list[float | None] = [None] * LOCALS
    values = words.values
    for variable, slot, convert in arguments.typed:
        local[variable] = values[slot] if convert is None else convert(values[slot])
    for variable, value in arguments.fixed:
        local[variable] = value
    return local


def _arguments(words: Words, skip: str, without_m: int | None) -> Arguments:
    """Which words of a block are arguments; known for all blocks of its shape once one has run."""
    plan = words.plan
    arguments = plan.arguments.get((skip, without_m))
    if arguments is None:
        fixed = [
            (ARGUMENTS["M"], word)
            for code, word in zip(plan.m_codes, plan.m_words, strict=True)
            if code != without_m
        ]
        arguments = Arguments(tuple(_typed_arguments(words, skip)), tuple(fixed))
        plan.arguments[skip, without_m] = arguments
    return arguments


def _typed_arguments(words: Words, skip: str) -> Iterator[tuple[int, int, Convert | None]]:
    """The words that are arguments, as `Arguments` has them."""
    number, last = 0, ""
    for address, slot, form in words.plan.typed:
        if address in skip or address not in ARGUMENTS:
            if address not in skip and address not in ("G", "L", "N", "P"):
                raise words.fail("argument_address", address)
            continue
        if address in "IJK":
            if last and address <= last:
                number += 1
            last = address
            if number >= _SETS:
                raise words.fail("argument_sets", address)
            variable = 4 + 3 * number + "IJK".index(address)
        else:
            variable = ARGUMENTS[address]
        yield variable, slot, _argument_converter(words.plan, form) if address in _LENGTHS else None


def _argument_converter(plan: Plan, form: str) -> Convert | None:
    """What makes the argument of a length in the program's units; None where it is what is typed."""
    convert = length_converter(form, plan.rules, inch=plan.inch)
    if form or convert is None:
        return None
    unit = INCH_MM if plan.inch else 1.0
    return (lambda value: convert(value) / unit) if plan.inch else convert


def call_macro(channel: MacroChannel, words: Words) -> None:
    """G65 P L arguments."""
    channel.off_path = True
    refuse_g_behind(words, "G65")
    program, repeats = _macro(channel, words)
    enter_macro(channel, program, arguments_of(words, "PLG"), repeats)


declare(call_macro, lambda plan: calls_as_data.macro(plan, _arguments(Words(plan, []), "PLG", None)))


def start_modal_call(channel: MacroChannel, words: Words) -> None:
    """G66 P L arguments: the macro follows every block that moves; G66.1: every block."""
    channel.off_path = True
    code = channel.mode["macro"]
    refuse_g_behind(words, code)
    program, repeats = _macro(channel, words)
    start_modal(channel, program, repeats, arguments_of(words, "PLG"), each=code == "G66.1")


def start_modal(
    channel: MacroChannel, program: Program, repeats: int, arguments: list[float | None], *, each: bool
) -> None:
    """From the next block on a macro follows every block that moves, or every block."""
    channel.mode = channel.mode.with_code("macro", "G66.1" if each else "G66")
    ModalCallState.of(channel).calls.append(ModalCall(program, repeats, arguments, each))


def refuse_g_behind(words: Words, call: str) -> None:
    """Alarm for a G code behind the code that calls: it cannot be an argument."""
    order = words.plan.order
    for key in order[order.index(call) + 1 :]:
        if key[0] == "G":
            raise words.fail("g_as_argument", call)


def end_modal_call(channel: MacroChannel, words: Words) -> None:
    """G67: the last modal call ends."""
    subprograms.note_call(channel, words, "G67")
    calls = ModalCallState.of(channel).calls
    if calls:
        calls.pop()
        if calls:
            channel.mode = channel.mode.with_code("macro", "G66.1" if calls[-1].each_block else "G66")
    elif not channel.memory.parameters.G67:
        raise words.fail("no_modal_call", "G67")


def _macro(channel: MacroChannel, words: Words) -> tuple[Program, int]:
    return subprograms.called_program(channel, words), subprograms.repeats_of(words)


def enter_macro(
    channel: Channel,
    program: Program,
    local: object,
    repeats: int = 1,
    *,
    kind: LevelKind = LevelKind.MACRO,
) -> None:
    """Put a macro on the stack with local variables of its own, as its language has them; nothing for no repeats."""
    if repeats < 1:
        return
    channel.control.check_nesting(channel, kind)
    channel.memory.locals = local
    channel.push(program, kind=kind, repeats=repeats - 1, local=local)


def plan_modal_call(builder: Builder, plan: Plan) -> Step | None:
    """What finds the macro that follows the blocks of a shape while a modal call is active, or None.

    A move in a modal macro is followed by the macro that was called before it, and so on (nested G66).
    """
    if builder.before["macro"] not in ("G66", "G66.1") or builder.mode["macro"] == "G67":
        return None
    if any(row.group == "macro" for row in builder.codes):
        return None
    if not plan.axis_words or any(row.axis_words and row.code == "G4" for row in builder.codes):
        return None

    def find(channel: MacroChannel, _values: list[float]) -> None:
        state = ModalCallState.of(channel)
        inside = sum(1 for level in channel.stack if level.kind in (LevelKind.MODAL, LevelKind.EVERY_BLOCK))
        state.due = state.calls[-1 - inside] if inside < len(state.calls) else None

    return find


def plan_following(builder: Builder, plan: Plan) -> Step | None:
    """The macro begins when all of its block is done: an M99 of the block has left its program by then."""
    return None if plan_modal_call(builder, plan) is None else _follow


def _follow(channel: MacroChannel, _values: list[float]) -> None:
    state = ModalCallState.of(channel)
    call, state.due = state.due, None
    if call is not None and not channel.finished:
        enter_macro(channel, call.program, list(call.arguments), call.repeats, kind=LevelKind.MODAL)


def plan_argument_block(builder: Builder, plan: Plan) -> Step | None:
    """Under G66.1 every block is an argument list of the macro."""
    if builder.before["macro"] != "G66.1" or any(row.group == "macro" for row in builder.codes):
        return None
    if "B" not in builder.before.codes.get("calls", "B"):
        return None

    def call(channel: MacroChannel, values: list[float]) -> None:
        channel.off_path = True
        modal = ModalCallState.of(channel).calls[-1]
        arguments = _block_arguments(Words(plan, values), builder)
        enter_macro(channel, modal.program, arguments, modal.repeats, kind=LevelKind.EVERY_BLOCK)
        note_level(channel)

    return call


def _block_arguments(words: Words, builder: Builder) -> list[float | None]:
    local = arguments_of(words, "LP")
    for address in ("L", "P"):
        if address in words:
            local[FURTHER_ARGUMENTS[address]] = words.typed(address)
    if builder.codes:
        local[FURTHER_ARGUMENTS["G"]] = float(builder.codes[-1].code[1:])
    return local


def note_level(channel: MacroChannel) -> None:
    """Set the letters that may call on the level that runs now.

    Inside a program that a code called, codes call nothing; with 6008#6 GMP those of the other kind do. Inside the
    macro of G66.1, blocks call nothing.
    """
    if "calls" not in channel.mode.codes:
        return
    callers = {level.kind.code_letter for level in channel.stack if level.kind.code_letter}
    by_code = callers - {"B"}
    if not by_code:
        letters = "GMT"
    elif not channel.memory.parameters.GMP:
        letters = ""
    else:
        letters = "".join(kind for kind in ("G", "MT") if not by_code & set(kind))
    channel.mode = channel.mode.with_code("calls", letters if "B" in callers else letters + "B")
