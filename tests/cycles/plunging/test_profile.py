"""Profiles: heights for the point of a tool, compared with the tool set down on the contour by trial."""

from __future__ import annotations

from itertools import pairwise
from math import sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.cycles.plunging.profile import (
    Profile,
    dilated,
    envelope,
    level,
    of_tool,
    profile,
    stretches,
    swept,
    upright,
    widened,
)
from polycnc.cycles.turning.contour import Contour, Piece
from polycnc.geometry import offset

Point = tuple[float, float]
#: A groove 10 wide and 5 deep.
GROOVE = ((0.0, 10.0), (2.0, 10.0), (2.0, 5.0), (12.0, 5.0), (12.0, 10.0), (15.0, 10.0))


def lines(*corners: Point) -> Contour:
    return [Piece(offset.line(a, b)) for a, b in pairwise(corners)]


def test_a_contour_is_turned_upright() -> None:
    bore = [
        Piece(offset.line((0.0, 20.0), (-5.0, 25.0))),
        Piece(offset.arc((-5.0, 25.0), (-10.0, 20.0), (-10.0, 25.0), False)),
    ]
    first, second = (piece.edge for piece in upright(bore, 1.0))
    assert (first.start, first.end, first.center, first.ccw) == (
        (-10.0, -20.0),
        (-5.0, -25.0),
        (-10.0, -25.0),
        False,
    )
    assert (second.start, second.end) == ((-5.0, -25.0), (0.0, -20.0))


def test_what_runs_back_or_nowhere_has_no_heights() -> None:
    with pytest.raises(ValueError, match="overhang"):
        profile(lines((0.0, 5.0), (5.0, 3.0), (4.0, 0.0), (8.0, 5.0)), 5.0)
    with pytest.raises(ValueError, match="no way"):
        profile(lines((0.0, 5.0), (0.0, 3.0)), 5.0)


def test_a_tool_goes_down_between_the_walls() -> None:
    floor = of_tool(profile(lines(*GROOVE), 10.0), 0.0, 3.0)
    assert stretches(level(10.0, 0.0, 12.0), floor) == [pytest.approx((2.0, 9.0), abs=1e-4)]
    assert floor.height(5.0) == pytest.approx(5.0)
    assert floor.height(1.0) == pytest.approx(10.0)


def test_stock_on_walls_and_base() -> None:
    floor = of_tool(widened(profile(lines(*GROOVE), 10.0), 0.2, 0.5), 0.0, 3.0)
    assert stretches(level(10.0, 0.0, 12.0), floor) == [pytest.approx((2.2, 8.8), abs=1e-4)]
    assert floor.height(5.0) == pytest.approx(5.5)


def test_a_tool_as_wide_as_the_groove_has_one_place() -> None:
    floor = of_tool(profile(lines(*GROOVE[1:5]), 10.0), 0.0, 10.0)
    ((low, high),) = stretches(level(10.0, 1.0, 3.0), floor)
    assert low == pytest.approx(2.0, abs=1e-4)
    assert 0.0 < high - low < 1e-4


def test_arcs_keep_their_shape() -> None:
    hill = profile([Piece(offset.arc((0.0, 0.0), (10.0, 0.0), (5.0, 0.0), False))], 0.0)
    assert dilated(hill, 1.0).height(5.0) == pytest.approx(6.0)
    assert swept(hill, 4.0).height(2.0) == pytest.approx(5.0)
    valley = profile([Piece(offset.arc((0.0, 5.0), (10.0, 5.0), (5.0, 5.0), True))], 5.0)
    assert dilated(valley, 1.0).height(5.0) == pytest.approx(1.0)
    # A circle larger than the valley lies on its rims.
    assert dilated(valley, 6.0).height(5.0) == pytest.approx(5.0 + sqrt(36.0 - 25.0))


def _set_down(corners: list[Point], radius: float, width: float, a: float) -> float:
    """Height at which a tool comes to lie on points of a contour."""
    height = -1e9
    for p, q in pairwise(corners):
        for k in range(401):
            u, h = (x + (y - x) * k / 400.0 for x, y in zip(p, q, strict=True))
            if -1e-9 <= u - a <= width + 1e-9:
                beside = max(radius - (u - a), u - a - (width - radius), 0.0)
                height = max(height, h - radius + sqrt(max(radius**2 - beside**2, 0.0)))
    return height


@settings(max_examples=25)
@given(
    st.lists(st.tuples(st.sampled_from((0.0, 0.7, 2.0, 4.0)), st.floats(-6.0, 6.0)), min_size=2, max_size=6),
    st.sampled_from((0.0, 0.3)),
    st.sampled_from((1.0, 2.5)),
)
def test_the_tool_lies_on_the_contour(ways: list[tuple[float, float]], radius: float, width: float) -> None:
    corners = [(0.0, 8.0)]
    for along, up in ways:
        a, h = corners[-1]
        corners.append((a + along, max(h + up, 0.0)))
    end = corners[-1][0]
    if end < width + 1.0:
        return
    top = max(h for _, h in corners) + 1.0
    floor = of_tool(profile(lines(*corners), top), radius, width)
    closed = [(0.0, top), *corners, (end, top)]
    for k in range(1, 12):
        a = (end - width) * (k + 0.137) / 13.0
        assert floor.height(a) == pytest.approx(_set_down(closed, radius, width, a), abs=0.1)


def test_a_gap_is_an_error() -> None:
    with pytest.raises(ValueError, match="gap"):
        envelope([offset.line((0.0, 0.0), (1.0, 0.0)), offset.line((2.0, 0.0), (3.0, 0.0))])
    assert (
        Profile(envelope([offset.line((0.0, 0.0), (2.0, 2.0)), offset.line((0.0, 2.0), (2.0, 0.0))])).height(
            1.0
        )
        == 1.0
    )


def test_what_rounding_leaves_of_a_crossing_is_no_curve_and_no_gap() -> None:
    sliver, end = 4e-7, (10.0, 5.0)
    curves = [offset.line((0.0, 5.0), (4.0, 5.0)), offset.line((4.0, 5.0), (4.0 + sliver, 5.0))]
    split = Profile((*curves, offset.line((4.0 + sliver, 5.0), end)))
    assert [piece.edge.end for piece in split.between(0.0, 10.0)] == [(4.0, 5.0), end]
    for gap in (sliver, 5e-5):
        bridged = Profile(envelope([curves[0], offset.line((4.0 + gap, 5.0), end)]))
        assert (bridged.begin, bridged.end) == (0.0, 10.0)
        assert bridged.height(4.0 + 0.5 * gap) == pytest.approx(5.0)
    with pytest.raises(ValueError, match="gap"):
        envelope([curves[0], offset.line((4.1, 5.0), end)])
