"""The scanner's kernels by themselves, as plain functions."""

from __future__ import annotations

from array import array
from math import isclose

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.word_address.block.numbers import NumberRules, conversion, length_converter
from polycnc.geometry import arcs
from polycnc.language.bulk import layout
from polycnc.language.bulk.kernels import NO_KEY, read_rest, read_word
from polycnc.language.bulk.moves import center_by_radius, converted


def text(line: str) -> array[int]:
    return array("B", line.encode() + b"\n")


@pytest.mark.parametrize(
    ("word", "grammar", "key", "value"),
    [
        ("X1.5", layout.Grammar.FORMS_COUNT, 23 * layout.FORMS + 1, 1.5),
        ("X15", layout.Grammar.FORMS_COUNT, 23 * layout.FORMS, 15.0),
        ("X.00015", layout.Grammar.FORMS_COUNT, 23 * layout.FORMS + 3, 0.00015),
        ("G001", 0, layout.FIRST_CODE + 1, 0.0),
        ("CR=5", layout.Grammar.CR_RADIUS | layout.Grammar.EQUALS, 2 * layout.FORMS + layout.CR_FORM, 5.0),
        ("CR5", layout.Grammar.CR_RADIUS | layout.Grammar.EQUALS, NO_KEY, 0.0),
        ("C5", layout.Grammar.CR_RADIUS, 2 * layout.FORMS, 5.0),
        ("X=-0", layout.Grammar.EQUALS, 23 * layout.FORMS + 1, 0.0),
        ("X=5", 0, NO_KEY, 0.0),
        ("G1.5", 0, NO_KEY, 0.0),
        ("G999", 0, layout.FIRST_CODE + 999, 0.0),
        ("G1000", 0, NO_KEY, 0.0),
        ("XA", 0, NO_KEY, 0.0),
    ],
)
def test_words_have_the_key_of_their_address_and_form(
    word: str, grammar: int, key: int, value: float
) -> None:
    assert read_word(text(word), 0, grammar, 15)[1:] == (key, value)


@pytest.mark.parametrize(
    ("rest", "grammar", "length"),
    [
        ("(a) X1", layout.Grammar.ROUND_COMMENTS, 3),
        ("(a", layout.Grammar.ROUND_COMMENTS, -1),
        ("(a", layout.Grammar.ROUND_COMMENTS | layout.Grammar.OPEN_COMMENTS, 2),
        ("(a)", 0, -1),
        ("// X1", layout.Grammar.SLASH_COMMENTS, 5),
        ("/ X1", layout.Grammar.SLASH_COMMENTS, -1),
        ("; X1", layout.Grammar.SEMICOLON_COMMENTS, 4),
        ("; X1", 0, -1),
        (";  ", 0, 3),
        ("; (a) ", layout.Grammar.ROUND_COMMENTS, 6),
        ("; (a) X", layout.Grammar.ROUND_COMMENTS, -1),
        ("%", layout.Grammar.ROUND_COMMENTS, -1),
    ],
)
def test_comments_end_where_the_control_says(rest: str, grammar: int, length: int) -> None:
    assert read_rest(text(rest), 0, grammar) == length


@settings(deadline=None)
@given(
    st.floats(-9999, 9999),
    st.sampled_from(("", ".", ":", ";")),
    st.booleans(),
    st.booleans(),
    st.sampled_from((NumberRules(), NumberRules(calculator=True), NumberRules(cuts_digits=False))),
)
def test_numbers_are_converted_as_the_control_does(
    value: float, form: str, inch: bool, diameter: bool, rules: NumberRules
) -> None:
    convert = length_converter(form, rules, inch=inch, diameter=diameter)
    told = conversion(convert)
    assert told is not None
    expected = value if convert is None else convert(value)
    assert converted(value, *told).hex() == expected.hex()


@settings(deadline=None)
@given(*[st.floats(-50, 50)] * 4, st.floats(0.5, 200), st.booleans(), st.booleans())
def test_the_centre_of_a_radius_is_that_of_the_geometry(
    u: float, v: float, end_u: float, end_v: float, radius: float, ccw: bool, long: bool
) -> None:
    radius = -radius if long else radius
    found, *center = center_by_radius(u, v, end_u, end_v, radius, ccw, 0.01)
    if found:
        assert tuple(center) == arcs.center_from_radius((u, v), (end_u, end_v), radius, ccw, 0.01)


def test_a_quarter_circle_to_the_left_turns_about_its_corner() -> None:
    found, u, v = center_by_radius(10.0, 0.0, 0.0, 10.0, 10.0, True, 0.001)
    assert found
    assert isclose(u, 0.0, abs_tol=1e-12)
    assert isclose(v, 0.0, abs_tol=1e-12)
