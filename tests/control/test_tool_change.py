"""Tool changes where the machine file allows them, and elsewhere."""

from __future__ import annotations

from pathlib import Path

import pytest

import polycnc
from polycnc.control.registry import control, ids

MILL = 'base = "mill3"\nname = "Shop 3"\n[axis.Z]\nreference_points = [0, -120]\n[magazine]\n{magazine}\n'
LATHE = 'base = "lathe2"\nname = "Shop 4"\n[axis.X]\nreference_points = [0, 50]\n[magazine]\nchange_at = { X = [2] }\n'
WORDS = "G91 G28 Z0\n{way}\nT1\nM6\nM30\n"
SINUMERIK = "G74 Z1=0\n{way}\nT1\nM6\nM30\n"
#: Machine position -120 of Z: the second reference point.
SECOND = "G90 G53 G0 Z-120."


def alarms(tmp_path: Path, control: str, program: str, machine: str) -> list[str]:
    """What a program on a machine of one's own raises."""
    path = tmp_path / "shop.toml"
    path.write_text(machine, encoding="utf-8")
    result = polycnc.run(program, control=control, machine=path, setup={"tools": {1: {"radius": 5}}})
    return [alarm.code for alarm in result.alarms]


@pytest.mark.parametrize(
    ("control", "program"),
    [("fanuc-m", WORDS), ("meldas-m", WORDS), ("syntec-mill", WORDS), ("sinumerik-840d", SINUMERIK)],
)
@pytest.mark.parametrize(("points", "allowed"), [("[2]", True), ("[1, 2]", True), ("[1]", False)])
def test_a_tool_is_changed_at_the_points_of_the_machine_file_only(
    tmp_path: Path, control: str, program: str, points: str, allowed: bool
) -> None:
    machine = MILL.format(magazine=f"change_at = {{ Z = {points} }}")
    assert (alarms(tmp_path, control, program.format(way=SECOND), machine) == []) is allowed


def test_hartford_machines_have_alarms_of_their_own(tmp_path: Path) -> None:
    machine = 'rules = "hartford"\n' + MILL.format(magazine="change_at = { Z = [1] }")
    program = WORDS.format(way=SECOND)
    assert alarms(tmp_path, "fanuc-m", program, machine) == ["1046"]
    assert alarms(tmp_path, "meldas-m", program, machine) == ["3017"]
    assert alarms(tmp_path, "syntec-mill", program, machine) == ["PC0012"]


@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
def test_every_axis_that_the_file_names_has_to_stand_there(tmp_path: Path, control: str) -> None:
    machine = MILL.format(magazine="change_at = { X = [1], Z = [1] }")
    assert alarms(tmp_path, control, "G91 G28 Z0\nG0 X-10.\nT1\nM6\nM30\n", machine) == ["PC0012"]
    assert alarms(tmp_path, control, "G91 G0 X-10.\nG28 X0 Z0\nT1\nM6\nM30\n", machine) == []


def test_a_turret_turns_where_the_file_allows_it(tmp_path: Path) -> None:
    assert alarms(tmp_path, "fanuc-0i-tf", "G0 X20. Z5.\nT0101\nM30\n", LATHE) == ["PC0012"]
    assert alarms(tmp_path, "fanuc-0i-tf", "G30 U0\nT0101\nG0 X20.\nT0102\nM30\n", LATHE) == []


@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_polycncs_own_alarms_have_a_text_on_every_control(lang: str) -> None:
    for each in ids():
        for code in ("PC0001", "PC0002", "PC0003", "PC0005", "PC0012"):
            assert control(each).catalogue.text(code, lang)
