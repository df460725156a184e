"""From ways of the direction to ways of the rotary axes."""

from __future__ import annotations

from itertools import pairwise
from math import pi, radians
from typing import TYPE_CHECKING

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from polycnc.machine import load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.machine.model import Joint
from polycnc.transformation.orientation.choice import nearest
from polycnc.transformation.orientation.directions import angle_between, great_circle, unit_of
from polycnc.transformation.orientation.solutions import pole_angle, solutions_for
from polycnc.transformation.orientation.turning import Course, Knot, Turning, follow

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector

CONE = 2.0
#: What `follow` promises outside the cones, with what the chords between its looks may add.
CLOSE = radians(0.05)
_parts = st.floats(-1.0, 1.0)
#: Upwards, so that every head reaches them.
vectors = st.tuples(_parts, _parts, st.floats(0.05, 1.0)).map(unit_of).filter(lambda v: v is not None)
MACHINES = [
    Kinematics.of(load_machine(f"mill5-{name}")) for name in ("ca-head", "ac-table", "bc-head", "ab-head")
]


def anywhere(_angles: object) -> bool:
    return True


def start_of(kinematics: Kinematics, direction: Vector) -> dict[str, float]:
    found = nearest(solutions_for(kinematics, direction, {}), {})
    assert found is not None
    return {axis: found.get(axis, 0.0) for axis in kinematics.axes}


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(MACHINES), vectors, vectors)
def test_between_knots_the_tool_keeps_to_the_way_outside_the_cones(
    kinematics: Kinematics, a: Vector, b: Vector
) -> None:
    assume(angle_between(a, b) < pi - 0.1)
    way, start = great_circle(a, b), start_of(kinematics, a)
    assert way is not None
    knots = follow(kinematics, way, start, anywhere, CONE)
    assert knots is not None
    assert knots[-1].share == 1.0
    assert kinematics.tool_on_work(knots[-1].angles) == pytest.approx(b, abs=1e-6)
    for first, last in pairwise([Knot(0.0, start), *knots]):
        for part in (0.25, 0.5, 0.75):
            share = first.share + part * (last.share - first.share)
            angles = {k: v + part * (last.angles[k] - v) for k, v in first.angles.items()}
            off = angle_between(kinematics.tool_on_work(angles), way(share))
            assert off < CLOSE or pole_angle(kinematics, angles) < CONE + 1e-6
            assert off < radians(2.0 * CONE) + CLOSE


@settings(max_examples=100, deadline=None)
@given(st.sampled_from(MACHINES), vectors, vectors, st.lists(st.floats(-20.0, 20.0), min_size=1, max_size=4))
def test_a_way_that_goes_to_and_fro_is_kept_to_as_well(
    kinematics: Kinematics, a: Vector, b: Vector, within: list[float]
) -> None:
    assume(0.05 < angle_between(a, b) < 1.0)
    way, start = great_circle(a, b, tuple(within)), start_of(kinematics, a)
    assert way is not None
    assume(pole_angle(kinematics, start) > 2.0 * CONE)
    knots = follow(kinematics, way, start, anywhere, CONE)
    assert knots is not None
    for first, last in pairwise([Knot(0.0, start), *knots]):
        share = 0.5 * (first.share + last.share)
        angles = {k: 0.5 * (v + last.angles[k]) for k, v in first.angles.items()}
        off = angle_between(kinematics.tool_on_work(angles), way(share))
        # Between the places that are looked at it may leave the way by a little more.
        assert off < 1.2 * CLOSE or pole_angle(kinematics, angles) < 2.0 * CONE


def test_through_the_pole_one_axis_goes_on_and_the_other_one_stays() -> None:
    kinematics = MACHINES[0]
    way = great_circle((0.5, 0.0, 0.8660254037844386), (-0.5, 0.0, 0.8660254037844386))
    assert way is not None
    (knot,) = follow(kinematics, way, {"C": 90.0, "A": 30.0}, anywhere, CONE) or []
    assert knot.angles == pytest.approx({"C": 90.0, "A": -30.0})


