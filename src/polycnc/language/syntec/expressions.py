"""Expressions of the macro language, turned into Python code.

Numbers and texts are lifted out of the code (`n0`, `n1` …), so that all expressions of one shape share one compiled
function. The code works on `m`, the channel's memory:

    #1 * 2.5 + SIN(#[#3])     m.locals.get(n0, VACANT) * n1 + SIN(m.variable(m.locals.get(n2, VACANT)))
"""

from __future__ import annotations

from math import isfinite

from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, call, constant, name, unary
from polycnc.language.expressions.cursor import Cursor
from polycnc.language.expressions.operators import (
    TIGHTEST,
    Operator,
    OperatorReader,
    applied,
    applied_to_one,
)
from polycnc.language.expressions.shapes import Shapes, TooDeepError
from polycnc.language.syntec import values
from polycnc.language.syntec.functions import FUNCTIONS
from polycnc.language.syntec.tokens import Token, fault
from polycnc.language.syntec.values import VACANT, Text, Value
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, MutableMapping, Sequence

    from polycnc.channel.channel import Channel

    Evaluate = Callable[[Channel], Any]

TOO_COMPLEX = "COM-005"
NO_SUCH_VARIABLE = "COR-016"
MAX_LITERAL_DIGITS = 18
LAST_LOCAL = 400


class MacroMemory(Protocol):
    """What expressions ask of a channel's memory."""

    locals: MutableMapping[int, Value]
    functions: Mapping[str, Callable[..., Value]]

    def variable(self, index: Value) -> Value:
        """The value of `#index`."""

    def set_variable(self, index: Value, value: Value) -> None:
        """`#index := value`."""

    def register(self, index: Value) -> Value:
        """The value of `@index`."""

    def set_register(self, index: Value, value: Value) -> None:
        """`@index := value`."""


# ---- what code may call ----------------------------------------------------------------------------------


def queried(memory: MacroMemory, function: str, *arguments: Value) -> Value:
    """A function that the control executes."""
    found = memory.functions.get(function)
    if found is None:
        raise AlarmError("PC0001", hint="hint.not-supported", code=function)
    return found(*arguments)


def app_variable(_memory: MacroMemory, _index: Value) -> Value:
    """AR and MAR belong to the macros of an APP; everywhere else they cannot be reached."""
    raise AlarmError(NO_SUCH_VARIABLE, hint="hint.syntec.app-variable")


_NAMES: dict[str, object] = {
    "VACANT": VACANT,
    "divide": values.divide,
    "modulo": values.modulo,
    "bit_and": values.bit_and,
    "bit_or": values.bit_or,
    "bit_xor": values.bit_xor,
    "bit_not": values.bit_not,
    "queried": queried,
    "app_variable": app_variable,
    **{name: f.calculate for name, f in FUNCTIONS.items() if f.calculate},
}


def syntec_shapes() -> Shapes:
    """A place for the compiled code of a control's programs."""
    return Shapes(_NAMES)


# ---- reading ---------------------------------------------------------------------------------------------

#: Comparisons give 1 or 0.
COMPARISON = "comparison"
#: Operators between two operands (operation manual of the macro language); a greater power binds closer.
OPERATORS = {
    "*": Operator(8, nodes.Mult),
    "/": Operator(8, "divide"),
    "MOD": Operator(8, "modulo"),
    "+": Operator(7, nodes.Add),
    "-": Operator(7, nodes.Sub),
    "<": Operator(6, nodes.Lt, COMPARISON),
    ">": Operator(6, nodes.Gt, COMPARISON),
    "<=": Operator(6, nodes.LtE, COMPARISON),
    ">=": Operator(6, nodes.GtE, COMPARISON),
    "=": Operator(5, nodes.Eq, COMPARISON),
    "<>": Operator(4, nodes.NotEq, COMPARISON),
    "&": Operator(3, "bit_and"),
    "AND": Operator(3, "bit_and"),
    "XOR": Operator(2, "bit_xor"),
    "OR": Operator(1, "bit_or"),
}
SIGNS = {
    "-": Operator(TIGHTEST, nodes.USub),
    "+": Operator(TIGHTEST, nodes.UAdd),
    "NOT": Operator(TIGHTEST, "bit_not"),
}
#: Bare expressions in words hold arithmetic only; a comparison there needs brackets.
ABOVE_COMPARISONS = 6
_MEMORY, _VACANT = name("m"), name("VACANT")


