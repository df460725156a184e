"""What a larger cutter has left: all of it is milled, and the cutter goes down in what is milled already."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.cycles.milling import region, residual
from polycnc.cycles.milling.contour_pocket import ContourPocket
from polycnc.cycles.milling.region import Loop
from polycnc.cycles.milling.stroke import MillStroke
from polycnc.geometry import distance, offset
from polycnc.geometry.arcs import Point
from polycnc.toolpath import Kind
from tests.cycles.milling.test_contour_pocket import NO_SHRINKING, circle, pocket, polygon

BOX = polygon((0.0, 0.0), (40.0, 0.0), (40.0, 20.0), (0.0, 20.0))
#: A box with a slot into which the larger cutter does not go.
KEYHOLE = polygon(
    (0.0, 0.0), (30.0, 0.0), (30.0, 7.0), (44.0, 7.0), (44.0, 14.0), (30.0, 14.0), (30.0, 20.0), (0.0, 20.0)
)
LARGE, SMALL = 5.0, 2.0


def small(*contours: Loop) -> ContourPocket:
    return pocket(*contours, radius=SMALL)


def ways(strokes: list[MillStroke], level: float) -> list[list[offset.Edge]]:
    """The cuts in the plane at a level, one list from rapid to rapid."""
    found: list[list[offset.Edge]] = []
    at, w = (0.0, 0.0), 0.0
    for stroke in strokes:
        end = stroke.point or at
        if stroke.w is not None:
            w = stroke.w
            found.append([])
        elif stroke.kind is not Kind.RAPID and w == level and end != at:
            if stroke.center is None:
                found[-1].append(offset.line(at, end))
            else:
                found[-1].append(offset.arc(at, end, stroke.center, stroke.kind is Kind.CCW))
        at = end
    return [way for way in found if way]


def test_the_corners_of_a_box_are_milled_from_clear_place_to_clear_place() -> None:
    found = ways(list(residual.rough(small(BOX), [-4.0], LARGE)), -4.0)
    assert len(found) == 4
    for way in found:
        assert [edge.length for edge in way] == pytest.approx([3.0, 3.0], abs=0.2)
        for place in (way[0].start, way[-1].end):
            # Within the circle of the larger cutter in the corner of its loop.
            corner = (5.0 if place[0] < 20.0 else 35.0, 5.0 if place[1] < 10.0 else 15.0)
            assert hypot(place[0] - corner[0], place[1] - corner[1]) <= LARGE - SMALL + 0.01


def test_every_level_is_milled() -> None:
    strokes = list(residual.rough(small(BOX), [-2.0, -4.0], LARGE))
    assert len(ways(strokes, -2.0)) == len(ways(strokes, -4.0)) == 4


def test_an_area_that_the_larger_cutter_does_not_reach_is_gone_into() -> None:
    alone = polygon((0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0))
    (way,) = ways(list(residual.rough(small(alone), [-4.0], LARGE)), -4.0)
    assert way[0].start == way[-1].end


def covered(shape: ContourPocket, larger: list[Loop], path: list[offset.Edge], point: Point) -> bool:
    """Whether the larger cutter has reached a point, or the cutter has passed over it."""
    if any(distance.of_point(point, edge) <= shape.radius + 0.02 for edge in path):
        return True
    if not larger:
        return False
    inside = region.clearance(shape.walls, point) >= LARGE + shape.allowance
    return inside or region.clearance(larger, point) <= LARGE + 0.02


@pytest.mark.parametrize("allowance", [0.0, 0.4])
@pytest.mark.parametrize("contours", [(BOX,), (KEYHOLE,), (KEYHOLE, circle((15.0, 10.0), 3.0))])
def test_nothing_is_left_that_the_cutter_reaches(contours: tuple[Loop, ...], allowance: float) -> None:
    shape = replace(small(*contours), allowance=allowance)
    found = ways(list(residual.rough(shape, [-4.0], LARGE)), -4.0)
    _check(shape, found)


def _check(shape: ContourPocket, found: list[list[offset.Edge]]) -> None:
    loops = region.loops_at(shape.walls, shape.off)
    larger = region.loops_at(shape.walls, LARGE + shape.allowance)
    path = [edge for way in found for edge in way]
    for x in range(1, 45, 2):
        for y in range(1, 30):
            point = (x + 0.13, y + 0.29)
            if not region.is_free(shape.walls, point):
                continue
            inside = region.clearance(shape.walls, point) >= shape.off
            if inside or region.clearance(loops, point) <= shape.radius - 0.02:
                assert covered(shape, larger, path, point), point
    for way in found:
        for edge in way:
            assert region.room_along(shape.walls, edge) >= shape.off - 1e-3


@settings(max_examples=3, phases=NO_SHRINKING)
@given(st.lists(st.integers(-2, 2), min_size=8, max_size=8))
def test_nothing_is_left_of_any_pocket(moved: list[int]) -> None:
    places = [(0, 0), (14, 0), (28, 0), (28, 12), (28, 24), (14, 24), (0, 24), (0, 12)]
    shape = small(polygon(*((x + float(m), y + 0.7 * m) for (x, y), m in zip(places, moved, strict=True))))
    _check(shape, ways(list(residual.rough(shape, [-4.0], LARGE)), -4.0))
