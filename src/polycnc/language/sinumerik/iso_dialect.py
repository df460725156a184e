"""Blocks of the ISO dialect (G291): their words, and what the control's own language calls them.

Behind a block of G291, up to the next one of G290, lines are words of ISO code M: letters with numbers, comments in
brackets. What means the same on both sides, or has a counterpart, is translated here; what has none is for the control
(`control.sinumerik.iso`), which takes the words of such functions; what is left is refused, as PC0001 with its word.
The manual names G290 and G291 (job planning 16.1, group 47) alone; counterparts are those of the control's manual of
ISO milling.
"""

from __future__ import annotations

import re

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.errors import not_supported, syntax
from polycnc.language.sinumerik.lexer import prefix_of

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

#: Blocks that change the language; they hold nothing else.
_SWITCH = regex(r"[ \t]*G[ \t]*(29[01])[ \t\r\x00]*(?:;.*)?$", re.IGNORECASE | re.ASCII)
_COMMENT = regex(r"\([^()]*\)|;.*$")
_WORD = regex(r"[ \t\r\x00]*(,?[A-Z])[ \t]*([+-]?(?:\d+(?:\.\d*)?|\.\d+))", re.IGNORECASE | re.ASCII)
#: G functions and what they are called in the control's own language; an empty text for what is so in any case.
G_FUNCTIONS = {
    **{
        f"G{number}": f"G{number}"
        for number in (0, 1, 2, 3, 4, 9, 17, 18, 19, 40, 41, 42, 54, 55, 56, 57, 64, 90, 91, 93, 94, 95)
    },
    "G20": "G700",
    "G21": "G710",
    "G58": "G505",
    "G59": "G506",
    "G61": "G60",
    # The type of feed stays, as in the dialect.
    "G96": "G962",
    "G97": "G972",
}
#: Words that mean the same.
SAME = frozenset("XYZABCUVWIJKFSTM")
#: Words of corners: between a straight move or an arc and the next one.
CORNERS = {",R": "RND", ",C": "CHR"}
#: M functions of subprograms.
CALLS = frozenset((98.0, 99.0))
MOTIONS = ("G0", "G1", "G2", "G3")
CONTOUR = frozenset(("G1", "G2", "G3"))
_CIRCLES, _DWELL = frozenset(("G2", "G3")), "G4"
_MILLI = 1000.0


class IsoWord(NamedTuple):
    """A word of a block: letter, value, number as written, column from 1, and whether it is an increment (U, W)."""

    letter: str
    value: float
    number: str
    column: int
    incremental: bool = False

    @property
    def name(self) -> str:
        """The word without leading zeros."""
        return f"{self.letter}{self.value:g}"

    @property
    def code(self) -> str:
        """A G function without leading zeros; empty for another word."""
        return self.name if self.letter == "G" else ""


class IsoBlock(NamedTuple):
    """A block of the ISO dialect.

    Attributes:
        line: As written.
        end: Where its block number and skip mark end.
        words: Its words in their order.
    """

    line: str
    end: int
    words: tuple[IsoWord, ...]

    @property
    def codes(self) -> tuple[str, ...]:
        """Its G functions."""
        return tuple(word.code for word in self.words if word.code)

    def find(self, letter: str) -> IsoWord | None:
        """The last word with a letter."""
        return next((word for word in reversed(self.words) if word.letter == letter), None)

    def told(self, motion: str, taken: Collection[IsoWord] = ()) -> str:
        """The block in the words of the control's own language; words keep their columns where they can.

        Args:
            motion: The motion function that is active in front of it.
            taken: Words that are somebody else's.

        Raises:
            NcSyntaxError: PC0001 for a word that is not translated.
        """
        codes = self.codes
        motion = next((code for code in codes if code in MOTIONS), motion)
        if _DWELL in codes and not any(word.letter in "XP" for word in self.words):
            raise not_supported(self.end + 1, "G291 G4")
        text = self.line[: self.end]
        for word in self.words:
            if word in taken:
                continue
            told = _told(word, codes, motion)
            text = f"{text.ljust(word.column - 1)}{told} " if told else text
        return text


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


def parsed(line: str) -> IsoBlock:
    """The words of a block.

    Raises:
        NcSyntaxError: PC0001 for macro statements, 12080 for what is no word.
    """
    end = start = prefix_of(line).end
    text = _COMMENT.sub(lambda found: " " * len(found[0]), line)
    words = []
    while (found := _WORD.match(text, end)) is not None:
        words.append(IsoWord(found[1].upper(), float(found[2]), found[2], found.start(1) + 1))
        end = found.end()
    if text[end:].strip(" \t\r\x00"):
        rest = len(text) - len(text[end:].lstrip(" \t\r\x00"))
        if text[rest] in "#[]=*O%" or text[rest].isalpha():
            raise not_supported(rest + 1, f"G291 {text[rest:].split()[0]}")
        raise syntax(rest + 1, text[rest:].split()[0])
    return IsoBlock(line, start, tuple(words))


def _told(word: IsoWord, codes: Sequence[str], motion: str) -> str:
    letter, value, number, column, incremental = word
    if word.code:
        if word.code not in G_FUNCTIONS:
            raise not_supported(column, f"G291 {word.code}")
        return G_FUNCTIONS[word.code]
    if _DWELL in codes and letter in "XP":
        return f"F{value if letter == 'X' else value / _MILLI!r}"
    if letter in CORNERS and motion in CONTOUR and value >= 0.0:
        return f"{CORNERS[letter]}={number}"
    if letter == "R" and motion in _CIRCLES:
        return f"CR={number}"
    if letter not in SAME or (letter == "M" and value in CALLS) or (_DWELL in codes and letter != "M"):
        raise not_supported(column, f"G291 {letter}{number}")
    return f"{letter}=IC({number})" if incremental else f"{letter}{number}"
