"""Words and codes of plain blocks that tell more than a way: S."""

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
    assert scanned(text, control_id) == len(BLOCKS)


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
        {"switches": {"TOOL_UNCLAMPED": 1}},
    )
    (alarm,) = run(text, control_id, setup).alarms
    assert alarm.line == 4
    assert differences(text, control_id, setup) == []


def test_a_spindle_in_step_with_another_tells_its_speed_too() -> None:
    text = program(
        "syntec-mill", "X9.", "G51.2 P1 Q2 R0", "X8. S150", "X7. S150", "X6. S200", "G50.2", "X5. S10"
    )
    assert differences(text, "syntec-mill") == []
