"""Blocks as tokens (840D sl Fundamentals 2.2, job planning 1.1).

Upper and lower case are equal, blanks are free except inside names and numbers: `N10G1X10Y-5` is four words.
A letter followed by digits is one token (`word`), because only the parser knows whether `X1` is X with value
1, the axis X1 or, before `=`, an extended address.
"""

from __future__ import annotations

import re
from math import isinf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.language.sinumerik.errors import NcSyntaxError, syntax


class Token(NamedTuple):
    """One token of a block.

    Attributes:
        kind: `name`, `word` (letter and number), `number`, `string`, `op`, or `end`.
        text: Upper case; of a string its contents as written, of a word all of it.
        value: Number of a `number` or `word` token.
        start: Place in the line, from 0.
        end: Place behind it.
    """

    kind: str
    text: str
    value: int | float
    start: int
    end: int

    @property
    def column(self) -> int:
        """Column, from 1."""
        return self.start + 1

    @property
    def letter(self) -> str:
        """Address letter of a `word`."""
        return self.text[0]


_NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)(?:EX[+-]?\d+)?"
_TOKEN = regex(
    rf"""[ \t]*(?:
      (?P<word>[A-Z](?:\d+(?:\.\d*)?(?:EX[+-]?\d+)?))
    | (?P<name>\$\$?[A-Z]\w*|[A-Z_]{{2}}\w*|[A-Z])
    | (?P<number>{_NUMBER})
    | "(?P<string>[^"]*)"
    | '(?P<literal>[HB][0-9A-F]+)'
    | '(?P<char>[^'])'
    | (?P<op><<|==|<>|<=|>=|[-+*/=()\[\],:<>])
    )""",
    re.VERBOSE | re.IGNORECASE | re.ASCII,
)
_BLANK = " \t\r\n\x00"
LABEL = regex(r"[ \t]*([A-Z_]{2}\w{0,30})[ \t]*:", re.IGNORECASE | re.ASCII)
PREFIX = regex(
    r"[ \t]*(?:/(?P<skip>\d?)[ \t]*)?(?:(?P<number>N[ \t]*\d+|:[ \t]*\d+)[ \t]*)?", re.IGNORECASE | re.ASCII
)
MAX_EXPONENT = 300
JUMPS = frozenset({"GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS"})


def number_of(text: str, column: int = 0) -> int | float:
    """The value of a number: INT without point and exponent (REAL beyond the range of INT), else REAL."""
    mantissa, _, exponent = text.upper().partition("EX")
    if exponent and abs(int(exponent)) > MAX_EXPONENT:
        raise NcSyntaxError("12160", column, text)
    if exponent:
        return float(f"{mantissa}e{exponent}")
    if "." in text or len(text) > 10:
        value = float(text)
        if isinf(value):
            raise NcSyntaxError("12160", column, text)
        return value
    value = int(text)
    return value if value < 2**31 else float(value)


def _literal(text: str, column: int) -> int:
    """`'HFF'` and `'B101'` (1.4)."""
    digits, base = text[1:], 16 if text[0] in "Hh" else 2
    try:
        value = int(digits, base)
    except ValueError:
        raise syntax(column, text) from None
    if value >= 2**32:
        raise NcSyntaxError("12230" if base == 16 else "12220", column, text)
    return value - 2**32 if value >= 2**31 else value


def tokenize(line: str, start: int = 0) -> list[Token]:
    """The tokens of a line from a place on, without its comment, closed by an `end` token.

    Raises:
        NcSyntaxError: 12080 for a character that begins nothing, or a string without end.
    """
    tokens: list[Token] = []
    position = start
    match = _TOKEN.match
    while (found := match(line, position)) is not None:
        kind = found.lastgroup or ""
        begin, position = found.span(kind)
        text = found[kind]
        column = begin + 1
        if kind in ("string", "char"):  # a character stands in quotes of either kind (10.5.2)
            position += 1
            begin -= 1
            tokens.append(Token("string", text, 0, begin, position))
        elif kind == "number":
            tokens.append(Token(kind, text.upper(), number_of(text, column), begin, position))
        elif kind == "word":
            tokens.append(Token(kind, text.upper(), number_of(text[1:], column), begin, position))
        elif kind == "literal":
            position += 1
            tokens.append(Token("number", text.upper(), _literal(text, column), begin - 1, position))
        else:
            tokens.append(Token(kind, text.upper(), 0, begin, position))
    rest = position + len(line[position:]) - len(line[position:].lstrip(_BLANK))
    if rest < len(line) and line[rest] != ";":
        raise syntax(rest + 1, (line[rest:].split(maxsplit=1) or [repr(line[rest])])[0])
    tokens.append(Token("end", "", 0, rest, rest))
    return tokens


class Prefix(NamedTuple):
    """What stands before the words: skip level (-1 for none), block number, label, and where they end."""

    skip: int
    number: str
    label: str
    end: int


def prefix_of(line: str) -> Prefix:
    """Skip level, block number (`N10` or `:10`, without leading zeros) and label of a line."""
    found = PREFIX.match(line)
    assert found is not None  # every part is optional
    end = found.end()
    skip = -1 if found["skip"] is None else int(found["skip"] or 0)
    number = found["number"]
    if number:
        number = number[0].upper() + str(int(number[1:]))
    label = LABEL.match(line, end)
    if label is None or label[1].upper() in JUMPS:  # GOTOF :20 is a jump to a main block
        return Prefix(skip, number or "", "", end)
    return Prefix(skip, number or "", label[1].upper(), label.end())
