from __future__ import annotations

from math import cos, dist, pi, radians, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.frames import translation
from polycnc.session import open_session
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Auxiliary
from polycnc.toolpath.strokes import arc_points, strokes
from polycnc.transformation.couplings.coupled import Coupled, Shown
from polycnc.transformation.couplings.laws import Ratio
from polycnc.transformation.kinematic.parallel import ParallelAxes
from tests.toolpath.paths import Z_UP, Draft

XYZ = (0, 1, 2)


def test_rapids_and_feeds_and_tools_are_strokes_of_their_own() -> None:
    draft = Draft().move(Kind.RAPID, 0, 0, 0).move(Kind.RAPID, 10, 0, 0).move(Kind.FEED, 20, 0, 0)
    draft.move(Kind.FEED, 20, 10, 0).under(Context(tool=3)).move(Kind.FEED, 0, 10, 0)
    found = [(stroke.tool, stroke.rapid, stroke.points) for stroke in strokes(draft.toolpath, XYZ)]
    assert found == [
        ("T0", True, [(0, 0, 0), (0, 0, 0), (10, 0, 0)]),
        ("T0", False, [(10, 0, 0), (20, 0, 0), (20, 10, 0)]),
        ("T3", False, [(20, 10, 0), (0, 10, 0)]),
    ]


def test_dwells_and_events_do_not_break_a_stroke() -> None:
    draft = Draft().move(Kind.FEED, 1, 0, 0).event(Auxiliary(8)).move(Kind.DWELL, 1, 0, 0, curve=(1, 0))
    draft.move(Kind.FEED, 2, 0, 0)
    assert len(list(strokes(draft.toolpath, XYZ))) == 1


def test_a_new_work_offset_moves_the_coordinates_and_not_the_machine() -> None:
    draft = Draft().move(Kind.FEED, 10, 0, 0).under(Context(frame=translation(100, 0, 0)))
    draft.move(Kind.FEED, 5, 0, 0)
    last = list(strokes(draft.toolpath, XYZ))[-1]
    assert last.points == [(-90, 0, 0), (5, 0, 0)]


def test_a_transformation_begins_a_new_stroke_where_its_first_move_ends() -> None:
    draft = (
        Draft()
        .move(Kind.FEED, 10, 0, 0)
        .under(Context(transformation=ParallelAxes((0, 1, 2))))
        .move(Kind.FEED, 5, 5, 0)
    )
    draft.move(Kind.FEED, 6, 6, 0)
    last = list(strokes(draft.toolpath, XYZ))[-1]
    assert last.points == [(5, 5, 0), (5, 5, 0), (6, 6, 0)]


def test_an_axis_that_does_not_exist_counts_as_zero() -> None:
    draft = Draft(("X", "Z")).move(Kind.FEED, 10, 20)
    (stroke,) = strokes(draft.toolpath, (0, -1, 1))
    assert stroke.points[-1] == (10, 0, 20)


def test_a_clockwise_quarter_is_drawn_on_the_right_side() -> None:
    draft = Draft().move(Kind.FEED, 0, 10, 0).move(Kind.CW, 10, 0, 0, curve=(0, 0, 0, *Z_UP, 0))
    (stroke,) = strokes(draft.toolpath, XYZ)
    assert all(point[0] >= 0 and point[1] >= -1e-9 for point in stroke.points)
    assert len(stroke.points) > 10


def test_a_full_circle_goes_all_the_way_round() -> None:
    points = arc_points((10, 0, 0), (10, 0, 0), (0, 0, 0), Z_UP, 0, 0.01)
    way = sum(dist(a, b) for a, b in zip([(10.0, 0.0, 0.0), *points], points, strict=False))
    assert way == pytest.approx(2 * pi * 10, rel=1e-3)


def test_further_turns_are_drawn() -> None:
    once = arc_points((10, 0, 0), (10, 0, -3), (0, 0, 0), Z_UP, 0, 0.01)
    thrice = arc_points((10, 0, 0), (10, 0, -3), (0, 0, 0), Z_UP, 2, 0.01)
    assert len(thrice) == pytest.approx(3 * len(once), abs=3)


@given(
    radius=st.floats(0.1, 500),
    sweep=st.floats(1, 359),
    rise=st.floats(-50, 50),
    error=st.floats(0.001, 0.1),
)
def test_the_points_of_a_helix_lie_on_its_cylinder_and_climb_evenly(
    radius: float, sweep: float, rise: float, error: float
) -> None:
    end = (radius * cos(radians(sweep)), radius * sin(radians(sweep)), rise)
    points = arc_points((radius, 0, 0), end, (0, 0, 0), Z_UP, 0, error)
    assert points[-1] == end
    for k, (x, y, z) in enumerate(points, 1):
        assert (x * x + y * y) ** 0.5 == pytest.approx(radius)
        assert z == pytest.approx(rise * k / len(points), abs=1e-9)


def test_a_following_axis_is_drawn_where_it_is() -> None:
    led, bare = Coupled.of({1: [Ratio(0, 0.5)]}, XYZ), Coupled((), XYZ)
    coupled = Context(transformation=led, shown_by=Shown(led, bare))
    draft = Draft().move(Kind.RAPID, 10, 5, 0).under(coupled).move(Kind.FEED, 20, 0, 0)
    draft.under(Context()).move(Kind.FEED, 20, 0, 0)
    assert [stroke.points for stroke in strokes(draft.toolpath, XYZ)] == [
        [(10, 5, 0), (10, 5, 0)],
        [(10, 5, 0), (20, 10, 0), (20, 0, 0)],
    ]


PLANES = (
    "G90 G54\nG00 X0 Y0 Z10.\n{plane}\nG53.1\nG43 H1\nG01 X0 Y0 Z0 F1000\nX5. Y3.\nG49\nG69\n"
    "G52 X100.\nG01 X1. Y1. Z1.\nM30\n"
)


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill"])
@pytest.mark.parametrize("machine", ["mill5-ac-table", "mill5-bc-head"])
def test_tilted_planes_and_local_systems_are_drawn_on_the_work(control: str, machine: str) -> None:
    # The plane at X10 has X along -Z, Y along Y and Z along X of the work.
    program = PLANES.format(plane="G68.2 X10. Y0 Z0 I90. J90. K-90.")
    session = open_session(program, control=control, machine=machine, setup={"tools": {1: {"length": 50}}})
    result = session.run()
    assert result.ok, result.alarms
    found = [stroke.points[-1] for stroke in strokes(session.channel.toolpath, XYZ) if not stroke.rapid]
    corner = [
        point
        for stroke in strokes(session.channel.toolpath, XYZ)
        for point in stroke.points
        if dist(point, (10.0, 3.0, -5.0)) < 1e-9
    ]
    assert corner
    assert found[-1] == pytest.approx((101.0, 1.0, 1.0))


def test_tip_control_on_a_turned_table_is_drawn_on_the_work() -> None:
    program = "G90 G54 G00 C90.\nG43.4 H1\nG01 X10. Y0 Z0 F1000\nC0\nM30\n"
    setup = {"tools": {1: {"length": 50}}}
    drawn = {}
    for control in ("fanuc-m", "syntec-mill"):
        session = open_session(program, control=control, machine="mill5-ac-table", setup=setup)
        session.run()
        drawn[control] = list(strokes(session.channel.toolpath, XYZ))[-1].points[-1]
    # On FANUC the work system is that of the turned table: its X lies along -Y of the work at zero.
    assert drawn["syntec-mill"] == pytest.approx((10.0, 0.0, 0.0))
    assert drawn["fanuc-m"] == pytest.approx((0.0, -10.0, 0.0), abs=1e-9)
