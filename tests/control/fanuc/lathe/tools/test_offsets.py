"""T words and offsets of the lathe."""

from __future__ import annotations

import pytest

from tests.control.fanuc.lathe.support import alarms, moves, run


@pytest.mark.parametrize(
    ("word", "digits", "tool", "shift"),
    [
        ("T0101", 0, 1, 1.0),
        ("T101", 2, 1, 1.0),
        ("T01001", 3, 1, 1.0),
        ("T11", 1, 1, 1.0),
        ("T0102", 0, 1, 2.0),
    ],
)
def test_the_last_digits_of_t_are_the_offset(word: str, digits: int, tool: int, shift: float) -> None:
    tools = {1: {"z": 1.0}, 2: {"z": 2.0}}
    result = run(f"G0 {word}\nZ0\nM30", tools=tools, parameters={"5028": digits})
    assert result.final["machine"]["Z"] == shift
    assert [row["tool"] for row in result.rows if row["type"] == "t"] == [tool]


@pytest.mark.parametrize(("lwt", "lgt"), [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_the_machine_stands_in_the_same_place_however_an_offset_acts(lwt: int, lgt: int) -> None:
    tools = {1: {"x": -4.0, "z": 10.0, "wear": {"x": 0.2, "z": 0.5}}}
    result = run("T0101\nG0 X50. Z0\nM30", tools=tools, parameters={"5002#2": lwt, "5002#4": lgt})
    machine = result.final["machine"]
    assert (machine["X"], machine["Z"]) == pytest.approx((46.2, 10.5))
    moved_x = (0.0 if lwt else 0.2) + (-4.0 if lgt else 0.0)
    assert result.final["work"]["X"] == pytest.approx(50.0 + moved_x)


def test_an_increment_counts_from_the_programmed_point() -> None:
    result = run("G0 T0101 X50. Z0\nU-10.\nM30", tools={1: {"wear": {"x": 0.2}}})
    assert moves(result) == [("rapid", 50.2, 0.0), ("rapid", 40.2, 0.0)]


def test_arcs_move_with_the_offset() -> None:
    result = run("G0 T0101 X20. Z0\nG3 X40. Z-10. R10. F0.1\nM30", tools={1: {"wear": {"x": 2.0, "z": 1.0}}})
    arc = next(row for row in result.rows if row["type"] == "ccw")
    assert arc["center"] == {"X": 22.0, "Z": -9.0}


def test_too_large_an_offset_number_is_an_alarm() -> None:
    assert alarms(run("T12345\nM30", parameters={"3032": 4})) == ["PS0003"]


def test_a_tool_word_has_no_point() -> None:
    assert alarms(run("T1.5\nM30")) == ["PS0007"]


@pytest.mark.parametrize(("lwm", "after"), [(0, 1.0), (1, 3.0)])
def test_a_changed_wear_acts_at_the_next_t_or_at_the_next_move(lwm: int, after: float) -> None:
    program = "G0 T0101\nZ0\nG10 P1 Z3.\nZ0\nM30"
    setup = {"tools": {1: {"z": 1.0}}, "parameters": {"8136#6": 1, "5002#6": lwm}}
    assert run(program, **setup).final["machine"]["Z"] == after
