"""`polycnc features`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from polycnc.control.registry import ids

if TYPE_CHECKING:
    from tests.cli.console import Console

CONTROLS = Path(__file__).parents[2] / "docs" / "controls"


def test_features_are_counted_for_every_control(console: Console) -> None:
    said = console("features")
    assert [line.split()[0] for line in said.out.splitlines()] == list(ids())


def test_features_of_a_folder_are_those_whose_cases_all_pass(console: Console) -> None:
    (console.folder / "cases").mkdir()
    case = (
        '- {{id: {id}, feature: {feature}, control: fanuc-m, program: "G0 X1.\\nM30",'
        " expect: {{final: {{work: {{X: {x}}}}}}}}}\n"
    )
    console.file(
        "cases/a.yaml",
        case.format(id=1, feature="f.good", x=1)
        + case.format(id=2, feature="f.half", x=1)
        + case.format(id=3, feature="f.half", x=2),
    )
    said = console("features", "--from", "cases", "--format", "json")
    assert json.loads(said.out) == {"fanuc-m": {"f.good": 1}}
    assert "f.good" in console("features", "--from", "cases", "--control", "fanuc-m").out


@pytest.mark.parametrize("control", ids())
def test_the_page_of_a_control_shows_what_the_command_prints(control: str, console: Console) -> None:
    said = console("features", "--control", control, "--format", "markdown", "--lang", "en")
    page = (CONTROLS / f"{control}-functions.md").read_text(encoding="utf-8")
    assert page == said.out, "run `make features`"


def test_functions_are_named_in_the_language_of_the_user(console: Console) -> None:
    said = console("features", "--control", "fanuc-0i-tf", "--lang", "zh-TW")
    assert "多頭螺紋" in said.out
