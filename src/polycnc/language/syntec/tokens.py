"""From characters to tokens, for macro files (`%@MACRO`) and for ISO files.

In a macro file round brackets group and `(* *)` is a comment; in an ISO file `( )` is a comment. Everything
else is read alike. A token knows whether it is the first on its line: line ends are no tokens, but they can
end a statement.
"""

from __future__ import annotations

import re

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.syntec.functions import FUNCTIONS
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

SYNTAX = "COM-003"
NOT_ASCII = "COM-027"

OPERATORS = frozenset({"AND", "OR", "XOR", "NOT", "MOD"})
#: Words that begin a statement or a part of one.
OPENERS = frozenset({"IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "GOTO", "PAUSE"})
PARTS = frozenset({"ELSEIF", "ELSE", "END_IF", "END_CASE", "END_FOR", "END_WHILE", "UNTIL", "END_REPEAT"})
#: Words inside the head of a statement.
LINKS = frozenset({"THEN", "OF", "TO", "BY", "DO"})
ALIASES = {
    "ENDIF": "END_IF", "ENDFOR": "END_FOR", "ENDWHILE": "END_WHILE", "ENDCASE": "END_CASE",
    "ENDREPEAT": "END_REPEAT",
}  # fmt: skip
#: Forms of other controls, and how SYNTEC writes them.
FOREIGN = {
    "EQ": "=", "NE": "<>", "GT": ">", "GE": ">=", "LT": "<", "LE": "<=", "==": "=", "!=": "<>", "DIV": "/",
    "FIX": "FLOOR", "FUP": "CEIL", "POPEN": "OPEN", "PCLOS": "CLOSE", "DPRNT": "PRINT", "ELSIF": "ELSEIF",
    "DEFAULT": "ELSE",
}  # fmt: skip

_NAMES = sorted(
    {*OPERATORS, *OPENERS, *PARTS, *LINKS, *ALIASES, *FUNCTIONS, "AR", "MAR", *filter(str.isalpha, FOREIGN)},
    key=len,
    reverse=True,
)
#: A whole statement in one line that is nothing but words with numbers; most lines of long programs are.
_PLAIN = r"(?:(?<=\n)|\A)[ \t]*(?:[A-Z][-+]?(?:\d+(?:\.\d*)?|\.\d+)[ \t]*)+;[ \t]*(?=\n|\Z)"
_PATTERN = r"""
    (?P<newline>\n)
  | (?P<plain>{plain})
  | (?P<space>[ \t\f\v]+)
  | (?P<comment>//[^\n]*|{comment})
  | (?P<open>{unclosed})
  | (?P<text>"(?:\\[^\n]|[^"\\\n])*")
  | (?P<hex>0[xX][0-9A-Fa-f]+)
  | (?P<number>\d+\.?\d*|\.\d+)
  | (?P<name>(?:{names})(?![A-Za-z_]))
  | (?P<letter>[A-Za-z])
  | (?P<symbol>:=|<=|>=|<>|==|!=|[-+*/<>=&(),:;\[\]\#@$!%])
  | (?P<wrong>.)
"""
_names = "|".join(_NAMES)
_MACRO = regex(
    _PATTERN.format(comment=r"\(\*.*?\*\)", unclosed=r"\(\*", names=_names, plain=_PLAIN),
    re.VERBOSE | re.IGNORECASE | re.DOTALL,
)
_ISO = regex(
    _PATTERN.format(comment=r"\([^)\n]*\)", unclosed=r"\(", names=_names, plain="(?!)"),
    re.VERBOSE | re.IGNORECASE | re.DOTALL,
)
_QUIET = frozenset({"space", "comment"})


class Token(NamedTuple):
    """One token.

    Attributes:
        kind: `number`, `text`, `name`, `letter`, `symbol`, `fault`, a `plain` block of words, or, behind the
            last one, `end`.
        text: As typed; names and letters in upper case.
        line: Line of the file, from 1.
        column: Column in the line, from 1.
        first: Nothing stands before it on its line.
        hint: Message id of what is wrong with a `fault`.
    """

    kind: str
    text: str
    line: int
    column: int
    first: bool
    hint: str = ""


def tokenize(lines: Sequence[str], *, macro: bool, first_line: int = 1) -> list[Token]:
    """All tokens of a text, closed by one of kind `end`. Mistakes become tokens of kind `fault`."""
    return list(_scan("\n".join(lines), _MACRO if macro else _ISO, first_line))


def _scan(source: str, pattern: re.Pattern[str], line: int) -> Iterator[Token]:
    start = 0
    first = True
    after_letter = False
    position = 0
    while match := pattern.match(source, position):
        kind, text = str(match.lastgroup), match.group()
        if kind == "hex" and after_letter:
            # `X0X10` is two words, not a hexadecimal number.
            kind, text = "number", "0"
        column = position - start + 1
        position += len(text)
        if kind == "newline":
            line, start, first = line + 1, position, True
            continue
        if kind in _QUIET:
            if "\n" in text:
                line += text.count("\n")
                start = match.start() + text.rindex("\n") + 1
                first = True
            continue
        yield _token(kind, text, line, column, first)
        first = False
        after_letter = kind == "letter"
        if kind == "open":
            # A comment without an end: what follows cannot be read as anything.
            break
    yield Token("end", "", line, position - start + 1, True)


def _token(kind: str, text: str, line: int, column: int, first: bool) -> Token:
    if kind == "hex":
        return Token("number", text, line, column, first)
    if kind == "name":
        name = text.upper()
        name = ALIASES.get(name, name)
        if name in FOREIGN:
            return Token("fault", name, line, column, first, "hint.syntec.foreign")
        return Token("name", name, line, column, first)
    if kind == "letter":
        return Token(kind, text.upper(), line, column, first)
    if kind == "symbol" and text in FOREIGN:
        return Token("fault", text, line, column, first, "hint.syntec.foreign")
    if kind == "open":
        return Token("fault", text, line, column, first, "hint.syntec.open-comment")
    if kind == "wrong":
        return Token("fault", text, line, column, first)
    return Token(kind, text, line, column, first)


def fault(token: Token, code: str = SYNTAX, hint: str = "") -> AlarmError:
    """The alarm for a token that cannot stand where it stands; one that can stand nowhere has its own."""
    if token.kind == "fault":
        code = SYNTAX if token.text.isascii() else NOT_ASCII
        hint = hint or token.hint
    return AlarmError(
        code,
        line=token.line,
        column=token.column,
        hint=hint,
        text=token.text,
        form=FOREIGN.get(token.text, ""),
    )
