"""Subprograms in the ISO dialect: M98 and M99."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from polycnc.language.sinumerik.statements.calls import call_program, named_program

if TYPE_CHECKING:
    from polycnc.control.sinumerik.iso.running import IsoRun
    from polycnc.language.sinumerik.iso_dialect import IsoWord

#: P of M98: the number of the program in the lower four digits, how often it runs in those in front of them.
DIGITS = 4
_NUMBERS = 10**DIGITS


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


def return_(running: IsoRun, word: IsoWord) -> None:
    """M99: back to the calling program; PC0001 in the main program."""
    if len(running.channel.stack) == 1:
        raise running.refused(word)
    running.extra.append("M17")
