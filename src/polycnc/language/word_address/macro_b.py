"""Expressions of custom macro B, compiled to Python.

The reader turns the text into code in which every number is a parameter, so that all expressions of one shape share
one compiled function (FANUC macro B; priorities: functions, `* / AND MOD`, `+ - OR XOR`, comparisons). The code reads
variables through the channel's memory `m`: `m.locals[n]` for #1-#33, `m.common` for #100-#199, `m.kept` for #500-#999,
`m.read(n)` for the rest. A vacant variable is None; in arithmetic it counts as zero.
"""

from __future__ import annotations

import re
from math import isinf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import (
    Code,
    Lifted,
    attribute,
    call,
    constant,
    either,
    given,
    item,
    name,
)
from polycnc.language.expressions.operators import (
    TIGHTEST,
    Operator,
    OperatorReader,
    applied_to_one,
    calculated,
)
from polycnc.language.expressions.shapes import Function, Shapes, TooDeepError
from polycnc.language.word_address.functions import NAMESPACE
from polycnc.language.word_address.patterns import MEMORIES, NUMBER, Spot
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import FunctionType

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
#: Powers of comparisons, of sums and of products; a comparison stands in a condition only.
COMPARISON, SUM, PRODUCT = 1, 2, 3
#: Operators that tell a vacant variable from zero.
VACANT_TOO = "vacant too"
OPERATORS = {
    "EQ": Operator(COMPARISON, "eq_", VACANT_TOO),
    "NE": Operator(COMPARISON, "ne_", VACANT_TOO),
    "GT": Operator(COMPARISON, nodes.Gt),
    "GE": Operator(COMPARISON, nodes.GtE),
    "LT": Operator(COMPARISON, nodes.Lt),
    "LE": Operator(COMPARISON, nodes.LtE),
    "+": Operator(SUM, nodes.Add),
    "-": Operator(SUM, nodes.Sub),
    "XOR": Operator(SUM, "xor_"),
    "OR": Operator(SUM, "or_"),
    "*": Operator(PRODUCT, nodes.Mult),
    "/": Operator(PRODUCT, nodes.Div),
    "AND": Operator(PRODUCT, "and_"),
    "MOD": Operator(PRODUCT, "mod_"),
}
SIGNS = {"-": Operator(TIGHTEST, nodes.USub), "+": Operator(TIGHTEST, nodes.UAdd)}

_BLANKS = (" ", "\t")
_VARIABLE = regex(r"#[ \t]*(\d+)(?![\d.])")
_FUNCTION = regex(r"([A-Z]+)[ \t]*(?=\[)")
_OPERATOR = regex(rf"[ \t]*({'|'.join(map(re.escape, OPERATORS))})")
_LOGIC = regex(r"AND|OR|XOR")
_NAMED = regex(r"\[#(_?[A-Z][A-Z0-9_]*)")

MEMORY = name("m")
_MEMORIES = {memory: attribute(MEMORY, memory) for memory in MEMORIES}
_NONE, _ZERO = constant(None), constant(0.0)


def macro_shapes() -> Shapes:
    """A place for the compiled code of a control's programs."""
    return Shapes(NAMESPACE)


class Lifting(NamedTuple):
    """Code, and the numbers that were lifted out of it."""

    code: Code
    numbers: tuple[float, ...]


