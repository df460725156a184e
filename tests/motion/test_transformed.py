"""Under a transformation the real axes keep their velocity and acceleration."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import polycnc
from polycnc.machine import Machine, load_machine
from polycnc.mainrun import State
from polycnc.motion import Settings
from polycnc.motion.frames import real_of
from polycnc.motion.kernels.columns import Form, PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.sampling.run import Run
from polycnc.motion.transformed import RealAxes
from polycnc.toolpath import Context, Kind, Toolpath
from tests.examples import examples
from tests.mainrun.support import power_on

POLAR = """O1
G98 G0 X60. Z5. C0
G12.1
G1 X2. F3000
C15.
X-2.
C-15.
X2. C1.
X20. C0
G3 X0 C20. R20.
G13.1
M30
"""
MACHINE = load_machine("lathe-c-transmit")
SLACK = 1.0 + 1e-6


def test_the_real_axes_keep_their_velocity_near_the_centre() -> None:
    virtual = power_on(POLAR, "fanuc-0i-tf", machine="lathe-c-transmit")
    virtual.cycle_start()
    cycle, before, fastest = 0.004, virtual.machine_position, [0.0, 0.0, 0.0]
    while virtual.state is State.RUNNING:
        virtual.step()
        now = virtual.machine_position
        ways = [abs((b - a + 180.0) % 360.0 - 180.0) for a, b in zip(before, now, strict=True)]
        fastest = [max(f, way / cycle) for f, way in zip(fastest, ways, strict=True)]
        before = now
    assert virtual.state is State.READY
    for name, speed in zip(virtual.channel.axes, fastest, strict=True):
        axis = MACHINE.axis[name]
        assert speed <= max(axis.rapid, axis.max_feed) * 1.02, name


@pytest.mark.parametrize(("x", "y"), [(-28.841, 0.848), (-11.137, -24.856), (-29.0, 2.0)])
def test_the_rotary_axis_keeps_its_velocity_where_a_line_is_nearest_to_the_centre(x: float, y: float) -> None:
    text = f"G21 G90 G61\nG1 X30. C0 F12000\nG12.1\nG1 X{x} C{y}\nM30\n"
    result, machine = polycnc.run(text, control="fanuc-m", machine="mill4-xyzc"), load_machine("mill4-xyzc")
    assert not result.alarms
    for run, context in runs_of(result, machine):
        _, velocity, _ = real_motion(run, context, np.arange(0.0, run.seconds, 0.001), machine)
        assert np.abs(velocity[:, 3]).max() <= machine.axis["C"].rapid * 1.0001


def test_a_plan_is_slow_where_the_rotary_axis_has_to_be_fast() -> None:
    result = polycnc.run(POLAR, control="fanuc-0i-tf", machine="lathe-c-transmit")
    near = next(i for i, row in enumerate(result.rows) if row.get("line") == 5)
    c = MACHINE.axis["C"]
    # 15 mm past the centre at 1 mm: C turns at v/r, r = 1 mm at the start.
    assert result.plan.row_s[near] > 15.0 / (c.max_feed * 3.1416 / 180.0)


def test_rows_without_a_transformation_have_no_bounds() -> None:
    toolpath = Toolpath(("X", "Z", "C"))
    number = toolpath.context_number(Context())
    toolpath.append(Kind.FEED, 0, 1, number, 10.0, [10.0, 0.0, 90.0])
    real = RealAxes(MACHINE, 1, ("X", "Z", "C"), Settings(), (0.0, 0.0, 0.0))
    bounds = real.bounds(toolpath.chunk, toolpath.contexts)
    assert bounds.enters == {}
    assert all(len(column) == 0 for column in bounds.shares)


@pytest.mark.parametrize("radius", [5.0, 20.0])
def test_a_circle_around_the_centre_turns_the_rotary_axis_evenly(radius: float) -> None:
    """C turns by 180/(pi·r) degrees a millimetre: the cap is its velocity over that, X stands."""
    there, back = f"X{2 * radius} C0", f"X0 C{radius}"
    text = f"O1\nG98 G0 {there} Z5.\nG12.1\nG3 {back} R{radius} F30000\nG13.1\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    arc = next(i for i, row in enumerate(result.rows) if row["type"] == "ccw")
    seconds = 90.0 / MACHINE.axis["C"].max_feed
    assert result.plan.row_s[arc] >= seconds * 0.98


def test_the_path_goes_on_from_where_the_real_axes_are() -> None:
    """A quarter circle and a line in the plane, then a rapid of the real axes from X20 C180."""
    text = "O1\nG98 G0 X40. C0\nG12.1\nG3 X0 C20. R20. F300\nG1 X-20. C0\nG13.1\nG0 C90.\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    assert result.plan.times.cutting_mm == pytest.approx(20.0 * pi / 2.0 + hypot(20.0, 20.0), rel=1e-6)
    assert result.plan.times.rapid_mm == pytest.approx(20.0 + 90.0, rel=1e-6)


def test_a_line_past_the_centre_is_slow_only_next_to_it() -> None:
    text = "O1\nG98 G0 X60. C0\nG12.1\nG1 X30. C0.1 F3000\nX-30.\nG13.1\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    past = next(i for i, row in enumerate(result.rows) if row.get("line") == 5)
    # Half a turn of C alone takes 0.3 s. At the speed next to the centre the whole line would take a minute.
    assert 0.3 < result.plan.row_s[past] < 10.0


POINT = st.one_of(
    st.tuples(st.floats(-40.0, 40.0), st.floats(-40.0, 40.0)),
    st.tuples(st.floats(-40.0, 40.0), st.just(0.0)),
    st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)),
    st.just((0.0, 0.0)),
).map(lambda p: (round(p[0], 3), round(p[1], 3)))


def polar_program(points: list[tuple[float, float]], arcs: list[bool], feed: int) -> str:
    """Lines and arcs between points of the plane, the centre among them."""
    lines, (x, y) = ["O1", "G98 G0 X60. Z5. C0", "G12.1"], (60.0, 0.0)
    for (a, b), is_arc in zip(points, arcs, strict=False):
        if (a, b) != (x, y):
            code = f"G3 R{round(hypot(a - x, b - y), 3)}" if is_arc else "G1"
            lines.append(f"{code} X{a} C{b} F{feed}")
            x, y = a, b
    return "\n".join([*lines, "G13.1", "M30", ""])


@settings(max_examples=examples(25), deadline=None)
@example([(-5.75, 0.0)], [False] * 6, 3000)
@example([(-4.0, 0.0)], [False] * 6, 3000)
@given(
    st.lists(POINT, min_size=1, max_size=6),
    st.lists(st.booleans(), min_size=6, max_size=6),
    st.sampled_from([100, 3000, 30000]),
)
def test_real_axes_keep_velocity_acceleration_and_jerk_under_polar_interpolation(
    points: list[tuple[float, float]], arcs: list[bool], feed: int
) -> None:
    result = polycnc.run(polar_program(points, arcs, feed), control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    keeps_limits(result, MACHINE)


TIP = st.tuples(
    st.integers(-50, 50),
    st.integers(-50, 50),
    st.integers(-20, 20),
    st.integers(-60, 60),
    st.integers(-90, 90),
)


@settings(max_examples=examples(12), deadline=None)
@given(
    st.sampled_from([("mill5-bc-head", "B", "C"), ("mill5-ac-table", "A", "C")]),
    st.lists(TIP, min_size=1, max_size=5),
    st.sampled_from([100, 3000, 20000]),
)
def test_real_axes_keep_velocity_acceleration_and_jerk_under_tool_centre_point_control(
    machine: tuple[str, str, str], points: list[tuple[int, ...]], feed: int
) -> None:
    name, tilt, turn = machine
    lines = [f"X{x}. Y{y}. Z{z}. {tilt}{a}. {turn}{b}." for x, y, z, a, b in points]
    text = "\n".join([f"G43.4 H1\nG1 F{feed}", *lines, "G49", "M30", ""])
    result = polycnc.run(text, control="fanuc-m", machine=name, setup={"tools": {1: {"length": 100}}})
    assert not result.alarms
    keeps_limits(result, load_machine(name))


@pytest.mark.parametrize("acceleration", ["BRISK", "SOFT"])
@pytest.mark.parametrize("machine", ["mill5-ca-head", "mill5-bc-head", "mill5-ac-table"])
@pytest.mark.parametrize(("miss", "limit"), [(0.0, 2.0), (0.0005, 0.0), (0.036, 2.0), (0.1, 0.0)])
def test_real_axes_keep_their_limits_where_the_tool_turns_past_its_pole(
    machine: str, acceleration: str, miss: float, limit: float
) -> None:
    """On great circles that pass the pole by `miss`, within the cone of `limit` degrees, beyond it, and without one."""
    text = (
        f"{acceleration}\nT1 D1 F20000\nTRAORI\nG1 X0 Y0 Z0 A3=-1 B3=0 C3=4\nX60 A3=1 B3={miss} C3=4\n"
        f"X61 A3=0 B3={miss} C3=1\nX90 A3=0.3 B3=-0.5 C3=1\nM30\n"
    )
    setup = {"tools": {1: {"length": 100}}, "parameters": {"$MC_TRAFO5_POLE_LIMIT_1": limit}}
    result = polycnc.run(text, control="sinumerik-840d", machine=machine, setup=setup)
    assert not result.alarms
    keeps_limits(result, load_machine(machine), jerk=acceleration == "SOFT")


def keeps_limits(result: polycnc.Result, machine: Machine, *, jerk: bool = True) -> None:
    for run, context in runs_of(result, machine):
        times = np.arange(0.0, min(run.seconds, 10.0), 0.001)
        _, velocity, acceleration = real_motion(run, context, times, machine)
        jerks = np.diff(acceleration, axis=0) / 0.001
        for i, name in enumerate(result.toolpath.axes):
            axis = machine.axis[name]
            assert np.abs(velocity[:, i]).max(initial=0.0) <= max(axis.rapid, axis.max_feed) * SLACK
            assert np.abs(acceleration[:, i]).max(initial=0.0) <= axis.acceleration * SLACK
            assert not jerk or np.abs(jerks[:, i]).max(initial=0.0) <= axis.jerk * SLACK


def runs_of(result: polycnc.Result, machine: Machine) -> list[tuple[Run, Context]]:
    """What the axes do from rest to rest, rapids of each axis alone left out."""
    toolpath, found, n = result.toolpath, list[Any](), len(result.toolpath.axes)
    width = piece_width(n)
    planner = Planner(
        toolpath,
        machine,
        **result.lead,
        compiled=False,
        on_pieces=lambda pieces, count: found.append(np.array(pieces[: count * width]).reshape(count, width)),
    )
    planner.finish()
    pieces, rows = np.concatenate(found), list(toolpath.rows())
    starts = [*np.flatnonzero(pieces[:, PieceRecord.SPEED2] == 0.0).tolist(), len(pieces)]
    return [
        (Run(pieces[a:b], n), rows[int(pieces[a, PieceRecord.ROW])].context)
        for a, b in pairwise(starts)
        if pieces[a, PieceRecord.FORM] != Form.TIMED
    ]


def real_motion(run: Run, context: Context, times: Any, machine: Machine) -> tuple[Any, Any, Any]:
    """Position, velocity and acceleration of the real axes, by the chain rule over a short time."""
    position, velocity, acceleration = run.at(times)
    short, geometry = 1e-4, machine.geometry_indices(1)
    places = [position + velocity * t + acceleration * t * t / 2.0 for t in (-short, 0.0, short)]
    before, now, after = (
        np.array([real_of(place, context, geometry) for place in laid.tolist()]) for laid in places
    )
    ways = [now - before, after - now]
    turning = [i for i, name in enumerate(machine.channel(1).axes) if machine.axis[name].rotary]
    for way in ways:
        way[:, turning] = (way[:, turning] + 180.0) % 360.0 - 180.0
    return now, (ways[0] + ways[1]) / (2.0 * short), (ways[1] - ways[0]) / short**2
