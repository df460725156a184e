"""`polycnc alarms`, and the alarms of a run in JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tests.cli.console import Console
FANUC = ("--control", "fanuc-m")


def test_an_alarm_is_explained_however_its_code_is_written(console: Console) -> None:
    for code in ("PS0010", "10", "010"):
        said = console("alarms", code, *FANUC)
        assert said.status == 0
        assert said.out.startswith("fanuc-m PS0010 ")
        assert "  remedy: " in said.out


def test_an_alarm_tells_its_cause_and_its_remedy_in_both_languages(console: Console) -> None:
    said = console("alarms", "3017", "--control", "meldas-m")
    assert [line.split(":")[0].strip() for line in said.out.splitlines()[1:]] == ["cause", "remedy"]
    said = console("alarms", "3017", "--control", "meldas-m", "--lang", "zh-TW")
    assert [line.split(":")[0].strip() for line in said.out.splitlines()[1:]] == ["原因", "處理"]


def test_alarms_as_json_have_text_cause_and_remedy(console: Console) -> None:
    (alarm,) = json.loads(console("alarms", "1046", *FANUC, "--format", "json").out)
    assert (alarm["control"], alarm["code"]) == ("fanuc-m", "1046")
    assert "M06" in alarm["text"]
    assert "Z" in alarm["cause"]
    assert "G28" in alarm["remedy"]
    assert len(json.loads(console("alarms", *FANUC, "--format", "json").out)) > 100


def test_a_file_with_an_alarm_tells_cause_and_remedy_in_json(console: Console) -> None:
    console.file("away.nc", "O1\nT1\nG0 Z-9.\nM6\nM30\n")
    (finding,) = json.loads(
        console("check", "away.nc", *FANUC, "--machine", "hartford", "--format", "json").out
    )
    assert finding["code"] == "1046"
    assert finding["cause"]
    assert finding["remedy"]


def test_all_alarms_of_a_control_are_listed(console: Console) -> None:
    said = console("alarms", *FANUC)
    assert len(said.out.splitlines()) > 20
