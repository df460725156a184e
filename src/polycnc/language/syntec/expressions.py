"""Expressions of the macro language, turned into Python source.

Numbers and texts are lifted out of the source (`k[0]`, `k[1]` …), so that all expressions of one shape share
one compiled function. The source works on `m`, the channel's memory, and `k`, the literals:

    #1 * 2.5 + SIN(#[#3])     m.locals.get(k[0],VACANT)*k[1]+SIN(m.variable(m.locals.get(k[2],VACANT)))
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol

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
#: Python's own parser ends at 200 levels of brackets; a level here can cost two.
MAX_DEPTH = 90
MAX_OPERATORS = 200
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


# ---- compiled shapes -------------------------------------------------------------------------------------


def call(memory: MacroMemory, name: str, *arguments: Value) -> Value:
    """A function that the control executes."""
    function = memory.functions.get(name)
    if function is None:
        raise AlarmError("PC0001", hint="hint.not-supported", code=name)
    return function(*arguments)


def app_variable(_memory: MacroMemory, _index: Value) -> Value:
    """AR and MAR belong to the macros of an APP; everywhere else they cannot be reached."""
    raise AlarmError(NO_SUCH_VARIABLE, hint="hint.syntec.app-variable")


_NAMESPACE: dict[str, Any] = {
    "VACANT": VACANT,
    "divide": values.divide,
    "modulo": values.modulo,
    "bit_and": values.bit_and,
    "bit_or": values.bit_or,
    "bit_xor": values.bit_xor,
    "bit_not": values.bit_not,
    "call": call,
    "app_variable": app_variable,
    **{name: f.calculate for name, f in FUNCTIONS.items() if f.calculate},
}
_compiled: dict[str, Callable[[Any, tuple[Any, ...]], Any]] = {}


def compile_source(source: str) -> Callable[[Any, tuple[Any, ...]], Any]:
    """The function of (memory, literals) for generated source; one for each shape of expression."""
    function = _compiled.get(source)
    if function is None:
        code = compile(f"lambda m, k: {source}", "<macro>", "eval")
        function = _compiled[source] = eval(code, _NAMESPACE)  # the source is ours, not the user's
    return function


def evaluator(source: str, literals: Sequence[Any]) -> Evaluate:
    """A function of the channel that gives the value of generated source."""
    function = compile_source(source)
    k = tuple(literals)
    return lambda channel: function(channel.memory, k)


# ---- reading ---------------------------------------------------------------------------------------------

#: Operators with two operands: rank (a lower one binds closer), and how the source writes them.
BINARY: dict[str, tuple[int, str]] = {
    "*": (4, "{}*{}"),
    "/": (4, "divide({},{})"),
    "MOD": (4, "modulo({},{})"),
    "+": (5, "{}+{}"),
    "-": (5, "{}-{}"),
    "<": (6, "(+({}<{}))"),
    ">": (6, "(+({}>{}))"),
    "<=": (6, "(+({}<={}))"),
    ">=": (6, "(+({}>={}))"),
    "=": (7, "(+({}=={}))"),
    "<>": (8, "(+({}!={}))"),
    "&": (9, "bit_and({},{})"),
    "AND": (9, "bit_and({},{})"),
    "XOR": (10, "bit_xor({},{})"),
    "OR": (11, "bit_or({},{})"),
}
LOWEST_RANK = 11
#: Bare expressions in words hold arithmetic only; a comparison there needs brackets.
ARITHMETIC_RANK = 5


class Reader:
    """A cursor over tokens that reads expressions.

    Attributes:
        tokens: The text, closed by an `end` token.
        at: Index of the next token.
        literals: Numbers and texts lifted out of the expressions read since `take_literals`.
    """

    def __init__(self, tokens: Sequence[Token]) -> None:
        self.tokens = tokens
        self.at = 0
        self.literals: list[Any] = []
        self._nesting = 0
        self._operators = 0

    # ---- cursor ------------------------------------------------------------------------------------------

    @property
    def next(self) -> Token:
        """The next token."""
        return self.tokens[self.at]

    def take(self) -> Token:
        """The next token, read; the closing one stays."""
        token = self.tokens[self.at]
        if token.kind != "end":
            self.at += 1
        return token

    def accept(self, text: str) -> bool:
        """Read a name or symbol if it comes next."""
        token = self.tokens[self.at]
        if token.text == text and token.kind in ("symbol", "name"):
            self.at += 1
            return True
        return False

    def expect(self, text: str, code: str = "COM-003") -> Token:
        """Read a name or symbol that must come next."""
        token = self.next
        if not self.accept(text):
            raise fault(token, code)
        return token

    def take_literals(self) -> list[Any]:
        """The literals lifted out so far; the next expression begins with none."""
        literals, self.literals = self.literals, []
        return literals

    def evaluator(self, source: str) -> Evaluate:
        """A function of the channel for source that was just read."""
        return evaluator(source, self.take_literals())

    def _literal(self, value: Any) -> str:
        self.literals.append(value)
        return f"k[{len(self.literals) - 1}]"

    # ---- expressions -------------------------------------------------------------------------------------

    def expression(self, rank: int = LOWEST_RANK) -> str:
        """Source of an expression of operators up to a rank."""
        start = self.next
        self._nesting = self._operators = 0
        source = self._ranked(rank)
        if source.count("(") > MAX_DEPTH and _depth(source) > MAX_DEPTH:
            raise fault(start, TOO_COMPLEX)
        return source

    def _ranked(self, rank: int) -> str:
        """Operands joined by operators up to a rank.

        Only `*`, `+` and `-` become operators of Python, with the same ranks; all others carry brackets.
        """
        left = self._operand()
        while True:
            token = self.next
            if token.kind not in ("symbol", "name") or token.text not in BINARY:
                return left
            if token.first and token.text == "/":
                return left  # block skip of the next line
            own, template = BINARY[token.text]
            if own > rank:
                return left
            self.take()
            self._operators += 1
            if self._operators > MAX_OPERATORS:
                raise fault(token, TOO_COMPLEX)
            left = template.format(left, self._ranked(own - 1))

    def _operand(self) -> str:
        """A value with its signs."""
        token = self.take()
        if token.kind == "symbol" and token.text in ("-", "+"):
            if self.next.kind == "number":
                value = number_value(self.take())
                return self._literal(-value if token.text == "-" else value)
            self._nest(1)
            source = self._operand()
            self._nest(-1)
            return f"(-{source})" if token.text == "-" else source
        if token.kind == "name" and token.text == "NOT":
            self._nest(1)
            source = self._operand()
            self._nest(-1)
            return f"bit_not({source})"
        return self._primary(token)

    def _nest(self, levels: int) -> None:
        self._nesting += levels
        if self._nesting > MAX_DEPTH:
            raise fault(self.next, TOO_COMPLEX)

    def _inner(self) -> str:
        """A whole expression inside brackets."""
        self._nest(1)
        source = self._ranked(LOWEST_RANK)
        self._nest(-1)
        return source

    def _primary(self, token: Token) -> str:
        """A number, a text, a variable, a function or a bracket."""
        if token.kind == "number":
            return self._literal(number_value(token))
        if token.kind == "text":
            return self._literal(Text(token.text[1:-1]))
        if token.kind == "name":
            return self._named(token)
        if token.kind == "symbol":
            if token.text == "(":
                return f"({self._bracket(')')})"
            if token.text == "#":
                return self._variable()
            if token.text == "@":
                return f"m.register({self.index()})"
            if token.text == "[":
                raise fault(token, hint="hint.syntec.square-bracket")
        raise fault(token)

    def _bracket(self, closing: str) -> str:
        """An expression up to a closing bracket."""
        source = self._inner()
        self.expect(closing)
        return source

    def _variable(self) -> str:
        """`#n`, `#[expression]`; the sign is read."""
        token = self.next
        if token.kind == "number" and token.text.isdigit():
            number = number_value(token)
            if number == 0:
                self.take()
                return "VACANT"
            if number <= LAST_LOCAL:
                self.take()
                return f"m.locals.get({self._literal(number)},VACANT)"
        return f"m.variable({self.index()})"

    def index(self) -> str:
        """Source of the number behind `#`, `@`, `AR`: digits or an expression in square brackets."""
        token = self.take()
        if token.kind == "number":
            return self._literal(number_value(token))
        if token.kind == "symbol" and token.text == "[":
            return self._bracket("]")
        raise fault(token)

    def _named(self, token: Token) -> str:
        if token.text in FUNCTIONS:
            return self._call(token)
        if token.text in ("AR", "MAR"):
            return f"app_variable(m,{self.index()})"
        raise fault(token)

    def _call(self, token: Token) -> str:
        """A function with its arguments; `STKTOP` takes its one in square brackets."""
        function = FUNCTIONS[token.text]
        arguments: list[str] = []
        closing = "]" if token.text == "STKTOP" else ")"
        self.expect("[" if closing == "]" else "(")
        while not self.accept(closing):
            if arguments:
                self.expect(",")
            named = len(arguments) in function.names
            arguments.append(self._name_argument() if named else self._inner())
            if len(arguments) > function.most:
                raise fault(token, hint="hint.syntec.argument-count")
        if len(arguments) < function.least:
            raise fault(token, hint="hint.syntec.argument-count")
        joined = ",".join(arguments)
        if function.calculate:
            return f"{token.text}({joined})"
        return f"call(m,'{token.text}'{',' if joined else ''}{joined})"

    def _name_argument(self) -> str:
        """An address or axis name without quotes: `Y`, `X1`."""
        token = self.take()
        if token.kind != "letter":
            raise fault(token)
        name = token.text
        if self.next.kind == "number" and self.next.text.isdigit():
            name += self.take().text
        return self._literal(Text(name))


def _depth(source: str) -> int:
    """Levels of brackets in generated source."""
    depth = deepest = 0
    for char in source:
        depth += (char == "(") - (char == ")")
        deepest = max(deepest, depth)
    return deepest


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
