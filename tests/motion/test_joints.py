"""With limited jerk: joints that come one soon after the other keep every limit, however they turn."""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING

from hypothesis import example, given, settings
from hypothesis import strategies as st

from polycnc.motion.limits import EXACT_MM, averages
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import CornerMode
from tests.motion.paths import MILL, Build
from tests.motion.test_jerk import SLACK, SOFT, check, contexts, machines, runs, stray

if TYPE_CHECKING:
    from polycnc.machine import Machine

FINE = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.02)
EXPLORES = settings.get_current_profile_name() == "explore"


class Walk:
    """Lines and arcs, each of which goes on in the direction of the one before unless it turns first."""

    def __init__(self, context: Context, heading: float, feed: float) -> None:
        self.rows, self.heading, self.feed = Build(context=context), heading, feed

    def line(self, length: float, turn: float = 0.0) -> Walk:
        self.heading += turn
        x, y, z = self.rows.end
        self.rows.feed(x + length * cos(self.heading), y + length * sin(self.heading), z, feed=self.feed)
        return self

    def arc(self, radius: float, angle: float) -> Walk:
        """To the left by an angle, to the right by a negative one."""
        x, y, _ = self.rows.end
        side = radius if angle > 0.0 else -radius
        cx, cy = x - side * sin(self.heading), y + side * cos(self.heading)
        self.heading += angle
        end = cx + side * sin(self.heading), cy - side * cos(self.heading), 0.0
        kind = Kind.CCW if angle > 0.0 else Kind.CW
        self.rows.row(kind, *end, feed=self.feed, curve=(cx, cy, 0.0, 0.0, 0.0, 1.0, 0.0))
        return self

    def spiral(self, radius: float, last: float, angle: float, rise: float) -> Walk:
        """To the left by an angle, from one radius to another."""
        x, y, z = self.rows.end
        cx, cy = x - radius * sin(self.heading), y + radius * cos(self.heading)
        self.heading += angle
        end = cx + last * sin(self.heading), cy - last * cos(self.heading), z + rise
        turns = float(int(angle / (2.0 * pi)))
        self.rows.row(Kind.HELIX_CCW, *end, feed=self.feed, curve=(cx, cy, 0.0, 0.0, 0.0, 1.0, turns))
        return self


def keeps_all(rows: Build, context: Context, machine: Machine) -> None:
    """Limits at every sample, and the tolerance of the path."""
    check(rows, machine)
    blend = averages(context, machine, SOFT)[1]
    for run in runs(rows, machine)[1]:
        assert stray(run, blend) <= (context.tolerance_mm or EXACT_MM) * SLACK


@settings(max_examples=300 if EXPLORES else 6, deadline=None)
@given(
    st.floats(-1.3, 1.3),
    st.floats(-2.5, 0.3),
    st.sampled_from([(1, -1), (1, 1, -1, -1), (1, 1, -1), (1, 0, -1, 0), (1, 1, 1, 0)]),
    st.floats(0.0, 0.3),
    st.floats(0.0, 2.0 * pi),
    contexts,
    machines,
)
@example(0.67, -1.72, (1, 1, -1, -1), 0.06, 4.36, FINE, MILL)
def test_rows_that_turn_to_either_side(
    size: float,
    turn: float,
    sides: tuple[int, ...],
    unevenness: float,
    heading: float,
    context: Context,
    machine: Machine,
) -> None:
    """What one corner leaves of the jerk is not enough for two that turn to either side within the average."""
    walk = Walk(context, heading, 400.0).line(3.0)
    for k in range(24):
        walk.line(10.0**size * (1.0 + unevenness * sin(7.0 * k)), 10.0**turn * sides[k % len(sides)])
    keeps_all(walk.line(3.0).rows, context, machine)


@settings(max_examples=300 if EXPLORES else 6, deadline=None)
@given(st.floats(0.05, 1.5), st.floats(0.002, 0.1), st.floats(0.05, 6.0), contexts, machines)
@example(0.8, 0.033, 5.17, FINE, MILL)
@example(1.1, 0.036, 4.16, FINE, MILL)
def test_a_row_of_facets_may_end_in_a_line_that_goes_straight_on(
    length: float, turn: float, last: float, context: Context, machine: Machine
) -> None:
    """No corner says that the facets bend no more."""
    walk = Walk(context, 1.2, 400.0).line(5.0)
    for _ in range(20):
        walk.line(length, turn)
    keeps_all(walk.line(last).line(5.0).rows, context, machine)


@settings(max_examples=300 if EXPLORES else 6, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-0.5, 1.6), st.floats(-2.0, 0.4), st.booleans(), st.floats(-2.0, 1.3)),
        min_size=1,
        max_size=5,
    ),
    st.floats(-0.05, 0.05),
    st.sampled_from([20.0, 150.0, 1000.0]),
    contexts,
    machines,
)
def test_arcs_and_lines_that_touch_each_other(
    arcs: list[tuple[float, float, bool, float]],
    turn: float,
    feed: float,
    context: Context,
    machine: Machine,
) -> None:
    """From long ones, whose joints are alone, to arcs and lines that the average sees several of."""
    walk = Walk(context, 0.4, feed).line(30.0)
    for radius, angle, left, line in arcs:
        walk.arc(10.0**radius, 10.0**angle if left else -(10.0**angle))
        walk.line(10.0**line, turn)
    keeps_all(walk.line(30.0).rows, context, machine)


@settings(max_examples=300 if EXPLORES else 3, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(-1.0, 1.3), st.floats(-1.3, 1.3), st.floats(0.3, 12.0), st.floats(-20.0, 20.0)),
        min_size=1,
        max_size=1,
    ),
    contexts,
)
@example([(-0.52, -0.74, 11.84, 14.9)], FINE)
def test_spirals_that_grow_and_rise_by_much(
    spirals: list[tuple[float, float, float, float]], context: Context
) -> None:
    """A steep helix turns its q'' faster than a circle of its curvature."""
    walk = Walk(context, 0.4, 400.0).line(10.0)
    for radius, growth, angle, rise in spirals:
        walk.spiral(10.0**radius, 10.0 ** (radius + growth), angle, rise if angle > 3.0 else 0.0).line(3.0)
    keeps_all(walk.rows, context, MILL)


def test_a_corner_far_from_others_takes_what_the_axes_can_do() -> None:
    """A zigzag whose corners the average sees one by one is run at 0.75 of the speed that the jerk allows there."""
    tolerance, turn = 0.05, pi / 9.0
    context = Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=tolerance)
    walk = Walk(context, 0.5 * turn, 1000.0)
    for k in range(20):
        walk.line(4.0, turn if k % 2 else -turn)
    fastest = (36.0 * tolerance**2 * MILL.axes[0].jerk) ** (1.0 / 3.0) / turn
    assert walk.rows.plan(MILL, settings=SOFT).total_s < 80.0 / (0.75 * fastest)