class Reader(OperatorReader[int, Code]):
    """A place in the text of one block, and the numbers met so far.

    Args:
        text: The block in upper case, comments blanked out, so that columns stay true.
        alarms: Names of mistakes to the control's alarm codes.
        shapes: Compiled code of the control.
    """

    def __init__(self, text: str, alarms: Mapping[str, str], shapes: Shapes) -> None:
        super().__init__()
        self.text = text
        self.pos = 0
        self.alarms = alarms
        self.shapes = shapes
        self.numbers: list[float] = []
        self.spots: list[Spot | None] = []
        self.in_word = False
        self._open_brackets = 0
        self._behind_operator = 0

    def fail(self, mistake: str, column: int | None = None) -> AlarmError:
        """The alarm for a mistake at this place."""
        place = self.pos if column is None else column
        return AlarmError(self.alarms[mistake], column=place + 1, word=self.text[place : place + 1])

    def space(self) -> None:
        """Pass over blanks."""
        text, pos = self.text, self.pos
        while text[pos : pos + 1] in _BLANKS:
            pos += 1
        self.pos = pos

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

    # ---- operators -----------------------------------------------------------------------------------------------

    def prefix_ahead(self) -> Operator | None:
        """A sign."""
        operator = SIGNS.get(self.peek())
        self._behind_operator = self.pos + 1
        return operator

    def infix_ahead(self) -> Operator | None:
        """The operator that stands here."""
        match = _OPERATOR.match(self.text, self.pos)
        if match is None:
            return None
        self._behind_operator = match.end()
        return OPERATORS[match[1]]

    def take_operator(self) -> int:
        """Read the operator that was found ahead."""
        self.pos = self._behind_operator
        return self.pos

    def signed(self, operator: Operator, _mark: int, operand: Code) -> Code:
        """A value with its sign."""
        return applied_to_one(operator.gives, number_of(operand))

    def joined(self, operator: Operator, _mark: int, left: Code, right: Code) -> Code:
        """Two operands."""
        if operator.family != VACANT_TOO:
            left, right = number_of(left), number_of(right)
        return calculated(operator.gives, left, right)

    def too_deep(self) -> AlarmError:
        """More than Python takes."""
        return self.fail("nesting")

    # ---- grammar: each method gives code of a number, or of a number or None for a vacant variable --------------

    def sum(self) -> Code:
        """An expression without comparisons."""
        return self.expression(COMPARISON)

    def factor(self) -> Code:
        """An operand with its signs."""
        return self.expression(TIGHTEST)

    def operand(self) -> Code:
        """A number, a variable, a function, a bracket."""
        char = self.peek()
        if char == "#":
            plain = _VARIABLE.match(self.text, self.pos)
            if plain is None:
                return self.variable()
            self.pos = plain.end()
            return self._numbered(int(plain[1]), plain.start(1))
        if char == "[":
            return self.named_variable() if _NAMED.match(self.text, self.pos) else self.bracket()
        start = self.pos
        if number := self.match(NUMBER):
            value = float(number)
            if isinf(value):
                raise self.fail("too_many_digits", start)
            return self.lift(value, Spot(start, float))
        if function := self.match(_FUNCTION):
            return self.function(function.strip())
        raise self.fail("expression")

    def lift(self, number: float, spot: Spot | None) -> Lifted:
        """A number as a parameter of the code; where it stands, None for one that other lines cannot have otherwise."""
        self.numbers.append(number)
        self.spots.append(spot)
        return Lifted("n", len(self.numbers) - 1)

    def _open(self) -> None:
        self.expect("[", "open_bracket")
        self._open_brackets += 1
        if self._open_brackets > MAX_NESTING:
            raise self.fail("nesting")

    def bracket(self) -> Code:
        """`[ … ]`; at most five may be open."""
        self._open()
        inner = self.sum()
        if not self.accept("]"):
            comparison = self.infix_ahead()
            if comparison is None or comparison.power != COMPARISON:
                raise self.fail("close_bracket")
            self.take_operator()
            raise self.fail("condition_as_value")
        self._open_brackets -= 1
        return inner

    def variable(self) -> Code:
        """`#n` or `#[expression]`: the code that reads it (None when vacant)."""
        self.expect("#", "expression")
        if self.peek() == "[":
            return call("m.read_indirect", number_of(self.bracket()))
        if self.peek() == "#":
            raise self.fail("expression")
        number = self.match(NUMBER)
        if not number or "." in number:
            raise self.fail("expression")
        return self._numbered(int(number), self.pos - len(number))

    def _numbered(self, number: int, begin: int) -> Code:
        return self.place(number, begin) or call(
            "m.read", self.lift(number, Spot(begin, int, is_variable=True))
        )

    def place(self, number: int, begin: int) -> Code | None:
        """Where a local or a common variable lies, whose digits begin at a column; None for all others."""
        for memory, numbers in MEMORIES.items():
            if number in numbers:
                return item(_MEMORIES[memory], self.lift(number, Spot(begin, int, is_variable=True)))
        return None

    def named_variable(self) -> Code:
        """`[#NAME]` or `[#_ABSIO[n]]`: the code that reads a variable by its name."""
        name, index = self.name_and_index(self.pos)
        return call("m.read_named", constant(name), index)

    def name_and_index(self, begin: int) -> tuple[str, Code]:
        """The name of a variable in its brackets, which begin at a column, and its index (None without)."""
        match = _NAMED.match(self.text, begin)
        if match is None:
            raise self.fail("expression")
        self.pos = match.end()
        index = number_of(self.bracket()) if self.peek() == "[" else _NONE
        self.expect("]", "close_bracket")
        return match[1], index

    def function(self, written: str) -> Code:
        """A function call; `ATAN[a]/[b]` and `ATAN[a,b]` have two arguments."""
        function = _ABBREVIATIONS.get(written, written)
        if function not in FUNCTIONS:
            raise self.fail("function", self.pos - len(written))
        self._open()
        arguments = [number_of(self.sum())]
        while self.accept(","):
            arguments.append(number_of(self.sum()))
        self.expect("]", "close_bracket")
        self._open_brackets -= 1
        if function == "PRM":
            return self._parameter(arguments)
        if function == "ATAN" and len(arguments) == 1:
            arguments += self._divisor()
        if len(arguments) != (2 if function == "POW" else 1) and not (
            function == "ATAN" and len(arguments) == 2
        ):
            raise self.fail("argument")
        called = "round_increment_" if function == "ROUND" and self.in_word else f"{function.lower()}_"
        return call(called, MEMORY, *arguments)

    def _parameter(self, arguments: list[Code]) -> Code:
        """`PRM[number]`, `PRM[number,bit]`, each with `/[axis number]`: a machine parameter."""
        if len(arguments) > 2:
            raise self.fail("argument")
        bit = arguments[1] if len(arguments) == 2 else _NONE
        axis = self._divisor() or [_NONE]
        return call("m.parameter", arguments[0], bit, *axis)

    def _divisor(self) -> list[Code]:
        """The second argument of a function that has it behind a `/`."""
        before = self.pos
        if self.accept("/") and self.peek() == "[":
            return [number_of(self.bracket())]
        self.pos = before
        return []

    def condition(self) -> Code:
        """`[a EQ b]`, and with the parameter for it `[[a EQ b] AND [c GT d]]`."""
        self.expect("[", "open_bracket")
        start = self.pos, len(self.numbers), len(self.spots), self.depth, self._open_brackets
        if self.peek() == "[":
            try:
                left = self.condition()
            except AlarmError:
                self.pos, numbers, spots, self.depth, self._open_brackets = start
                del self.numbers[numbers:], self.spots[spots:]
            else:
                return self._joined_conditions(left)
        left = self.sum()
        comparison = self.infix_ahead()
        if comparison is None or comparison.power != COMPARISON:
            raise self.fail("condition")
        mark = self.take_operator()
        condition = self.joined(comparison, mark, left, self.sum())
        if not self.accept("]"):
            raise self.fail("close_bracket")
        return condition

    def _joined_conditions(self, left: Code) -> Code:
        while operator := self.match(_LOGIC):
            right = self.condition()
            left = call("joined_", MEMORY, left, constant(operator.lower()), right)
        self.expect("]", "close_bracket")
        return left

    def comment_behind(self, _begin: int) -> str:
        """The comment behind a place of the block; a plain reader has none."""
        return ""

    # ---- results ----------------------------------------------------------------------------------------------------

    def evaluator(self, code: Code) -> Evaluate:
        """A function of the channel that gives the value of code that was just read."""
        function = self.compiled(self.lifting(code))
        return lambda channel: function(channel.memory)

    def compiled(self, lifting: Lifting) -> FunctionType:
        """The function of the memory for the code of a value."""
        return self._function(lifting.numbers, given(lifting.code))

    def compiled_list(self, lifting: Lifting) -> FunctionType:
        """The function of the memory for the code of a list of values."""
        return self._function(lifting.numbers, given(lifting.code))

    def compiled_statement(self, lifting: Lifting) -> FunctionType:
        """The function of the memory that carries out a statement."""
        return self._function(lifting.numbers, lifting.code)

    def _function(self, numbers: tuple[float, ...], statement: Code) -> FunctionType:
        try:
            return self.shapes.function(Function(("m",), len(numbers), 0, (statement,)), numbers)
        except TooDeepError:
            raise self.too_deep() from None

    def lifting(self, code: Code) -> Lifting:
        """Code with the numbers read so far; the next code begins anew."""
        numbers, self.numbers = tuple(self.numbers), []
        return Lifting(code, numbers)


def number_of(code: Code) -> Code:
    """Code of a plain number: a bare variable counts as zero while it is vacant."""
    return either(nodes.Or, code, _ZERO) if _is_variable(code) else code


def _is_variable(code: Code) -> bool:
    """Whether code reads a variable: an item of a list of the memory, or a method of it."""
    if code.kind == nodes.Subscript:
        return True
    function = code[1]
    return code.kind == nodes.Call and isinstance(function, Code) and function.kind == nodes.Attribute
