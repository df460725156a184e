"""States at power-on and what one run leaves behind for the next: nothing."""

from __future__ import annotations

from math import cos, radians, sin
from pathlib import Path
from typing import Any

import pytest

from polycnc.memory.retained import WORK_TURNS, InMemoryStore
from polycnc.session import Result, open_session

#: A rotary axis B beside the table A, C.
BESIDE = Path(__file__).parents[2] / "conformance" / "machines" / "mill6-ac-table-b.toml"


def run(program: str, files: dict[str, str] | None = None, **setup: Any) -> Result:
    return open_session(program, control="syntec-mill", setup=setup, files=files or {}).run()


def test_a_run_starts_in_the_power_on_state_of_the_manual() -> None:
    result = run("%@MACRO\n#1 := #1000;\nM30;\n")
    mode = result.channel.mode
    assert [mode[group] for group in ("plane", "distance", "feed", "unit", "compensation", "length")] == [
        "G17", "G90", "G94", "G71", "G40", "G49",
    ]  # fmt: skip
    assert result.ok


def test_pr3836_starts_in_feed_per_revolution() -> None:
    result = run("G01 X1.\nM30\n", parameters={"3836": 1})
    assert result.rows[0]["feed"] == 1.0


def test_nothing_of_one_run_reaches_the_next() -> None:
    text = "%@MACRO\nG91 G55 G68 X0 Y0 R30.;\n@5 := @5 + 1;\n#401 := #401 + 1;\n#1 := RANDOM();\nM30;\n"
    first, second = run(text), run(text)
    for name in ("@5", "#401", "#1"):
        assert first.variables[name] == second.variables[name]
    assert first.variables["@5"] == 1


@pytest.mark.parametrize(("kept", "machine"), [(1, (5.0, 6.0, 7.0)), (2, (5.0, -6.0, 6.0))])
def test_pr3014_keeps_the_tilted_plane_over_power_off(kept: int, machine: tuple[float, ...]) -> None:
    # X' = X, Y' = Z, Z' = -Y: (5,6,7) of the plane is (5,-7,6) of the work from the origin (0,1,0).
    memory, setup = InMemoryStore(), {"parameters": {"3014": kept}}
    tilt, move = "G68.2 X0 Y1. Z0 I0 J90. K0\nM30\n", "G90 G00 X5. Y6. Z7.\nM30\n"
    results = [
        open_session(
            program, control="syntec-mill", machine="mill5-ac-table", setup=setup, memory=memory
        ).run()
        for program in (tilt, move)
    ]
    assert all(result.ok for result in results)
    assert [results[-1].rows[0]["machine"][axis] for axis in "XYZ"] == pytest.approx(machine)


def turned_work(program: str, machine: str, turn: list[float], **parameters: int) -> Result:
    """A run in a work system that G54.4 turns by the angles X, Y, Z of its page."""
    memory = InMemoryStore()
    memory.table(WORK_TURNS, 1)["G54"] = turn
    setup = {"parameters": parameters, "tools": {1: {"length": 50}}}
    return open_session(program, control="syntec-mill", machine=machine, setup=setup, memory=memory).run()


def test_vectors_count_in_a_turned_work_system_whatever_pr3057_says() -> None:
    text = "G54.4 P1\nG43.5 H1\nG00 X5. Y6. Z7. I0 J1. K0\nM30\n"
    result = turned_work(text, "mill5-bc-head", [90.0, 0.0, 0.0], **{"3057": 1})
    assert result.ok
    # X' = X, Y' = Z, Z' = -Y: the tool along Y' stands upright.
    assert result.rows[0]["machine"] == pytest.approx({"X": 5, "Y": -7, "Z": 6 + 50, "B": 0, "C": 0})


