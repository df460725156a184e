"""Code whose values have types becomes operations, or is the interpreter's."""

from __future__ import annotations

import pytest

from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.formulas.typed_postfix import Located, Sort, TypedPostfix
from polycnc.language.bulk.layout import Operation
from polycnc.language.expressions.code import Code, Lifted, assigned, quoted

N0, N1 = Lifted("n", 0), Lifted("n", 1)
PLACES = {"r": Sort.REAL, "i": Sort.WHOLE, "b": Sort.TRUTH}


def located(code: Code) -> Located:
    """`v[r]`: a variable at place 7, of a type by its name."""
    index = code[2]
    assert isinstance(index, Code)
    sort = PLACES.get(str(index[1]))
    if sort is None:
        raise OtherError
    return Located(sort, 7)


def postfix(*sorts: Sort) -> TypedPostfix:
    return TypedPostfix(lambda place: sorts[place], int, located, (0, 2.0, 0.5, "text"))


def condition(text: str, *sorts: Sort) -> list[int]:
    made = postfix(*sorts)
    made.condition(quoted(text, N0, N1))
    return made.done[::2]


def test_a_real_sum_is_stored() -> None:
    made = postfix(Sort.REAL, Sort.WHOLE)
    made.stored(quoted("{0} + float({1})", N0, N1), 3)
    assert made.done == [
        *(Operation.NUMBER, 0, Operation.NUMBER, 1, Operation.ADD, 0),
        *(Operation.STORE, 3),
    ]


def test_whole_numbers_stay_exact() -> None:
    made = postfix(Sort.WHOLE, Sort.WHOLE)
    made.assignment(assigned(quoted("v[i]"), quoted("-{0} * {1}", N0, N1)))
    assert made.done[::2] == [
        *(Operation.NUMBER, Operation.NEGATIVE, Operation.EXACT),
        *(Operation.NUMBER, Operation.MULTIPLY, Operation.EXACT, Operation.PUT),
    ]


def test_a_quotient_of_whole_numbers_is_real() -> None:
    postfix(Sort.WHOLE, Sort.WHOLE).stored(quoted("{0} / {1}", N0, N1), 0)
    with pytest.raises(OtherError):
        postfix(Sort.WHOLE, Sort.WHOLE).stored(quoted("{0} + {1}", N0, N1), 0)


def test_what_is_kept_is_used_again() -> None:
    done = condition("(t0 := {0} + v[r]) < {1} and not near(t0, {1})", Sort.REAL, Sort.REAL)
    assert done[3] == Operation.HOLD
    assert Operation.HELD in done
    assert done[-3:] == [Operation.NEAR, Operation.NOT, Operation.AND]


def test_indices_and_remainders_are_known_by_their_questions() -> None:
    asked = "({0} if 0 <= {0} < 5 else out_of_range('A', 1, {0})) == {1}"
    assert condition(asked, Sort.WHOLE, Sort.WHOLE)[:2] == [Operation.NUMBER, Operation.WITHIN]
    rest = "({0} % {1} if ({0} >= 0) & ({1} > 0) else remainder({0}, {1})) == {1}"
    assert condition(rest, Sort.WHOLE, Sort.WHOLE)[2:4] == [Operation.REMAINDER, Operation.EXACT]


@pytest.mark.parametrize(
    "text",
    [
        "min({0}, {1}) == {0}",  # the interpreter gives back an INT or a REAL
        "v[x] == {0}",
        "sind({0})",
        "other({0}) == {1}",
        "{0} @ {1} == {0}",
        "{0} < {1} < {0}",
        "t9 == {0}",
        "({0} and {1}) == {0}",
        "floor({0}) == {1}",
    ],
)
def test_other_code_is_the_interpreters(text: str) -> None:
    with pytest.raises(OtherError):
        condition(text, Sort.REAL, Sort.WHOLE)


def test_values_that_are_at_hand_are_small_and_whole() -> None:
    made = postfix()
    made.handed(Lifted("o", 1), Located(Sort.REAL, 9))
    assert made.done == [Operation.ARGUMENT, 2, Operation.PUT, 9]
    for place, sort in ((1, Sort.WHOLE), (2, Sort.REAL), (3, Sort.REAL), (4, Sort.REAL)):
        with pytest.raises(OtherError):
            postfix().handed(Lifted("o", place), Located(sort, 9))
