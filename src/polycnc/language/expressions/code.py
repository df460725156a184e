"""Generated Python as values.

`Code` is a syntax tree in tuples: the class of an `ast` node, then its fields in their order. Unlike `ast` nodes two
trees can be compared and hashed, so code of equal shape is compiled once (see `shapes`). Values that differ from
block to block are not in the tree: a `Lifted` stands for each.

    binary(ast.Mult, call("cosd", Lifted("n", 0)), name("x"))        cosd(n0) * x
"""

from __future__ import annotations

import ast
from functools import lru_cache
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from collections.abc import Iterable


class Code(tuple[object, ...]):
    """An expression or a statement: the class of its `ast` node, then the node's fields.

    A field is again `Code`, a tuple of such, an operator or a context (a class of `ast`), or a plain value.
    """

    __slots__ = ()

    @property
    def kind(self) -> object:
        """The class of its `ast` node."""
        return self[0]


class Lifted(Code):
    """A value that the code has as a parameter.

    Args:
        letter: What it is: `n` a number, `o` an object.
        place: Which one of these, from 0.
    """

    __slots__ = ()

    def __new__(cls, letter: str, place: int) -> Self:
        """Stand for a value."""
        return super().__new__(cls, (letter, place))

    @property
    def letter(self) -> str:
        """What it is: `n` a number, `o` an object."""
        return str(self[0])

    @property
    def place(self) -> int:
        """Which one of these."""
        place = self[1]
        assert isinstance(place, int)
        return place


#: Statements in their order.
Body = tuple[Code, ...]

# ---- expressions -----------------------------------------------------------------------------------------


def name(identifier: str) -> Code:
    """A name."""
    return Code((ast.Name, identifier, ast.Load))


def constant(value: float | str | bool | None) -> Code:
    """A constant; its written form tells 1 from 1.0 and True, which are equal."""
    return Code((ast.Constant, value, repr(value)))


def attribute(base: Code, *path: str) -> Code:
    """`base.first.second`."""
    for each in path:
        base = Code((ast.Attribute, base, each, ast.Load))
    return base


def dotted(path: str) -> Code:
    """`first.second.third`, given as a text."""
    first, *others = path.split(".")
    return attribute(name(first), *others)


def item(base: Code, index: Code) -> Code:
    """`base[index]`."""
    return Code((ast.Subscript, base, index, ast.Load))


def call(function: str | Code, *arguments: Code) -> Code:
    """`function(…)`; the function is a dotted name or an expression."""
    return Code((ast.Call, dotted(function) if isinstance(function, str) else function, arguments, ()))


def sequence(parts: Iterable[Code]) -> Code:
    """A tuple."""
    return Code((ast.Tuple, tuple(parts), ast.Load))


def listed(parts: Iterable[Code]) -> Code:
    """A list."""
    return Code((ast.List, tuple(parts), ast.Load))


def unary(operator: type[ast.unaryop], operand: Code) -> Code:
    """An operator before its operand."""
    return Code((ast.UnaryOp, operator, operand))


def negation(condition: Code) -> Code:
    """`not condition`."""
    return unary(ast.Not, condition)


def binary(operator: type[ast.operator], left: Code, right: Code) -> Code:
    """`a + b` and the like."""
    return Code((ast.BinOp, left, operator, right))


def compared(left: Code, operator: type[ast.cmpop], right: Code) -> Code:
    """`a < b` and the like."""
    return Code((ast.Compare, left, (operator,), (right,)))


def within(low: Code, value: Code, above: Code, *, closed: bool = False) -> Code:
    """`low <= value < above`; `closed`: `<=` at both ends."""
    return Code((ast.Compare, low, (ast.LtE, ast.LtE if closed else ast.Lt), (value, above)))


def either(operator: type[ast.boolop], left: Code, right: Code) -> Code:
    """`a and b`, `a or b`."""
    return Code((ast.BoolOp, operator, (left, right)))


def choice(condition: Code, then: Code, otherwise: Code) -> Code:
    """`then if condition else otherwise`."""
    return Code((ast.IfExp, condition, then, otherwise))


def bound(identifier: str, value: Code) -> Code:
    """`(identifier := value)`."""
    return Code((ast.NamedExpr, Code((ast.Name, identifier, ast.Store)), value))


def is_simple(code: Code) -> bool:
    """Whether a value is at hand: a parameter, a name, a constant, or an item of one at such a place."""
    if code.kind is ast.Subscript:
        base, index = code[1], code[2]
        return all(isinstance(part, Code) and _is_atom(part) for part in (base, index))
    return _is_atom(code)


def _is_atom(code: Code) -> bool:
    return isinstance(code, Lifted) or code.kind in (ast.Name, ast.Constant)


# ---- statements ------------------------------------------------------------------------------------------


def assigned(target: Code, value: Code) -> Code:
    """`target = value`; the target is a name, an attribute or an item."""
    return Code((ast.Assign, (Code((*target[:-1], ast.Store)),), value))


