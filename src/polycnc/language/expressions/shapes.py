"""Code compiled once for each shape.

`#1=#2*2.5` and `#7=#3*4.` are one piece of code with other numbers. The numbers and objects of a block are parameters
of its function, with the block's own as their defaults: Python's compiler runs once for each shape of block, and a
block costs no more than a function object. Shapes belong to a control, and the ones used longest ago are forgotten.
"""

from __future__ import annotations

from functools import lru_cache
from types import CodeType, FunctionType

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.expressions.code import Body, given, node

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.language.expressions.code import Code

#: Shapes that are kept; a program has some hundreds.
MOST_SHAPES = 4096


class TooDeepError(Exception):
    """Code that is nested deeper than Python nests it."""


class Function(NamedTuple):
    """What a function does.

    Attributes:
        parameters: What it is called with.
        numbers: How many lifted numbers its code has.
        objects: How many lifted objects its code has.
        body: Its statements.
    """

    parameters: tuple[str, ...]
    numbers: int
    objects: int
    body: Body


class Template(NamedTuple):
    """A compiled shape: what functions of its blocks are made of."""

    code: CodeType
    names: dict[str, object]

    def function(self, values: tuple[object, ...]) -> FunctionType:
        """The function of a block with its values: numbers, then objects."""
        return FunctionType(self.code, self.names, None, values)


class Shapes:
    """The shapes of a control's programs.

    Args:
        names: What the code may use besides its parameters.
        most: How many shapes are kept.
    """

    def __init__(self, names: dict[str, object], most: int = MOST_SHAPES) -> None:
        self.names = names
        self._compiled = lru_cache(most)(compiled)

    def template(self, function: Function) -> Template:
        """The shape of a function.

        Raises:
            TooDeepError: The code is nested too deeply.
        """
        try:
            return Template(self._compiled(function), self.names)
        except RecursionError:
            raise TooDeepError from None

    def function(self, function: Function, values: Iterable[object]) -> FunctionType:
        """The function of a block, with its values: numbers, then objects."""
        return self.template(function).function(tuple(values))

    def single(self, function: Function, values: Iterable[object]) -> FunctionType:
        """A function whose shape does not come again."""
        try:
            return Template(compiled(function), self.names).function(tuple(values))
        except (RecursionError, SyntaxError):  # more blocks in one another than Python takes
            raise TooDeepError from None

    def value(self, parameter: str, code: Code, numbers: Iterable[object]) -> FunctionType:
        """The function of one parameter that gives the value of an expression."""
        values = tuple(numbers)
        return self.function(Function((parameter,), len(values), 0, (given(code),)), values)

    def __len__(self) -> int:
        return self._compiled.cache_info().currsize


def with_values(function: FunctionType, values: tuple[object, ...]) -> FunctionType:
    """A function of a shape with the values of another block."""
    return FunctionType(function.__code__, function.__globals__, None, values)


def compiled(function: Function) -> CodeType:
    """Python's code of a function."""
    import _ast as ast

    lifted = [f"n{i}" for i in range(function.numbers)] + [f"o{i}" for i in range(function.objects)]
    parameters = [ast.arg(each, lineno=1, col_offset=0) for each in (*function.parameters, *lifted)]
    arguments = ast.arguments(
        posonlyargs=[], args=parameters, vararg=None, kwonlyargs=[], kw_defaults=[], kwarg=None, defaults=[]
    )
    body = [each for each in map(node, function.body) if isinstance(each, ast.stmt)]
    only = body[0]
    if len(body) == 1 and isinstance(only, ast.Return) and only.value is not None:
        value = ast.Lambda(arguments, only.value, lineno=1, col_offset=0)
        module = compile(ast.Expression(value), "<block>", "eval")
    else:
        definition = ast.FunctionDef("block", arguments, body, [], lineno=1, col_offset=0)
        module = compile(ast.Module([definition], []), "<block>", "exec")
    return next(each for each in module.co_consts if isinstance(each, CodeType))
