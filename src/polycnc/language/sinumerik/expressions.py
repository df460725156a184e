"""Expressions, compiled to Python code with known types (job planning 1.3 to 1.9)."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.errors import NcSyntaxError, syntax
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.scope import Scope


class Expr(NamedTuple):
    """Code of a value and the type that the value has."""

    code: str
    type: Type


#: Binary operators from the weakest to the strongest (1.7); one level works from left to right.
LEVELS: tuple[frozenset[str], ...] = tuple(
    frozenset(level.split())
    for level in (
        "== <> > < >= <=",
        "<<",
        "OR",
        "XOR",
        "AND",
        "B_OR",
        "B_XOR",
        "B_AND",
        "+ -",
        "* / DIV MOD",
        ":",
    )
)
_LEVEL_OF = {operator: i for i, level in enumerate(LEVELS) for operator in level}
_COMPARISONS = LEVELS[0]
_BITS = {"B_AND": "&", "B_OR": "|", "B_XOR": "^"}
_LOGIC = {"AND": "and", "OR": "or", "XOR": "!="}
MAX_DEPTH = 100


class TokenReader:
    """A place in the tokens of a block."""

    def __init__(self, tokens: list[Token]) -> None:
        self.tokens = tokens
        self.place = 0

    @property
    def token(self) -> Token:
        """The next token."""
        return self.tokens[self.place]

    def ahead(self, count: int = 1) -> Token:
        """A token behind the next one."""
        return self.tokens[min(self.place + count, len(self.tokens) - 1)]

    def take(self) -> Token:
        """Read the next token."""
        token = self.tokens[self.place]
        if token.kind != "end":
            self.place += 1
        return token

    def at(self, text: str) -> bool:
        """Whether the next token is this operator or keyword."""
        token = self.tokens[self.place]
        return token.text == text and token.kind in ("op", "name")

    def accept(self, text: str) -> bool:
        """Read the next token if it is this operator or keyword."""
        if self.at(text):
            self.place += 1
            return True
        return False

    def expect(self, text: str) -> Token:
        """Read this operator or keyword; 12080 if something else stands there."""
        if not self.at(text):
            raise self.error()
        return self.take()

    def error(self, token: Token | None = None) -> NcSyntaxError:
        """12080 at a token, the next one unless told otherwise."""
        token = token or self.token
        return syntax(token.column, token.text)


class ExpressionReader(TokenReader):
    """Reads expressions."""

    def __init__(self, tokens: list[Token], scope: Scope, emitter: Emitter) -> None:
        super().__init__(tokens)
        self.scope = scope
        self.emitter = emitter
        self.depth = 0

    def expression(self, level: int = 0) -> Expr:
        """Read an expression whose operators are of this level or stronger."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise NcSyntaxError("12540", self.token.column, self.token.text)
        left = self._unary()
        while True:
            token = self.token
            own = _LEVEL_OF.get(token.text, -1) if token.kind in ("op", "name") else -1
            if own < level:
                break
            self.take()
            left = self._binary(token, left, self.expression(own + 1))
        self.depth -= 1
        return left

    def operand(self) -> Expr:
        """Read one operand; an operator behind it is left."""
        return self._unary()

    def value(self, type_: Type) -> str:
        """Code of an expression converted to a type."""
        token = self.token
        return self.converted(self.expression(), type_, token)

    def condition(self) -> str:
        """Code of an expression as BOOL."""
        return self.value(Type.BOOL)

    # ---- operators -----------------------------------------------------------------------------------------

    def _unary(self) -> Expr:
        token = self.token
        if token.kind == "op" and token.text in ("-", "+"):
            self.take()
            operand = self._unary()
            self._need_number(operand, token)
            type_ = Type.REAL if operand.type is Type.REAL else Type.INT
            return Expr(f"({token.text}{operand.code})", type_)
        if token.kind == "op" and token.text == "<<":
            self.take()
            return Expr(self._text(self.expression(2), token), Type.STRING)
        if token.kind == "name" and token.text == "NOT" and not self.scope.find("NOT"):
            self.take()
            return Expr(f"(not {self.converted(self._unary(), Type.BOOL, token)})", Type.BOOL)
        if token.kind == "name" and token.text == "B_NOT":
            self.take()
            return Expr(f"(~{self.converted(self._unary(), Type.INT, token)})", Type.INT)
        return self._primary()

    def _binary(self, token: Token, left: Expr, right: Expr) -> Expr:
        operator = token.text
        if operator in _COMPARISONS:
            return Expr(self._comparison(token, left, right), Type.BOOL)
        if operator == "<<":
            return Expr(f"joined({self._text(left, token)}, {self._text(right, token)})", Type.STRING)
        if operator in _LOGIC:
            a, b = self.converted(left, Type.BOOL, token), self.converted(right, Type.BOOL, token)
            return Expr(f"({a} {_LOGIC[operator]} {b})", Type.BOOL)
        if operator == ":":
            if left.type is not Type.FRAME or right.type is not Type.FRAME:
                raise NcSyntaxError("12150", token.column, operator)
            return Expr(f"({left.code} @ {right.code})", Type.FRAME)
        self._need_number(left, token)
        self._need_number(right, token)
        if operator in _BITS:
            a, b = self.converted(left, Type.INT, token), self.converted(right, Type.INT, token)
            return Expr(f"({a} {_BITS[operator]} {b})", Type.INT)
        real = Type.REAL in (left.type, right.type)
        if operator == "/":
            return Expr(f"({left.code} / {right.code})", Type.REAL)
        if operator == "MOD":
            (a, a2), (b, b2) = (self.emitter.twice(self.converted(x, Type.INT, token)) for x in (left, right))
            # Python's % has the sign of the divisor: the same where neither is negative.
            positive = f"({a} >= 0) & ({b} > 0)"
            return Expr(f"({a2} % {b2} if {positive} else remainder({a2}, {b2}))", Type.INT)
        if operator == "DIV":
            function = "real_quotient" if real else "int_quotient"
            return Expr(f"{function}({left.code}, {right.code})", Type.REAL if real else Type.INT)
        return Expr(f"({left.code} {operator} {right.code})", Type.REAL if real else Type.INT)

    def _comparison(self, token: Token, left: Expr, right: Expr) -> str:
        operator = {"<>": "!="}.get(token.text, token.text)
        if not (left.type.is_number and right.type.is_number):
            left, right = self._comparable(token, left, right)
            if operator not in ("==", "!=") and not left.type.is_number:
                raise NcSyntaxError("12150", token.column, token.text)
        if Type.REAL not in (left.type, right.type):
            return f"({left.code} {operator} {right.code})"
        if operator == "==":
            return f"near({left.code}, {right.code})"
        if operator == "!=":
            return f"(not near({left.code}, {right.code}))"
        if self.scope.memory.exact_order and operator in "<>":
            return f"({left.code} {operator} {right.code})"
        (a, a2), (b, b2) = self.emitter.twice(left.code), self.emitter.twice(right.code)
        also = "and not" if operator in "<>" else "or"
        # Both values are worked out before they are compared, so the names of the second use are bound.
        return f"({a} {operator} {b} {also} near({a2}, {b2}))"

    def _comparable(self, token: Token, left: Expr, right: Expr) -> tuple[Expr, Expr]:
        """Operands of a comparison that are not both numbers.

        A CHAR compares with a STRING as text, and by its code where the order counts.
        """
        if {left.type, right.type} == {Type.CHAR, Type.STRING}:
            common = Type.STRING if token.text in ("==", "<>") else Type.CHAR
            return (
                Expr(self.converted(left, common, token), common),
                Expr(self.converted(right, common, token), common),
            )
        if left.type is not right.type:
            raise NcSyntaxError("12150", token.column, token.text)
        return left, right

    def _need_number(self, operand: Expr, token: Token) -> None:
        if not operand.type.is_number:
            raise NcSyntaxError("12150", token.column, token.text)

    # ---- conversions (1.8) ---------------------------------------------------------------------------------

    def converted(self, value: Expr, type_: Type, token: Token) -> str:
        """Code of a value as another type; alarm 12150 where the language has no conversion."""
        if value.type is type_:
            return value.code
        convert = _CONVERSIONS.get((value.type, type_))
        if convert is None:
            code = "12040" if type_ is Type.AXIS else "12150"
            raise NcSyntaxError(code, token.column, token.text)
        return convert(self.emitter, value.code)

    def _text(self, value: Expr, token: Token) -> str:
        """Code of a value as an operand of `<<`."""
        if value.type is Type.REAL:
            return f"real_text({value.code})"
        if value.type is Type.INT:
            return f"str({value.code})"
        return self.converted(value, Type.STRING, token)

    # ---- operands ------------------------------------------------------------------------------------------

    def _primary(self) -> Expr:
        token = self.take()
        if token.kind == "number":
            type_ = Type.INT if isinstance(token.value, int) else Type.REAL
            return Expr(self.emitter.number(token.value, token), type_)
        if token.kind == "string":
            self.emitter.has_text = True
            return Expr(repr(token.text), Type.STRING)
        if token.kind == "op" and token.text == "(":
            inner = self.expression()
            self.expect(")")
            return Expr(inner.code, inner.type)
        if token.kind == "word":
            return self.scope.word_operand(self, token)
        if token.kind == "name":
            return self._named(token)
        raise self.error(token)

    def _named(self, token: Token) -> Expr:
        name = token.text
        if self.scope.find(name) is not None or name[0] == "$" or name == "R":
            return self.scope.place(self, token).read(self)
        if name in ("TRUE", "FALSE"):
            return Expr(name.capitalize(), Type.BOOL)
        if name in keywords.FUNCTIONS:
            return self._function(token, keywords.FUNCTIONS[name])
        if name in keywords.SAME_TYPE_FUNCTIONS:
            return self._same_type(token, *keywords.SAME_TYPE_FUNCTIONS[name])
        if name in keywords.FRAME_FUNCTIONS:
            return self._frame(token)
        return self.scope.named_operand(self, token)

    def _function(self, token: Token, function: keywords.Function) -> Expr:
        self.expect("(")
        codes: list[str] = []
        for letter in function.arguments:
            if codes and not self.at(")"):
                self.expect(",")
            elif codes:
                if letter.isupper():
                    raise NcSyntaxError("14020", token.column, token.text)
                codes.append("None")
                continue
            codes.append(self._function_argument(letter))
        self.expect(")")
        if "memory" in function.code:
            code = function.code.replace("memory", self.emitter.object(self.scope.memory))
        else:
            code = function.code
        return Expr(code.format(*codes), function.result)

    def _function_argument(self, letter: str) -> str:
        """Code of an argument; functions of REAL take any number as it is."""
        token = self.token
        value = self.expression()
        if letter == "R" and value.type.is_number:
            return value.code
        return self.converted(value, keywords.TYPE_LETTERS[letter.upper()], token)

    def _same_type(self, token: Token, count: int, code: str) -> Expr:
        """ABS, MINVAL, MAXVAL: REAL if one of the arguments is, else INT."""
        self.expect("(")
        values = [self.expression()]
        for _ in range(count - 1):
            self.expect(",")
            values.append(self.expression())
        self.expect(")")
        for value in values:
            self._need_number(value, token)
        real = any(value.type is Type.REAL for value in values)
        return Expr(code.format(*(value.code for value in values)), Type.REAL if real else Type.INT)

    def _frame(self, token: Token) -> Expr:
        kind = keywords.FRAME_FUNCTIONS[token.text]
        codes: list[str] = []
        self.expect("(")
        while not self.at(")"):
            if codes:
                self.expect(",")
            codes.append(self.value(Type.AXIS))
            if kind != "cmirror":
                self.expect(",")
                codes.append(self.value(Type.REAL))
        self.expect(")")
        return Expr(f"frame_of({kind!r}, ({''.join(code + ', ' for code in codes)}))", Type.FRAME)


