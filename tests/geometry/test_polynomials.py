from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry import polynomials
from polycnc.geometry.polynomials import NODES

NUMBERS = st.floats(-100.0, 100.0)


@given(st.lists(NUMBERS, min_size=6, max_size=6), st.floats(0.0, 1.0))
def test_a_fit_has_the_values_and_a_polynomial_is_fitted_by_itself(given: list[float], p: float) -> None:
    values = [polynomials.value(given, node) for node in NODES]
    found = polynomials.fitted(values)
    assert polynomials.value(found, p) == pytest.approx(polynomials.value(given, p), abs=1e-6)


def test_a_fit_has_no_powers_that_are_rounding() -> None:
    assert polynomials.fitted([3.0 + 2.0 * node for node in NODES]) == pytest.approx((3.0, 2.0))
    assert polynomials.fitted([7.0] * 6) == (7.0,)


def test_turns_and_roots_are_in_order() -> None:
    wave = (0.1, -1.3, 4.0, -3.0)
    assert [
        round(polynomials.value(polynomials.derivative(wave), p), 9) for p in polynomials.turns(wave)
    ] == [0.0, 0.0]
    roots = polynomials.roots(wave)
    assert roots == sorted(roots)
    assert len(roots) == 3
    assert all(abs(polynomials.value(wave, p)) < 1e-9 for p in roots)


def test_roots_at_the_ends_count_and_a_constant_has_none() -> None:
    assert polynomials.roots((0.0, 1.0)) == [0.0]
    assert polynomials.roots((-1.0, 1.0)) == [1.0]
    assert polynomials.roots((0.0,)) == []


@given(st.floats(-5.0, 15.0))
def test_a_growing_polynomial_is_solved_within_its_ends(wanted: float) -> None:
    growing = (1.0, 4.0, 3.0, 1.0)
    p = polynomials.solved(growing, wanted)
    assert polynomials.value(growing, p) == pytest.approx(min(max(wanted, 1.0), 9.0))
