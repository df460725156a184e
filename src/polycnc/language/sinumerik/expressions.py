"""Expressions, compiled to Python code with known types (job planning 1.3 to 1.9)."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import (
    Code,
    constant,
    either,
    negation,
    quoted,
    sequence,
    unary,
)
from polycnc.language.expressions.cursor import Cursor
from polycnc.language.expressions.operators import (
    TIGHTEST,
    Operator,
    OperatorReader,
    applied,
    applied_to_one,
    calculated,
)
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.errors import NcSyntaxError, syntax
from polycnc.language.sinumerik.lexer import Token
from polycnc.language.sinumerik.names.values import Type

if TYPE_CHECKING:
    from polycnc.language.sinumerik.emitter import Emitter
    from polycnc.language.sinumerik.names.scope import Scope


class Expr(NamedTuple):
    """Code of a value and the type that the value has."""

    code: Code
    type: Type


#: Families of operators, by the operands that they take.
COMPARISON, TEXT, LOGIC, BITS, NUMBERS, FRAMES = "comparison", "text", "logic", "bits", "numbers", "frames"
#: Operators between two operands (1.7); a greater power binds closer.
OPERATORS = {
    "==": Operator(1, nodes.Eq, COMPARISON),
    "<>": Operator(1, nodes.NotEq, COMPARISON),
    ">": Operator(1, nodes.Gt, COMPARISON),
    "<": Operator(1, nodes.Lt, COMPARISON),
    ">=": Operator(1, nodes.GtE, COMPARISON),
    "<=": Operator(1, nodes.LtE, COMPARISON),
    "<<": Operator(2, "joined", TEXT),
    "OR": Operator(3, nodes.Or, LOGIC),
    "XOR": Operator(4, nodes.NotEq, LOGIC),
    "AND": Operator(5, nodes.And, LOGIC),
    "B_OR": Operator(6, nodes.BitOr, BITS),
    "B_XOR": Operator(7, nodes.BitXor, BITS),
    "B_AND": Operator(8, nodes.BitAnd, BITS),
    "+": Operator(9, nodes.Add, NUMBERS),
    "-": Operator(9, nodes.Sub, NUMBERS),
    "*": Operator(10, nodes.Mult, NUMBERS),
    "/": Operator(10, nodes.Div, NUMBERS),
    "DIV": Operator(10, "real_quotient", NUMBERS),
    "MOD": Operator(10, "remainder", NUMBERS),
    ":": Operator(11, nodes.MatMult, FRAMES),
}
#: Operators before an operand; `<<` alone takes more than one operand with its signs.
SIGNS = {
    "-": Operator(TIGHTEST, nodes.USub, NUMBERS),
    "+": Operator(TIGHTEST, nodes.UAdd, NUMBERS),
    "<<": Operator(2, "str", TEXT),
    "NOT": Operator(TIGHTEST, nodes.Not, LOGIC),
    "B_NOT": Operator(TIGHTEST, nodes.Invert, BITS),
}
_WORDS = ("NOT", "B_NOT")


class ExpressionReader(Cursor[Token], OperatorReader[Token, Expr]):
    """Reads expressions among the tokens of a block."""

    def __init__(self, tokens: list[Token], scope: Scope, emitter: Emitter) -> None:
        Cursor.__init__(self, tokens)
        self.scope = scope
        self.emitter = emitter

    def expect(self, text: str) -> Token:
        """Read this operator or keyword; 12080 if something else stands there."""
        if not self.at(text):
            raise self.error()
        return self.take()

    def error(self, token: Token | None = None) -> NcSyntaxError:
        """12080 at a token, the next one unless told otherwise."""
        token = token or self.token
        return syntax(token.column, token.text)

    def value(self, type_: Type) -> Code:
        """Code of an expression converted to a type."""
        token = self.token
        return self.converted(self.expression(), type_, token)

    def reference(self, token: Token) -> Code:
        """Read a variable that a procedure or function may change."""
        return self.scope.place(self, token).reference(self)

    def literal(self) -> Code | None:
        """A number, with a minus or without, that is all of an argument; None, and nothing read, for anything else."""
        minus = self.at("-")
        token = self.ahead(minus)
        if token.kind != "number" or self.ahead(minus + 1).text not in (",", ")"):
            return None
        self.place += minus + 1
        number = self.emitter.number(token.value, token)
        return unary(nodes.USub, number) if minus else number

    def condition(self) -> Code:
        """Code of an expression as BOOL."""
        return self.value(Type.BOOL)

    # ---- operators -----------------------------------------------------------------------------------------

    def prefix_ahead(self) -> Operator | None:
        """A sign, NOT (unless a variable has this name), B_NOT or `<<`."""
        token = self.token
        operator = SIGNS.get(token.text)
        if operator is None or token.kind != ("name" if token.text in _WORDS else "op"):
            return None
        return None if token.text == "NOT" and self.scope.find("NOT") else operator

    def infix_ahead(self) -> Operator | None:
        """The operator that comes next."""
        token = self.token
        return OPERATORS.get(token.text) if token.kind in self.FIXED else None

    def take_operator(self) -> Token:
        """Read the operator."""
        return self.take()

    def too_deep(self) -> NcSyntaxError:
        """12540: the block is too complex."""
        return NcSyntaxError("12540", self.token.column, self.token.text)

    def signed(self, operator: Operator, mark: Token, operand: Expr) -> Expr:
        """The value of an operator before its operand."""
        if operator.family == TEXT:
            return Expr(self._text(operand, mark), Type.STRING)
        if operator.family == NUMBERS:
            self._need_number(operand, mark)
            type_ = Type.REAL if operand.type is Type.REAL else Type.INT
            return Expr(applied_to_one(operator.gives, operand.code), type_)
        type_ = Type.BOOL if operator.family == LOGIC else Type.INT
        return Expr(applied_to_one(operator.gives, self.converted(operand, type_, mark)), type_)

    def joined(self, operator: Operator, mark: Token, left: Expr, right: Expr) -> Expr:
        """The value of an operator between two operands."""
        family = operator.family
        if family == COMPARISON:
            return Expr(self._comparison(operator, mark, left, right), Type.BOOL)
        if family == TEXT:
            texts = self._text(left, mark), self._text(right, mark)
            return Expr(applied(operator.gives, *texts), Type.STRING)
        if family == FRAMES:
            if left.type is not Type.FRAME or right.type is not Type.FRAME:
                raise NcSyntaxError("12150", mark.column, mark.text)
            return Expr(applied(operator.gives, left.code, right.code), Type.FRAME)
        if family != LOGIC:
            self._need_number(left, mark)
            self._need_number(right, mark)
        if family == NUMBERS:
            return self._number(operator, mark, left, right)
        type_ = Type.BOOL if family == LOGIC else Type.INT
        values = self.converted(left, type_, mark), self.converted(right, type_, mark)
        return Expr(applied(operator.gives, *values), type_)

    def _number(self, operator: Operator, mark: Token, left: Expr, right: Expr) -> Expr:
        """The value of an operator between two numbers."""
        type_ = Type.REAL if Type.REAL in (left.type, right.type) else Type.INT
        if mark.text == "MOD":
            (a, a2), (b, b2) = (self.emitter.twice(self.converted(x, type_, mark)) for x in (left, right))
            # Python's % has the sign of the divisor: the same where neither is negative.
            code = quoted("{2} % {3} if ({0} >= 0) & ({1} > 0) else remainder({2}, {3})", a, b, a2, b2)
            return Expr(code, type_)
        gives = operator.gives
        if mark.text == "DIV" and type_ is Type.INT:
            gives = "int_quotient"
        if Type.REAL in (left.type, right.type):
            return Expr(calculated(gives, left.code, right.code), Type.REAL)
        return Expr(applied(gives, left.code, right.code), Type.REAL if mark.text == "/" else type_)

    def _comparison(self, operator: Operator, mark: Token, left: Expr, right: Expr) -> Code:
        gives = operator.gives
        if not (left.type.is_number and right.type.is_number):
            left, right = self._comparable(mark, left, right)
            if gives not in (nodes.Eq, nodes.NotEq) and not left.type.is_number:
                raise NcSyntaxError("12150", mark.column, mark.text)
        if Type.REAL not in (left.type, right.type):
            return applied(gives, left.code, right.code)
        if gives in (nodes.Eq, nodes.NotEq):
            near = quoted("near({0}, {1})", left.code, right.code)
            return near if gives == nodes.Eq else negation(near)
        strict = gives in (nodes.Lt, nodes.Gt)
        if self.scope.memory.exact_order and strict:
            return applied(gives, left.code, right.code)
        (a, a2), (b, b2) = self.emitter.twice(left.code), self.emitter.twice(right.code)
        # Both values are worked out before they are compared, so the names of the second use are bound.
        near, ordered = quoted("near({0}, {1})", a2, b2), applied(gives, a, b)
        return either(nodes.And, ordered, negation(near)) if strict else either(nodes.Or, ordered, near)

    def _comparable(self, mark: Token, left: Expr, right: Expr) -> tuple[Expr, Expr]:
        """Operands of a comparison that are not both numbers.

        A CHAR compares with a STRING as text, and by its code where the order counts.
        """
        if {left.type, right.type} == {Type.CHAR, Type.STRING}:
            common = Type.STRING if mark.text in ("==", "<>") else Type.CHAR
            return (
                Expr(self.converted(left, common, mark), common),
                Expr(self.converted(right, common, mark), common),
            )
        if left.type is not right.type:
            raise NcSyntaxError("12150", mark.column, mark.text)
        return left, right

    def _need_number(self, operand: Expr, token: Token) -> None:
        if not operand.type.is_number:
            raise NcSyntaxError("12150", token.column, token.text)

    # ---- conversions (1.8) ---------------------------------------------------------------------------------

    def converted(self, value: Expr, type_: Type, token: Token) -> Code:
        """Code of a value as another type; alarm 12150 where the language has no conversion."""
        if value.type is type_:
            return value.code
        if type_ is Type.REAL and value.type in (Type.INT, Type.BOOL, Type.CHAR):
            return self.emitter.as_real(value.code)
        conversion = _CONVERSIONS.get((value.type, type_))
        if conversion is None:
            code = "12040" if type_ is Type.AXIS else "12150"
            raise NcSyntaxError(code, token.column, token.text)
        return quoted(conversion, value.code)

    def _text(self, value: Expr, token: Token) -> Code:
        """Code of a value as an operand of `<<`."""
        if value.type is Type.REAL:
            return quoted("real_text({0})", value.code)
        if value.type is Type.INT:
            return quoted("str({0})", value.code)
        return self.converted(value, Type.STRING, token)

    # ---- operands ------------------------------------------------------------------------------------------

    def operand(self) -> Expr:
        """Read an operand without signs."""
        token = self.take()
        if token.kind == "number":
            type_ = Type.INT if isinstance(token.value, int) else Type.REAL
            return Expr(self.emitter.number(token.value, token), type_)
        if token.kind == "string":
            return Expr(constant(token.text), Type.STRING)
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
            return Expr(constant(name == "TRUE"), Type.BOOL)
        if name in keywords.FUNCTIONS:
            return self._function(token, keywords.FUNCTIONS[name])
        if name in keywords.SAME_TYPE_FUNCTIONS:
            return self._same_type(token, *keywords.SAME_TYPE_FUNCTIONS[name])
        if name in keywords.FRAME_FUNCTIONS:
            return self._frame(token)
        return self.scope.named_operand(self, token)

    def _function(self, token: Token, function: keywords.Function) -> Expr:
        self.expect("(")
        codes: list[Code] = []
        for letter in function.arguments:
            if codes and not self.at(")"):
                self.expect(",")
            elif codes:
                if letter.isupper():
                    raise NcSyntaxError("14020", token.column, token.text)
                codes.append(constant(None))
                continue
            codes.append(self._function_argument(letter))
        self.expect(")")
        if token.text == "AXNAME":
            codes.append(self.emitter.object(self.scope.memory))
        return Expr(quoted(function.code, *codes), function.result)

    def _function_argument(self, letter: str) -> Code:
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
        return Expr(quoted(code, *(value.code for value in values)), Type.REAL if real else Type.INT)

    def _frame(self, token: Token) -> Expr:
        kind = keywords.FRAME_FUNCTIONS[token.text]
        codes: list[Code] = []
        self.expect("(")
        while not self.at(")"):
            if codes:
                self.expect(",")
            codes.append(self.value(Type.AXIS))
            if kind != "cmirror":
                self.expect(",")
                codes.append(self.value(Type.REAL))
        self.expect(")")
        return Expr(quoted("frame_of(channel, {0}, {1})", kind, sequence(codes)), Type.FRAME)


#: How a value becomes one of another type; INT, BOOL and CHAR become REAL at once (`Emitter.as_real`).
_CONVERSIONS = {
    (Type.REAL, Type.INT): "round_half_up({0})",
    (Type.BOOL, Type.INT): "int({0})",
    (Type.CHAR, Type.INT): "{0}",
    (Type.REAL, Type.BOOL): "({0} != 0)",
    (Type.INT, Type.BOOL): "({0} != 0)",
    (Type.CHAR, Type.BOOL): "({0} != 0)",
    (Type.STRING, Type.BOOL): "({0} != '')",
    (Type.REAL, Type.CHAR): "checked_char(round_half_up({0}))",
    (Type.INT, Type.CHAR): "checked_char({0})",
    (Type.BOOL, Type.CHAR): "int({0})",
    (Type.STRING, Type.CHAR): "char_of_text({0})",
    (Type.BOOL, Type.STRING): "('1' if {0} else '0')",
    (Type.CHAR, Type.STRING): "chr({0})",
}
