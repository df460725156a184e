"""What a program says about speeds beside F: overrides, limits of axes, the axes that F is for."""

from __future__ import annotations

from math import inf, pi, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.machine.kinematics import Kinematics
from polycnc.machine.load import load_machine
from polycnc.motion import plan
from polycnc.motion.kernels.columns import Limits, PathLimits
from polycnc.motion.pace import Travel, edge_factor, following_top, pace_of
from polycnc.motion.settings import Settings
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.context import Pace
from polycnc.toolpath.modes import AccelerationMode, FeedMode
from polycnc.toolpath.row_path import line_path
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from tests.motion.paths import Build, mill

MACHINE = mill(acceleration=1000.0, top=500.0)
#: Velocity of rapids and cuts, acceleration, jump, that of parameters, acceleration on arcs, from line to line, rotary
#: or not, jerk: three linear axes.
LIMITS = Limits(
    [500.0] * 3, [250.0] * 3, [1000.0] * 3, [1.0] * 3, [inf] * 3, [inf] * 3, [inf] * 3,
    [0.0] * 3, [50000.0] * 3,    [0, 1, 2], PathLimits(), [],
)  # fmt: skip
SETTINGS = Settings(acceleration=AccelerationMode.CONSTANT, rapid_stops=False)
WEIGHTS = [1.0, 1.0, 1.0]


def seconds(build: Build) -> float:
    return plan(build.toolpath, MACHINE, settings=SETTINGS).total_s


def straight(pace: Pace | None, *end: float, kind: Kind = Kind.FEED, feed: float = 50.0) -> float:
    return seconds(Build(context=Context(pace=pace)).row(kind, *end, feed=feed))


def test_a_factor_on_the_feed_is_a_factor_on_the_speed() -> None:
    assert straight(Pace(feed=0.5), 100.0, 0.0, 0.0) == pytest.approx(
        straight(None, 100.0, 0.0, 0.0, feed=25.0)
    )


def test_a_factor_on_rapids_leaves_cuts_alone() -> None:
    assert straight(Pace(rapid=0.5), 500.0, 0.0, 0.0, kind=Kind.RAPID) == pytest.approx(2.25)
    assert straight(Pace(rapid=0.5), 100.0, 0.0, 0.0) == straight(None, 100.0, 0.0, 0.0)


def test_an_axis_that_stands_bounds_nothing() -> None:
    slow = Pace(velocity=(1.0, 0.01, 1.0), acceleration=(1.0, 0.01, 1.0))
    assert straight(slow, 100.0, 0.0, 0.0) == straight(None, 100.0, 0.0, 0.0)


def test_half_the_acceleration_takes_twice_as_long_to_get_up_to_speed() -> None:
    own = straight(Pace(acceleration=(0.5, 1.0, 1.0)), 100.0, 0.0, 0.0, feed=50.0)
    assert own == pytest.approx(100.0 / 50.0 + 50.0 / 500.0)


def test_the_feed_is_for_the_axes_that_have_weights() -> None:
    assert straight(Pace(weights=(1.0, 0.0, 0.0)), 50.0, 0.0, 120.0) == pytest.approx(1.0, abs=0.2)


@given(
    st.lists(st.just(0.0) | st.floats(0.001, 100.0), min_size=3, max_size=3).filter(any),
    st.lists(st.floats(0.1, 2.0), min_size=3, max_size=3),
)
def test_a_line_keeps_the_velocity_and_acceleration_of_every_axis(
    way: list[float], share: list[float]
) -> None:
    factors = (share[0], share[1], share[2])
    context = Context(pace=Pace(velocity=factors, acceleration=factors))
    moved = Travel([abs(part) for part in way])
    _, top, ease, _ = pace_of(context, moved, WEIGHTS, LIMITS, rapid=False, soft=False)
    length = moved.length(WEIGHTS)
    pull = ease * min(1000.0 / (part / length) for part in moved.moved if part)
    for part, factor in zip(moved.moved, factors, strict=True):
        assert part / length * top <= 250.0 * factor * (1 + 1e-9)
        assert part / length * pull <= 1000.0 * factor * (1 + 1e-9)