@pytest.mark.parametrize(
    ("words", "tool"),
    [
        # The work is turned by 30 degrees about Y: B30 of the machine stands the tool along its Z.
        ("B0 C0", (0.0, 0.0, 1.0)),
        ("B45. C0", (0.5**0.5, 0.0, 0.5**0.5)),
        ("B45. C90.", (0.0, 0.5**0.5, 0.5**0.5)),
        # An axis without a word keeps its program coordinate, and increments count from what words have told.
        ("B45.\nC90.", (0.0, 0.5**0.5, 0.5**0.5)),
        ("B45. C0\nG91 C90.", (0.0, 0.5**0.5, 0.5**0.5)),
    ],
)
@pytest.mark.parametrize(("frame", "parameter"), [(" Q1", 0), ("", 1)])
def test_rotary_words_tell_the_tool_in_a_turned_work_system(
    words: str, tool: tuple[float, float, float], frame: str, parameter: int
) -> None:
    text = f"G54.4 P1\nG43.4 H1{frame}\nG00 X5. Y6. Z7. {words}\nM30\n"
    result = turned_work(text, "mill5-bc-head", [0.0, 30.0, 0.0], **{"3057": parameter})
    assert result.ok, result.alarms
    machine = [row["machine"] for row in result.rows if "machine" in row][-1]
    b, c = radians(machine["B"]), radians(machine["C"])
    found = (sin(b) * cos(c), sin(b) * sin(c), cos(b))
    about_y = cos(radians(30.0)), sin(radians(30.0))

    def turned(x: float, y: float, z: float) -> tuple[float, float, float]:
        return (about_y[0] * x + about_y[1] * z, y, about_y[0] * z - about_y[1] * x)

    assert found == pytest.approx(turned(*tool), abs=1e-9)
    nose = [place + 50.0 * along for place, along in zip(turned(5.0, 6.0, 7.0), found, strict=True)]
    assert [machine[axis] for axis in "XYZ"] == pytest.approx(nose, abs=1e-6)


@pytest.mark.parametrize(
    ("blocks", "place"),
    [
        ("G52 X10.\nG00 X5. Y0", (15.0, 0.0)),
        ("G00 X5.\nG92 X0\nG00 X5. Y1.", (10.0, 1.0)),
        ("G92.1 X10. R90.\nG00 X5. Y0", (10.0, 5.0)),
        ("G92.1 X10. R90.\nG92.1 X2. R90.\nG00 X5. Y0", (10.0, 7.0)),
        ("G92.1 X10.\nG54.4 P0\nG54.4 P1\nG00 X5. Y1.", (15.0, 1.0)),
    ],
)
def test_systems_within_a_turned_work_system_turn_with_it(blocks: str, place: tuple[float, float]) -> None:
    result = turned_work(f"G90 G54.4 P1\n{blocks}\nM30\n", "mill3", [0.0, 0.0, 30.0])
    assert result.ok, result.alarms
    c, s, (x, y) = cos(radians(30.0)), sin(radians(30.0)), place
    machine = [row["machine"] for row in result.rows if "machine" in row][-1]
    assert (machine["X"], machine["Y"]) == pytest.approx((c * x - s * y, s * x + c * y), abs=1e-6)


def test_nothing_moves_before_words_have_told_the_tool_in_a_turned_work_system() -> None:
    text = "G54.4 P1\nG43.4 H1 Q1\nG00 X5.\nM30\n"
    result = turned_work(text, "mill5-bc-head", [0.0, 30.0, 0.0])
    assert [alarm.code for alarm in result.alarms] == ["PC0001"]


def test_a_tool_that_stands_in_a_system_turned_about_it_may_move_before_words_tell_it() -> None:
    text = "G54.4 P1\nG43.4 H1 Q1\nG00 X5. Y1. Z2.\nG00 C90.\nM30\n"
    result = turned_work(text, "mill5-bc-head", [0.0, 0.0, 30.0])
    assert result.ok, result.alarms
    machine = next(row["machine"] for row in result.rows if "machine" in row)
    c, s = cos(radians(30.0)), sin(radians(30.0))
    assert [machine[axis] for axis in "XYZBC"] == pytest.approx([5 * c - s, 5 * s + c, 52.0, 0.0, 0.0])


