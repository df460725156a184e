"""Contour pockets and spigots: what is cut, what is not, and how the cutter gets in."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, pi, sin

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from polycnc.cycles.milling import contour_pocket, region
from polycnc.cycles.milling.contour_pocket import ContourPocket, InsertionError
from polycnc.cycles.milling.pockets import Insertion
from polycnc.cycles.milling.region import Loop, RegionError
from polycnc.cycles.milling.stroke import MillStroke
from polycnc.geometry import arcs, distance, offset
from polycnc.geometry.arcs import Point
from polycnc.toolpath import Kind

NEAR = 1e-4
#: A failing pocket is drawn in no time, but shrunk in minutes.
NO_SHRINKING = (Phase.explicit, Phase.reuse, Phase.generate)


def polygon(*corners: Point) -> Loop:
    return [offset.line(a, b) for a, b in pairwise([*corners, corners[0]])]


def circle(middle: Point, radius: float) -> Loop:
    start = (middle[0] + radius, middle[1])
    return [offset.arc(start, start, middle, ccw=True)]


PLATE = polygon((0.0, 0.0), (60.0, 0.0), (60.0, 40.0), (0.0, 40.0))
ISLAND = circle((30.0, 20.0), 5.0)


def pocket(*contours: Loop, spigot: bool = False, radius: float = 4.0, **more: object) -> ContourPocket:
    outline, *islands = region.walls(contours[0], contours[1:], free_outside=spigot)
    blank = outline if spigot else None
    walls = islands if spigot else [outline, *islands]
    made = ContourPocket(
        walls,
        blank,
        radius,
        step=3.0,
        keeps_sense=True,
        feed=500.0,
        depth_feed=100.0,
        reference=0.0,
        safe=2.0,
        retract=50.0,
        clearance=2.0,
    )
    return replace(made, **more)  # type: ignore[arg-type]


def cuts(strokes: list[MillStroke], level: float) -> Loop:
    """Edges that are cut at a level; rapids at it would be a collision."""
    at: Point | None = None
    w = 50.0
    found: Loop = []
    for stroke in strokes:
        point = stroke.point or at
        if stroke.kind is Kind.RAPID:
            assert stroke.point is None or w >= 2.0
        elif at is not None and point is not None and (stroke.w is None or stroke.w == w) and w == level:
            if stroke.center is not None:
                found.append(offset.arc(at, point, stroke.center, stroke.kind is Kind.CCW))
            elif point != at:
                found.append(offset.line(at, point))
        at, w = point, stroke.w if stroke.w is not None else w
    return found


def sweep(made: ContourPocket, path: Loop) -> None:
    """The path keeps off every wall, and reaches every place that the cutter could."""
    for edge in path:
        assert region.room_along(made.walls, edge) >= made.off - NEAR
    u0, v0, u1, v1 = region.bounds(made.walls)
    for i in range(19):
        for j in range(19):
            middle = (u0 + (u1 - u0) * (i + 0.37) / 19, v0 + (v1 - v0) * (j + 0.61) / 19)
            if not region.is_free(made.walls, middle, free_outside=made.blank is not None):
                continue
            if made.blank is not None and not region.contains(made.blank, middle):
                continue
            if region.clearance(made.walls, middle) >= made.off:
                assert min(distance.of_point(middle, edge) for edge in path) <= made.radius + NEAR


def test_a_pocket_with_an_island_is_cleared_and_nothing_else() -> None:
    made = pocket(PLATE, ISLAND, allowance=0.5)
    strokes = list(contour_pocket.rough(made, [-2.5, -5.0]))
    assert strokes[0] == MillStroke(Kind.RAPID, None, 50.0)
    assert strokes[-1] == MillStroke(Kind.RAPID, None, 50.0)
    for level in (-2.5, -5.0):
        sweep(made, cuts(strokes, level))


@settings(deadline=None, max_examples=25, phases=NO_SHRINKING)
@given(
    st.lists(st.floats(14.0, 40.0), min_size=4, max_size=9),
    st.lists(st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0), st.floats(0.5, 4.0)), max_size=3),
    st.floats(1.0, 5.0),
    st.floats(0.5, 12.0),
    st.booleans(),
)
def test_any_pocket_is_cleared_and_nothing_else(
    reaches: list[float],
    islands: list[tuple[float, float, float]],
    radius: float,
    step: float,
    keeps: bool,
) -> None:
    count = len(reaches)
    outline = polygon(
        *((r * cos(2.0 * pi * k / count), r * sin(2.0 * pi * k / count)) for k, r in enumerate(reaches))
    )
    shapes = [outline]
    for u, v, size in islands:
        if all(
            min(distance.of_point((u, v), edge) for edge in shape) > size + 0.1
            and not (shape is not outline and region.contains(shape, (u, v)))
            for shape in shapes
        ):
            shapes.append(region.walls(circle((u, v), size))[0])
    made = pocket(*shapes, radius=radius, step=step, keeps_sense=keeps)
    try:
        strokes = list(contour_pocket.rough(made, [-1.0]))
    except RegionError as error:
        assert str(error) == "narrow"  # noqa: PT017 - other reasons are mistakes
        return
    sweep(made, cuts(strokes, -1.0))


@settings(deadline=None, max_examples=15, phases=NO_SHRINKING)
@given(st.lists(st.floats(5.0, 18.0), min_size=3, max_size=8), st.floats(1.0, 5.0), st.floats(0.5, 6.0))
def test_any_spigot_is_left_and_the_blank_round_it_cleared(
    reaches: list[float], radius: float, step: float
) -> None:
    count = len(reaches)
    outline = polygon(
        *((r * cos(2.0 * pi * k / count), r * sin(2.0 * pi * k / count)) for k, r in enumerate(reaches))
    )
    blank = polygon((-25.0, -25.0), (25.0, -25.0), (25.0, 25.0), (-25.0, 25.0))
    made = pocket(blank, outline, spigot=True, radius=radius, step=step)
    strokes = list(contour_pocket.rough(made, [-1.0]))
    path = cuts(strokes, -1.0)
    sweep(made, path)
    first = next(stroke.point for stroke in strokes if stroke.point is not None)
    assert first is not None
    assert not region.contains(region.walls(blank)[0], first)
    assert min(distance.of_point(first, edge) for edge in blank) >= radius


def test_two_pockets_each_get_their_own_way_in() -> None:
    dumbbell = polygon(
        (0.0, 0.0), (20.0, 0.0), (20.0, 8.0), (30.0, 8.0), (30.0, 0.0), (50.0, 0.0), (50.0, 20.0), (30.0, 20.0),
        (30.0, 12.0), (20.0, 12.0), (20.0, 20.0), (0.0, 20.0),
    )  # fmt: skip
    made = pocket(dumbbell)
    assert len(contour_pocket.areas(made)) == 2
    assert len(contour_pocket.entries(made)) == 2
    sweep(made, cuts(list(contour_pocket.rough(made, [-1.0])), -1.0))


def test_the_sense_is_turned_for_up_cut_milling() -> None:
    for keeps in (True, False):
        made = pocket(PLATE, ISLAND, keeps_sense=keeps)
        (outer,) = contour_pocket.areas(made)
        assert sorted(region.area(ring.loop) > 0.0 for ring in outer) == [False, True]
        biggest = max(outer, key=lambda ring: abs(region.area(ring.loop)))
        assert (region.area(biggest.loop) > 0.0) is keeps


def test_a_helix_goes_down_by_the_pitch_and_stays_off_the_walls() -> None:
    made = pocket(PLATE, insertion=Insertion.HELIX, helix=3.0, pitch=1.0)
    strokes = list(contour_pocket.rough(made, [-2.5]))
    turns = [stroke for stroke in strokes if stroke.center is not None and stroke.w is not None]
    assert [stroke.w for stroke in turns] == pytest.approx([-2.5 / 3.0, -5.0 / 3.0, -2.5])
    middle = turns[0].center
    assert middle is not None
    assert region.clearance(made.walls, middle) >= made.off + 3.0 - NEAR
    with pytest.raises(InsertionError):
        list(contour_pocket.rough(replace(made, helix=40.0), [-2.5]))


def test_an_oscillation_is_no_steeper_than_its_angle() -> None:
    made = pocket(PLATE, insertion=Insertion.OSCILLATION, angle_deg=2.0)
    at, w = None, 50.0
    slopes = []
    for stroke in contour_pocket.rough(made, [-2.0, -4.0]):
        if at is not None and stroke.point is not None and stroke.w is not None:
            slopes.append((w - stroke.w) / hypot(stroke.point[0] - at[0], stroke.point[1] - at[1]))
        at, w = stroke.point or at, stroke.w if stroke.w is not None else w
    assert slopes
    assert max(slopes) <= 0.03493


def test_edges_are_finished_at_every_level_and_the_cutter_comes_and_goes_off_the_wall() -> None:
    made = pocket(PLATE, ISLAND, step=0.5)
    strokes = list(contour_pocket.finish_edges(made, [-2.0, -4.0]))
    for level in (-2.0, -4.0):
        path = cuts(strokes, level)
        for edge in path:
            assert region.room_along(made.walls, edge) >= made.radius - NEAR
        for loop in region.loops_at(made.walls, made.radius):
            for edge in loop:
                assert min(distance.of_point(edge.start, other) for other in path) <= NEAR
    plunges = [k for k, stroke in enumerate(strokes) if stroke.feed == 100.0]
    assert len(plunges) == 4


def test_contours_that_are_open_or_cross_are_refused() -> None:
    with pytest.raises(RegionError, match="open"):
        region.walls(PLATE[:-1])
    with pytest.raises(RegionError, match="crossing"):
        region.walls(PLATE, [circle((60.0, 20.0), 5.0)])
    with pytest.raises(RegionError, match="crossing"):
        region.walls(polygon((0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 12.0)))
    with pytest.raises(RegionError, match="nested"):
        region.walls(PLATE, [circle((90.0, 20.0), 5.0)])
    with pytest.raises(RegionError, match="nested"):
        region.walls(PLATE, [circle((30.0, 20.0), 9.0), circle((30.0, 20.0), 3.0)])
    with pytest.raises(RegionError, match="narrow"):
        contour_pocket.areas(pocket(PLATE, radius=21.0))


def test_a_slot_as_wide_as_the_cutter_is_cut_along_its_middle() -> None:
    slot = polygon((0.0, 0.0), (30.0, 0.0), (30.0, 8.0), (0.0, 8.0))
    made = pocket(slot)
    path = cuts(list(contour_pocket.rough(made, [-1.0])), -1.0)
    assert {round(p[1], 6) for edge in path for p in (edge.start, edge.end)} == {4.0}
    assert {round(max(edge.start[0] for edge in path), 6), round(min(edge.start[0] for edge in path), 6)} == {
        4.0,
        26.0,
    }


def test_a_loop_knows_what_it_contains_with_arcs() -> None:
    moon = [
        offset.arc((10.0, 0.0), (-10.0, 0.0), (0.0, 0.0), ccw=True),
        offset.arc((-10.0, 0.0), (10.0, 0.0), (0.0, -5.0), ccw=False),
    ]
    assert region.contains(moon, (0.0, 8.0))
    assert not region.contains(moon, (0.0, 3.0))
    assert not region.contains(moon, (0.0, -3.0))
    assert region.area(moon) == pytest.approx(pi * 100.0 / 2.0 - _segment(hypot(10.0, 5.0), 10.0))


@given(st.floats(-9.0, 9.0), st.floats(-9.0, 9.0), st.floats(0.0, 360.0), st.booleans())
def test_a_circle_of_two_arcs_contains_what_is_nearer_than_its_radius(
    u: float, v: float, turned: float, ccw: bool
) -> None:
    start = arcs.point_at((0.0, 0.0), 7.0, turned)
    end = (-start[0], -start[1])
    loop = [offset.arc(start, end, (0.0, 0.0), ccw), offset.arc(end, start, (0.0, 0.0), ccw)]
    if abs(hypot(u, v) - 7.0) > NEAR:
        assert region.contains(loop, (u, v)) is (hypot(u, v) < 7.0)


def _segment(radius: float, half_chord: float) -> float:
    half = arcs.sweep_angle((half_chord, 5.0), (-half_chord, 5.0), (0.0, 0.0), ccw=True)
    return 0.5 * radius * radius * (half - sin(half))


@pytest.mark.parametrize("count", [60, 400])
def test_a_contour_of_short_lines_is_followed_as_a_curve(count: int) -> None:
    def place(k: int) -> Point:
        turned = 2.0 * pi * (k % count) / count
        return arcs.point_at((0.0, 0.0), 30.0 + 6.0 * sin(5.0 * turned), turned)

    made = pocket(polygon(*(place(k) for k in range(count))))
    (area,) = contour_pocket.areas(made)
    done = contour_pocket.passes(made, area)
    assert sum(not one.is_linked for one in done) == 1
    for one in done:
        for edge in one.loop[:: max(len(one.loop) // 20, 1)]:
            assert region.clearance(made.walls, edge.start) == pytest.approx(one.away, abs=NEAR)
