"""No case passes when the code of its function is left out of its program."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.cases.format import Case, parse_case
from tests.conformance.leaving_out import Codes, cases, exempt, proves_nothing
from tests.conformance.reading import FILES, HERE

if TYPE_CHECKING:
    from pathlib import Path


def case(program: str, *, feature: str, control: str = "fanuc-m", **more: object) -> Case:
    return parse_case({"id": "case", "control": control, "feature": feature, "program": program, **more})


def without_codes(program: str, feature: str, control: str = "fanuc-m", **more: object) -> Case:
    shorter = Codes.of(feature).without(case(program, feature=feature, control=control, **more))
    assert shorter is not None
    return shorter


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_every_case_needs_the_code_of_its_function(path: Path) -> None:
    known = exempt()
    tried = [case for _, case in cases([path])]
    found = {case.id for case in tried if proves_nothing(case, path.parent)}
    meant = {case.id for case in tried if case.id in known}
    assert found == meant, "a case proves nothing, or exempt.toml names one that does"


def test_exempt_cases_exist_and_say_why() -> None:
    known = exempt()
    assert set(known) <= {case.id for _, case in cases(FILES)}
    assert all(len(why.split()) >= 4 for why in known.values())


def test_a_code_goes_with_and_without_its_zeros() -> None:
    assert without_codes("G4 X1.\nG04X1.\nG43 Z1.", "har.dwell").program == " X1.\nX1.\nG43 Z1."


def test_a_code_with_a_decimal_is_another_code() -> None:
    shorter = without_codes("G54 X0\nG54.1 P1 X0\nG55 X0", "fmb.wc_g541")
    assert "G54 X0" in shorter.program
    assert "G54.1" not in shorter.program


def test_a_statement_goes_whole() -> None:
    shorter = without_codes("R1=MINVAL(1,2)\nR2=3\n", "sie.minmax_bound", "sinumerik-840d")
    assert shorter.program == "\nR2=3\n"


def test_a_parameter_goes_from_the_setup() -> None:
    setup = {"parameters": {"3401#6": 1, "1620 X": 50}}
    assert without_codes("G90", "fan.gcode_system", "fanuc-0i-tf", setup=setup).setup == {
        "parameters": {"1620 X": 50}
    }


def test_codes_go_from_called_files_too() -> None:
    files = {"O2": "G04 X1.\nM99"}
    assert without_codes("M98 P2", "har.dwell", files=files).files == {"O2": " X1.\nM99"}


def test_a_case_without_its_codes_has_none_to_leave_out() -> None:
    assert Codes.of("har.dwell").without(case("G01 X1. F100", feature="har.dwell")) is None


def test_a_case_that_looks_at_nothing_proves_nothing() -> None:
    program = "G90 G04 X1.\nG01 X1. F100\nM30"
    hollow = case(program, feature="har.dwell", expect={"final": {"work": {"X": 1}}})
    solid = case(program, feature="har.dwell", expect={"moves": [{"type": "dwell"}, {"type": "feed"}]})
    assert proves_nothing(hollow, HERE)
    assert not proves_nothing(solid, HERE)


def test_a_case_without_its_codes_must_have_a_line_that_matters() -> None:
    assert proves_nothing(case("G01 X1. F100\nM30", feature="har.dwell"), HERE)
    expect = {"final": {"work": {"X": 1}}}
    assert not proves_nothing(case("G01 X1. F100\nM30", feature="har.dwell", expect=expect), HERE)


def test_codes_go_one_by_one_too() -> None:
    program = "G61\nG09 G01 X1. F100\nM30"
    both = Codes.of("fan.t_g09_g61").without_one(
        case(program, feature="fan.t_g09_g61", control="fanuc-0i-tf")
    )
    assert [shorter.program for shorter in both] == [
        "G61\n G01 X1. F100\nM30",
        "\nG09 G01 X1. F100\nM30",
    ]


def test_a_switch_goes_from_the_setup() -> None:
    setup = {"switches": {"thread_chamfer": False, "block_skip": True}}
    shorter = without_codes("M30", "fan.g92_chamfer", "fanuc-0i-tf", setup=setup)
    assert shorter.setup == {"switches": {"block_skip": True}}


def test_codes_go_from_what_the_operator_does_and_types() -> None:
    shorter = without_codes(
        "M30", "fan.single_reset", "fanuc-0i-tf", operate=["cycle_start", "reset", {"mdi": "G4 X1."}]
    )
    assert shorter.operate == ["cycle_start", {"mdi": "G4 X1."}]
    assert without_codes("M30", "har.dwell", operate=[{"mdi": "G4 X1."}]).operate == [{"mdi": " X1."}]


def test_a_case_without_codes_may_need_a_command_of_its_operator() -> None:
    operate = [{"override": {"feed": 2.1}}]
    expect = {"panel": {"refused": ["override"]}}
    panel = case("O1\nM30", feature="har.panel_lock", operate=operate, expect=expect)
    assert not proves_nothing(panel, HERE)
