"""Expressions of custom macro B, held against Python's arithmetic."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.registry import control
from polycnc.language.word_address.functions import round_half_away
from polycnc.language.word_address.macro_b import Reader, macro_shapes
from polycnc.messages import AlarmError
from tests.support import codes, run

ALARMS: Any = control("fanuc-m").alarms  # type: ignore[attr-defined]


class Memory:
    """Variables as generated expressions read them."""

    angle_range_signed = 0
    joined_conditions = 0
    joining_hint = "hint.joined-conditions"
    increment = 0.001

    def __init__(self, **values: float) -> None:
        self.locals: list[float | None] = [None] * 34
        self.common: list[float | None] = [None] * 1000
        for name, value in values.items():
            self.common[int(name.lstrip("v"))] = value

    def fail(self, mistake: str) -> AlarmError:
        return AlarmError(ALARMS[mistake])

    def read(self, number: int) -> float | None:
        return self.common[number]

    def read_indirect(self, number: float) -> float | None:
        return self.read(int(round_half_away(number)))


class FakeChannel(NamedTuple):
    memory: Memory


def value_of(text: str, **variables: float) -> float | None:
    """The value of an expression."""
    reader = Reader(text, ALARMS, macro_shapes())
    evaluate = reader.evaluator(reader.sum())
    assert reader.peek() == "", f"unread: {text[reader.pos :]}"
    channel: Any = FakeChannel(Memory(**variables))
    return evaluate(channel)


class Term(NamedTuple):
    """A piece of an expression: its text, its value, how tightly it binds."""

    text: str
    value: float
    rank: int


ATOM, PRODUCT, SUM = 2, 1, 0


def number(value: float) -> Term:
    text = f"{value:.5f}"
    return Term(text, float(text), ATOM)


def joined(left: Term, operator: str, right: Term) -> Term:
    """Left-associative operators: the right side is bracketed where it binds no tighter than the operator."""
    rank = SUM if operator in "+-" else PRODUCT
    a = left.text if left.rank >= rank else f"[{left.text}]"
    b = right.text if right.rank > rank else f"[{right.text}]"
    value = {
        "+": left.value + right.value,
        "-": left.value - right.value,
        "*": left.value * right.value,
        "/": left.value / right.value if right.value else 0.0,
    }[operator]
    return Term(f"{a}{operator}{b}", value, rank)


def depth(text: str) -> int:
    deepest = level = 0
    for char in text:
        level += (char == "[") - (char == "]")
        deepest = max(deepest, level)
    return deepest


TERMS = st.recursive(
    st.floats(0.0, 1000.0).map(number),
    lambda inner: st.builds(joined, inner, st.sampled_from("+-*/"), inner),
    max_leaves=8,
)


def divides_by_zero(term: Term) -> bool:
    return "/0.0" in term.text or "/[" in term.text


@given(TERMS.filter(lambda term: depth(term.text) <= 5 and not divides_by_zero(term)))
def test_arithmetic_binds_and_associates_as_in_python(term: Term) -> None:
    assert value_of(term.text) == pytest.approx(term.value, rel=1e-12, abs=1e-12)


@given(TERMS.filter(lambda term: depth(term.text) <= 4 and not divides_by_zero(term)))
def test_brackets_around_an_expression_change_nothing(term: Term) -> None:
    assert value_of(f"[{term.text}]") == value_of(term.text)


@given(st.integers(0, 65535), st.integers(0, 65535))
def test_logic_works_on_the_bits_of_integers(a: int, b: int) -> None:
    assert value_of(f"{a} AND {b}") == a & b
    assert value_of(f"{a} OR {b}") == a | b
    assert value_of(f"{a} XOR {b}") == a ^ b


@given(st.integers(-10_000, 10_000), st.integers(1, 500))
def test_mod_keeps_the_sign_of_its_left_side(a: int, b: int) -> None:
    left = f"[0-{-a}]" if a < 0 else str(a)
    assert value_of(f"{left} MOD {b}") == math.fmod(a, b)


@given(st.floats(-1e6, 1e6))
def test_fix_and_fup_enclose_a_number(x: float) -> None:
    text = f"{x:.4f}"
    exact = float(text)
    source = f"[{text}]" if exact < 0 else text
    fix, fup = value_of(f"FIX[{source}]"), value_of(f"FUP[{source}]")
    assert fix is not None
    assert fup is not None
    assert abs(fix) <= abs(exact) + 1e-6 <= abs(fup) + 2e-6
    assert abs(fup) - abs(fix) in (0.0, 1.0)


@given(st.integers(0, 99_999_999))
def test_bin_takes_bcd_back(number_: int) -> None:
    assert value_of(f"BIN[BCD[{number_}]]") == number_


@given(st.floats(0.0, 359.999))
def test_the_direction_of_sine_and_cosine_is_the_angle(angle: float) -> None:
    found = value_of(f"ATAN[SIN[{angle:.4f}]]/[COS[{angle:.4f}]]")
    assert found is not None
    assert abs((found - float(f"{angle:.4f}") + 180.0) % 360.0 - 180.0) < 1e-6


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2+3*4", 14),
        ("1 OR 2*4", 9),
        ("6 AND 3+1", 3),
        ("7 MOD 4*2", 6),
        ("10-4-3", 3),
        ("64/4/2", 8),
        ("-3+5", 2),
        ("[1+1]*[1+1]", 4),
        ("-[2-5]", 3),
        ("ROUND[2.5]+ROUND[0-2.5]", 0),
        ("SQ[9]+RO[1.6]", 5),
        ("POW[2,0.5]*POW[2,0.5]", 2),
    ],
)
def test_operators_keep_their_priority(text: str, value: float) -> None:
    assert value_of(text) == pytest.approx(value)


def test_a_bare_vacant_variable_stays_vacant_and_counts_as_zero_in_a_sum() -> None:
    assert value_of("#5") is None
    assert value_of("#5+1") == 1.0


def test_a_vacant_variable_in_brackets_counts_as_zero_too() -> None:
    assert value_of("[#5]+1") == 1.0
    assert value_of("[#5]") is None


def test_a_sum_of_more_terms_than_python_nests_has_an_alarm() -> None:
    assert value_of("1" + "+1" * 190) == 191
    with pytest.raises(AlarmError) as caught:
        value_of("1" + "+1" * 300)
    assert caught.value.code == "PS0118"


def test_an_index_may_be_an_expression() -> None:
    assert value_of("#[100+#101]", v101=2.0, v102=7.5) == 7.5


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("[[[[[[1]]]]]]", "PS0118"),
        ("[1+2", "PS1132"),
        ("[1 GT 2]", "PS0114"),
        ("FOO[1]", "PS0114"),
        ("POW[1]", "PS1120"),
        ("1+", "PS0114"),
        ("##1", "PS0114"),
    ],
)
def test_a_wrong_expression_has_its_own_alarm(text: str, code: str) -> None:
    with pytest.raises(AlarmError) as caught:
        value_of(text)
    assert caught.value.code == code


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("1/0", "PS0112"),
        ("5 MOD 0", "PS0112"),
        ("SQRT[0-1]", "PS0119"),
        ("LN[0]", "PS0119"),
        ("ACOS[2]", "PS0119"),
    ],
)
def test_arithmetic_that_cannot_be_done_is_an_alarm(text: str, code: str) -> None:
    assert codes(run(f"#101={text}\nM30\n")) == [code]
