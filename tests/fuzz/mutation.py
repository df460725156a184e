"""How a text is changed: characters, words, numbers, lines, splices of other texts, bytes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from random import Random

#: Numbers at which something ends: digits, ranges of types, signs, exponents.
NUMBERS = (
    "0", "-0", "0.", ".", "-", "1", "-1", "2", "-2", ".5", "-.5", "1.5", "3", "7", "9", "10", "99", "100", "-100",
    "255", "256", "360", "-360", "1000", "9999", "10000", "32768", "65536", "99999", "248339", "999999", "9999999",
    "99999999", "99999999.", "-99999999", "999999999", "2147483647", "2147483648", "-2147483649", "4294967296",
    "9007199254740993", "9223372036854775808", "1" + "0" * 20, "9" * 40, "1" + "0" * 310, "9" * 400 + ".",
    "-1" + "0" * 310 + ".", "0." + "0" * 30 + "1", "0.0001", "0.00000001", ".001", "-.001", "0.9999999999",
    "1E5", "1E308", "1E309", "1EX5", "1EX300", "1EX-300", "1EX400", "1e-320", "90.", "45.", "180.", "-90.", "1.0.0",
    "--5", "+5", "-+5", "1,5", "0x10", "'HFF'", "'B101'", "1 2",
)  # fmt: skip
#: Pieces that do not come from the text itself.
PIECES = (
    "[" * 40, "]" * 40, "(" * 40, ")" * 40, "-" * 250, "+" * 250, "#" * 100, "NOT " * 100, "[" * 2000, "(" * 2000,
    "-" * 5000, "%", ":", ";", "/", "//", "/9", "\t", "\0", "\r", "\x1a", "\ufeff", "é", "軸", "😀", "\u2028", "\x85",
    "=", "==", "<<", "<>", '"', "'", "(", ")", "[", "]", "{", "}", "<", ">", "$", "$AA_IM[X]", "#0", "#5021", "R", "@",
    "M30", "M99", "M98P1", "G0", "G1", "G2", "G3", "G28", "G40", "G41D1", "G42D1", "G53", "G54", "G80", "G90", "G91",
    "K9999999", "L9999999", "P1", "Q0", "R0", "F0", "F.0001", "F9999999.", "S0", "D1", "T1", "X1.", "Y1.", "Z1.",
    "I1.", "J1.", "K1.", "X=X", "GOTO1", "N1", "N1 ", "WHILE[1]DO1", "END1", "IF[1]", "WHILE TRUE", "ENDWHILE", "LOOP",
    "ENDLOOP", "GOTOB A", "A:", "REPEAT A", "RET", "DEF INT A", "DEF REAL A[3]=SET(1,2)", "POT(", "SQRT(-1)", "1/0",
    "ATAN[1]/[0]", "LN[0]", "EXP[1000]", "POW(10,400)", "DIV", "MOD", "TRANS X1", "ROT RPL=", "SCALE X0", "MIRROR X0",
)  # fmt: skip
_NUMBER = re.compile(r"\d+\.?\d*|\.\d+")
_WORD = re.compile(r"[A-Za-z_$#]+(?:\[[^\]]*\])?=?-?[\d.]+|[A-Za-z_$]+|\S")
_ALPHABET = "0123456789.-+XYZABCDEFGHIJKLMNOPQRSTUVW#[]()=/*,:;<>%\"'&@$!_ \n"
Change = "Callable[[Random, list[str], str], None]"


def mutated(random: Random, text: str, other: str) -> str:
    """A text with one to five changes.

    Args:
        random: Decides them.
        text: What is changed.
        other: Where spliced lines come from.
    """
    lines = text.split("\n")
    for _ in range(random.choice((1, 1, 1, 2, 2, 3, 5))):
        random.choices(_CHANGES, _WEIGHTS)[0](random, lines, other)
        if not lines:
            lines.append("")
    return "\n".join(lines)


def _at(random: Random, lines: list[str]) -> int:
    """A line, if possible one that says something."""
    at = random.randrange(len(lines))
    return at if lines[at].strip() else random.randrange(len(lines))


def _number(random: Random, lines: list[str], _: str) -> None:
    at = _at(random, lines)
    found = list(_NUMBER.finditer(lines[at]))
    if found:
        match = random.choice(found)
        lines[at] = lines[at][: match.start()] + random.choice(NUMBERS) + lines[at][match.end() :]


def _digit(random: Random, lines: list[str], _: str) -> None:
    """A number becomes another one of its kind."""
    at = _at(random, lines)
    found = list(_NUMBER.finditer(lines[at]))
    if found:
        match = random.choice(found)
        digits = [random.choice("0123456789") if c.isdigit() else c for c in match[0]]
        lines[at] = lines[at][: match.start()] + "".join(digits) + lines[at][match.end() :]


def _character(random: Random, lines: list[str], _: str) -> None:
    at = _at(random, lines)
    line = lines[at]
    place = random.randrange(len(line) + 1)
    lines[at] = line[:place] + random.choice(_ALPHABET) + line[place + random.randint(0, 1) :]


def _piece(random: Random, lines: list[str], _: str) -> None:
    at = _at(random, lines)
    place = random.randrange(len(lines[at]) + 1)
    lines[at] = lines[at][:place] + random.choice(PIECES) + lines[at][place:]


def _cut(random: Random, lines: list[str], _: str) -> None:
    at = _at(random, lines)
    begin, end = sorted(random.randrange(len(lines[at]) + 1) for _ in range(2))
    lines[at] = lines[at][:begin] + lines[at][end:]


def _words(random: Random, lines: list[str], _: str) -> None:
    """Words of a block are dropped, doubled or put into another order."""
    at = _at(random, lines)
    words = _WORD.findall(lines[at])
    if len(words) > 1:
        one = random.randrange(len(words))
        what = random.randrange(3)
        if what == 0:
            del words[one]
        elif what == 1:
            words.insert(random.randrange(len(words)), words[one])
        else:
            random.shuffle(words)
        lines[at] = " ".join(words)


def _word_of_another(random: Random, lines: list[str], other: str) -> None:
    words = _WORD.findall(random.choice(other.split("\n")))
    if words:
        lines[_at(random, lines)] += " " + random.choice(words)


def _drop(random: Random, lines: list[str], _: str) -> None:
    del lines[random.randrange(len(lines))]


def _double(random: Random, lines: list[str], _: str) -> None:
    lines.insert(random.randrange(len(lines)), random.choice(lines))


def _swap(random: Random, lines: list[str], _: str) -> None:
    one, two = random.randrange(len(lines)), random.randrange(len(lines))
    lines[one], lines[two] = lines[two], lines[one]


def _join(random: Random, lines: list[str], _: str) -> None:
    at = random.randrange(len(lines))
    lines[at : at + 2] = [" ".join(lines[at : at + 2])]


def _splice(random: Random, lines: list[str], other: str) -> None:
    taken = other.split("\n")
    first = random.randrange(len(taken))
    place = random.randrange(len(lines) + 1)
    lines[place:place] = taken[first : first + random.choice((1, 1, 1, 2, 4, 20))]


def _bytes(random: Random, lines: list[str], _: str) -> None:
    at = _at(random, lines)
    place = random.randrange(len(lines[at]) + 1)
    some = random.randbytes(random.choice((1, 2, 8))).decode("latin-1")
    lines[at] = lines[at][:place] + some + lines[at][place:]


def _end(random: Random, lines: list[str], _: str) -> None:
    del lines[random.randrange(len(lines)) :]


_CHANGES = (
    _number, _digit, _character, _piece, _cut, _words, _word_of_another, _drop, _double, _swap, _join, _splice,
    _bytes, _end,
)  # fmt: skip
_WEIGHTS = (20, 10, 12, 12, 4, 10, 8, 5, 5, 5, 3, 14, 2, 1)
