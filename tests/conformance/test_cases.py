"""Every case of this folder passes, and the list of features that is shipped says what they prove."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from polycnc.cases.features import claimed, shipped_of_cases
from polycnc.cases.format import case_id, parse_case
from polycnc.cases.runner import run_case
from tests.conformance.reading import FILES, cases_in

if TYPE_CHECKING:
    from pathlib import Path

CASES = [(path, number, data) for path in FILES for number, data in enumerate(cases_in(path), 1)]


def name_of(case: tuple[Path, int, Any]) -> str:
    return case_id(case[2], case[1])


@pytest.mark.parametrize("case", CASES, ids=name_of)
def test_the_control_does_what_its_manual_says(case: tuple[Path, int, Any]) -> None:
    outcome = run_case(parse_case(case[2]), case[0].parent)
    assert outcome.status == "passed", outcome.message


def test_no_two_cases_have_the_same_id() -> None:
    names = [name_of(case) for case in CASES]
    assert sorted(names) == sorted(set(names))


def test_the_shipped_list_of_features_is_current() -> None:
    assert shipped_of_cases() == claimed(data for _, _, data in CASES), "run `make features`"


def test_cases_lie_by_control_and_function() -> None:
    for path, number, data in CASES:
        assert path.parent.name == data["control"], f"{path.name}: {case_id(data, number)}"
