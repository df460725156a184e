"""Radius compensation of random contours: the tool keeps its distance, and symmetry holds."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, pi, sin

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely.geometry import LineString, Point, Polygon

from polycnc.channel.moves.path import Move, PlacedEvent
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.policy import Policy, Violation
from polycnc.geometry import arcs
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary
from tests.compensation import policies
from tests.compensation.support import CODES, G17, Recorder, into

Corner = tuple[float, float]
POLICIES = [
    policies.FANUC_A, policies.FANUC_B, policies.SYNTEC, policies.SINUMERIK_NORM_G450,
    policies.SINUMERIK_NORM_G451, policies.SINUMERIK_KONT_G450,
]  # fmt: skip
RADIUS = 4.0


@st.composite
def star(draw: st.DrawFn) -> list[Corner]:
    """A polygon, convex or not, counter-clockwise about the origin, whose edges are long against the tool."""
    count = draw(st.integers(3, 9))
    corners = []
    for k in range(count):
        angle = 2 * pi * (k + draw(st.floats(-0.3, 0.3))) / count
        radius = draw(st.floats(60, 200))
        corners.append((round(radius * cos(angle), 3), round(radius * sin(angle), 3)))
    return corners


def compensate(policy: Policy, contour: list[Corner], side: int, radius: float = RADIUS) -> Recorder:
    """Walk round a closed contour, starting and ending in the middle of its last edge."""
    recorder = Recorder()
    stage = into(recorder, CutterCompensation(G17, policy, CODES))
    (u0, v0), (u1, v1) = contour[-1], contour[0]
    middle = (0.5 * (u0 + u1), 0.5 * (v0 + v1))
    far = (middle[0] + (u0 - u1), middle[1] + (v0 - v1))
    on = (middle[0] - (u0 - u1), middle[1] - (v0 - v1))
    points = [far, middle, *contour, middle, on]
    for line, (one, two) in enumerate(pairwise(points), 1):
        if line == 1:
            stage.engage(side, radius)
        if line == len(points) - 1:
            stage.cancel()
        stage.move(Move(Kind.FEED, [*one, 0.0], [*two, 0.0], 1.0, line=line))
        stage.event(PlacedEvent(Auxiliary(line), 0, line, 0))
        stage.block()
    stage.flush()
    return recorder


def outcome(policy: Policy, contour: list[Corner], side: int) -> Recorder | AlarmError:
    """The rows, or the alarm."""
    try:
        return compensate(policy, contour, side)
    except AlarmError as error:
        return error


def flattened(move: Move) -> list[Corner]:
    """Points along a row."""
    start, end = (move.start[0], move.start[1]), (move.end[0], move.end[1])
    if move.center is None:
        return [
            start,
            *((start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1])) for s in (0.5, 1)),
        ]
    center = (move.center[0], move.center[1])
    return [start, *arcs.split(start, end, center, move.kind in (Kind.CCW, Kind.HELIX_CCW), 8)]


@settings(max_examples=60, deadline=None)
@given(star(), st.sampled_from(POLICIES), st.sampled_from([1, -1]))
def test_the_tool_keeps_its_radius_from_the_contour_on_the_right_side(
    contour: list[Corner], policy: Policy, side: int
) -> None:
    # Corner moves up to a limit are left out by the control (FANUC 5010); without the limit the radius is exact.
    policy = replace(policy, least_move_mm=0.0)
    polygon = Polygon(contour)
    assume(polygon.is_valid and polygon.buffer(-2 * RADIUS).area > 0)
    try:
        recorder = compensate(policy, contour, side)
    except AlarmError:
        assume(False)
    ring = LineString([*contour, contour[0]])
    inside = side == 1
    # The first and last rows lead to and from the contour.
    for move in recorder.moves[1:-1]:
        for u, v in flattened(move):
            assert ring.distance(Point(u, v)) >= RADIUS - 1e-6
            assert polygon.contains(Point(u, v)) == inside


@settings(max_examples=60, deadline=None)
@given(star(), st.sampled_from([1, -1]))
def test_every_contour_line_is_cut_by_the_transition_circle_policy_outside(
    contour: list[Corner], side: int
) -> None:
    # With arcs about the corners the outer path is exactly the buffer's boundary wherever corners are convex.
    polygon = Polygon(contour)
    assume(polygon.is_valid and abs(polygon.convex_hull.area - polygon.area) < 1e-9)
    if side == 1:
        contour.reverse()
    recorder = compensate(policies.SINUMERIK_NORM_G450, contour, 1 if side == 1 else -1)
    ring = LineString([*contour, contour[0]])
    for move in recorder.moves[1:-1]:
        for u, v in flattened(move):
            assert ring.distance(Point(u, v)) == pytest.approx(RADIUS, abs=1e-6)


@settings(max_examples=40, deadline=None)
@given(star(), st.sampled_from(POLICIES))
def test_radius_zero_gives_the_programmed_path(contour: list[Corner], policy: Policy) -> None:
    recorder = compensate(policy, contour, 1, radius=0.0)
    (u0, v0), (u1, v1) = contour[-1], contour[0]
    middle = (0.5 * (u0 + u1), 0.5 * (v0 + v1))
    expected = [middle, *contour, middle, (middle[0] - u0 + u1, middle[1] - v0 + v1)]
    assert len(recorder.moves) == len(expected)
    for move, point in zip(recorder.moves, expected, strict=True):
        assert (move.end[0], move.end[1]) == pytest.approx(point)


@settings(max_examples=40, deadline=None)
@given(star(), st.sampled_from(POLICIES), st.sampled_from([1, -1]))
def test_mirror_images_mirror(contour: list[Corner], policy: Policy, side: int) -> None:
    mirrored = [(-u, v) for u, v in contour]
    one, two = outcome(policy, contour, side), outcome(policy, mirrored, -side)
    if isinstance(one, AlarmError) or isinstance(two, AlarmError):
        assert isinstance(one, AlarmError)
        assert isinstance(two, AlarmError)
        assert (one.code, one.line) == (two.code, two.line)
        return
    assert [m.line for m in one.moves] == [m.line for m in two.moves]
    for a, b in zip(one.moves, two.moves, strict=True):
        assert (a.end[0], a.end[1]) == pytest.approx((-b.end[0], b.end[1]), abs=1e-9)
        if a.center is not None and b.center is not None:
            assert a.center[0] == pytest.approx(-b.center[0], abs=1e-9)
            assert {a.kind, b.kind} == {Kind.CW, Kind.CCW}


@settings(max_examples=40, deadline=None)
@given(star(), st.sampled_from(POLICIES), st.sampled_from([1, -1]))
def test_rows_are_continuous_and_events_keep_their_order(
    contour: list[Corner], policy: Policy, side: int
) -> None:
    try:
        recorder = compensate(policy, contour, side)
    except AlarmError:
        assume(False)
    for one, two in pairwise(recorder.moves):
        assert hypot(one.end[0] - two.start[0], one.end[1] - two.start[1]) < 1e-9
    codes = [int(name[1:]) for name in recorder.order if name.startswith("m")]
    assert codes == list(range(1, len(contour) + 4))
    lines = [m.line for m in recorder.moves]
    assert lines == sorted(lines)


@settings(max_examples=60, deadline=None)
@given(star(), st.sampled_from(POLICIES), st.integers(0, 12))
def test_a_flush_at_any_point_gives_all_rows(contour: list[Corner], policy: Policy, at: int) -> None:
    recorder = Recorder()
    unchecked = {Violation.ARC_START: "034"}
    stage = into(recorder, CutterCompensation(G17, policy, unchecked))
    stage.engage(1, RADIUS)
    points = [(0.0, 0.0), *contour]
    for line, (one, two) in enumerate(pairwise(points), 1):
        stage.move(Move(Kind.FEED, [*one, 0.0], [*two, 0.0], 1.0, line=line))
        stage.block()
        if line == at:
            stage.flush()
            assert recorder.moves[-1].line == line
    stage.flush()
    assert {m.line for m in recorder.moves} | _left_out(policy) >= set(range(1, len(points)))
    u, v = points[-1]
    assert hypot(recorder.moves[-1].end[0] - u, recorder.moves[-1].end[1] - v) == pytest.approx(RADIUS)


def _left_out(policy: Policy) -> set[int]:
    """Lines that a policy may leave out: those that avoid interference may leave out any."""
    return set(range(20)) if policy.avoids else set()
