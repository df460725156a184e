"""Code compiled once for each shape."""

from __future__ import annotations

import pytest

from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, binary, bound, call, constant, given, moved, name
from polycnc.language.expressions.shapes import Function, Shapes, TooDeepError


def shapes(most: int = 16) -> Shapes:
    return Shapes({"__builtins__": {}, "abs": abs}, most)


def nested(depth: int) -> Code:
    code = name("x")
    for _ in range(depth):
        code = binary(nodes.Add, code, Lifted("n", 0))
    return code


def test_functions_of_one_shape_differ_in_their_numbers_only() -> None:
    kept = shapes()
    product = binary(nodes.Mult, call("abs", name("x")), Lifted("n", 0))
    first, second = kept.value("x", product, [2.0]), kept.value("x", product, [5.0])
    assert (first(-3.0), second(-3.0)) == (6.0, 15.0)
    assert len(kept) == 1
    assert first.__code__ is second.__code__


def test_constants_that_are_equal_but_of_other_types_are_other_shapes() -> None:
    kept = shapes()
    found = [kept.value("x", constant(value), [])(None) for value in (1, 1.0, True, 0.0, -0.0)]
    assert list(map(repr, found)) == ["1", "1.0", "True", "0.0", "-0.0"]


def test_the_shapes_used_longest_ago_are_forgotten() -> None:
    kept = shapes(most=3)
    for depth in range(20):
        assert kept.value("x", nested(depth), [1.0] if depth else [])(0.0) == depth
    assert len(kept) == 3


def test_code_nested_deeper_than_python_nests_is_refused() -> None:
    with pytest.raises(TooDeepError):
        shapes().value("x", nested(5000), [1.0])


def test_moved_code_takes_its_numbers_and_objects_further_on() -> None:
    code = call(Lifted("o", 0), bound("t0", Lifted("n", 1)))
    function = Function((), 4, 2, (given(moved(code, {"n": 2, "o": 1})),))
    assert shapes().single(function, [0, 1, 2, 3, None, abs])() == 3
