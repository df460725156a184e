"""`polycnc parameters`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import yaml

if TYPE_CHECKING:
    from tests.cli.console import Console
LATHE = ("--control", "fanuc-0i-tf")


def test_parameters_are_listed_with_their_meaning_in_both_languages(console: Console) -> None:
    english = console("parameters", "list", *LATHE).out
    assert "5114      0            Retract of high speed pecking [mm]" in english.splitlines()
    chinese = console("parameters", "list", *LATHE, "--lang", "zh-TW").out
    assert "高速深孔鑽的退刀量" in chinese
    assert len(chinese.splitlines()) == len(english.splitlines()) > 100


def test_values_of_a_setup_stand_in_the_list(console: Console) -> None:
    console.file("setup.yaml", 'parameters: {"5114": 0.5, "1241 X": 100, "3402": 80}\n')
    lines = console("parameters", "list", *LATHE, "--setup", "setup.yaml").out.splitlines()
    values = {line.split()[0]: line.split()[1] for line in lines}
    assert (values["5114"], values["1241"], values["3402#4"], values["3402#6"]) == ("0.5", "X=100", "1", "1")


def test_a_number_shows_all_its_bits(console: Console) -> None:
    said = console("parameters", "show", "3401", *LATHE).out
    assert [line.split()[0] for line in said.splitlines() if line.startswith("3401")] == [
        "3401#0",
        "3401#6",
        "3401#7",
    ]
    assert console("parameters", "show", "9999", *LATHE).status == 2


def test_parameters_are_set_in_a_setup_and_a_run_has_them(console: Console) -> None:
    said = console("parameters", "set", "3402#4=1", "5114=0.5", "1241 X=100", *LATHE, "--setup", "setup.yaml")
    assert said.status == 0
    setup = yaml.safe_load((console.folder / "setup.yaml").read_text())
    assert setup == {"parameters": {"3402#4": 1, "5114": 0.5, "1241 X": 100}}
    console.file("part.nc", "G30 U0\nM30\n")
    assert console("run", "part.nc", *LATHE, "--setup", "setup.yaml").status == 0


def test_a_wrong_assignment_sets_nothing(console: Console) -> None:
    for word in ("3402#4=2", "5114", "5114=x", "99999=1", "=3"):
        said = console("parameters", "set", "5115=1", word, *LATHE, "--setup", "setup.yaml")
        assert said.status == 2
        assert not (console.folder / "setup.yaml").exists()


def test_a_control_without_a_list_says_so(console: Console) -> None:
    assert console("parameters", "list", "--control", "fanuc-m").status == 2
    assert console("parameters", "list").status == 2


def test_a_name_with_several_numbers_is_shown_and_set_by_each_of_them(console: Console) -> None:
    mill = ("--control", "syntec-mill")
    assert console("parameters", "show", "283", *mill).out.startswith("281-300 ")
    assert console("parameters", "set", "283=1", "--setup", "mill.yaml", *mill).status == 0
    assert "283=1" in console("parameters", "list", "--setup", "mill.yaml", *mill).out
    assert console("parameters", "set", "301=1", "--setup", "mill.yaml", *mill).status == 2
