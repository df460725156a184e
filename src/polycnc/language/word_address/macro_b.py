"""Expressions of custom macro B, compiled to Python.

A recursive-descent parser turns the text into Python source in which every literal is a parameter, so that all
expressions of one shape share one compiled function (FANUC macro B; priorities: functions, `* / AND MOD`,
`+ - OR XOR`, comparisons). Generated code reads variables through the channel's memory `m`: `m.locals[n]` for #1-#33,
`m.common` for #100-#999, `m.read(n)` for the rest. A vacant variable is None; in arithmetic it counts as zero.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from polycnc.language.word_address import functions
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel

    Evaluate = Callable[[Channel], float | None]

MAX_NESTING = 5

FUNCTIONS = (
    "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT", "ABS", "BIN", "BCD", "ROUND", "FIX", "FUP", "LN",
    "EXP", "POW", "PRM",
)  # fmt: skip
#: Functions may be written with their first two letters; three where two are not enough.
_ABBREVIATIONS = {"SI": "SIN", "CO": "COS", "TA": "TAN", "AS": "ASIN", "AC": "ACOS", "AT": "ATAN", "SQ": "SQRT",
                  "AB": "ABS", "BI": "BIN", "BC": "BCD", "RO": "ROUND", "FI": "FIX", "FU": "FUP", "EX": "EXP",
                  "PO": "POW"}  # fmt: skip
_SPACE = re.compile(r"[ \t]*")
_NUMBER = re.compile(r"\d+\.?\d*|\.\d+")
_FUNCTION = re.compile(r"([A-Z]+)[ \t]*(?=\[)")
_TERM_OPERATOR = re.compile(r"\*|/|AND|MOD")
_SUM_OPERATOR = re.compile(r"\+|-|OR|XOR")
_COMPARISON = re.compile(r"EQ|NE|GT|GE|LT|LE")
_LOGIC = re.compile(r"AND|OR|XOR")
_NAMED = re.compile(r"\[#(_?[A-Z][A-Z0-9_]*)")

_compiled: dict[str, Callable[[Any, list[float]], Any]] = {}


class Reader:
    """A place in the text of one block, and the literals met so far.

    Args:
        text: The block in upper case, comments blanked out, so that columns stay true.
        alarms: Names of mistakes to the control's alarm codes.
    """

    def __init__(self, text: str, alarms: Mapping[str, str], pos: int = 0) -> None:
        self.text = text
        self.pos = pos
        self.alarms = alarms
        self.literals: list[float] = []
        self.depth = 0
        self.in_word = False

    def fail(self, name: str, column: int | None = None) -> AlarmError:
        """The alarm for a mistake at this place."""
        place = self.pos if column is None else column
        return AlarmError(self.alarms[name], column=place + 1, word=self.text[place : place + 1])

    def space(self) -> None:
        """Pass over blanks."""
        match = _SPACE.match(self.text, self.pos)
        if match:
            self.pos = match.end()

    def peek(self) -> str:
        """The next character that is not blank, or an empty text at the end."""
        self.space()
        return self.text[self.pos] if self.pos < len(self.text) else ""

    def accept(self, token: str) -> bool:
        """Take a token if it stands here."""
        self.space()
        if self.text.startswith(token, self.pos):
            self.pos += len(token)
            return True
        return False

    def match(self, pattern: re.Pattern[str]) -> str:
        """Take what a pattern matches here, or nothing."""
        self.space()
        match = pattern.match(self.text, self.pos)
        if match is None:
            return ""
        self.pos = match.end()
        return match.group()

    def expect(self, token: str, mistake: str) -> None:
        """Take a token that must stand here."""
        if not self.accept(token):
            raise self.fail(mistake)

    # ---- grammar: each method gives Python source of a number (`value`) or of a number or None (`raw`) -------------

    def sum(self) -> str:
        """Terms joined by `+ - OR XOR`."""
        left = self.term()
        while operator := self.match(_SUM_OPERATOR):
            right = _value(self.term())
            left = _value(left)
            left = (
                f"({left}{operator}{right})" if operator in "+-" else f"{operator.lower()}_({left},{right})"
            )
        return left

    def term(self) -> str:
        """Factors joined by `* / AND MOD`."""
        left = self.factor()
        while operator := self.match(_TERM_OPERATOR):
            right = _value(self.factor())
            left = _value(left)
            left = (
                f"({left}{operator}{right})" if operator in "*/" else f"{operator.lower()}_({left},{right})"
            )
        return left

    def factor(self) -> str:
        """A number, a variable, a function, a bracket, with signs."""
        char = self.peek()
        if char == "-":
            self.pos += 1
            return f"(-{_value(self.factor())})"
        if char == "+":
            self.pos += 1
            return f"(+{_value(self.factor())})"
        if char == "#":
            return self.variable()
        if char == "[":
            named = _NAMED.match(self.text, self.pos)
            return self.named_variable(named) if named else self.bracket()
        if number := self.match(_NUMBER):
            self.literals.append(float(number))
            return f"k[{len(self.literals) - 1}]"
        if name := self.match(_FUNCTION):
            return self.function(name.strip())
        raise self.fail("expression")

    def bracket(self) -> str:
        """`[ … ]`; at most five may be open."""
        self.expect("[", "open_bracket")
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise self.fail("nesting")
        inner = self.sum()
        if not self.accept("]"):
            raise self.fail("condition_as_value" if self.match(_COMPARISON) else "close_bracket")
        self.depth -= 1
        return inner if inner.startswith(("(", "k[")) else f"({inner})"

    def variable(self) -> str:
        """`#n` or `#[expression]`: the source that reads it (None when vacant)."""
        self.expect("#", "expression")
        if self.peek() == "[":
            return f"m.read_indirect({_value(self.bracket())})"
        if self.peek() == "#":
            raise self.fail("expression")
        number = self.match(_NUMBER)
        if not number or "." in number:
            raise self.fail("expression")
        n = int(number)
        if 1 <= n <= 33:
            return f"m.locals[{n}]"
        if 100 <= n <= 199 or 500 <= n <= 999:
            return f"m.common[{n}]"
        return f"m.read({n})"

    def named_variable(self, match: re.Match[str]) -> str:
        """`[#NAME]` or `[#_ABSIO[n]]`: a variable by its name."""
        self.pos = match.end()
        name = match.group(1)
        index = _value(self.bracket()) if self.peek() == "[" else "None"
        self.expect("]", "close_bracket")
        return f"m.read_named({name!r},{index})"

    def function(self, name: str) -> str:
        """A function call; `ATAN[a]/[b]` and `ATAN[a,b]` have two arguments."""
        full = _ABBREVIATIONS.get(name, name)
        if full not in FUNCTIONS:
            raise self.fail("function", self.pos - len(name))
        self.expect("[", "open_bracket")
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise self.fail("nesting")
        arguments = [_value(self.sum())]
        while self.accept(","):
            arguments.append(_value(self.sum()))
        self.expect("]", "close_bracket")
        self.depth -= 1
        if full == "PRM":
            return self._parameter(arguments)
        if full == "ATAN" and len(arguments) == 1:
            before = self.pos
            if self.accept("/") and self.peek() == "[":
                arguments.append(_value(self.bracket()))
            else:
                self.pos = before
        if len(arguments) != (2 if full == "POW" else 1) and not (full == "ATAN" and len(arguments) == 2):
            raise self.fail("argument")
        call = full.lower()
        if full == "ROUND" and self.in_word:
            call = "round_increment"
        return f"{call}_(m,{','.join(arguments)})"

    def _parameter(self, arguments: list[str]) -> str:
        """`PRM[number]`, `PRM[number,bit]`, each with `/[axis number]`: a machine parameter."""
        if len(arguments) > 2:
            raise self.fail("argument")
        bit = arguments[1] if len(arguments) == 2 else "None"
        before = self.pos
        axis = "None"
        if self.accept("/") and self.peek() == "[":
            axis = _value(self.bracket())
        else:
            self.pos = before
        return f"m.parameter({arguments[0]},{bit},{axis})"

    def condition(self) -> str:
        """`[a EQ b]`, and with the parameter for it `[[a EQ b] AND [c GT d]]`."""
        self.expect("[", "open_bracket")
        start, literals = self.pos, len(self.literals)
        if self.peek() == "[":
            try:
                left = self.condition()
            except AlarmError:
                self.pos = start
                del self.literals[literals:]
            else:
                return self._joined_conditions(left)
        left = self.sum()
        comparison = self.match(_COMPARISON)
        if not comparison:
            raise self.fail("condition")
        right = self.sum()
        if not self.accept("]"):
            raise self.fail("close_bracket")
        if comparison in ("EQ", "NE"):
            return f"{comparison.lower()}_({left},{right})"
        operator = {"GT": ">", "GE": ">=", "LT": "<", "LE": "<="}[comparison]
        return f"({_value(left)}{operator}{_value(right)})"

    def _joined_conditions(self, left: str) -> str:
        while operator := self.match(_LOGIC):
            right = self.condition()
            left = f"joined_(m,{left},{operator.lower()!r},{right})"
        self.expect("]", "close_bracket")
        return left

    def comment_behind(self, _begin: int) -> str:
        """The comment behind a place of the block; a plain reader has none."""
        return ""

    # ---- results ----------------------------------------------------------------------------------------------------

    def evaluator(self, source: str) -> Evaluate:
        """A function of the channel that gives the value of generated source."""
        function = compile_source(source)
        literals = self.take_literals()
        return lambda channel: function(channel.memory, literals)

    def take_literals(self) -> list[float]:
        """The literals of the source generated so far; the next source begins anew."""
        literals, self.literals = self.literals, []
        return literals


def _value(source: str) -> str:
    """Source of a plain number: a bare variable counts as zero while it is vacant."""
    return f"({source} or 0.0)" if source.startswith("m.") else source


def compile_source(source: str) -> Callable[[Any, list[float]], Any]:
    """The function of (memory, literals) for generated source; one for each shape of expression."""
    function = _compiled.get(source)
    if function is None:
        code = compile(f"lambda m, k: {source}", "<macro>", "eval")
        function = _compiled[source] = eval(code, functions.NAMESPACE)
    return function


def compile_statement(source: str) -> Callable[[Any, list[float]], Any]:
    """The function of (memory, literals) that carries out a generated statement; one for each shape."""
    function = _compiled.get(source)
    if function is None:
        space = dict(functions.NAMESPACE)
        exec(compile(f"def run(m, k):\n    {source}", "<macro>", "exec"), space)
        function = _compiled[source] = space["run"]
    return function
