"""Blocks of the ISO dialect (G291), told in the words of the control's own language.

Behind a block of G291, up to the next one of G290, lines are words of ISO code M: letters with numbers, comments in
brackets. What means the same on both sides, or has a counterpart, is translated; the rest of the dialect is refused, as
PC0001 with its word. The manual names G290 and G291 (job planning 16.1, group 47) alone; counterparts are those of the
control's manual of ISO milling.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from polycnc.deferred.regexes import regex
from polycnc.language.sinumerik.errors import not_supported, syntax
from polycnc.language.sinumerik.lexer import prefix_of

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Blocks that change the language; they hold nothing else.
_SWITCH = regex(r"[ \t]*G[ \t]*(29[01])[ \t\r\x00]*(?:;.*)?$", re.IGNORECASE | re.ASCII)
_COMMENT = regex(r"\([^()]*\)|;.*$")
_WORD = regex(r"[ \t\r\x00]*([A-Z])[ \t]*([+-]?(?:\d+(?:\.\d*)?|\.\d+))", re.IGNORECASE | re.ASCII)
#: G functions and what they are called in the control's own language; an empty text for what is so in any case.
G_FUNCTIONS = {
    **{
        f"G{number}": f"G{number}"
        for number in (0, 1, 2, 3, 4, 9, 17, 18, 19, 40, 54, 55, 56, 57, 64, 90, 91, 94, 95)
    },
    "G21": "G71",
    "G49": "D0",
    "G58": "G505",
    "G59": "G506",
    "G61": "G60",
    "G80": "",
}
#: Words that mean the same.
SAME = frozenset("XYZABCUVWIJKFSTM")
#: M functions of subprograms.
CALLS = frozenset((98.0, 99.0))
_CIRCLES, _DWELL = frozenset(("G2", "G3")), "G4"
_MILLI = 1000.0


def switched(line: str) -> str:
    """`G290` or `G291` for a block that changes the language, else empty."""
    found = _SWITCH.match(line, prefix_of(line).end)
    return f"G{found[1]}" if found else ""


def region(lines: Sequence[str], first: int) -> range:
    """The lines that G291 makes ISO code, from the one behind it up to that with G290."""
    for index in range(first, len(lines)):
        if switched(lines[index]) == "G290":
            return range(first, index)
    return range(first, len(lines))


def translated(line: str, motion: str) -> str:
    """A block of ISO code in the words of the control's own language; words keep their columns where they can.

    Args:
        line: The block.
        motion: The motion function that is active in front of it.

    Raises:
        NcSyntaxError: PC0001 for a word that is not translated, 12080 for what is no word.
    """
    end = prefix_of(line).end
    words = _words(line, end)
    codes = [f"G{value:g}" for letter, value, *_ in words if letter == "G"]
    motion = next((code for code in codes if code in ("G0", "G1", *_CIRCLES)), motion)
    text = line[:end]
    for letter, value, number, column in words:
        told = _told(letter, value, number, column, codes, motion)
        text = f"{text.ljust(column - 1)}{told} " if told else text
    return text


def _words(line: str, end: int) -> list[tuple[str, float, str, int]]:
    """Letter, value, number as written and column of each word behind the block number."""
    text = _COMMENT.sub(lambda found: " " * len(found[0]), line)
    words = []
    while (found := _WORD.match(text, end)) is not None:
        words.append((found[1].upper(), float(found[2]), found[2], found.start(1) + 1))
        end = found.end()
    if text[end:].strip(" \t\r\x00"):
        rest = len(text) - len(text[end:].lstrip(" \t\r\x00"))
        if text[rest] in "#[]=*O%" or text[rest].isalpha():
            raise not_supported(rest + 1, f"G291 {text[rest:].split()[0]}")
        raise syntax(rest + 1, text[rest:].split()[0])
    return words


def _told(letter: str, value: float, number: str, column: int, codes: Sequence[str], motion: str) -> str:
    if letter == "G":
        code = f"G{value:g}"
        if code not in G_FUNCTIONS:
            raise not_supported(column, f"G291 {code}")
        return G_FUNCTIONS[code]
    if _DWELL in codes and letter in "XP":
        return f"F{value if letter == 'X' else value / _MILLI!r}"
    if letter == "R" and motion in _CIRCLES:
        return f"CR={number}"
    if letter not in SAME or (letter == "M" and value in CALLS) or (_DWELL in codes and letter != "M"):
        raise not_supported(column, f"G291 {letter}{number}")
    return f"{letter}{number}"
