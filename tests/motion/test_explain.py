"""Which limit held for how long: the parts add up to the plan."""

from __future__ import annotations

from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion import Settings
from polycnc.motion.explain import Cause, TimeAccount, account
from polycnc.motion.explain.compiled import Kernels, kernels
from polycnc.motion.planner import Planner
from polycnc.session import open_session
from polycnc.toolpath import Context
from polycnc.toolpath.context import Pace
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from polycnc.transformation.couplings.coupled import Coupled
from polycnc.transformation.couplings.laws import Ratio
from tests.examples import examples
from tests.kernels.strict import strict
from tests.motion.paths import MILL, Build
from tests.motion.test_limits import arc, build, line, spiral, spline
from tests.motion.test_planner import varied

MODES = st.sampled_from([AccelerationMode.CONSTANT, AccelerationMode.JERK_LIMITED])


def account_of(rows: Build, lead: Settings) -> tuple[float, float, TimeAccount]:
    """Planned time and way, and what they go into."""
    planner = Planner(rows.toolpath, MILL, settings=lead, compiled=False)
    account = TimeAccount(rows.toolpath, planner, compiled=False)
    plan = planner.finish()
    return plan.total_s, plan.times.cutting_mm + plan.times.rapid_mm, account


def seconds(rows: Build, cause: Cause, lead: Settings | None = None) -> float:
    return account_of(rows, lead or Settings())[2].parts[cause].seconds


@settings(max_examples=examples(30), deadline=None)
@given(st.lists(st.one_of(line, arc, spiral, spline), min_size=1, max_size=5), MODES, st.booleans())
def test_the_parts_add_up_to_time_and_way(
    steps: list[tuple[str, float, float, float, float]], mode: AccelerationMode, by_axis: bool
) -> None:
    rows = build(steps, Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.02)).rapid(3.0, 40.0, 5.0)
    total, way, account = account_of(rows, Settings(acceleration=mode, rapid_by_axis=by_axis))
    assert sum(part.seconds for part in account.parts.values()) == pytest.approx(total, rel=1e-9)
    assert sum(part.way for part in account.parts.values()) == pytest.approx(way, rel=1e-9)
    assert all(part.seconds >= 0.0 for part in account.parts.values())


def test_a_long_slow_line_runs_at_its_feed() -> None:
    assert seconds(Build().feed(100.0, 0.0, 0.0, feed=10.0), Cause.FEED) == pytest.approx(10.0, abs=0.01)


def test_a_line_that_is_asked_to_be_faster_than_its_axis_runs_at_the_axis() -> None:
    top = MILL.axis["X"].max_feed
    rows = Build().feed(2000.0, 0.0, 0.0, feed=10.0 * top)
    assert seconds(rows, Cause.AXES) == pytest.approx(2000.0 / top, rel=0.1)
    assert seconds(rows, Cause.FEED) == 0.0


@pytest.mark.parametrize("by_axis", [False, True])
def test_a_long_rapid_runs_at_the_velocity_of_its_axis(by_axis: bool) -> None:
    rows = Build().rapid(2000.0, 0.0, 0.0)
    found = seconds(rows, Cause.RAPID, Settings(rapid_by_axis=by_axis))
    top, pull = MILL.axis["X"].rapid, MILL.axis["X"].acceleration
    assert found == pytest.approx(2000.0 / top - top / pull, rel=1e-6)


def test_a_small_circle_is_bound_by_its_curve() -> None:
    rows = Build().arc(2.0, 0.0, 0.0, center=(1.0, 0.0), feed=5000.0, turns=5.0)
    parts = account_of(rows, Settings())[2].parts
    assert parts[Cause.CURVATURE].seconds > 0.5 * sum(part.seconds for part in parts.values())


def test_a_short_line_only_accelerates_and_its_axis_builds_up_jerk() -> None:
    rows = Build().feed(1.0, 0.0, 0.0, feed=5000.0)
    parts = account_of(rows, Settings(acceleration=AccelerationMode.JERK_LIMITED))[2].parts
    assert parts[Cause.JERK].seconds > 0.01
    assert parts[Cause.FEED].seconds == 0.0


