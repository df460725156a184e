# ruff: noqa: E501 - programs stand as they are written
"""Words and codes of plain blocks beside a way: S, modes of the path, codes that are in force already."""

from __future__ import annotations

import pytest

from tests.language.bulk.both_ways import differences, run, scanned

CONTROLS = ("fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d", "fanuc-0i-tf")
HEADS = {"fanuc-0i-tf": "G98 G1 F1000."}
BLOCKS = ("X1.", "S1200", "X2. S1300", "S1400 X3. F500.", "G0 X4. S1400", "G1 X5. F300. S1500", "X6.")


def program(control_id: str, *blocks: str) -> str:
    """Two blocks for the interpreter around others."""
    head = HEADS.get(control_id, "G90 G94 G1 F1000.")
    return "\n".join((head, "M3", *blocks, "M30", ""))


@pytest.mark.parametrize("control_id", CONTROLS)
def test_speeds_are_scanned(control_id: str) -> None:
    text = program(control_id, *BLOCKS)
    assert differences(text, control_id) == []
    assert scanned(text, control_id) >= len(BLOCKS)


@pytest.mark.parametrize("control_id", CONTROLS)
def test_the_event_of_a_speed_stands_in_front_of_the_move_of_its_block(control_id: str) -> None:
    channel = run(program(control_id, "X1.", "X2. S1300", "X3."), control_id)
    rows = [(row.event.type if row.event else row.kind.name, row.line) for row in channel.toolpath.rows()]
    assert rows[1:5] == [("FEED", 3), ("s", 4), ("FEED", 4), ("FEED", 5)]


@pytest.mark.parametrize("control_id", CONTROLS)
@pytest.mark.parametrize("speed", ["S-5", "S0", "S1.5", "S1500.", "S1E3", "S=5", "S1=5"])
def test_speeds_that_a_control_may_refuse_give_the_same(control_id: str, speed: str) -> None:
    assert differences(program(control_id, "X1.", f"X2. {speed}", "X3.", "S9", "X4."), control_id) == []


@pytest.mark.parametrize("before", ["G96 S120 M3", "G96 S120 M3\nG50 S2000", "G99 F0.2", "G99 F0.2\nG96 S90"])
def test_speeds_under_constant_surface_speed_give_the_same(before: str) -> None:
    text = program("fanuc-0i-tf", "X9.", before, "X8.", "X7. S150", "S200 X6. F0.3", "G97 S900", "X5. S100")
    assert differences(text, "fanuc-0i-tf") == []


def test_a_limit_of_the_speed_gives_the_same() -> None:
    text = program("fanuc-m", "X9.", "G96 S120", "G92 S500", "X8. S150", "X7.", "G97", "X6. S10", "X5.")
    assert differences(text, "fanuc-m") == []
    text = program("sinumerik-840d", "X9", "LIMS=500", "X8 S150", "X7", "G95 F0.2", "X6 S10", "X5")
    assert differences(text, "sinumerik-840d") == []


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m"])
def test_a_machine_that_refuses_speeds_refuses_them_in_runs_of_plain_blocks(control_id: str) -> None:
    text, setup = (
        program(control_id, "X9.", "X8.", "X7. S500", "X6.").replace("M3\n", ""),
        {"machine": "hartford", "switches": {"TOOL_UNCLAMPED": 1}},
    )
    (alarm,) = run(text, control_id, setup).alarms
    assert alarm.line == 4
    assert differences(text, control_id, setup) == []


def test_a_spindle_in_step_with_another_tells_its_speed_too() -> None:
    text = program(
        "syntec-mill", "X9.", "G51.2 P1 Q2 R0", "X8. S150", "X7. S150", "X6. S200", "G50.2", "X5. S10"
    )
    assert differences(text, "syntec-mill") == []


#: Codes that are in force from the second block on.
IN_FORCE = {
    "fanuc-m": "G17 G54 G90 G94 G64 G40 G21 G69 G50 G80 G97 G98 G49 G67",
    "meldas-m": "G17 G54 G90 G94 G64 G40 G21 G69 G50 G80 G97 G98 G49 G67",
    "syntec-mill": "G17 G54 G90 G94 G64 G71 G69 G50 G97 G98 G49 G67 G96",
    "sinumerik-840d": "G17 G54 G90 G94 G64 G40 G71 G450 G601 G641 G602 G340",
    "fanuc-0i-tf": "G18 G54 G64 G21 G69.1 G80 G97 G98 G49 G67 G96",
}


