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
from polycnc.machine import load_machine
from polycnc.mainrun import State
from polycnc.motion import Settings
from polycnc.motion.frames import real_of
from polycnc.motion.kernels.columns import FORM, ROW, SPEED2, TIMED, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.run import Run
from polycnc.motion.samples import Sampler, Samples
from polycnc.motion.transformed import RealAxes
from polycnc.toolpath import Context, Kind, Toolpath
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


def polar(*blocks: str) -> polycnc.Result:
    """The blocks in the polar plane (X60 C0, where X counts radius), and one row for each of them from line 4 on."""
    text = "\n".join(["O1", "G98 G0 X120. Z5. C0", "G12.1", *blocks, "G13.1", "G0 X100. C10.", "M30", ""])
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    return result


def samples_of(result: polycnc.Result) -> Samples:
    """The sampled motion of a program, 1 ms."""
    found: list[Samples] = []
    planner = Planner(result.toolpath, MACHINE, **result.lead, compiled=False)
    settings = result.lead["settings"]
    sampler = Sampler(result.toolpath, MACHINE, planner, settings, 0.001, found.append)
    for chunk in result.toolpath.chunks:
        sampler.take(chunk)
    planner.finish()
    sampler.close()
    return Samples(*(np.concatenate(column) for column in zip(*found, strict=True)))


def assert_within_limits(samples: Samples) -> None:
    """Velocity, acceleration and jerk of every axis; and velocity is the change of position: nothing leaps."""
    ways = np.diff(samples.position, axis=0)
    ways[:, 2] = (ways[:, 2] + 180.0) % 360.0 - 180.0
    for i, name in enumerate("XZC"):
        axis = MACHINE.axis[name]
        speeds = np.abs(np.concatenate([ways[:, i] / 0.001, samples.velocity[:, i]]))
        assert speeds.max() <= max(axis.rapid, axis.max_feed) * SLACK
        assert np.abs(samples.acceleration[:, i]).max() <= axis.acceleration * SLACK
        assert np.abs(np.diff(samples.acceleration[:, i])).max() / 0.001 <= axis.jerk * SLACK


def turn_s(degrees: float) -> float:
    """The least time of C for a turn from rest to rest, by velocity and acceleration."""
    c = MACHINE.axis["C"]
    return degrees / c.max_feed + c.max_feed / c.acceleration


def seconds_of(result: polycnc.Result, line: int) -> float:
    """Planned time of the row of a line."""
    return result.plan.row_s[next(i for i, row in enumerate(result.rows) if row.get("line") == line)]


THROUGH = [
    ("a line", ["G1 X-60. F3000"], 4),
    ("a slow line", ["G1 X-60. F300"], 4),
    ("a line beside it by less than is displayed", ["G1 C0.001 F3000", "X-60."], 5),
    ("two half circles", ["G1 X20. F3000", "G3 X0 C0 I-10. J0", "G2 X-20. C0 I-10. J0"], 6),
    ("a full circle", ["G1 X20. F3000", "G3 X20. C0 I-10. J0"], 5),
]


@pytest.mark.parametrize(
    ("blocks", "line"), [case[1:] for case in THROUGH], ids=[case[0] for case in THROUGH]
)
def test_a_path_through_the_centre_rests_there_while_c_turns_by_half_a_round(
    blocks: list[str], line: int
) -> None:
    result = polar(*blocks)
    samples = samples_of(result)
    assert_within_limits(samples)
    assert samples.time[-1] == pytest.approx(result.plan.total_s, abs=0.01)
    turning = (samples.position[:, 0] < 2e-4) & (np.abs(samples.velocity[:, 2]) > 1.0)
    assert np.abs(samples.velocity[turning, 0]).max() < 1e-3
    assert turning.sum() * 0.001 == pytest.approx(turn_s(180.0), rel=0.6)
    turned = np.abs(np.trapezoid(samples.velocity[turning, 2], dx=0.001))
    assert turned == pytest.approx(180.0, abs=1.0)
    assert len([row for row in result.rows if row.get("line") == line]) == 1


@pytest.mark.parametrize("feed", [300, 3000])
def test_a_line_through_the_centre_takes_its_way_and_half_a_turn(feed: int) -> None:
    way, taken = 120.0 / (feed / 60.0), seconds_of(polar(f"G1 X-60. F{feed}"), 4)
    assert way + turn_s(180.0) * 0.7 < taken < way + turn_s(180.0) + 0.8


@pytest.mark.parametrize(
    ("to", "degrees"), [("C20.", 90.0), ("X20. C20.", 45.0), ("X30.", 0.0), ("X-20. C-1.", 177.1376)]
)
def test_a_row_that_ends_at_the_centre_is_left_after_a_turn_by_the_angle_between(
    to: str, degrees: float
) -> None:
    result = polar("G1 X0 F3000", to)
    samples = samples_of(result)
    assert_within_limits(samples)
    there = (samples.line == 5) & (samples.position[:, 0] < 1.5e-4)
    assert np.abs(np.trapezoid(samples.velocity[there, 2], dx=0.001)) == pytest.approx(degrees, abs=0.5)