def test_from_the_pole_the_axes_go_evenly_to_the_edge_of_its_cone() -> None:
    way = great_circle((0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    assert way is not None
    edge, end = follow(MACHINES[0], way, {"C": 90.0, "A": 0.0}, anywhere, 10.0) or []
    assert edge.angles["A"] == pytest.approx(-10.0, abs=1e-5) or edge.angles["A"] == pytest.approx(
        10.0, abs=1e-5
    )
    assert edge.share == pytest.approx(1.0 / 9.0, abs=1e-6)
    assert end.angles["C"] == edge.angles["C"]


def test_a_way_that_the_axes_cannot_follow_has_no_knots() -> None:
    way = great_circle((0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    assert way is not None
    assert follow(MACHINES[0], way, {}, lambda angles: abs(angles["A"]) < 60.0, CONE) is None


def test_a_course_at_the_start_ends_early() -> None:
    turning = Turning((3,), (0.5, 1.0), ((10.0,), (40.0,)), Course(40.0, 8.0, both_ends=False))
    assert turning.paced([0.0], 20.0) == Turning((3,), (0.125, 0.25, 1.0), ((10.0,), (40.0,), (40.0,)))
    assert turning.paced([0.0], 5.0) == Turning((3,), (0.5, 1.0), ((10.0,), (40.0,)))


def test_a_course_at_both_ends_rests_between() -> None:
    turning = Turning((3,), (0.25, 1.0), ((10.0,), (40.0,)), Course(40.0, 4.0, both_ends=True))
    paced = turning.paced([0.0], 20.0)
    assert paced.shares == (0.125, 0.25, 0.75, 1.0)
    assert paced.places == ((10.0,), (20.0,), (20.0,), (40.0,))


def test_a_part_of_a_turn_begins_and_ends_where_it_is_cut() -> None:
    turning = Turning((3,), (0.25, 0.75, 1.0), ((10.0,), (40.0,), (80.0,)))
    part = turning.part([0.0], 0.125, 0.5)
    assert part.shares == pytest.approx((1.0 / 3.0, 1.0))
    assert part.places == ((10.0,), (25.0,))
    assert turning.at([0.0], 0.125) == (5.0,)
    assert turning.part([0.0], 0.0, 1.0) == turning


@given(st.lists(st.tuples(st.floats(0.05, 1.0), st.floats(-90.0, 90.0)), min_size=2, max_size=6))
def test_a_smooth_turn_has_the_knots_and_goes_neither_back_nor_beyond_them(
    steps: list[tuple[float, float]],
) -> None:
    whole = sum(width for width, _ in steps)
    shares = [sum(width for width, _ in steps[: k + 1]) / whole for k in range(len(steps))]
    places = [sum(way for _, way in steps[: k + 1]) for k in range(len(steps))]
    smooth = Turning((3,), (*shares[:-1], 1.0), tuple((place,) for place in places)).smoothed([0.0])
    for first, last, a, b in zip([0.0, *shares], shares, [0.0, *places], places, strict=False):
        between = [smooth.at([0.0], first + (last - first) * k / 50.0)[0] for k in range(51)]
        assert between[0] == pytest.approx(a, abs=1e-9)
        assert between[-1] == pytest.approx(b, abs=1e-9)
        assert all(min(a, b) - 1e-9 <= place <= max(a, b) + 1e-9 for place in between)
        assert all((later - place) * (b - a) >= -1e-9 for place, later in pairwise(between))


def test_a_smooth_turn_has_no_corners() -> None:
    smooth = Turning((3,), (0.25, 0.75, 1.0), ((10.0,), (40.0,), (80.0,))).smoothed([0.0])
    for knot in (0.25, 0.75):
        before, at, behind = (smooth.at([0.0], knot + step)[0] for step in (-1e-5, 0.0, 1e-5))
        assert behind - at == pytest.approx(at - before, rel=1e-3)


def test_a_smooth_turn_that_is_even_stays_even() -> None:
    smooth = Turning((3,), (0.25, 1.0), ((10.0,), (40.0,))).smoothed([0.0])
    assert [smooth.at([0.0], k / 8.0)[0] for k in range(9)] == pytest.approx([5.0 * k for k in range(9)])


def test_a_turn_with_a_course_keeps_its_rate() -> None:
    turning = Turning((3,), (0.5, 1.0), ((10.0,), (40.0,)), Course(40.0, 8.0, both_ends=False))
    assert turning.smoothed([0.0]) is turning


def test_directions_that_no_position_reaches_are_passed_within_the_cone_of_the_pole() -> None:
    """Axes a degree off the square leave a hole about the first one; a way through it goes on behind it."""
    skewed = Kinematics((joint("C", (0.02, 0.0, 1.0)), joint("A", (1.0, 0.0, 0.03))), ())
    pole = (0.02, 0.0, 1.0)
    assert solutions_for(skewed, pole, {}) == []
    for side in ((1.0, 0.2, 1.0), (-0.3, -1.0, 1.0), (1.0, -0.4, 0.2)):
        a, b = unit_of(side), unit_of((0.04 - side[0], -side[1], 2.0 - side[2]))
        assert a is not None
        assert b is not None
        way = great_circle(a, b)
        assert way is not None
        knots = follow(skewed, way, start_of(skewed, a), anywhere, CONE)
        assert knots is not None
        assert skewed.tool_on_work(knots[-1].angles) == pytest.approx(b, abs=1e-6)
        start = start_of(skewed, a)
        for first, last in pairwise([Knot(0.0, start), *knots]):
            middle = {axis: 0.5 * (first.angles[axis] + last.angles[axis]) for axis in start}
            off = angle_between(skewed.tool_on_work(middle), way(0.5 * (first.share + last.share)))
            assert off < radians(2.0 * CONE)
        assert follow(skewed, way, start, anywhere, 0.0) is None


def test_a_way_through_what_a_head_cannot_reach_ends() -> None:
    nutating = Kinematics((joint("C", (0.0, 0.0, 1.0)), joint("B", (0.0, 1.0, 1.0))), ())
    a, b = unit_of((1.0, 0.0, 0.02)), unit_of((-1.0, 0.1, 0.02))
    assert a is not None
    assert b is not None
    below = great_circle(a, (0.0, 0.0, -1.0))
    beyond = great_circle((0.0, 0.0, -1.0), b)
    assert below is not None
    assert beyond is not None

    def way(u: float) -> Vector:
        return below(2.0 * u) if u < 0.5 else beyond(2.0 * u - 1.0)

    assert follow(nutating, way, start_of(nutating, a), anywhere, CONE) is None


def joint(axis: str, direction: Vector) -> Joint:
    """A rotary joint without offset."""
    return Joint(axis, rotary=True, carries="tool", direction=direction, offset=(0.0, 0.0, 0.0))