def test_directions_of_the_machine_count_again_behind_q0() -> None:
    text = "G54.4 P1\nG43.4 H1 Q1\nG00 X0 Y0 Z0 B0 C0\nG43.4 H1 Q0\nG00 B0 C0\nM30\n"
    result = turned_work(text, "mill5-bc-head", [0.0, 30.0, 0.0])
    places = [row["machine"]["B"] for row in result.rows if "machine" in row]
    assert places == pytest.approx([30.0, 0.0])


def test_a_rotary_axis_that_stands_no_tool_tells_no_direction() -> None:
    # The work is turned by 30 degrees about X: A-30 stands the tool along its Z.
    text = "G54.4 P1\nG43.4 H1 Q1\nG00 X0 Y0 Z0 A0 C0\nG91 G93 G01 B10. F2.\nM30\n"
    result = turned_work(text, str(BESIDE), [30.0, 0.0, 0.0])
    assert result.ok, result.alarms
    row = [row for row in result.rows if "machine" in row][-1]
    assert (row["machine"]["A"], row["machine"]["B"]) == pytest.approx((-30.0, 10.0), abs=1e-9)
    assert row["feed"] == pytest.approx(20.0)


def test_a_channel_runs_its_own_section_of_a_file() -> None:
    result = run("$1\nG00 X1.\nM30\n$2\nG00 X2.\nM30\n")
    assert [row["to"]["X"] for row in result.rows if row["type"] == "rapid"] == [1.0]
    assert result.rows[0]["line"] == 2


def test_variables_of_the_setup_are_there_at_the_start() -> None:
    result = run("%@MACRO\n#2 := #101 + @3 + @106000;\nM30;\n", variables={"#101": 1.5, "@3": 2, "R6000": 3})
    assert result.variables["#2"] == 6.5


def test_variables_that_do_not_exist_are_no_key() -> None:
    result = run("M30\n")
    for name in ("#7777", "@3000", "Q5", "#A"):
        with pytest.raises(KeyError):
            result.variables[name]


def test_names_of_variables_that_hold_something_are_listed() -> None:
    result = run("%@MACRO\n#1 := 1;\n@2 := 2;\n@106000 := 3;\n#2001 := 4;\n#450 := 5;\nM30;\n")
    assert list(result.variables) == ["#1", "#450", "#2001", "@2", "R6000"]


def test_an_alarm_names_line_and_column_of_the_mistake() -> None:
    result = run("%@MACRO\nG00 X1.;\n#1 := 3 + ;\nM30;\n")
    alarm = result.alarms[0]
    assert (alarm.code, alarm.line, alarm.column) == ("COM-003", 3, 11)
    assert "syntax" in result.alarm_text(alarm, "en").lower()


def test_an_alarm_inside_a_macro_names_the_macro_and_its_caller() -> None:
    result = run("%@MACRO\n\nG65 P10;\nM30;\n", {"O0010": "%@MACRO\n#1 := 1 MOD 0;\nM99;\n"})
    alarm = result.alarms[0]
    assert (alarm.code, alarm.program, alarm.line) == ("COR-004", "O0010", 2)
    assert [line for _, line in alarm.call_chain] == [3]


def test_user_alarms_carry_the_text_of_the_macro() -> None:
    result = run('%@MACRO\nALARM(7, "NO TOOL");\n')
    assert result.alarm_text(result.alarms[0]) == "NO TOOL"
    assert result.alarms[0].code == "MAR-007"


def test_an_endless_loop_ends_at_the_block_limit() -> None:
    session = open_session("%@MACRO\nWHILE 1 DO\nEND_WHILE;\n", control="syntec-mill", block_limit=5000)
    assert session.run().alarms[0].code == "PC0002"


def test_macro_statements_leave_no_rows() -> None:
    result = run("%@MACRO\nFOR #1 := 1 TO 5 DO #2 := #1; END_FOR;\nM30;\n")
    assert [row["type"] for row in result.rows] == ["m"]