def added(target: Code, value: int) -> Code:
    """`target += value`."""
    return Code((ast.AugAssign, Code((*target[:-1], ast.Store)), ast.Add, constant(value)))


def deleted(target: Code) -> Code:
    """`del target`."""
    return Code((ast.Delete, (Code((*target[:-1], ast.Del)),)))


def run(expression: Code) -> Code:
    """An expression as a statement."""
    return Code((ast.Expr, expression))


def when(condition: Code, body: Body, otherwise: Body = ()) -> Code:
    """`if condition: … else: …`."""
    return Code((ast.If, condition, body or PASS, otherwise))


def repeated(passes: Code, body: Body, otherwise: Body = ()) -> Code:
    """`for _ in passes: … else: …`."""
    return Code((ast.For, Code((ast.Name, "_", ast.Store)), passes, body, otherwise))


def given(value: Code | None = None) -> Code:
    """`return value`."""
    return Code((ast.Return, value))


BREAK = Code((ast.Break,))
PASS: Body = (Code((ast.Pass,)),)


def guarded(body: Body, caught: tuple[str, ...], handler: Body, always: Body = ()) -> Code:
    """`try: … except (caught) as error: … finally: …`."""
    kinds = sequence(map(name, caught))
    return Code((ast.Try, body, (Code((ast.ExceptHandler, kinds, "error", handler)),), (), always))


# ---- quotations ------------------------------------------------------------------------------------------

#: A part that is put into a quotation; what is no code is a constant.
Plain = float | str | bool | None


def quoted(text: str, *parts: Code | Plain) -> Code:
    """The code of Python as written, with parts where `{0}`, `{1}` … stand: `quoted("min({0}, 5)", value)`."""
    return _filled(
        _quotation(text), tuple(part if isinstance(part, Code) else constant(part) for part in parts)
    )


@lru_cache(maxsize=512)
def _quotation(text: str) -> Code:
    """A text as a tree, once for each text of our own sources; a hole is the tree of a set with a number."""
    statement = ast.parse(text).body[0]
    code = _tree(statement.value if isinstance(statement, ast.Expr) else statement)
    assert isinstance(code, Code)
    return code


def _tree(part: object) -> object:
    if isinstance(part, ast.expr_context | ast.operator | ast.unaryop | ast.cmpop | ast.boolop):
        return type(part)
    if isinstance(part, ast.Constant):
        return Code((ast.Constant, part.value, repr(part.value)))
    if isinstance(part, ast.AST):
        return Code((type(part), *(_tree(getattr(part, field, None)) for field in part._fields)))
    return tuple(map(_tree, part)) if isinstance(part, list) else part


def _filled(code: Code, parts: tuple[Code, ...]) -> Code:
    if code.kind is ast.Set:
        return parts[_hole(code)]
    return Code(_filled_field(field, parts) for field in code)


def _hole(code: Code) -> int:
    """The number in a hole."""
    (number,) = code[1] if isinstance(code[1], tuple) else ()
    place = number[1] if isinstance(number, Code) else None
    assert isinstance(place, int)
    return place


def _filled_field(field: object, parts: tuple[Code, ...]) -> object:
    if isinstance(field, Code):
        return _filled(field, parts)
    return tuple(_filled_field(each, parts) for each in field) if isinstance(field, tuple) else field


# ---- trees -----------------------------------------------------------------------------------------------


def moved(code: Code, offsets: dict[str, int]) -> Code:
    """Code with its lifted values further on, where code of several blocks is put together."""
    if isinstance(code, Lifted):
        return Lifted(code.letter, code.place + offsets[code.letter])
    return Code(_moved(part, offsets) for part in code)


def _moved(part: object, offsets: dict[str, int]) -> object:
    if isinstance(part, Code):
        return moved(part, offsets)
    return tuple(_moved(each, offsets) for each in part) if isinstance(part, tuple) else part


@lru_cache(maxsize=1024)
def node(code: Code) -> ast.AST:
    """The `ast` node of code. Nodes may stand in many trees, so those of frequent parts are kept."""
    kind, *parts = code
    if isinstance(code, Lifted):
        return ast.Name(f"{kind}{code.place}", _LOAD, lineno=1, col_offset=0)
    assert isinstance(kind, type)
    made = kind(*map(_field, parts), lineno=1, col_offset=0)
    assert isinstance(made, ast.AST)
    return made


def _field(part: object) -> object:
    """A field of an `ast` node: a node, a list of nodes, an operator or a context, or a plain value."""
    if isinstance(part, Code):
        return node(part)
    if isinstance(part, type):
        return _FIXED[part]
    return list(map(_field, part)) if isinstance(part, tuple) else part


class _Fixed(dict[type, object]):
    """Operators and contexts: one node of each."""

    def __missing__(self, kind: type) -> object:
        made = self[kind] = kind()
        return made


_FIXED = _Fixed()
_LOAD = ast.Load()
