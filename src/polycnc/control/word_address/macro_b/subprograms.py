"""Subprograms: M98, M198 and M99 of the FANUC and MELDAS families."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.control.word_address.macro_b import calls_as_data
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import declare

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MacroChannel, WordAddressChannel
    from polycnc.program import Program

#: Five and more digits of P hold the number of repeats in front of a four-digit program number.
PROGRAM_NUMBERS = 10_000
#: What a block that calls or returns may hold beside its code, and still be nothing else.
_OF_CALLS = frozenset("NPLQH")


def note_call(channel: WordAddressChannel, words: Words, code: str) -> None:
    """Tell stages that look ahead whether a block is a call or a return and nothing else.

    Such a block is prepared like a macro statement: it is none of the path (FANUC macro B reference 7).
    """
    channel.off_path = words.plan.keys - _OF_CALLS <= {code}


def call_subprogram(channel: MacroChannel, words: Words, *, begins_at: str = "Q") -> None:
    """M98 P L Q: program P, L times, from sequence number Q (`begins_at`); without P within the same program."""
    note_call(channel, words, "M98")
    number, repeats = _program_and_repeats(channel, words)
    sequence = words.integer(begins_at) if begins_at in words else None
    if number is None and not words.plan.program_name and sequence is not None:
        program = channel.level.code.program
    else:
        program = called_program(channel, words, number)
    enter_subprogram(channel, program, repeats, sequence)


declare(call_subprogram, calls_as_data.subprogram)


def called_program(channel: MacroChannel, words: Words, number: int | None = None) -> Program:
    """The program that P or `<NAME>` names."""
    if words.plan.program_name:
        return _by_name(channel, words)
    if number is None:
        number = words.integer("P") if "P" in words else None
    if number is None:
        raise words.fail("no_program", "P")
    program: Program = channel.control.find_program(channel, number)
    return program


def _by_name(channel: MacroChannel, words: Words) -> Program:
    name = words.plan.program_name
    program = channel.store.find_name(name)
    if program is None:
        raise words.fail("no_program", f"<{name}>")
    return program


def call_external_subprogram(channel: MacroChannel, words: Words) -> None:
    """M198 P L: a program on the external device; not from one that was called so itself."""
    note_call(channel, words, "M198")
    number, repeats = _program_and_repeats(channel, words)
    if number is None:
        raise words.fail("no_program", "M198")
    if any(level.kind is LevelKind.EXTERNAL for level in channel.stack):
        raise words.fail("external_nested", "M198")
    program = channel.store.find_external_number(number)
    if program is None:
        raise words.fail("no_program", "P")
    enter_subprogram(channel, program, repeats, None, kind=LevelKind.EXTERNAL)


def enter_subprogram(
    channel: MacroChannel,
    program: Program,
    repeats: int,
    sequence: int | None,
    *,
    kind: LevelKind = LevelKind.SUBPROGRAM,
) -> None:
    """Put a subprogram on the stack: it shares the caller's local variables; nothing for no repeats."""
    if repeats < 1:
        return
    channel.control.check_nesting(channel, kind)
    local = channel.level.locals
    level = channel.push(program, kind=kind, repeats=repeats - 1, local=local)
    if sequence is not None:
        level.index = level.entry = level.code.find_sequence(sequence, -1, "no_return_sequence")


def _program_and_repeats(channel: MacroChannel, words: Words) -> tuple[int | None, int]:
    number, repeats = words.integer("P") if "P" in words else None, repeats_of(words)
    if number is not None and number >= PROGRAM_NUMBERS and not channel.control.long_program_numbers(channel):
        packed, number = divmod(number, PROGRAM_NUMBERS)
        return number, packed if channel.control.packs_repeats(channel) else repeats
    return number, repeats


def repeats_of(words: Words) -> int:
    """L of a block that calls a program: how often it runs, once without; it has no sign."""
    repeats = words.integer("L")
    if repeats is None:
        return 1
    if repeats < 0:
        raise words.fail("minus", "L")
    return repeats


def return_from_subprogram(channel: MacroChannel, words: Words) -> None:
    """M99 [P] [L]: end of a pass; P names a sequence number of the caller, L the passes that remain.

    In the main program M99 goes to the top, M99 P to a sequence number.
    """
    note_call(channel, words, "M99")
    level = channel.level
    sequence = words.integer("P") if "P" in words else None
    if len(channel.stack) == 1:
        level.index = (
            0 if sequence is None else level.code.find_sequence(sequence, level.current, "no_return_sequence")
        )
        level.data.clear()
        channel.begin_again()
        return
    left = words.integer("L") if "L" in words else None
    if left is not None:
        level.repeats = max(left - 1, 0) if left else 0
    if sequence is None and level.repeats > 0:
        level.repeats -= 1
        level.index = level.entry
        level.data.clear()
        return
    channel.control.leave(channel, jumps=sequence is not None)
    if sequence is not None:
        caller = channel.level
        caller.index = caller.code.find_sequence(sequence, caller.current, "no_return_sequence")


declare(return_from_subprogram, calls_as_data.subprogram_end)
