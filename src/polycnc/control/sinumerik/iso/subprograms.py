"""Programs that the ISO dialect calls: M98 and M99, and macros by G65 to G67.

A program that begins with PROC is one of the control's own language, and reads the words of the call as `$C_A` to
`$C_Z`; any other is ISO code.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.stack import LevelKind
from polycnc.control.sinumerik.iso.macro_words import LETTERS, WORDS
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.lexer import prefix_of
from polycnc.language.sinumerik.statements.calls import call_program, call_without_arguments, named_program

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord

#: P of M98: the number of the program in the lower four digits, how often it runs in those in front of them.
DIGITS = 4
_NUMBERS = 10**DIGITS
#: Functions that hand words over.
MACROS = frozenset(("G65", "G66"))


def call(running: IsoRun, word: IsoWord) -> None:
    """M98 P… [L…]: the program whose name is the number, with zeros in front to four digits, runs as ISO code.

    Raises:
        AlarmError: 14011 where there is none; PC0001 without P, for a number that is none, for both kinds of repeats.
    """
    chosen, repeats = running.take("P"), running.take("L")
    if chosen is None or not chosen.number.isdigit():
        raise running.refused(chosen or word)
    passes, number = divmod(int(chosen.number), _NUMBERS)
    if repeats is not None:
        if passes or not repeats.number.isdigit():
            raise running.refused(repeats)
        passes = int(repeats.number)
    elif not passes:
        passes = 1
    running.after.append(partial(_call, running, f"{number:0{DIGITS}d}", passes))


def _call(running: IsoRun, name: str, passes: int) -> None:
    channel = running.channel
    program = named_program(channel, name)
    channel.executable(program).whole.become_iso()
    call_program(channel, program, (), (), passes)


# ---- macros


def call_macro(running: IsoRun, word: IsoWord) -> None:
    """G65 P… [L…]: the program of that number, once or L times, with the other words of the block.

    Raises:
        AlarmError: 14011 where there is none; PC0001 without P, and for words that hand over nothing.
    """
    name, words = _macro(running, word)
    repeats = running.take("L")
    if repeats is not None and not repeats.number.isdigit():
        raise running.refused(repeats)
    passes = 1 if repeats is None else int(repeats.number)
    running.after.append(partial(_call_macro, running.channel, name, words, passes, LevelKind.SUBPROGRAM))


def call_modally(running: IsoRun, word: IsoWord) -> None:
    """G66 P…: as G65, behind every block that moves, until G67; PC0001 while a drilling cycle is modal."""
    name, words = _macro(running, word)
    if running.state.cycle is not None:
        raise running.refused(word)
    named_program(running.channel, name)

    def call(channel: SinumerikChannel) -> None:
        _call_macro(channel, name, words, 1, LevelKind.MODAL)

    running.after.append(lambda: setattr(running.channel.memory.language, "modal_call", call))


def end_modal(running: IsoRun, _word: IsoWord) -> None:
    """G67: no program is modal."""
    running.before.append(lambda: setattr(running.channel.memory.language, "modal_call", None))


def _macro(running: IsoRun, word: IsoWord) -> tuple[str, dict[str, float]]:
    """Name of the program and what it gets; no word of the block does anything else."""
    chosen = running.take("P")
    if chosen is None or not chosen.number.isdigit() or len(chosen.number) > DIGITS:
        raise running.refused(chosen or word)
    running.positions = True
    words: dict[str, float] = {}
    for each in running.block.words:
        if each.letter in LETTERS and each not in running.taken:
            if each.letter in words:
                raise running.refused(each)
            words[each.letter] = each.value
            running.taken.append(each)
    return chosen.number.zfill(DIGITS), words


def _call_macro(
    channel: SinumerikChannel, name: str, words: Mapping[str, float], passes: int, kind: LevelKind
) -> None:
    program = named_program(channel, name)
    code = channel.executable(program).whole
    first = code.text(0) if len(code) else ""
    if first[prefix_of(first).end :].strip().upper().startswith("PROC"):
        call_without_arguments(channel, program, kind)
        channel.level.repeats = passes - 1
    else:
        code.become_iso()
        call_program(channel, program, (), (), passes, kind)
    channel.level.data[WORDS] = words


# ---- return


def return_(running: IsoRun, word: IsoWord) -> None:
    """M99: back to the calling program; PC0001 in the main program."""
    if len(running.channel.stack) == 1:
        raise running.refused(word)
    running.extra.append("M17")
