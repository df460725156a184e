from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import radians, tan
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

from polycnc.cycles.turning.groove import Corner, Groove, GrooveError, GrooveStroke, Side, strokes
from polycnc.geometry import arcs

if TYPE_CHECKING:
    from numpy.typing import NDArray

SIZES = st.floats(0.1, 20.0)


@given(SIZES, SIZES, SIZES, st.floats(0.0, 0.04), st.floats(0.0, 0.04), st.floats(0.0, 5.0))
def test_the_tool_stays_within_the_groove_and_reaches_its_corners(
    tool: float, more: float, depth: float, on_base: float, on_wall: float, infeed: float
) -> None:
    groove = Groove(tool + more, depth, tool, on_base, on_wall, max(infeed, depth / 20.0), 1.0)
    ends = [stroke.end for stroke in strokes(groove) if stroke.end is not None]
    assert all(-1e-9 <= w <= more + 1e-9 and t <= depth + 1e-9 for w, t in ends)
    assert max(t for _, t in ends) >= depth - 1e-9
    assert {0.0, more} <= {round(w, 9) if abs(w - more) > 1e-9 else more for w, _ in ends}


@given(SIZES, SIZES, SIZES, st.floats(0.0, 5.0))
def test_rapids_go_across_above_the_rim_alone(tool: float, more: float, depth: float, infeed: float) -> None:
    groove = Groove(tool + more, depth, tool, 0.0, 0.0, infeed and max(infeed, depth / 20.0), 1.0)
    way = [stroke for stroke in strokes(groove) if stroke.end is not None]
    for before, stroke in pairwise(way):
        (w0, t0), (w1, t1) = before.end or (0.0, 0.0), stroke.end or (0.0, 0.0)
        if stroke.is_rapid:
            assert w0 == w1 or t0 == t1 == -1.0


@given(SIZES, SIZES)
def test_plunges_lie_at_most_a_tool_apart(tool: float, more: float) -> None:
    groove = Groove(tool + more, 5.0, tool)
    columns = sorted(
        {
            stroke.end[0]
            for stroke in strokes(groove)
            if stroke.end and stroke.end[1] == -1.0 and stroke.is_rapid
        }
    )
    assert all(b - a <= tool + 1e-6 for a, b in pairwise(columns))


ANGLES, CORNERS = st.floats(0.0, 50.0), st.floats(0.0, 0.4)
BROKEN = st.builds(lambda size, kind: Corner(**{kind: size}), CORNERS, st.sampled_from(Corner._fields))
SIDES = st.builds(Side, ANGLES, BROKEN, BROKEN)


@given(SIDES, SIDES, st.floats(1.0, 3.0), st.floats(1.5, 6.0), st.floats(1.0, 8.0), st.floats(0.0, 2.0))
def test_the_tool_stays_within_a_groove_of_any_shape(
    first: Side, second: Side, tool: float, more: float, depth: float, infeed: float
) -> None:
    groove = Groove(tool + more, depth, tool, infeed=infeed and max(infeed, 0.2), sides=(first, second))
    at = (0.0, -1.0)
    for stroke in strokes(groove):
        if stroke.end is None:
            continue
        for part in (0.25, 0.5, 0.75, 1.0):
            if stroke.center is not None:
                w, t = arcs.point_on_arc(at, stroke.end, stroke.center, stroke.ccw, part)
            else:
                w, t = (a + part * (b - a) for a, b in zip(at, stroke.end, strict=True))
            assert t <= groove.room(0, w) + 1e-6 or t <= 0.0
            assert t <= groove.room(1, groove.top - w - tool) + 1e-6 or t <= 0.0
        at = stroke.end