class Reader(Cursor[Token], OperatorReader[Token, Code]):
    """A cursor over tokens that reads expressions.

    Args:
        tokens: The text, closed by an `end` token.
        shapes: Compiled code of the control.
    """

    FIXED = ("symbol", "name")

    def __init__(self, tokens: Sequence[Token], shapes: Shapes) -> None:
        Cursor.__init__(self, tokens)
        self.shapes = shapes
        self.literals: list[Value] = []

    def expect(self, text: str, code: str = "COM-003") -> Token:
        """Read a name or symbol that must come next."""
        token = self.token
        if not self.accept(text):
            raise fault(token, code)
        return token

    def forget_literals(self) -> None:
        """The next expression begins with no literals and outside of all brackets."""
        self.literals = []
        self.depth = 0

    def evaluator(self, code: Code) -> Evaluate:
        """A function of the channel for code that was just read."""
        literals, self.literals = self.literals, []
        try:
            function = self.shapes.value("m", code, literals)
        except TooDeepError:
            raise self.too_deep() from None
        return lambda channel: function(channel.memory)

    def lift(self, value: Value) -> Lifted:
        """A literal as a parameter of the code."""
        self.literals.append(value)
        return Lifted("n", len(self.literals) - 1)

    # ---- operators ---------------------------------------------------------------------------------------

    def prefix_ahead(self) -> Operator | None:
        """A sign or NOT."""
        token = self.token
        return SIGNS.get(token.text) if token.kind in self.FIXED else None

    def infix_ahead(self) -> Operator | None:
        """The operator that comes next; a `/` that begins a line is block skip."""
        token = self.token
        if token.kind not in self.FIXED or (token.first and token.text == "/"):
            return None
        return OPERATORS.get(token.text)

    def take_operator(self) -> Token:
        """Read the operator."""
        return self.take()

    def signed(self, operator: Operator, _mark: Token, operand: Code) -> Code:
        """A value with its sign; a number takes it at once."""
        if operator.gives == nodes.UAdd:
            return operand
        value = self.literals[operand.place] if isinstance(operand, Lifted) else None
        if operator.gives == nodes.USub and isinstance(operand, Lifted) and isinstance(value, int | float):
            self.literals[operand.place] = -value
            return operand
        return applied_to_one(operator.gives, operand)

    def joined(self, operator: Operator, _mark: Token, left: Code, right: Code) -> Code:
        """Two operands."""
        value = applied(operator.gives, left, right)
        return unary(nodes.UAdd, value) if operator.family == COMPARISON else value

    def too_deep(self) -> AlarmError:
        """An expression that is too complex."""
        return fault(self.token, TOO_COMPLEX)

    # ---- operands ----------------------------------------------------------------------------------------

    def operand(self) -> Code:
        """A number, a text, a variable, a function or a bracket."""
        token = self.take()
        if token.kind == "number":
            return self.lift(number_value(token))
        if token.kind == "text":
            return self.lift(Text(token.text[1:-1]))
        if token.kind == "name":
            return self._named(token)
        if token.kind == "symbol":
            if token.text == "(":
                return self._bracket(")")
            if token.text == "#":
                return self._variable()
            if token.text == "@":
                return call("m.register", self.index())
            if token.text == "[":
                raise fault(token, hint="hint.syntec.square-bracket")
        raise fault(token)

    def _bracket(self, closing: str) -> Code:
        """An expression up to a closing bracket."""
        value = self.expression()
        self.expect(closing)
        return value

    def _variable(self) -> Code:
        """`#n`, `#[expression]`; the sign is read."""
        token = self.token
        if token.kind == "number" and token.text.isdigit():
            number = number_value(token)
            if number == 0:
                self.take()
                return _VACANT
            if number <= LAST_LOCAL:
                self.take()
                return call("m.locals.get", self.lift(number), _VACANT)
        return call("m.variable", self.index())

    def index(self) -> Code:
        """Code of the number behind `#`, `@`, `AR`: digits or an expression in square brackets."""
        token = self.take()
        if token.kind == "number":
            return self.lift(number_value(token))
        if token.kind == "symbol" and token.text == "[":
            return self._bracket("]")
        raise fault(token)

    def _named(self, token: Token) -> Code:
        if token.text in FUNCTIONS:
            return self._call(token)
        if token.text in ("AR", "MAR"):
            return call("app_variable", _MEMORY, self.index())
        raise fault(token)

    def _call(self, token: Token) -> Code:
        """A function with its arguments; `STKTOP` takes its one in square brackets."""
        function = FUNCTIONS[token.text]
        arguments: list[Code] = []
        closing = "]" if token.text == "STKTOP" else ")"
        self.expect("[" if closing == "]" else "(")
        while not self.accept(closing):
            if arguments:
                self.expect(",")
            named = len(arguments) in function.names
            arguments.append(self._name_argument() if named else self.expression())
            if len(arguments) > function.most:
                raise fault(token, hint="hint.syntec.argument-count")
        if len(arguments) < function.least:
            raise fault(token, hint="hint.syntec.argument-count")
        if function.calculate:
            return call(token.text, *arguments)
        return call("queried", _MEMORY, constant(token.text), *arguments)

    def _name_argument(self) -> Code:
        """An address or axis name without quotes: `Y`, `X1`."""
        token = self.take()
        if token.kind != "letter":
            raise fault(token)
        written = token.text
        if self.token.kind == "number" and self.token.text.isdigit():
            written += self.take().text
        return self.lift(Text(written))


def number_value(token: Token) -> int | float:
    """The value of a number: a Long without decimal point, a Double with one."""
    text = token.text
    if not text.isascii():
        raise fault(token)
    if text[:2] in ("0x", "0X"):
        if len(text) > MAX_LITERAL_DIGITS:
            raise fault(token)
        value = int(text, 16)
        return value - 2**32 if values.LONG_MAX < value < 2**32 else value
    if "." in text:
        result = float(text)
        if not isfinite(result):
            raise fault(token)
        return result
    if len(text) > MAX_LITERAL_DIGITS:
        raise fault(token)
    return int(text)
