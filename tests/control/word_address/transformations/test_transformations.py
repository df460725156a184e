"""Modes that make axes of others: polar and cylindrical interpolation, hypothetical axes, normal lines."""

from __future__ import annotations

from math import cos, tau

import pytest

import polycnc
from tests.support import codes, ends, moves, run


def test_a_tool_on_the_negative_side_of_the_centre_does_not_turn_the_rotary_axis_when_the_mode_begins() -> (
    None
):
    channel = run("G1 X-30. C10. F100\nG12.1\nX-20.\nG13.1\nM30\n", machine="mill4-xyzc")
    assert channel.coordinates.position == pytest.approx([-20.0, 0.0, 0.0, 10.0])


@pytest.mark.parametrize(
    ("mode", "machine", "control"),
    [
        ("G12.1\nX20. C5.", "mill4-xyzc", "fanuc-m"),
        ("G7.1 A30.\nX20. A45.", "mill4", "fanuc-m"),
        ("G7 Y0\nX20. Y30.", "mill3", "meldas-m"),
        ("G41.1\nX20. Y30.", "mill4-c-head", "fanuc-m"),
    ],
)
def test_a_reset_ends_the_mode_where_the_axes_stand(mode: str, machine: str, control: str) -> None:
    channel = run(f"G1 X10. F100\n{mode}\nM30\n", control, machine=machine)
    before = channel.toolpath.to_machine(
        tuple(moves(channel)[-1].end), channel.control.context(channel), channel.coordinates.geometry
    )
    channel.control.reset(channel)
    assert channel.coordinates.machine == pytest.approx(before)
    assert not channel.path.stages
    assert channel.coordinates.transformation is None


def test_many_plain_blocks_on_a_cylinder_are_those_of_single_ones() -> None:
    text = "G1 X0 A0 F100\nG7.1 A30.\n" + "".join(f"X{i}.\nA{i}.\n" for i in range(1, 200)) + "G7.1 A0\nM30\n"
    channel = run(text, machine="mill4")
    assert ends(channel)[-1] == pytest.approx((199.0, 0.0, 0.0, 199.0 * 30.0 * tau / 360.0))
    assert channel.coordinates.machine == pytest.approx([199.0, 0.0, 0.0, 199.0])


@pytest.mark.parametrize("code", ["G0 X1.", "G28 X0", "G54", "G81 Z-1. R0", "G43 H1", "G17"])
def test_what_polar_interpolation_does_not_allow_is_an_alarm(code: str) -> None:
    assert codes(run(f"G1 X10. F100\nG12.1\n{code}\nM30\n", machine="mill4-xyzc")) == ["PS0146"]


def test_two_axes_can_be_hypothetical_and_come_back_one_by_one() -> None:
    text = "G1 F100\nG7 X0\nG7 Y0\nX5. Y5. Z5.\nG7 X1\nX6. Y6. Z6.\nG7 Y1\nX7. Y7. Z7.\nM30\n"
    assert ends(run(text, "meldas-m")) == [(0, 0, 5), (6, 0, 6), (7, 7, 7)]


def test_a_sine_curve_stays_on_its_helix() -> None:
    text = "G1 X10. F100\nG7 Y0\nG3 X10. I-10. Z-20.\nG7 Y1\nM30\n"
    rows = ends(run(text, "meldas-m"))[1:]
    assert len(rows) > 50
    assert all(abs(x - 10.0 * cos(tau * z / -20.0)) < 0.002 and y == 0.0 for x, y, z in rows)


def test_the_turn_of_a_normal_line_has_the_feed_of_its_parameter_and_small_turns_are_left_out() -> None:
    setup = {"parameters": {"5481": 360.0, "5482": 10.0}}
    text = "G41.1 G1 X10. F100\nX20. Y1.\nY11.\nM30\n"
    rows = moves(run(text, setup=setup, machine="mill4-c-head"))
    turns = [row for row in rows if row.feed == pytest.approx(6.0)]
    assert [row.line for row in turns] == [1, 3]
    assert [round(row.end[3], 3) for row in rows] == [90.0, 90.0, 90.0, 180.0, 180.0]


@pytest.mark.parametrize("tilt", ["G68.2 X5. I0 J30. K0", "G68.2 X5. I0 J30. K0\nG53.1\nG43 H1 Z5."])
def test_a_reset_ends_a_tilted_plane_where_the_axes_stand(tilt: str) -> None:
    text = f"{tilt}\nG0 X10. Y5.\nM30\n"
    channel = run(text, machine="mill5-ac-table", setup={"tools": {1: {"length": 20}}})
    before = channel.coordinates.machine
    channel.control.reset(channel)
    assert channel.coordinates.machine == pytest.approx(before)
    assert channel.coordinates.zero.is_identity
    assert channel.mode["rotation"] == "G69"


def test_an_alarm_on_a_cylinder_leaves_the_axes_where_the_last_block_has_led_them() -> None:
    text = "G1 X0 A0 F100\nG7.1 A10.\nX10. A30.\nG2 X20. Y5. R1.\nM30\n"
    channel = run(text, machine="mill4")
    assert codes(channel) == ["PS0023"]
    assert channel.coordinates.machine == pytest.approx([10.0, 0.0, 0.0, 30.0])
    channel.control.reset(channel)
    assert channel.coordinates.machine == pytest.approx([10.0, 0.0, 0.0, 30.0])


def test_lines_and_arcs_on_a_cylinder_have_the_length_of_its_surface() -> None:
    text = (
        "G0 X100. Z10. C0\nG98 G1 Z0 F100\nG7.1 C50.\nC90.\nG2 Z-10. C101.459 R10.\nG1 Z-20.\nG7.1 C0\nM30\n"
    )
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c")
    assert not result.alarms
    lengths = 10.0 + 50.0 * tau / 4.0 + 10.0 * tau / 4.0 + 10.0
    assert result.plan.times.cutting_mm == pytest.approx(lengths, abs=0.05)