@given(st.floats(1.0, 3.0), st.floats(0.0, 12.0), st.floats(1.0, 8.0), st.floats(0.2, 5.0), ANGLES)
def test_plunges_from_the_middle_outwards_never_cut_at_rapid(
    tool: float, more: float, depth: float, infeed: float, angle: float
) -> None:
    """What a rapid sweeps sideways has been cut down to there before."""
    side = Side(angle)
    groove = Groove(
        tool + more, depth, tool, infeed=infeed, sides=(side, side), step=0.8, alternates=True, finishes=False
    )
    cut: list[tuple[float, float]] = []
    at = (0.0, -1.0)
    for stroke in strokes(groove):
        if stroke.end is None:
            continue
        (w0, t0), (w1, t1) = at, stroke.end
        if w0 != w1:
            low, high = sorted((w0, w1))
            assert stroke.is_rapid
            assert t0 == t1
            reached = [w for w, t in cut if t >= t1 - 1e-9 and low - 1e-9 <= w <= high + 1e-9]
            assert t1 <= 0.0 or (min(reached) <= low + 1e-9 and max(reached) >= high - 1e-9)
        elif t1 > t0:
            assert not stroke.is_rapid or t1 <= 0.0 or any(w == w1 and t >= t1 - 1e-9 for w, t in cut)
            cut.append((w1, t1))
        at = stroke.end
    assert max(t for _, t in cut) >= depth - 1e-9


def test_sides_meet_where_the_wider_corner_of_the_base_ends() -> None:
    """The tool has 0.5 of play; a corner of 0.6 takes 0.4 of it for a nose of 0.2, the middle lies at 0.25."""
    wide, sharp = Side(base=Corner(radius=0.6)), Side()
    for sides, meeting in (((wide, sharp), 0.4), ((sharp, wide), 0.1)):
        groove = Groove(3.5, 2.0, 3.0, sides=sides, nose_radius=0.2)
        assert groove.meeting == pytest.approx((meeting, 0.5 - meeting))
        ends = [stroke.end for stroke in strokes(groove) if stroke.end is not None and not stroke.is_rapid]
        assert ends[-1] == pytest.approx((meeting, 2.0))


def test_corners_that_leave_the_tool_no_play_do_not_fit() -> None:
    wide = Side(base=Corner(radius=0.5))
    with pytest.raises(GrooveError):
        list(strokes(Groove(3.5, 2.0, 3.0, sides=(wide, wide), nose_radius=0.2)))