def test_z_moves_at_the_centre_without_a_turn() -> None:
    samples = samples_of(polar("G1 X0 F3000", "Z-3.", "C20."))
    assert_within_limits(samples)
    drilling = samples.line == 5
    assert drilling.any()
    assert np.abs(samples.velocity[drilling, 2]).max() < 1e-6


def test_a_plane_that_is_entered_at_the_centre_is_left_in_any_direction() -> None:
    text = "O1\nG98 G0 X0. Z5. C30.\nG12.1\nG1 C20. F3000\nG13.1\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    samples = samples_of(result)
    assert_within_limits(samples)
    assert samples.position[-1].tolist() == pytest.approx([20.0, 5.0, 120.0], abs=1e-6)


def test_the_nearer_a_line_passes_the_centre_the_longer_it_takes_but_not_much() -> None:
    """At best C turns by half a round from rest to rest; the plan allows itself a few of them."""
    beside = [0.5, 0.1, 0.02, 0.005, 0.002]
    taken = [seconds_of(polar(f"G1 C{distance} F3000", "X-60."), 5) for distance in beside]
    assert taken == sorted(taken)
    assert max(taken) < 120.0 / 50.0 + 7.0 * turn_s(180.0)
    assert all(b < 1.2 * a for a, b in pairwise(taken))


@pytest.mark.parametrize(
    "blocks", [["G1 X-60. F3000"], ["G1 X20. F3000", "G3 X20. C0 I-10. J0"], ["G1 X0 F3000", "Z3.", "C5."]]
)
@pytest.mark.parametrize("override", [0.5, 1.0])
def test_the_main_run_turns_at_the_centre_too(blocks: list[str], override: float) -> None:
    text = "\n".join(["O1", "G98 G0 X120. Z5. C0", "G12.1", *blocks, "G13.1", "G0 X100. C10.", "M30", ""])
    virtual = power_on(text, "fanuc-0i-tf", machine="lathe-c-transmit")
    virtual.override(feed=override)
    virtual.cycle_start()
    cycle, places = 0.004, [virtual.machine_position]
    while virtual.state is State.RUNNING:
        virtual.step()
        places.append(virtual.machine_position)
    assert virtual.state is State.READY
    ways = np.diff(np.array(places), axis=0)
    ways[:, 2] = (ways[:, 2] + 180.0) % 360.0 - 180.0
    for i, name in enumerate("XZC"):
        axis = MACHINE.axis[name]
        assert np.abs(ways[:, i]).max() / cycle <= max(axis.rapid, axis.max_feed) * SLACK
        assert np.abs(np.diff(ways[:, i], 1)).max() / cycle**2 <= axis.acceleration * SLACK
        assert np.abs(np.diff(ways[:, i], 2)).max() / cycle**3 <= axis.jerk * SLACK


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


@settings(max_examples=25, deadline=None)
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
    for run, context in runs_of(result):
        times = np.arange(0.0, min(run.seconds, 10.0), 0.001)
        _, velocity, acceleration = real_motion(run, context, times)
        jerk = np.diff(acceleration, axis=0) / 0.001
        for i, name in enumerate("XZC"):
            axis = MACHINE.axis[name]
            assert np.abs(velocity[:, i]).max(initial=0.0) <= max(axis.rapid, axis.max_feed) * SLACK
            assert np.abs(acceleration[:, i]).max(initial=0.0) <= axis.acceleration * SLACK
            assert np.abs(jerk[:, i]).max(initial=0.0) <= axis.jerk * SLACK


def runs_of(result: polycnc.Result) -> list[tuple[Run, Context]]:
    """What the axes do from rest to rest, rapids of each axis alone left out."""
    toolpath, found, n = result.toolpath, list[Any](), 3
    width = piece_width(n)
    planner = Planner(
        toolpath,
        MACHINE,
        **result.lead,
        compiled=False,
        on_pieces=lambda pieces, count: found.append(np.array(pieces[: count * width]).reshape(count, width)),
    )
    planner.finish()
    pieces, rows = np.concatenate(found), list(toolpath.rows())
    starts = [*np.flatnonzero(pieces[:, SPEED2] == 0.0).tolist(), len(pieces)]
    return [
        (Run(pieces[a:b], n), rows[int(pieces[a, ROW])].context)
        for a, b in pairwise(starts)
        if pieces[a, FORM] != TIMED
    ]


def real_motion(run: Run, context: Context, times: Any) -> tuple[Any, Any, Any]:
    """Position, velocity and acceleration of the real axes, by the chain rule over a short time."""
    position, velocity, acceleration = run.at(times)
    short, geometry = 1e-4, MACHINE.geometry_indices(1)
    places = [position + velocity * t + acceleration * t * t / 2.0 for t in (-short, 0.0, short)]
    before, now, after = (
        np.array([real_of(place, context, geometry) for place in laid.tolist()]) for laid in places
    )
    ways = [now - before, after - now]
    for way in ways:
        way[:, 2] = (way[:, 2] + 180.0) % 360.0 - 180.0
    return now, (ways[0] + ways[1]) / (2.0 * short), (ways[1] - ways[0]) / short**2
