"""Generated Python as values.

`Code` is a syntax tree in tuples: the kind of a node (`nodes`), then its fields in their order. Unlike `ast` nodes two
trees can be compared and hashed, so code of equal shape is compiled once (see `shapes`). Values that differ from
block to block are not in the tree: a `Lifted` stands for each.

    binary(nodes.Mult, call("cosd", Lifted("n", 0)), name("x"))        cosd(n0) * x
"""

from __future__ import annotations

from functools import cache, lru_cache

from polycnc.deferred.typing import TYPE_CHECKING, Any, Self
from polycnc.language.expressions import nodes
from polycnc.language.expressions.nodes import Kind

if TYPE_CHECKING:
    import ast
    from collections.abc import Iterable


class Code(tuple[object, ...]):
    """An expression or a statement: the kind of its node, then the node's fields.

    A field is again `Code`, a tuple of such, an operator or a context (each a `Kind`), or a plain value.
    """

    __slots__ = ()

    @property
    def kind(self) -> object:
        """The kind of its node."""
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
    return Code((nodes.Name, identifier, nodes.Load))


def constant(value: float | str | bool | None) -> Code:
    """A constant; its written form tells 1 from 1.0 and True, which are equal."""
    return Code((nodes.Constant, value, repr(value)))


def attribute(base: Code, *path: str) -> Code:
    """`base.first.second`."""
    for each in path:
        base = Code((nodes.Attribute, base, each, nodes.Load))
    return base


def dotted(path: str) -> Code:
    """`first.second.third`, given as a text."""
    first, *others = path.split(".")
    return attribute(name(first), *others)


def item(base: Code, index: Code) -> Code:
    """`base[index]`."""
    return Code((nodes.Subscript, base, index, nodes.Load))


def call(function: str | Code, *arguments: Code) -> Code:
    """`function(…)`; the function is a dotted name or an expression."""
    return Code((nodes.Call, dotted(function) if isinstance(function, str) else function, arguments, ()))


def sequence(parts: Iterable[Code]) -> Code:
    """A tuple."""
    return Code((nodes.Tuple, tuple(parts), nodes.Load))


def listed(parts: Iterable[Code]) -> Code:
    """A list."""
    return Code((nodes.List, tuple(parts), nodes.Load))


def unary(operator: Kind, operand: Code) -> Code:
    """An operator before its operand."""
    return Code((nodes.UnaryOp, operator, operand))


def negation(condition: Code) -> Code:
    """`not condition`."""
    return unary(nodes.Not, condition)


def binary(operator: Kind, left: Code, right: Code) -> Code:
    """`a + b` and the like."""
    return Code((nodes.BinOp, left, operator, right))


def compared(left: Code, operator: Kind, right: Code) -> Code:
    """`a < b` and the like."""
    return Code((nodes.Compare, left, (operator,), (right,)))


def within(low: Code, value: Code, above: Code, *, closed: bool = False) -> Code:
    """`low <= value < above`; `closed`: `<=` at both ends."""
    return Code((nodes.Compare, low, (nodes.LtE, nodes.LtE if closed else nodes.Lt), (value, above)))


def either(operator: Kind, left: Code, right: Code) -> Code:
    """`a and b`, `a or b`."""
    return Code((nodes.BoolOp, operator, (left, right)))


def choice(condition: Code, then: Code, otherwise: Code) -> Code:
    """`then if condition else otherwise`."""
    return Code((nodes.IfExp, condition, then, otherwise))


def bound(identifier: str, value: Code) -> Code:
    """`(identifier := value)`."""
    return Code((nodes.NamedExpr, Code((nodes.Name, identifier, nodes.Store)), value))


def is_simple(code: Code) -> bool:
    """Whether a value is at hand: a parameter, a name, a constant, or an item of one at such a place."""
    if code.kind == nodes.Subscript:
        base, index = code[1], code[2]
        return all(isinstance(part, Code) and _is_atom(part) for part in (base, index))
    return _is_atom(code)


def _is_atom(code: Code) -> bool:
    return isinstance(code, Lifted) or code.kind in (nodes.Name, nodes.Constant)


# ---- statements ------------------------------------------------------------------------------------------


def assigned(target: Code, value: Code) -> Code:
    """`target = value`; the target is a name, an attribute or an item."""
    return Code((nodes.Assign, (Code((*target[:-1], nodes.Store)),), value))


def added(target: Code, value: int) -> Code:
    """`target += value`."""
    return Code((nodes.AugAssign, Code((*target[:-1], nodes.Store)), nodes.Add, constant(value)))


def deleted(target: Code) -> Code:
    """`del target`."""
    return Code((nodes.Delete, (Code((*target[:-1], nodes.Del)),)))


def run(expression: Code) -> Code:
    """An expression as a statement."""
    return Code((nodes.Expr, expression))


def when(condition: Code, body: Body, otherwise: Body = ()) -> Code:
    """`if condition: … else: …`."""
    return Code((nodes.If, condition, body or PASS, otherwise))


def repeated(passes: Code, body: Body, otherwise: Body = ()) -> Code:
    """`for _ in passes: … else: …`."""
    return Code((nodes.For, Code((nodes.Name, "_", nodes.Store)), passes, body, otherwise))


def given(value: Code | None = None) -> Code:
    """`return value`."""
    return Code((nodes.Return, value))


BREAK = Code((nodes.Break,))
PASS: Body = (Code((nodes.Pass,)),)


def guarded(body: Body, caught: tuple[str, ...], handler: Body, always: Body = ()) -> Code:
    """`try: … except (caught) as error: … finally: …`."""
    kinds = sequence(map(name, caught))
    return Code((nodes.Try, body, (Code((nodes.ExceptHandler, kinds, "error", handler)),), (), always))


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
    import _ast as ast

    tree = compile(text, "<quotation>", "exec", ast.PyCF_ONLY_AST)
    assert isinstance(tree, ast.Module)
    statement = tree.body[0]
    code = _tree(statement.value if isinstance(statement, ast.Expr) else statement)
    assert isinstance(code, Code)
    return code


def _tree(part: object) -> object:
    import _ast as ast

    if isinstance(part, ast.expr_context | ast.operator | ast.unaryop | ast.cmpop | ast.boolop):
        return Kind(type(part).__name__)
    if isinstance(part, ast.Constant):
        return Code((nodes.Constant, part.value, repr(part.value)))
    if isinstance(part, ast.AST):
        fields = (_tree(getattr(part, field, None)) for field in part._fields)
        return Code((Kind(type(part).__name__), *fields))
    return tuple(map(_tree, part)) if isinstance(part, list) else part


def _filled(code: Code, parts: tuple[Code, ...]) -> Code:
    if code.kind == nodes.Set:
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
        kind, parts = nodes.Name, [f"{kind}{code.place}", nodes.Load]
    assert isinstance(kind, Kind)
    made: ast.AST = _class_of(kind)(*map(_field, parts), lineno=1, col_offset=0)
    return made


def _field(part: object) -> object:
    """A field of an `ast` node: a node, a list of nodes, an operator or a context, or a plain value."""
    if isinstance(part, Code):
        return node(part)
    if isinstance(part, Kind):
        return _fixed(part)
    return list(map(_field, part)) if isinstance(part, tuple) else part


@cache
def _fixed(kind: Kind) -> object:
    """An operator or a context: one node of each."""
    return _class_of(kind)()


@cache
def _class_of(kind: Kind) -> Any:
    import _ast as ast

    return getattr(ast, kind)