class Stock:
    """A slanted groove in the making: heights of the material over a grid of places, and what is to be left."""

    COUNT = 160

    def __init__(self, groove: Groove) -> None:
        self.groove = groove
        self.places = groove.top * (np.arange(-self.COUNT // 4, self.COUNT * 5 // 4) + 0.5) / self.COUNT
        self.rest = groove.slope * self.places
        self.finished = np.array([self._finished(float(x)) for x in self.places])

    def _finished(self, x: float) -> float:
        """The part as drawn, told without the code under test where its corners are sharp."""
        groove = self.groove
        if not all(side.rim.is_sharp and side.base.is_sharp for side in groove.sides):
            drawn = replace(groove, flank_allowance=0.0)
            starts = [contour[0].edge.start for contour in drawn.contours]
            for slope, u, (before, rim) in zip(
                (groove.slope, -groove.slope), (x, groove.top - x), starts, strict=True
            ):
                if u < before:  # a rounded rim that rises towards the groove begins at its summit
                    return groove.slope * x if slope > 0.0 else max(groove.slope * x, rim)
            return min(drawn.room(0, x), drawn.room(1, groove.top - x))
        if not 0.0 <= x <= groove.top:
            return groove.slope * x
        depth = groove.slope * x + groove.depth
        for lean, u, rim in zip(
            (tan(radians(side.angle_deg)) for side in groove.sides),
            (x, groove.top - x),
            (0.0, groove.slope * groove.top),
            strict=True,
        ):
            depth = min(depth, rim + u / lean) if lean else depth
        return depth

    def cut(self, before: tuple[float, float], stroke: GrooveStroke) -> None:
        """A stroke: a feed takes material and none of the finished part, a rapid touches nothing."""
        assert stroke.end is not None
        bounds = self.rest.copy() if stroke.is_rapid else self.finished
        parts = 1 if before[0] == stroke.end[0] else 16
        for part in range(parts + 1):
            if stroke.center is not None:
                w, t = arcs.point_on_arc(before, stroke.end, stroke.center, stroke.ccw, part / parts)
            else:
                w, t = (a + part / parts * (b - a) for a, b in zip(before, stroke.end, strict=True))
            first, last = np.searchsorted(self.places, (w + 1e-6, w + self.groove.tool_width - 1e-6))
            front = t - self._rounding(self.places[first:last] - w)
            # A nose that is larger by a rounding error than the corner of a base rests in it.
            assert np.all(front <= bounds[first:last] + (2e-2 if self.groove.nose_radius else 1e-5))
            np.maximum(self.rest[first:last], front, out=self.rest[first:last])

    def _rounding(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """How far the tool's noses lie back from its front."""
        radius = self.groove.nose_radius
        beside = np.maximum(radius - np.minimum(x, self.groove.tool_width - x), 0.0)
        back: NDArray[np.float64] = radius - np.sqrt(radius * radius - beside * beside)
        return back

    def reachable(self) -> NDArray[np.float64]:
        """The deepest a tool may stand anywhere over each place."""
        width = self.groove.tool_width
        deepest: NDArray[np.float64] = self.groove.slope * self.places
        for w in self.places[(self.places >= 0.0) & (self.places <= self.groove.top - width)]:
            under = (self.places > w) & (self.places < w + width)
            deepest[under] = np.maximum(deepest[under], self.finished[under].min())
        return deepest


SLOPES = st.floats(-65.0, 65.0).map(lambda angle: tan(radians(angle)))


@settings(max_examples=12)
@given(
    st.tuples(SIDES, SIDES) | st.tuples(st.builds(Side, ANGLES), st.builds(Side, ANGLES)),
    SLOPES,
    st.tuples(st.floats(1.0, 3.0), st.floats(0.0, 6.0), st.floats(0.5, 8.0)),
    st.tuples(st.floats(0.0, 2.0), st.floats(0.0, 0.3), st.floats(0.0, 0.3)),
    st.booleans(),
    st.sampled_from((0.0, 0.1, 0.3)),
)
def test_a_slanted_groove_is_cut_as_far_as_the_tool_reaches_and_no_rapid_meets_material(
    sides: tuple[Side, Side],
    slope: float,
    sizes: tuple[float, float, float],
    how: tuple[float, float, float],
    alternates: bool,
    nose: float,
) -> None:
    tool, more, depth = sizes
    infeed, on_base, on_wall = how
    groove = Groove(
        tool + 2.0 * on_wall + more,
        depth,
        tool,
        min(on_base, 0.2 * depth),
        on_wall,
        infeed=infeed and max(infeed, 0.4),
        sides=sides,
        nose_radius=nose,
        slope=slope,
        step=0.8 if alternates else 1.0,
        alternates=alternates,
    )
    try:
        way = [stroke for stroke in strokes(groove) if stroke.end is not None]
    except GrooveError:
        reject()
    stock = Stock(groove)
    at = ((way[0].end or (0.0, 0.0))[0], groove.over)
    for stroke in way:
        stock.cut(at, stroke)
        at = stroke.end or at
    coarse = groove.top / stock.COUNT * (2.0 + abs(slope) + 6.0 / max(0.5, depth))
    inside = (stock.places > 0.0) & (stock.places < groove.top)
    # A tool between two grid lines reaches as deep at a wall as at one of them.
    reachable = stock.reachable()
    nearby = np.minimum(reachable, np.minimum(np.roll(reachable, 1), np.roll(reachable, -1)))
    missing = np.count_nonzero((nearby - stock.rest > 0.05 + 4.0 * coarse)[inside])
    assert nose or missing <= 6  # walls are steep: a grid line beside one may be off by the whole height