def test_the_velocity_of_a_following_axis_is_that_of_an_axis() -> None:
    led = Context(transformation=Coupled.of({1: [Ratio(0, 5.0)]}, (0, 1, 2)))
    top = MILL.axis["Y"].max_feed
    parts = account_of(Build(context=led).feed(2000.0, 0.0, 0.0, feed=10.0 * top), Settings())[2].parts
    assert parts[Cause.AXES].seconds == pytest.approx(2000.0 / (top / 5.0), rel=0.1)
    assert parts[Cause.CORNERS].seconds == 0.0


def test_what_an_overlaid_motion_leaves_to_an_axis_says_so() -> None:
    pace = Pace(left=(10.0, inf, inf), left_pull=(1.0, 1.0, 1.0))
    rows = Build(context=Context(pace=pace)).feed(100.0, 0.0, 0.0, feed=100.0)
    assert seconds(rows, Cause.OVERLAID) == pytest.approx(10.0, abs=0.05)


def test_a_corner_at_which_the_axes_rest_unasked_is_a_corner() -> None:
    rows = Build().feed(50.0, 0.0, 0.0, feed=50.0).feed(0.0, 0.0, 0.0, feed=50.0)
    assert seconds(rows, Cause.CORNERS) == pytest.approx(seconds(rows, Cause.STANDSTILL), rel=1e-6)
    asked = Build(context=Context(corner_mode=CornerMode.EXACT_STOP)).feed(50.0, 0.0, 0.0, feed=50.0)
    assert seconds(asked.feed(0.0, 0.0, 0.0, feed=50.0), Cause.CORNERS) == 0.0


def test_an_arc_that_a_parameter_slows_says_so() -> None:
    lead = Settings(acceleration=AccelerationMode.JERK_LIMITED, arc_pulls={"X": 20.0, "Y": 80.0})
    rows = Build().arc(0.0, 0.0, 0.0, center=(20.0, 0.0), feed=100.0)
    _, _, account = account_of(rows, lead)
    assert account.parts[Cause.ARC_PULL].way == pytest.approx(125.66, abs=3.0)
    assert account.parts[Cause.ARC_PULL].seconds == pytest.approx(125.66 / 20.0, rel=0.03)
    assert seconds(rows, Cause.ARC_PULL, Settings(acceleration=AccelerationMode.JERK_LIMITED)) == 0.0


def test_corners_that_a_parameter_slows_say_so() -> None:
    mode = AccelerationMode.JERK_LIMITED
    rows = Build(context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=1.0))
    for k in range(1, 40):
        rows.feed(1.0 * k, 0.02 * (k % 2), 0.0, feed=20.0)
    found = account_of(rows, Settings(acceleration=mode, corner_steps={"Y": 0.7}))[2].parts
    # Each corner turns Y by 0.04 of the speed.
    assert found[Cause.CORNER_STEP].seconds == pytest.approx(39.0 * 0.04 / 0.7, rel=0.01)
    assert found[Cause.CORNERS].seconds == 0.0
    assert seconds(rows, Cause.CORNER_STEP, Settings(acceleration=mode)) == 0.0


@pytest.mark.parametrize("mode", AccelerationMode)
def test_no_index_counts_from_the_end(mode: AccelerationMode, monkeypatch: pytest.MonkeyPatch) -> None:
    """Compiled kernels would read what lies in front of the array."""
    lead = Settings(acceleration=mode)
    whole = account_of(varied(400), lead)[2].by_axis
    monkeypatch.setattr(account, "kernels", lambda **_: Kernels._make(map(strict, kernels(compiled=False))))
    assert account_of(varied(400), lead)[2].by_axis == whole


def test_a_turn_at_the_pole_takes_time_and_is_no_way() -> None:
    text = b"G98 G0 X60. Z5. C0\nG12.1\nG1 X-60. F1000.\nX60.\nG13.1\nM30\n"
    session = open_session(text, control="fanuc-0i-tf", machine="lathe-c-transmit", keep=False)
    account = session.explain_time()
    times = session.run().plan.times
    parts = account.parts.values()
    assert sum(part.seconds for part in parts) == pytest.approx(times.cutting_s + times.rapid_s)
    assert sum(part.way for part in parts) == pytest.approx(times.cutting_mm + times.rapid_mm)
