from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.cycles.turning.groove import Corner, Groove, GrooveError, Side, strokes
from polycnc.geometry import arcs

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