@pytest.mark.parametrize(
    ("control_id", "code"), [(control, code) for control, codes in IN_FORCE.items() for code in codes.split()]
)
def test_codes_that_are_in_force_are_scanned(control_id: str, code: str) -> None:
    setup = {"work_offsets": {"G54": {"X": 0.1, "Z": 0.7}}}
    code = code.replace("G69.1", "")
    blocks = ("G54 G64", "X0.3", f"{code} X1.7", f"{code} G1 X2.6 F500.", code, f"G0 {code} X3.", "X4.")
    text = program(control_id, *blocks)
    assert differences(text, control_id, setup) == []
    assert scanned(text, control_id, setup) >= len(blocks) - 1


@pytest.mark.parametrize("code", ["G96", "G961", "G97"])
def test_constant_cutting_speed_in_force_is_scanned_on_a_lathe(code: str) -> None:
    setup = {"machine": "lathe2"}
    blocks = (
        "X30",
        f"{code} S90 F0.2",
        "X20",
        f"{code} X19",
        f"{code} S120 X18",
        "S100",
        code,
        f"G0 {code} X9",
    )
    text = program("sinumerik-840d", *blocks)
    assert differences(text, "sinumerik-840d", setup) == []
    assert scanned(text, "sinumerik-840d", setup) >= len(blocks) - 1
    kept = text.replace("M3", "G96 S150 M3").replace("M30", "G97\nG97 X7\nM30")
    assert differences(kept, "sinumerik-840d", setup) == []


def test_a_modal_call_that_ends_gives_the_same() -> None:
    stretch = ("G67 X1.", "X2.", "G67", "X3.")
    text = program("fanuc-m", *stretch, "G66 P8 A1.", "X4.", "X5.", *stretch)
    for parameters in ({}, {6000: 0}):
        setup = {"parameters": parameters}
        assert differences(text, "fanuc-m", setup, files={"O0008": "O0008\nG91 Y#1\nG90\nM99\n"}) == []


@pytest.mark.parametrize("control_id", CONTROLS)
def test_a_mode_of_the_path_is_scanned(control_id: str) -> None:
    codes = ("G64", "G60", "G64", "G60") if control_id == "sinumerik-840d" else ("G64", "G61", "G63", "G64")
    blocks = [f"{code} X{i}." if i % 2 else f"{code}\nX{i}." for i, code in enumerate(codes * 2, 1)]
    text = program(control_id, *blocks)
    assert differences(text, control_id) == []
    assert scanned(text, control_id) >= 12


@pytest.mark.parametrize(
    "between",
    [
        "G54 P3", "G10 L2 P1 X5. Y5.", "#5221=7.5", "G52 X5.", "G92 X0", "G68 X0 Y0 R30.", "G51 X0 Y0 P2.", "G18", "G55", "G20", "G95 F0.2",
        "G61", "G43 H1", "G41 D1 X3.", "G22 X5. I3.",
    ],
)  # fmt: skip
@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill"])
def test_what_changes_in_front_of_a_code_in_force_counts_both_ways(control_id: str, between: str) -> None:
    setup = {
        "work_offsets": {"G54": {"X": 0.1, "Y": 0.7}, "G55": {"X": 3.3}},
        "tools": {1: {"length": 3.3, "radius": 1}},
    }
    stretch = (
        "G54 X1.1",
        "G17 X2.2",
        "G94 X3.3 F100.",
        "G64 X4.4",
        "G40 X5.5",
        "G21 X6.6",
        "G69 X7.7",
        "G49 X8.8",
        "G91 G49 Z0.1",
        "G90 G54 G17 Y3.",
    )
    text = program(control_id, *stretch, between, *stretch, between, *stretch)
    assert differences(text, control_id, setup) == []


@pytest.mark.parametrize(
    "between",
    [
        "TRANS X3", "$P_UIFR[1]=CTRANS(X,5)", "G55", "ROT RPL=30", "G18", "G95 F0.2", "G60", "G41 X3", "G70", "$TC_DP3[1,1]=7", "T1 D1",
        "$P_BFRAME=CTRANS(Y,2)",
    ],
)  # fmt: skip
def test_what_changes_in_front_of_a_function_in_force_counts_both_ways(between: str) -> None:
    setup = {
        "work_offsets": {"G54": {"X": 0.1, "Y": 0.7}, "G55": {"X": 3.3}},
        "tools": {1: {"length": 3.3, "radius": 1}},
    }
    stretch = ("G54 X1.1", "G17 X2.2", "G94 X3.3 F100", "G64 X4.4", "G40 X5.5", "G71 X6.6", "G90 G54 G17 Y3")
    text = program("sinumerik-840d", *stretch, between, *stretch, between, *stretch)
    assert differences(text, "sinumerik-840d", setup) == []