def _code(template: str) -> Callable[[Emitter, str], str]:
    return lambda _, code: template.format(code)


def _to_real(emitter: Emitter, code: str) -> str:
    return emitter.as_real(code)


_CONVERSIONS: dict[tuple[Type, Type], Callable[[Emitter, str], str]] = {
    (Type.INT, Type.REAL): _to_real,
    (Type.BOOL, Type.REAL): _to_real,
    (Type.CHAR, Type.REAL): _to_real,
    (Type.REAL, Type.INT): _code("round_half_up({0})"),
    (Type.BOOL, Type.INT): _code("int({0})"),
    (Type.CHAR, Type.INT): _code("{0}"),
    (Type.REAL, Type.BOOL): _code("({0} != 0)"),
    (Type.INT, Type.BOOL): _code("({0} != 0)"),
    (Type.CHAR, Type.BOOL): _code("({0} != 0)"),
    (Type.STRING, Type.BOOL): _code("({0} != '')"),
    (Type.REAL, Type.CHAR): _code("checked_char(round_half_up({0}))"),
    (Type.INT, Type.CHAR): _code("checked_char({0})"),
    (Type.BOOL, Type.CHAR): _code("int({0})"),
    (Type.STRING, Type.CHAR): _code("char_of_text({0})"),
    (Type.BOOL, Type.STRING): _code("('1' if {0} else '0')"),
    (Type.CHAR, Type.STRING): _code("chr({0})"),
}
