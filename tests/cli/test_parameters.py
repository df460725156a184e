"""`polycnc parameters`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import yaml

if TYPE_CHECKING:
    from tests.cli.console import Console
LATHE = ("--control", "fanuc-0i-tf")
SINUMERIK = ("--control", "sinumerik-840d")


def test_parameters_are_listed_with_their_meaning_in_both_languages(console: Console) -> None:
    english = console("parameters", "list", *LATHE).out
    assert "5114      0.5          Retract of high speed pecking [mm]" in english.splitlines()
    chinese = console("parameters", "list", *LATHE, "--lang", "zh-TW").out
    assert "高速深孔鑽的退刀量" in chinese
    assert len(chinese.splitlines()) == len(english.splitlines()) > 100


@pytest.mark.parametrize(
    ("control", "english", "chinese"),
    [
        ("fanuc-m", "19625     3            Blocks that compensation looks ahead", "補正的預讀單節數"),
        (
            "meldas-m",
            "8012      0.5          G73 n: retract of high speed pecking [mm]",
            "高速深孔鑽的退刀量",
        ),
    ],
)
def test_the_parameters_of_mills_are_listed(
    console: Console, control: str, english: str, chinese: str
) -> None:
    assert english in console("parameters", "list", "--control", control).out.splitlines()
    assert chinese in console("parameters", "list", "--control", control, "--lang", "zh-TW").out


@pytest.mark.parametrize(
    ("control", "known", "unknown"),
    [
        ("fanuc-m", "3404#7=1", "3404#0=1"),
        ("meldas-m", "7213=8211", "7214=1"),
        ("meldas-m", "1086=0", "6001#5=1"),
    ],
)
def test_only_numbers_and_bits_of_the_list_are_set(
    console: Console, control: str, known: str, unknown: str
) -> None:
    assert console("parameters", "set", known, "--control", control, "--setup", "mill.yaml").status == 0
    refused = console("parameters", "set", unknown, "--control", control, "--setup", "mill.yaml")
    assert refused.status == 2
    assert unknown.partition("=")[0] in refused.err


def test_values_of_a_setup_stand_in_the_list(console: Console) -> None:
    console.file("setup.yaml", 'parameters: {"5114": 0.5, "1241 X": 100, "3402": 80}\n')
    lines = console("parameters", "list", *LATHE, "--setup", "setup.yaml").out.splitlines()
    values = {line.split()[0]: line.split()[1] for line in lines}
    assert (values["5114"], values["1241"], values["3402#4"], values["3402#6"]) == ("0.5", "X=100", "1", "1")


@pytest.mark.parametrize("control", ["fanuc-0i-tf", "fanuc-m"])
def test_numbers_and_bits_of_a_setup_that_the_control_does_not_have_are_named(
    console: Console, control: str
) -> None:
    console.file("setup.yaml", 'parameters: {"5114": 0.5, "6004": 1, "6004#7": 1, "1240 X": 5, "9999": 3}\n')
    said = console("parameters", "list", "--control", control, "--setup", "setup.yaml")
    assert said.status == 0
    assert said.err == f"{control}: polycnc knows no parameter 6004#7, 9999\n"


def test_a_run_names_parameters_of_the_setup_that_have_no_effect(console: Console) -> None:
    console.file("part.nc", "G90 G01 X1. F100.\nM30\n")
    console.file("setup.yaml", 'parameters: {"405": 1000, "402": 50, "3836": 1}\n')
    said = console("run", "part.nc", "--control", "syntec-mill", "--setup", "setup.yaml")
    assert said.status == 0
    assert said.err == "syntec-mill: polycnc knows no parameter 402\n"


@pytest.mark.parametrize("datum", ["35100", "$MA_SPIND_VELO_LIMIT"])
def test_a_run_names_parameters_that_are_only_kept(console: Console, datum: str) -> None:
    console.file("part.mpf", "G1 X1 F100\nM30\n")
    console.file("setup.yaml", f'parameters: {{"{datum}": 1}}\n')
    said = console("run", "part.mpf", "--control", "sinumerik-840d", "--setup", "setup.yaml")
    assert said.err == f"sinumerik-840d: kept only, nothing acts on parameter {datum}\n"


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


def test_a_list_is_that_of_a_control(console: Console) -> None:
    assert console("parameters", "list").status == 2
    assert console("parameters", "list", "--control", "no-such-control").status == 2


def test_machine_data_are_listed_by_number_with_their_identifier(console: Console) -> None:
    lines = console("parameters", "list", *SINUMERIK).out.splitlines()
    largest = "largest difference of the radii at start and end of a circle"
    assert f"21000     0.01         $MC_CIRCLE_ERROR_CONST: {largest} [mm]" in lines
    assert next(line for line in lines if line.startswith("35100")).endswith(
        "(kept only: nothing acts on it)"
    )
    assert "現用" in console("parameters", "show", "42940", *SINUMERIK, "--lang", "zh-TW").out


def test_machine_data_are_shown_by_number_or_identifier(console: Console) -> None:
    by_number, by_name = (
        console("parameters", "show", name, *SINUMERIK).out for name in ("22560", "$MC_TOOL_CHANGE_M_CODE")
    )
    assert by_number == by_name
    assert "delivered: 6" in by_name


def test_machine_data_of_a_setup_are_shown_with_axis_element_and_bit(console: Console) -> None:
    written = (
        '"36110[X]": 500, "$MA_POS_LIMIT_PLUS[Y]": 400, "20150[7]": 2, "20110#6": 1, "20000": MILL, 77: 1'
    )
    console.file("setup.yaml", f"parameters: {{{written}}}\n")
    said = console("parameters", "list", *SINUMERIK, "--setup", "setup.yaml")
    values = {line.split()[0]: line.split("  $")[0].split()[1:] for line in said.out.splitlines()}
    assert values["36110"][:2] == ["X=500", "Y=400"]
    assert (values["20150"][0], values["20110"][0], values["20000"][0]) == ("[7]=2", "#6=1", "MILL")
    assert [line.split()[-1] for line in said.err.splitlines()] == ["77"]


def test_machine_data_are_set_by_number_or_identifier_and_a_run_has_them(console: Console) -> None:
    words = ("36110[X]=30", "$MC_CHAN_NAME=MILL", "20110#6=1")
    assert console("parameters", "set", *words, *SINUMERIK, "--setup", "setup.yaml").status == 0
    setup = yaml.safe_load((console.folder / "setup.yaml").read_text())
    assert setup == {"parameters": {"36110[X]": 30, "$MC_CHAN_NAME": "MILL", "20110#6": 1}}
    console.file("part.mpf", "G0 X31\nM30\n")
    said = console("run", "part.mpf", *SINUMERIK, "--setup", "setup.yaml")
    assert "10720" in said.out + said.err


@pytest.mark.parametrize("word", ["21000=wide", "21000#1=1", "20110#6=2", "$MC_NO_SUCH=1"])
def test_what_a_datum_cannot_be_is_refused(console: Console, word: str) -> None:
    assert console("parameters", "set", word, *SINUMERIK, "--setup", "setup.yaml").status == 2


def test_a_name_with_several_numbers_is_shown_and_set_by_each_of_them(console: Console) -> None:
    mill = ("--control", "syntec-mill")
    assert console("parameters", "show", "283", *mill).out.startswith("281-300 ")
    assert console("parameters", "set", "283=1", "--setup", "mill.yaml", *mill).status == 0
    assert "283=1" in console("parameters", "list", "--setup", "mill.yaml", *mill).out
    assert console("parameters", "set", "301=1", "--setup", "mill.yaml", *mill).status == 2
