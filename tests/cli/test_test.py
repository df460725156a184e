from __future__ import annotations

import json
from typing import TYPE_CHECKING
from xml.etree import ElementTree

if TYPE_CHECKING:
    from tests.cli.console import Console

CASES = """
- id: good-one
  feature: f.a
  control: fanuc-m
  program: |
    G0 X1.
    M30
  expect: {moves: [{type: rapid, to: {X: 1}}]}
- id: bad-one
  feature: f.b
  control: fanuc-m
  program: |
    G0 X1.
    M30
  expect: {moves: [{type: rapid, to: {X: 2}}]}
"""


def test_failures_take_a_line_each_and_the_last_line_counts(console: Console) -> None:
    console.file("cases.yaml", CASES)
    said = console("test", "cases.yaml")
    assert said.status == 1
    lines = said.out.splitlines()
    assert lines[0].startswith("FAILED bad-one: move 1: expected rapid X2, came rapid X1 ")
    assert lines[-1] == "1 passed, 1 failed, 0 skipped"
    assert len(lines) == 2


def test_cases_are_selected_by_id_and_by_feature(console: Console) -> None:
    console.file("cases.yaml", CASES)
    assert console("test", "cases.yaml", "-k", "good").out == "1 passed, 0 failed, 0 skipped\n"
    assert console("test", "cases.yaml", "--feature", "f.a").out == "1 passed, 0 failed, 1 skipped\n"
    assert console("test", "cases.yaml", "--skip-feature", "f.b").out == "1 passed, 0 failed, 1 skipped\n"


def test_several_files_are_one_run(console: Console) -> None:
    console.file("a.yaml", CASES)
    console.file("b.yaml", CASES)
    assert console("test", "a.yaml", "b.yaml").out.splitlines()[-1] == "2 passed, 2 failed, 0 skipped"


def test_the_report_lists_every_case(console: Console) -> None:
    console.file("cases.yaml", CASES)
    console("test", "cases.yaml", "--report", "out.json")
    report = json.loads((console.folder / "out.json").read_text(encoding="utf-8"))
    assert [(entry["id"], entry["status"]) for entry in report] == [
        ("good-one", "passed"),
        ("bad-one", "failed"),
    ]
    assert set(report[0]) == {"id", "status", "message"}


def test_json_and_junit_come_alone_on_standard_output(console: Console) -> None:
    console.file("cases.yaml", CASES)
    assert len(json.loads(console("test", "cases.yaml", "--format", "json").out)) == 2
    suite = ElementTree.fromstring(console("test", "cases.yaml", "--format", "junit").out)
    assert suite.get("failures") == "1"


def test_an_unknown_key_names_case_and_key_and_the_others_still_run(console: Console) -> None:
    console.file("cases.yaml", CASES + "- {id: odd-one, control: fanuc-m, program: M30, expekt: {}}\n")
    said = console("test", "cases.yaml")
    assert said.status == 2
    assert "FAILED odd-one: unknown key expekt" in said.out
    assert said.out.splitlines()[-1] == "1 passed, 2 failed, 0 skipped"


def test_an_unreadable_file_is_status_2_and_the_others_still_run(console: Console) -> None:
    console.file("cases.yaml", CASES)
    console.file("broken.yaml", "- [")
    said = console("test", "broken.yaml", "cases.yaml", "-k", "good")
    assert said.status == 2
    assert "broken.yaml" in said.err
    assert said.out.splitlines()[-1] == "1 passed, 0 failed, 0 skipped"


def test_all_passed_is_status_0(console: Console) -> None:
    console.file("cases.yaml", CASES)
    assert console("test", "cases.yaml", "-k", "good").status == 0
