from __future__ import annotations

from itertools import pairwise

import pytest

from polycnc.control.sinumerik.contours.elements import Element, Side
from polycnc.geometry import arcs, offset

OUTSIDE, FACE = Side(across=False, sign=1.0), Side(across=True, sign=1.0)


@pytest.mark.parametrize(
    ("start", "end", "angle"),
    [
        ((20, 150), (30, 110), 104.0362435),
        ((70, 50), (85, 40), 146.3099325),
        ((85, 40), (90, 30), 116.5650512),
        ((20, 45), (0, 45), 0.0),
        ((0, 45), (20, 45), 0.0),
        ((20, 45), (0, 45 - 1e-13), 0.0),
        ((100, 100), (20, 20), 45.0),
        ((0, 150), (0, 20), 90.0),
    ],
)
def test_angles_of_lines_are_those_of_the_manual(
    start: tuple[float, float], end: tuple[float, float], angle: float
) -> None:
    assert OUTSIDE.angle(offset.line(start, end)) == pytest.approx(angle)
    assert OUTSIDE.angle(offset.line(end, start)) == pytest.approx(angle)


def test_angle_of_an_arc_is_the_greatest_of_its_tangents() -> None:
    assert OUTSIDE.angle(offset.arc((30, 65), (45, 50), (45, 65), ccw=True)) == pytest.approx(180.0)
    assert OUTSIDE.angle(offset.arc((0, 45), (-15, 30), (-15, 45), ccw=False)) == pytest.approx(90.0)
    assert OUTSIDE.angle(offset.arc((-15, 30), (0, 45), (-15, 45), ccw=True)) == pytest.approx(90.0)


def test_face_angles_are_those_of_the_swapped_contour() -> None:
    edge = offset.arc((10, 0), (6, 8), (0, 0), ccw=True)
    swapped = offset.arc((0, 10), (8, 6), (0, 0), ccw=False)
    assert FACE.angle(edge) == pytest.approx(OUTSIDE.angle(swapped))
    assert FACE.angle(offset.line((0, 0), (3, 1))) == pytest.approx(
        OUTSIDE.angle(offset.line((0, 0), (1, 3)))
    )


@pytest.mark.parametrize("side", [OUTSIDE, FACE, Side(across=True, sign=-1.0)])
@pytest.mark.parametrize("ccw", [True, False])
def test_slopes_of_an_arc_rise_or_fall_and_join(side: Side, ccw: bool) -> None:
    start, end = (6.0, 8.0), (10.0, 0.0)
    parts = side.slopes(Element(offset.arc(start, end, (0.0, 0.0), ccw), 10))
    assert parts[0].edge.start == start
    assert parts[-1].edge.end == end
    for before, behind in pairwise(parts):
        assert before.edge.end == behind.edge.start
    for part in parts:
        heights = [
            side.height(arcs.point_on_arc(part.edge.start, part.edge.end, (0.0, 0.0), ccw, k / 16))
            for k in range(17)
        ]
        assert heights in (sorted(heights), sorted(heights, reverse=True))


def test_a_rising_edge_is_met_at_a_height() -> None:
    arc = offset.arc((0.0, -10.0), (10.0, 0.0), (0.0, 0.0), ccw=True)
    assert OUTSIDE.at_height(arc, -6.0) == pytest.approx((8.0, -6.0))
    assert FACE.at_height(arc, 6.0) == pytest.approx((6.0, -8.0))
    assert OUTSIDE.at_height(offset.line((0, 0), (10, 20)), 5.0) == pytest.approx((2.5, 5.0))