@given(st.floats(1.0, 50.0), st.floats(0.5, 20.0), st.booleans(), st.sampled_from((1, -1)))
def test_the_edge_of_the_tool_moves_at_the_feed(radius: float, tool: float, ccw: bool, side: int) -> None:
    inside = (side > 0) == ccw
    centre = radius - tool if inside else radius + tool
    if centre <= 0.01:
        return
    way = Travel([0.0] * 3, (0, 1), centre * pi, centre, ccw)
    context = Context(side=side, radius_mm=tool)
    edge = edge_factor(Pace(edge="always"), context, way) * radius / centre
    assert edge == pytest.approx(1.0)
    assert edge_factor(Pace(edge="inside"), context, way) == (
        pytest.approx(centre / radius) if inside else 1.0
    )
    assert edge_factor(Pace(), context, way) == 1.0


def test_a_block_in_a_time_has_no_edge() -> None:
    way = Travel([0.0] * 3, (0, 1), 40.0, 10.0, ccw=True)
    context = Context(side=1, radius_mm=5.0, feed_mode=FeedMode.INVERSE_TIME)
    assert edge_factor(Pace(edge="always"), context, way) == 1.0


def test_about_a_corner_the_tool_turns_at_the_feed() -> None:
    way = Travel([0.0] * 3, (0, 1), 5.0, 5.0, ccw=False)
    assert edge_factor(Pace(edge="always"), Context(side=1, radius_mm=5.0), way) == 1.0


def test_an_arc_counts_its_whole_length_once() -> None:
    way = Travel([0.0, 0.0, 30.0], (0, 1), 40.0, 10.0, ccw=True)
    assert way.length(WEIGHTS) == 50.0
    assert way.length([1.0, 0.0, 0.0]) == 40.0
    assert way.length([0.0, 0.0, 1.0]) == 30.0


def test_a_slower_arc_keeps_the_acceleration_across_it() -> None:
    way = Travel([0.0] * 3, (0, 1), 40.0, 10.0, ccw=True)
    context = Context(pace=Pace(acceleration=(0.5, 1.0, 1.0)))
    _, top, ease, _ = pace_of(context, way, WEIGHTS, LIMITS, rapid=False, soft=False)
    assert top == pytest.approx(sqrt(0.5 * 1000.0 * 10.0))
    assert ease == 0.5


def test_nothing_moves_without_a_way() -> None:
    context = Context(pace=Pace(feed=0.5))
    assert pace_of(context, Travel([0.0] * 3), WEIGHTS, LIMITS, rapid=False, soft=False) == (
        1.0,
        inf,
        1.0,
        1.0,
    )


@given(st.floats(1.0, 300.0), st.floats(-500.0, 500.0), st.floats(1.0, 170.0))
def test_axes_that_follow_a_turning_head_keep_their_speed(length: float, way: float, turn: float) -> None:
    machine = load_machine("mill5-bc-head")
    axes = ("X", "Y", "Z", "B", "C")
    tip = ToolCentrePoint(Kinematics.of(machine), axes, (0, 1, 2), (0.0,) * 5, (0.0, 0.0, -length))
    path = line_path([0.0] * 5, [way, 0.0, 0.0, turn, 0.0])
    context = Context(transformation=tip, pace=Pace(following=10.0))
    top = following_top(context, path, 50.0, rapid=False)
    # B turns by turn/50 degrees a millimetre, and the nose is the tool's length away from the tip.
    assert top == pytest.approx(10.0 / (length * turn / 50.0 * pi / 180.0))


def test_axes_follow_nothing_where_no_axis_turns() -> None:
    machine = load_machine("mill5-bc-head")
    axes = ("X", "Y", "Z", "B", "C")
    tip = ToolCentrePoint(Kinematics.of(machine), axes, (0, 1, 2), (0.0,) * 5, (0.0, 0.0, -100.0))
    context = Context(transformation=tip, pace=Pace(following=10.0))
    straight, turning = (line_path([0.0] * 5, [9.0, 0.0, 0.0, b, 0.0]) for b in (0.0, 1.0))
    assert following_top(context, straight, 9.0, rapid=False) == inf
    assert following_top(context, turning, 9.0, rapid=True) == inf
    assert following_top(context, turning, 9.0, rapid=False) < inf
