"""CYCLE800: wherever the rotary axes stand, a point of the swivelled plane is where its frame says on the work."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.geometry.frames import Frame, rotation
from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.session import Result
from tests.control.sinumerik.support import codes, run

LENGTH = 80.0
MACHINES = ("mill5-ac-table", "mill5-bc-head", "mill5-ca-head", "mill5-ab-head")
ANGLES = st.floats(-85.0, 85.0).map(lambda a: round(a, 3))
START = ("G17 G90 T1 D1 M6",)
TOOLS = {1: {"radius": 5.0, "length": LENGTH}}


def tip_on_work(machine: str, result: Result) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Tip and direction of the tool as the work sees them, from the machine's axes alone."""
    kinematics = Kinematics.of(load_machine(machine))
    axes = [row["machine"] for row in result.rows if "machine" in row][-1]
    head, work = kinematics.head_turn(axes), kinematics.work_turn(axes)
    tip = Frame(head.m, (axes["X"], axes["Y"], axes["Z"])).apply(0.0, 0.0, -LENGTH)
    return work.inverse().apply(*tip), kinematics.tool_on_work(axes)


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(MACHINES), ANGLES, ANGLES, st.sampled_from([-1, 1]))
def test_a_point_lies_on_the_work_where_the_frame_says(
    machine: str, a: float, b: float, direction: int
) -> None:
    swivel = f'CYCLE800(0,"",200000,57,1,2,3,{a},{b},15,4,5,6,{direction})'
    result = run(*START, swivel, "G0 X10 Y-20 Z30", machine=machine, tools=TOOLS)
    assert codes(result) == []
    turned = rotation(0, a) @ rotation(1, b) @ rotation(2, 15.0)
    expected = tuple(p + q for p, q in zip((1.0, 2.0, 3.0), turned.apply(14.0, -15.0, 36.0), strict=True))
    tip, along = tip_on_work(machine, result)
    assert tip == pytest.approx(expected, abs=1e-6)
    assert along == pytest.approx(turned.apply(0.0, 0.0, 1.0), abs=1e-6)


@pytest.mark.parametrize("machine", MACHINES)
def test_the_two_directions_are_two_solutions_of_one_plane(machine: str) -> None:
    ends = []
    for direction in (-1, 1):
        result = run(
            *START,
            f'CYCLE800(0,"",200000,57,0,0,0,25,10,0,0,0,0,{direction})',
            "G0 X1",
            machine=machine,
            tools=TOOLS,
        )
        ends.append([row["machine"] for row in result.rows if "machine" in row][-1])
    assert ends[0] != ends[1]


def test_the_rotary_axes_move_together_before_the_next_row() -> None:
    swivel = 'CYCLE800(0,"",200000,57,0,0,0,30,0,0,0,0,0,1)'
    result = run(*START, "G0 Z100", swivel, "G0 X10", machine="mill5-bc-head", tools=TOOLS)
    rows = [row for row in result.rows if "to" in row]
    assert [row["type"] for row in rows] == ["rapid", "rapid", "rapid"]
    assert {name for name in "XYZBC" if rows[0]["machine"][name] != rows[1]["machine"][name]} == {"B", "C"}


def test_computing_only_moves_no_axis() -> None:
    swivel = 'CYCLE800(0,"",200000,57,0,0,0,30,0,0,0,0,0,0)'
    result = run(*START, swivel, machine="mill5-bc-head", tools=TOOLS)
    assert [row for row in result.rows if "to" in row] == []


def test_an_angle_that_the_axes_do_not_reach_is_an_alarm() -> None:
    swivel = 'CYCLE800(0,"",200000,57,0,0,0,30,0,0,0,0,0,2)'
    assert codes(run(*START, swivel, machine="mill5-bc-head", tools=TOOLS)) == [("61189", 2)]


def test_retraction_goes_along_the_tool_by_the_way_that_is_told() -> None:
    lines = (
        'CYCLE800(0,"",200000,57,0,0,0,0,90,0,0,0,0,1)',
        'CYCLE800(5,"",200000,57,0,0,0,0,0,0,0,0,0,1,50)',
    )
    result = run(*START, "G0 Z10", *lines, machine="mill5-bc-head", tools=TOOLS)
    machine = [row["machine"] for row in result.rows if "machine" in row]
    assert machine[2]["X"] - machine[1]["X"] == pytest.approx(50.0)


def test_deselection_gives_lengths_and_frames_back() -> None:
    lines = ('CYCLE800(0,"",200000,57,10,0,0,0,90,0,0,0,0,1)', "CYCLE800()", "G0 X1 Y2 Z3")
    result = run(*START, *lines, machine="mill5-bc-head", tools=TOOLS)
    machine = [row["machine"] for row in result.rows if "machine" in row][-1]
    assert (machine["X"], machine["Y"], machine["Z"]) == pytest.approx((1.0, 2.0, 3.0 + LENGTH))
