from __future__ import annotations

from typing import Any

import pytest

from polycnc.cases.format import CaseError, case_id, parse_case

SMALLEST: dict[str, Any] = {"id": "a", "control": "fanuc-m", "program": "M30\n"}


def test_the_smallest_case_expects_no_alarm_and_nothing_else() -> None:
    expect = parse_case(SMALLEST).expect
    assert expect.alarms == []
    assert expect.moves is None
    assert (expect.moves_match, expect.tolerance) == ("exact", 0.001)


def test_an_empty_list_of_moves_is_not_the_same_as_none() -> None:
    assert parse_case({**SMALLEST, "expect": {"moves": []}}).expect.moves == []


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"expekt": {}}, "expekt"),
        ({"expect": {"mooves": []}}, "expect.mooves"),
        ({"expect": {"moves": [{"type": "feed"}, {"too": {}}]}}, "expect.moves[1].too"),
        ({"expect": {"alarms": [{"kode": 1}]}}, "expect.alarms[0].kode"),
        ({"expect": {"moves_match": "loose"}}, "expect.moves_match"),
        ({"expect": {"final": {"work": {"X": "far"}}}}, "expect.final.work.X"),
        ({"files": {"O1": 5}}, "files.O1"),
    ],
)
def test_a_wrong_key_is_named_with_its_place(wrong: dict[str, Any], named: str) -> None:
    with pytest.raises(CaseError) as caught:
        parse_case({**SMALLEST, **wrong})
    assert named in str(caught.value)


@pytest.mark.parametrize(
    ("wrong", "meant"),
    [
        ({"expekt": {}}, "; did you mean expect?"),
        ({"parameters": {}}, "; parameters is a key of setup"),
        ({"expect": {"moves": [{"code": 1}]}}, "; code is a key of expect.alarms"),
        ({"expect": {"program": "O1"}}, "; program is a key of expect.moves, expect.alarms"),
        ({"colour": "red"}, ""),
    ],
)
def test_an_unknown_key_says_where_it_belongs(wrong: dict[str, Any], meant: str) -> None:
    with pytest.raises(CaseError, match="unknown key") as caught:
        parse_case({**SMALLEST, **wrong})
    said = str(caught.value)
    assert meant in said
    assert bool(meant) == (";" in said)


def test_a_missing_key_is_named() -> None:
    with pytest.raises(CaseError, match="program"):
        parse_case({"id": "a", "control": "fanuc-m"})


def test_what_is_no_mapping_is_no_case() -> None:
    with pytest.raises(CaseError):
        parse_case("O0001")


def test_a_section_left_empty_is_the_same_as_none() -> None:
    assert parse_case({**SMALLEST, "setup": None, "files": None}).setup == {}


def test_ids_may_be_numbers_and_a_case_without_one_is_called_by_its_place() -> None:
    assert parse_case({**SMALLEST, "id": 7}).id == "7"
    assert case_id({"id": 7}, 3) == "7"
    assert case_id({}, 3) == "#3"
    assert case_id("text", 4) == "#4"
