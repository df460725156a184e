"""Products of vectors."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.vectors import axis_vector, cross, dot, minus, times

numbers = st.floats(-100.0, 100.0)
vectors = st.tuples(numbers, numbers, numbers)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_an_axis_is_the_product_of_the_two_that_follow_it(axis: int) -> None:
    assert cross(axis_vector((axis + 1) % 3), axis_vector((axis + 2) % 3)) == axis_vector(axis)


@given(vectors, vectors)
def test_a_vector_product_stands_on_both_and_is_as_long_as_their_area(
    a: tuple[float, float, float], b: tuple[float, float, float]
) -> None:
    product = cross(a, b)
    assert dot(product, a) == pytest.approx(0.0, abs=1e-6)
    assert dot(product, b) == pytest.approx(0.0, abs=1e-6)
    assert dot(product, product) + dot(a, b) ** 2 == pytest.approx(dot(a, a) * dot(b, b), abs=1e-3)


@given(vectors, vectors)
def test_a_difference_and_a_multiple_are_those_of_the_components(
    a: tuple[float, float, float], b: tuple[float, float, float]
) -> None:
    assert minus(a, times(b, -1.0)) == tuple(x + y for x, y in zip(a, b, strict=True))
