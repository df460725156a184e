"""The commands that only look things up, or draw."""

from __future__ import annotations

import json
import tomllib
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

from polycnc.machine import builtin_ids
from tests.cli.console import BAD, GOOD

if TYPE_CHECKING:
    from tests.cli.console import Console

FANUC = ("--control", "fanuc-m")


def test_the_built_in_machines_are_listed_one_a_line(console: Console) -> None:
    said = console("machines")
    assert [line.split()[0] for line in said.out.splitlines()] == list(builtin_ids())


def test_a_machine_is_shown_as_a_file_that_can_be_used(console: Console) -> None:
    shown = console("machines", "show", "mill3").out
    assert tomllib.loads(shown)["axis"]["X"]["kind"] == "linear"
    console.file("copy.toml", shown)
    console.file("good.nc", GOOD)
    assert console("run", "good.nc", *FANUC, "--machine", "copy.toml").status == 0


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
    (finding,) = json.loads(console("check", "away.nc", *FANUC, "--format", "json").out)
    assert finding["code"] == "1046"
    assert finding["cause"]
    assert finding["remedy"]


def test_all_alarms_of_a_control_are_listed(console: Console) -> None:
    said = console("alarms", *FANUC)
    assert len(said.out.splitlines()) > 20


def test_a_drawing_is_svg(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("plot", "good.nc", *FANUC, "-o", "good.svg")
    assert (said.status, said.err) == (0, "")
    root = ElementTree.parse(console.folder / "good.svg").getroot()
    views = {group.get("id") for group in root.iter("{http://www.w3.org/2000/svg}g")} - {None}
    assert views == {"view-xy", "view-xz", "view-yz"}


def test_the_view_can_be_chosen(console: Console) -> None:
    console.file("good.nc", GOOD)
    console("plot", "good.nc", *FANUC, "-o", "good.svg", "--view", "xy")
    assert 'id="view-xz"' not in (console.folder / "good.svg").read_text(encoding="utf-8")


def test_a_program_that_alarms_is_drawn_up_to_the_alarm(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("plot", "bad.nc", *FANUC, "-o", "bad.svg")
    assert said.status == 1
    assert "PS0010" in said.err
    assert (console.folder / "bad.svg").exists()


def test_a_picture_without_its_library_says_what_to_install(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "resvg_py", None)
    console.file("good.nc", GOOD)
    said = console("plot", "good.nc", *FANUC, "-o", "good.png")
    assert said.status == 2
    assert "polycnc[png]" in said.err
    assert not (console.folder / "good.png").exists()


def test_a_picture_is_png(console: Console) -> None:
    pytest.importorskip("resvg_py")
    console.file("good.nc", GOOD)
    assert console("plot", "good.nc", *FANUC, "-o", "good.png").status == 0
    assert (console.folder / "good.png").read_bytes().startswith(b"\x89PNG")
