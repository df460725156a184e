from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
import yaml

from polycnc import session
from polycnc.cases import runner
from polycnc.cases.features import claimed, counted
from polycnc.cases.runner import Outcome, run_cases
from polycnc.cases.selection import Selection

if TYPE_CHECKING:
    from pathlib import Path

CASE: dict[str, Any] = {
    "id": "drill",
    "feature": "f.one",
    "control": "fanuc-m",
    "program": "O1\nT5 M6\nG90 G0 X10. Y20.\nG1 Z-5. F120.\nM30\n",
    "expect": {
        "moves": [
            {"type": "rapid", "to": {"X": 10, "Y": 20}, "line": 3},
            {"type": "feed", "to": {"Z": -5}, "feed": 120},
        ],
        "events": [{"t": 5}, {"m": 6}],
        "final": {"work": {"Z": -5}, "machine": {"X": 10}},
    },
}


def outcomes(tmp_path: Path, *cases: object, selection: Selection | None = None) -> list[Outcome]:
    return list(run_cases(list(cases), selection or Selection(), tmp_path))


def changed(**changes: Any) -> dict[str, Any]:
    return {**CASE, **changes}


def expecting(**expect: Any) -> dict[str, Any]:
    return changed(expect=expect)


def test_a_case_that_gets_what_it_expects_passes(tmp_path: Path) -> None:
    (outcome,) = outcomes(tmp_path, CASE)
    assert (outcome.status, outcome.message) == ("passed", "")


@pytest.mark.parametrize(
    ("expect", "told"),
    [
        ({"moves": []}, "move 1"),
        ({"final": {"work": {"Z": 5}}}, "work.Z"),
        ({"variables": {"#100": 1}}, "#100"),
        ({"alarms": [{"code": 10}]}, "alarm"),
        ({"events": [{"m": 8}]}, "event 1"),
        ({"stops": ["N10"]}, "stops"),
    ],
)
def test_each_part_of_the_expectation_can_fail(tmp_path: Path, expect: dict[str, Any], told: str) -> None:
    (outcome,) = outcomes(tmp_path, expecting(**expect))
    assert outcome.status == "failed"
    assert told in outcome.message


def test_the_setup_is_where_the_run_starts(tmp_path: Path) -> None:
    setup = {"work_offsets": {"G54": {"X": 100}}, "start": {"Y": 7}, "variables": {"#101": 3}}
    case = changed(setup=setup, program="G90 G54 G0 X#101\nM30\n")
    case["expect"] = {"final": {"work": {"X": 3}, "machine": {"X": 103, "Y": 7}}, "variables": {"#101": 3}}
    (outcome,) = outcomes(tmp_path, case)
    assert outcome.message == ""


def test_further_files_can_be_called(tmp_path: Path) -> None:
    case = changed(files={"O9001": "G0 X1.\nM99\n"}, program="M98 P9001\nM30\n")
    case["expect"] = {"moves": [{"type": "rapid", "to": {"X": 1}}]}
    (outcome,) = outcomes(tmp_path, case)
    assert outcome.message == ""


def test_a_programmed_stop_is_recorded_and_started_again(tmp_path: Path) -> None:
    case = changed(program="M0\nG0 X1.\nM30\n")
    case["expect"] = {"events": [{"stop": "M00"}], "final": {"work": {"X": 1}}}
    (outcome,) = outcomes(tmp_path, case)
    assert outcome.message == ""


def test_a_program_without_end_ends_with_an_alarm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runner, "CASE_BLOCK_LIMIT", 1000)
    case = changed(program="N1 #100=#100+1\nGOTO 1\n")
    case["expect"] = {"alarms": [{"code": "any"}]}
    (outcome,) = outcomes(tmp_path, case)
    assert outcome.message == ""


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"control": "fanuc-x"}, "fanuc-x"),
        ({"setup": {"startt": {"X": 1}}}, "startt"),
        ({"setup": {"machine": "none"}}, "none"),
        ({"expect": {"move": []}}, "expect.move"),
        ({"setup": {"channels": {1: ["X", "Q"]}}}, "Q"),
    ],
)
def test_a_case_that_cannot_be_understood_names_what_is_wrong(
    tmp_path: Path, change: dict[str, Any], told: str
) -> None:
    (outcome,) = outcomes(tmp_path, changed(**change))
    assert (outcome.status, outcome.readable) == ("failed", False)
    assert told in outcome.message


def test_a_mistake_of_polycnc_fails_its_case_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = session.open_session

    def broken(program: str, **options: Any) -> Any:
        if "BREAK" in program:
            raise ZeroDivisionError("oops")
        return real(program, **options)

    monkeypatch.setattr(runner, "open_session", broken)
    broken_outcome, fine = outcomes(tmp_path, changed(program="(BREAK)\n"), CASE)
    assert "ZeroDivisionError: oops" in broken_outcome.message
    assert fine.status == "passed"


def test_cases_are_selected_by_words_of_their_id(tmp_path: Path) -> None:
    found = outcomes(tmp_path, CASE, changed(id="turn"), selection=Selection(words="DRI"))
    assert [outcome.id for outcome in found] == ["drill"]


def test_cases_of_other_features_are_counted_as_skipped(tmp_path: Path) -> None:
    other = changed(id="turn", feature="f.two")
    only = outcomes(tmp_path, CASE, other, selection=Selection(only=frozenset({"f.one"})))
    assert [outcome.status for outcome in only] == ["passed", "skipped"]
    without = outcomes(tmp_path, CASE, other, selection=Selection(skip=frozenset({"f.one"})))
    assert without[0].status == "skipped"


def test_a_machine_file_lies_beside_the_case_file(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('base = "mill3"\n[axis.X]\nlimit_plus = 5\n', encoding="utf-8")
    (outcome,) = outcomes(
        tmp_path, changed(setup={"machine": "mine.toml"}, expect={"alarms": [{"code": "any"}]})
    )
    assert outcome.message == ""


def test_a_feature_works_only_if_all_its_cases_pass() -> None:
    found = [
        Outcome("1", "passed", feature="a", control="fanuc-m"),
        Outcome("2", "passed", feature="b", control="fanuc-m"),
        Outcome("3", "failed", feature="b", control="fanuc-m"),
        Outcome("4", "passed", feature="a", control="fanuc-m"),
        Outcome("5", "passed", feature="a", control="meldas-m"),
    ]
    assert counted(found) == {"fanuc-m": {"a": 2}, "meldas-m": {"a": 1}}


def test_features_that_cases_speak_of_are_counted_by_control() -> None:
    cases = yaml.safe_load(
        "[{feature: b, control: x}, {feature: a, control: x}, {feature: b, control: x}, {control: x}]"
    )
    assert claimed(cases) == {"x": {"a": 1, "b": 2}}
