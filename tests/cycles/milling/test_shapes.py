"""Pockets, slots, faces, spigots, contours and milled threads as strokes."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.milling import contour as path_milling
from polycnc.cycles.milling import facing, pockets, slots, spigots
from polycnc.cycles.milling import thread as thread_milling
from polycnc.cycles.milling.contour import Approach, ApproachShape, PathMilling
from polycnc.cycles.milling.pockets import Insertion, Pocket
from polycnc.cycles.milling.slots import Curved, Slotting, Straight
from polycnc.cycles.milling.stroke import MillStroke, Place, ring, steps
from polycnc.cycles.turning.contour import Piece
from polycnc.geometry import arcs, offset
from polycnc.toolpath import Kind


def walk(strokes: Iterable[MillStroke], samples: int = 24) -> list[tuple[float, float, float, Kind]]:
    """Points along strokes with their level; arcs are sampled."""
    at, w = (0.0, 0.0), 0.0
    result = []
    for stroke in strokes:
        end = stroke.point or at
        level = w if stroke.w is None else stroke.w
        for k in range(1, samples + 1):
            part = k / samples
            if stroke.center is None:
                point = (at[0] + part * (end[0] - at[0]), at[1] + part * (end[1] - at[1]))
            else:
                point = arcs.point_on_arc(at, end, stroke.center, stroke.kind is Kind.CCW, part)
            result.append((*point, w + part * (level - w), stroke.kind))
        at, w = end, level
    return result


def is_true_arc(strokes: Iterable[MillStroke]) -> bool:
    """Whether every arc begins and ends equally far from its centre."""
    at = (0.0, 0.0)
    for stroke in strokes:
        end = stroke.point or at
        if stroke.center is not None and abs(arcs.radius_mismatch(at, end, stroke.center)) > 1e-9:
            return False
        at = end
    return True


def pocket(half_length: float, half_width: float, corner: float, radius: float, **changes: object) -> Pocket:
    values = {
        "reference": 0.0, "safe": 2.0, "retract": 10.0, "depth": -6.0, "infeed": 2.5, "width": 1.6 * radius,
        "feed": 500.0, "depth_feed": 100.0, "ccw": True, **changes,
    }  # fmt: skip
    return Pocket(Place(), half_length, half_width, corner, radius, **values)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("total", "most", "count"), [(6.0, 2.5, 3), (6.0, 2.0, 3), (6.0, 0.0, 1), (6.0, 9.0, 1)]
)
def test_steps_are_equal_and_as_few_as_possible(total: float, most: float, count: int) -> None:
    found = steps(total, most)
    assert found == pytest.approx([total * k / count for k in range(1, count + 1)])


SHAPES = st.tuples(st.floats(10.0, 60.0), st.floats(10.0, 60.0), st.floats(0.0, 1.0), st.floats(1.0, 9.0))


@given(SHAPES, st.booleans(), st.sampled_from(list(Insertion)))
def test_a_pocket_is_never_left_while_the_tool_is_down(
    shape: tuple[float, float, float, float], ccw: bool, insertion: Insertion
) -> None:
    length, width, part, radius = shape
    length, width = max(length, width), min(length, width)
    corner = radius + part * (width - radius)
    work = pocket(
        length,
        width,
        corner,
        radius,
        ccw=ccw,
        insertion=insertion,
        insertion_size=0.4 * (width - radius) + 0.1,
        pitch=1.0,
    )
    for strokes in (list(pockets.rough(work)), list(pockets.finish(work))):
        assert is_true_arc(strokes)
        for x, y, w, kind in walk(strokes):
            if w < 0.0 and kind is not Kind.RAPID:
                assert abs(x) <= length - radius + 1e-6
                assert abs(y) <= width - radius + 1e-6
                beyond = (abs(x) - (length - corner), abs(y) - (width - corner))
                if min(beyond) > 0.0:
                    assert hypot(*beyond) <= corner - radius + 1e-6


@given(SHAPES)
def test_roughing_leaves_no_island_in_a_pocket(shape: tuple[float, float, float, float]) -> None:
    length, width, _, radius = shape
    length, width = max(length, width), min(length, width)
    work = pocket(length, width, radius, radius, infeed=0.0)
    path = np.array([(x, y) for x, y, w, _ in walk(pockets.rough(work), 160) if w < -5.9])
    for i in range(-4, 5):
        for j in range(-4, 5):
            x, y = i / 4.5 * (length - radius), j / 4.5 * (width - radius)
            assert np.hypot(*(path - (x, y)).T).min() <= radius + 0.5


def test_what_is_milled_out_already_is_left_out() -> None:
    full = list(pockets.rough(pocket(40.0, 40.0, 40.0, 5.0, infeed=0.0)))
    ring_only = list(
        pockets.rough(pocket(40.0, 40.0, 40.0, 5.0, infeed=0.0, core_length=50.0, core_depth=6.0))
    )
    assert len(ring_only) < len(full)


@given(st.floats(1.0, 20.0), st.floats(0.0, 15.0), st.floats(0.0, 1.0), st.booleans())
def test_a_ring_closes(half_length: float, more: float, part: float, ccw: bool) -> None:
    a, b = half_length + more, half_length
    place = Place((5.0, -3.0), 33.0)
    strokes = [MillStroke(Kind.RAPID, place(a, 0.0)), *ring(place, a, b, part * b, ccw, 1.0)]
    assert strokes[-1].point == pytest.approx(place(a, 0.0))
    assert is_true_arc(strokes)


def slotting(**changes: object) -> Slotting:
    values = {
        "half_width": 6.0, "radius": 5.0, "reference": 0.0, "safe": 2.0, "retract": 10.0, "depth": -6.0, "infeed": 3.0,
        "finishing_infeed": 0.0, "allowance": 0.2, "base_allowance": 0.0, "feed": 500.0, "depth_feed": 100.0,
        "finishing_feed": 400.0, "ccw": True, **changes,
    }  # fmt: skip
    return Slotting(**values)  # type: ignore[arg-type]


@pytest.mark.parametrize("insertion", [Insertion.RAPID, Insertion.FEED, Insertion.OSCILLATION])
@pytest.mark.parametrize("ccw", [True, False])
def test_a_straight_slot_keeps_its_width_and_length(insertion: Insertion, ccw: bool) -> None:
    work = slotting(insertion=insertion, steepest_deg=5.0, ccw=ccw)
    strokes = [*slots.rough(work, Straight(Place(), 30.0)), *slots.finish(work, Straight(Place(), 30.0))]
    assert is_true_arc(strokes)
    down = [(x, y, w) for x, y, w, _ in walk(strokes) if w < 0.0]
    assert max(abs(y) for _, y, _ in down) == pytest.approx(1.0)
    assert (min(x for x, _, _ in down), max(x for x, _, _ in down)) == pytest.approx((-1.0, 31.0))
    assert min(w for _, _, w in down) == pytest.approx(-6.0)


@pytest.mark.parametrize("ccw", [True, False])
def test_a_curved_slot_keeps_its_width(ccw: bool) -> None:
    work = slotting(ccw=ccw)
    strokes = list(slots.finish(work, Curved(Place(), 40.0, 60.0)))
    assert is_true_arc(strokes)
    radii = [hypot(x, y) for x, y, w, _ in walk(strokes) if w < 0.0]
    assert (min(radii), max(radii)) == pytest.approx((39.0, 41.0))


def face(*, width: float, step: float, overrun: float, across: bool, alternating: bool) -> facing.Face:
    return facing.Face(
        Place(),
        60.0,
        width,
        5.0,
        step,
        overrun,
        0.0,
        across,
        alternating,
        feed=1.0,
        safe=2.0,
        retract=9.0,
    )


def test_strips_cover_a_face_and_leave_it_by_the_overrun() -> None:
    strips = face(width=-20.0, step=8.0, overrun=3.0, across=False, alternating=True).strips()
    assert len(strips) == 3
    assert strips[0][0] == pytest.approx((-8.0, -(20.0 / 3.0 - 5.0)))
    assert strips[0][1] == pytest.approx((68.0, -(20.0 / 3.0 - 5.0)))
    assert strips[-1][0][1] == pytest.approx(-15.0)


def test_strips_in_one_direction_return_over_the_face() -> None:
    one_way = face(width=20.0, step=10.0, overrun=0.0, across=True, alternating=False)
    strokes = list(facing.face(one_way, [-6.0]))
    w = 0.0
    for stroke in strokes[1:]:
        w = w if stroke.w is None else stroke.w
        assert stroke.kind is Kind.FEED or stroke.point is None or w >= 2.0
    cuts = [s.point for s in strokes if s.kind is Kind.FEED and s.point is not None]
    assert [point[1] for point in cuts] == pytest.approx([25.0] * 6)


@given(st.floats(5.0, 40.0), st.floats(5.0, 40.0), st.floats(0.0, 1.0), st.booleans())
def test_a_spigot_is_never_cut_into(half_length: float, half_width: float, part: float, ccw: bool) -> None:
    corner = part * min(half_length, half_width)
    shape = spigots.Spigot(
        Place(), spigots.Rectangle(half_length, half_width, corner),
        half_length + 3.0, 5.0, 1.0, ccw, 500.0, 100.0, 2.0, 10.0,
    )  # fmt: skip
    strokes = list(spigots.mill(shape, [-3.0, -6.0]))
    assert is_true_arc(strokes)
    for x, y, w, _ in walk(strokes):
        if w < 0.0:
            inside = max(abs(x) - (half_length - corner), 0.0), max(abs(y) - (half_width - corner), 0.0)
            assert hypot(*inside) >= corner + 5.0 - 1e-6


@given(st.integers(3, 9), st.floats(5.0, 40.0), st.floats(0.0, 1.0), st.booleans())
def test_a_polygon_is_never_cut_into(count: int, inner: float, part: float, ccw: bool) -> None:
    shape = spigots.Spigot(
        Place(), spigots.Polygon(count, inner, part * inner),
        2.0 * inner + 3.0, 5.0, 1.0, ccw, 500.0, 500.0, 2.0, 10.0,
    )  # fmt: skip
    strokes = list(spigots.mill(shape, [-3.0]))
    assert is_true_arc(strokes)
    sides = [2.0 * pi * k / count for k in range(count)]
    corner = part * inner
    for x, y, w, _ in walk(strokes):
        if w < 0.0:
            # The distance from the polygon shrunk by its corner radius is that radius and the tool's.
            assert max(x * cos(side) + y * sin(side) for side in sides) >= inner - corner - 1e-6
            assert hypot(x, y) >= inner + 5.0 - 1e-6


def contour() -> list[Piece]:
    corners = [(0.0, 0.0), (30.0, 0.0), (30.0, 20.0)]
    return [Piece(offset.line(a, b)) for a, b in pairwise(corners)]


@pytest.mark.parametrize(
    ("way", "begin"),
    [
        (ApproachShape.STRAIGHT, (-8.0, 0.0)),
        (ApproachShape.QUARTER, (-8.0, 8.0)),
        (ApproachShape.HALF, (0.0, 16.0)),
    ],
)
def test_an_approach_touches_the_contour(way: ApproachShape, begin: tuple[float, float]) -> None:
    work = PathMilling(
        contour(), 1.0, Approach(way, 8.0), Approach(way, 8.0), 500.0, 100.0, 0.0, [10.0], 2.0, 10.0
    )
    strokes = list(path_milling.mill(work, [-5.0]))
    assert strokes[0].point == pytest.approx(begin)
    assert is_true_arc(strokes)
    assert strokes[3].point == pytest.approx((0.0, 0.0))


def test_a_thread_keeps_its_pitch_on_all_of_its_way() -> None:
    thread = thread_milling.MilledThread(
        Place(), 10.0, 1.5, 0.0, -6.0, ccw=True, inside=True, clearance=6.0, feed=300.0, retract=10.0
    )
    strokes = list(thread_milling.mill(thread))
    assert is_true_arc(strokes)
    levels = [stroke.w for stroke in strokes]
    assert levels == pytest.approx([None, 0.75, 0.0, -1.5, -3.0, -4.5, -6.0, -6.75, 10.0])
