from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from polycnc.cases.format import CaseError, parse_case
from polycnc.cases.runner import Outcome, run_case

PROGRAM = "O1\nG90 G54 G94 G1 X60. F600.\nM30\n"


def outcome(operate: list[Any], **expect: Any) -> Outcome:
    case = {"id": "one", "control": "fanuc-m", "program": PROGRAM, "operate": operate, "expect": expect}
    case["setup"] = {"machine": "hartford"}
    return run_case(parse_case(case), Path())


def test_commands_are_given_in_order_and_time_passes_between_them() -> None:
    held = ["cycle_start", {"step": 3.0}, "feed_hold", "run"]
    said = outcome(held, final={"machine": {"X": 30}}, tolerance=1.0, panel={"state": "hold"})
    assert said.status == "passed", said.message


def test_what_the_panel_shows_is_compared() -> None:
    said = outcome(["cycle_start", "run"], panel={"parts": 2, "time": 6.0})
    assert said.status == "failed"
    assert "panel parts: expected 2, came 1" in said.message
    assert "panel time: expected 6.0" in said.message
    assert outcome(["cycle_start", "run"], panel={"time": 6.0, "tolerance": 0.3}).status == "passed"


def test_where_the_axes_stand_and_alarms_are_compared() -> None:
    assert "final machine.X" in outcome(["cycle_start", "run"], final={"machine": {"X": 61}}).message
    assert "1007" in outcome(["emergency_stop"]).message


def test_a_refused_command_is_a_difference_unless_it_is_expected() -> None:
    jogged = [{"select_mode": "jog"}, "cycle_start"]
    assert "refused" in outcome(jogged).message
    assert outcome(jogged, panel={"refused": ["cycle_start"], "mode": "jog"}).status == "passed"


def test_a_command_takes_a_mapping_a_list_or_one_value() -> None:
    jogged = [{"select_mode": "jog"}, {"jog": ["X", 1]}, {"step": 1.0}, {"stop_jog": "X"}, "run"]
    assert outcome([*jogged, {"override": {"feed": 0.5}}], panel={"state": "ready"}).status == "passed"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"operate": ["dance"]}, "a step is one of"),
        ({"operate": [{"run": None, "reset": None}]}, "a step is one of"),
        ({"operate": ["run"], "expect": {"moves": []}}, "moves cannot be expected here"),
        ({"operate": ["run"], "expect": {"stops_match": "exact"}}, "stops_match cannot be expected here"),
        ({"expect": {"panel": {"state": "hold"}}}, "panel cannot be expected here"),
    ],
)
def test_a_case_that_mixes_what_does_not_belong_together_is_refused(
    change: dict[str, Any], words: str
) -> None:
    with pytest.raises(CaseError, match=words):
        parse_case({"id": "one", "control": "fanuc-m", "program": PROGRAM} | change)


def test_a_command_that_does_not_take_what_it_is_given_makes_the_case_unreadable() -> None:
    said = outcome([{"override": {"food": 1}}])
    assert not said.readable
    assert "operate.override" in said.message


def test_variables_and_events_are_compared() -> None:
    program = "O1\n#101=2.5\nM8\nG4 X1.\nM9\nM30\n"
    case = {"id": "one", "control": "fanuc-m", "program": program, "operate": ["cycle_start", "run"]}

    def said(**expect: Any) -> str:
        return run_case(parse_case(case | {"expect": expect}), Path()).message

    assert said(variables={"#101": 2.5, "#102": None}, events=[{"m": 8}, {"m": 9}]) == ""
    assert "#101" in said(variables={"#101": 2})
    assert "R1" in said(variables={"R1": 2})
    assert "m: 8" in said(events=[{"m": 9}, {"m": 8}])
