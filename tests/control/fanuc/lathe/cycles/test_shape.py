"""Reading shapes ahead leaves nothing behind."""

from __future__ import annotations

from tests.control.fanuc.lathe.support import alarms, moves, run

PROGRAM = """G98 G0 X50. Z2. S100 M3
G71 U20. R1.
G71 P10 Q20 U0 W0 F30 S200
N10 G0 X20. S300 M4
G99 G1 Z-10. F0.1 T0202
N20 X50. M8
#101=#4005
#102=#4119
#103=#4109
#104=#4120
#105=#4001
M30"""


def test_feed_speed_tool_and_modal_codes_are_those_from_before_the_shape() -> None:
    result = run(PROGRAM)
    assert alarms(result) == []
    assert [result.variables[f"#{n}"] for n in range(101, 106)] == [98.0, 200.0, 30.0, 0.0, 0.0]


def test_events_of_the_shape_are_not_sent_while_roughing() -> None:
    sent = [row["code"] for row in run(PROGRAM).rows if row["type"] == "m"]
    assert sent == [3, 30]


def test_the_blocks_of_the_shape_are_not_run_again_behind_the_cycle() -> None:
    assert moves(run(PROGRAM))[-1] == ("rapid", 50.0, 2.0)


def test_finishing_runs_the_blocks_with_their_own_lines() -> None:
    result = run(PROGRAM.replace("#101=#4005", "G70 P10 Q20"))
    assert [row["line"] for row in result.rows if "to" in row][-4:] == [4, 5, 6, 7]


def test_a_loop_in_a_shape_is_followed() -> None:
    program = """#1=0
G0 X50. Z2.
G71 U20. R1.
G71 P10 Q20 U0 W0 F.1
N10 G0 X20.
WHILE[#1 LT 3]DO1
G1 U4. W-5.
#1=#1+1
END1
N20 G1 X50.
M30"""
    assert moves(run(program))[-5:] == [
        ("feed", 24.0, -3.0),
        ("feed", 28.0, -8.0),
        ("feed", 32.0, -13.0),
        ("feed", 50.0, -13.0),
        ("rapid", 50.0, 2.0),
    ]


def test_an_endless_shape_is_an_alarm() -> None:
    program = "G0 X50. Z2.\nG71 U2. R1.\nG71 P10 Q20 U0 W0 F.1\nN10 G0 X20.\nGOTO 10\nN20 G1 Z-5.\nM30"
    assert alarms(run(program)) == ["PS0063"]


def test_finishing_under_compensation_starts_up_and_cancels_at_the_start_point() -> None:
    program = """T0101
G0 X60. Z5.
G42
G70 P1 Q2
N1 G0 X20.
G1 Z-10. F.1
N2 X62.
G40 G0 X80.
M30"""
    found = moves(run(program, tools={1: {"radius": 0.8, "tip": 3}}))
    assert ("feed", 20.0, -10.0) in found
    assert ("rapid", 60.0, 5.0) in found[3:]
