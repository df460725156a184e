"""Avoidance on random jagged contours: the tool never cuts what is read when a move begins, or the alarm comes.

The contours run towards +X and never overhang, so "above" and "below" are the sides. Steps are often far smaller than
the tool. The judgement is made with arithmetic of its own: points along the rows against distances to the programmed
lines and arcs, nothing of the compensation's geometry.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from math import asin, atan2, ceil, cos, hypot, pi, sin, sqrt, tan

from hypothesis import example, given, settings
from hypothesis import strategies as st

from polycnc.channel.moves.path import Move, PlacedEvent
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.policy import Policy
from polycnc.geometry.offset import Joint, Outer
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary
from tests.compensation import policies
from tests.compensation.support import CODES, G17, Recorder, into

#: What counts as a cut, mm.
CUT_MM = 1e-4
LINES = replace(policies.FANUC_A, avoids=True)
ARCS = replace(LINES, outer=Outer(90.0, Joint.ARC))
POLICIES = [LINES, ARCS, policies.SINUMERIK_NORM_G450, policies.SINUMERIK_NORM_G451]


@dataclass(frozen=True)
class Piece:
    """A programmed line, or an arc that rises by `bulge` times half its chord over it, or falls where negative."""

    start: tuple[float, float]
    end: tuple[float, float]
    bulge: float = 0.0

    @property
    def circle(self) -> tuple[float, float, float] | None:
        """Centre and radius; None for a line. With half chord h and sagitta s the radius is (h² + s²)/2s."""
        if not self.bulge:
            return None
        (x0, y0), (x1, y1) = self.start, self.end
        half = 0.5 * hypot(x1 - x0, y1 - y0)
        sagitta = abs(self.bulge) * half
        radius = (half * half + sagitta * sagitta) / (2 * sagitta)
        away = (sagitta - radius if self.bulge > 0 else radius - sagitta) / (2 * half)
        return 0.5 * (x0 + x1) - away * (y1 - y0), 0.5 * (y0 + y1) + away * (x1 - x0), radius

    def distance(self, x: float, y: float) -> float:
        """Distance of a point."""
        (x0, y0), (x1, y1) = self.start, self.end
        if self.circle is None:
            dx, dy = x1 - x0, y1 - y0
            part = min(max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
            return hypot(x - x0 - part * dx, y - y0 - part * dy)
        cx, cy, radius = self.circle
        ends = min(hypot(x - x0, y - y0), hypot(x - x1, y - y1))
        # Bulges stay below a semicircle: the sector of the arc is the one about its middle.
        middle = atan2(0.5 * (y0 + y1) - cy, 0.5 * (x0 + x1) - cx)
        turned = (atan2(y - cy, x - cx) - middle + pi) % (2 * pi) - pi
        half_angle = asin(min(0.5 * hypot(x1 - x0, y1 - y0) / radius, 1.0))
        return min(ends, abs(hypot(x - cx, y - cy) - radius)) if abs(turned) <= half_angle else ends

    def height(self, x: float) -> float:
        """Height of the contour over a place between start and end."""
        (x0, y0), (x1, y1) = self.start, self.end
        if self.circle is None:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
        cx, cy, radius = self.circle
        rise = sqrt(max(radius * radius - (x - cx) ** 2, 0.0))
        return cy + rise if self.bulge > 0 else cy - rise


@st.composite
def jagged(draw: st.DrawFn) -> list[Piece]:
    """A flat way in, steps of 0.05 to 5 mm of which some are steep and some arcs, and a flat way out."""
    steep = draw(st.sampled_from([0.3, 1.0, 3.0, 6.0]))
    pieces = [Piece((-20.0, 0.0), (0.0, 0.0)), Piece((0.0, 0.0), (10.0, 0.0))]
    for _ in range(draw(st.integers(2, 16))):
        x, y = pieces[-1].end
        end = (round(x + draw(st.floats(0.05, 5)), 3), round(y + draw(st.floats(-steep, steep)), 3))
        # A bulge of tan(a/2) turns by a to each side of the chord; with it the arc must not stand steeper than upright.
        most = tan(0.5 * (pi / 2 - abs(atan2(end[1] - y, end[0] - x))))
        bulge = draw(st.sampled_from([0.0, 0.0, 1.0, -1.0])) * draw(st.floats(0.1, 0.95)) * most
        pieces.append(Piece((x, y), end, bulge if abs(bulge) > 0.01 else 0.0))
    x, y = pieces[-1].end
    return [*pieces, Piece((x, y), (x + 10, y)), Piece((x + 10, y), (x + 20, y))]


def compensate(policy: Policy, contour: list[Piece], side: int, radius: float) -> Recorder:
    """Run above the contour with G41, or below its mirror image with G42, with start-up and cancel far away."""
    recorder = Recorder()
    stage = into(recorder, CutterCompensation(G17, policy, CODES))
    x, y = contour[-1].end
    pieces = [*contour, Piece((x, y), (x + 20, y))]
    for line, piece in enumerate(pieces, 1):
        if line == 1:
            stage.engage(side, radius)
        if line == len(pieces):
            stage.cancel()
        kind, center = Kind.FEED, None
        if piece.circle is not None:
            kind = Kind.CW if (piece.bulge > 0) == (side > 0) else Kind.CCW
            center = (piece.circle[0], side * piece.circle[1], 0.0)
        start, end = ([p[0], side * p[1], 0.0] for p in (piece.start, piece.end))
        stage.move(Move(kind, start, end, 1.0, line=line, center=center))
        stage.event(PlacedEvent(Auxiliary(line), 0, line, 0))
        stage.block()
    stage.flush()
    return recorder


def along(move: Move, side: int) -> list[tuple[float, float]]:
    """Points of a row, never farther apart than 0.05 mm, with the mirror taken back."""
    (x0, y0), (x1, y1) = ((p[0], side * p[1]) for p in (move.start, move.end))
    if move.center is None:
        count = ceil(hypot(x1 - x0, y1 - y0) / 0.05) or 1
        return [(x0 + (x1 - x0) * k / count, y0 + (y1 - y0) * k / count) for k in range(count + 1)]
    cx, cy = move.center[0], side * move.center[1]
    radius = hypot(x0 - cx, y0 - cy)
    turn = atan2((x0 - cx) * (y1 - cy) - (y0 - cy) * (x1 - cx), (x0 - cx) * (x1 - cx) + (y0 - cy) * (y1 - cy))
    if (move.kind is Kind.CCW) == (side > 0):
        turn %= 2 * pi
    else:
        turn = -(-turn % (2 * pi))
    count, first = ceil(radius * abs(turn) / 0.05) or 1, atan2(y0 - cy, x0 - cx)
    return [(cx + radius * cos(first + turn * k / count), cy + radius * sin(first + turn * k / count))
            for k in range(count + 1)]  # fmt: skip


def deepest_cut(
    recorder: Recorder, contour: list[Piece], side: int, radius: float, read_blocks: int
) -> float:
    """How far the tool enters the material below the contour, mm.

    A move knows the blocks that are read when it begins, its own included: what comes later it may cut.
    """
    deepest = 0.0
    for move in recorder.moves:
        if not 1 < move.line <= len(contour):
            continue
        for x, y in along(move, side):
            read = contour[: move.line - 1 + read_blocks]
            near = [piece for piece in read if piece.start[0] - radius <= x <= piece.end[0] + radius]
            distance = min((piece.distance(x, y) for piece in near), default=radius)
            below = any(p.start[0] <= x <= p.end[0] and y < p.height(x) - CUT_MM for p in near)
            deepest = max(deepest, radius + distance if below else radius - distance)
    return deepest


def polyline(*points: tuple[float, float]) -> list[Piece]:
    """A contour of lines between the flat ways in and out."""
    (x, y) = points[-1]
    ends = [(-20.0, 0.0), (0.0, 0.0), *points, (x + 10, y), (x + 20, y)]
    return [Piece(one, two) for one, two in pairwise(ends)]


LATE = [
    *polyline((10, 0))[:2],
    Piece((10.0, 0.0), (10.1, -0.457), -0.08994452292586298),
    Piece((10.1, -0.457), (11.1, -0.33), 0.3785346295118184),
    Piece((11.1, -0.33), (16.1, -1.323), 0.41046513219324837),
    Piece((16.1, -1.323), (16.15, -1.39), 0.16600239234106712),
    Piece((16.15, -1.39), (26.15, -1.39)),
    Piece((26.15, -1.39), (36.15, -1.39)),
]


MISSING = [
    *polyline((10, 0))[:2],
    Piece((10.0, 0.0), (10.625, 1.0), 0.03584952830141509),
    Piece((10.625, 1.0), (11.312, 1.625), -0.27634587661055493),
    Piece((11.312, 1.625), (21.312, 1.625)),
    Piece((21.312, 1.625), (31.312, 1.625)),
]


@settings(derandomize=True, max_examples=150, deadline=None)
@given(
    jagged(),
    st.sampled_from([1, -1]),
    st.sampled_from([0.8, 2.0, 4.0, 7.0]),
    st.integers(3, 8),
    st.sampled_from(POLICIES),
)
# A step before an acute corner that is turned about: without its vectors the way would cut the corner.
@example(polyline((10, 0), (11.834, 0), (12.364, 1.13), (14.509, -1.033), (19.511, -3.671)), 1, 2.0, 8, ARCS)
@example(polyline((10, 0), (11.315, 0), (11.974, 4.107), (13.421, 0.986), (14.436, -0.179)), 1, 4.0, 8, ARCS)
# A way back of half a micrometre, which one could take for rounding: with it the tool would cut the corner behind.
@example(polyline((10, 0), (12, -0.659), (13, 0.216), (13.05, 0.52), (13.15, 1.429)), -1, 0.8, 6, LINES)
# The third step of the contour is an arc that the first move would have to keep off: with three blocks it is not read.
@example(LATE, 1, 7.0, 3, ARCS)
@example(LATE, 1, 7.0, 4, ARCS)
# The parallels of two arcs that miss each other by a few micrometres do not meet.
@example(MISSING, 1, 0.8, 3, POLICIES[-1])
def test_a_tool_that_avoids_interference_never_cuts_what_is_read(
    contour: list[Piece], side: int, radius: float, read_blocks: int, policy: Policy
) -> None:
    policy = replace(policy, read_blocks=read_blocks, least_move_mm=0.0)
    try:
        recorder = compensate(policy, contour, side, radius)
    except AlarmError:
        return
    assert deepest_cut(recorder, contour, side, radius, read_blocks) < CUT_MM
    for one, two in pairwise(recorder.moves):
        assert hypot(one.end[0] - two.start[0], one.end[1] - two.start[1]) < 1e-9
    codes = [int(name[1:]) for name in recorder.order if name.startswith("m")]
    assert codes == list(range(1, len(contour) + 2))


def test_a_block_more_read_ahead_keeps_the_first_move_off_a_late_arc() -> None:
    deepest = {}
    for read_blocks in (3, 4):
        recorder = compensate(replace(ARCS, read_blocks=read_blocks, least_move_mm=0.0), LATE, 1, 7.0)
        deepest[read_blocks] = deepest_cut(recorder, LATE, 1, 7.0, len(LATE))
    assert deepest[3] > 0.2
    assert deepest[4] < CUT_MM


def test_most_jagged_contours_have_a_way_round() -> None:
    # Two small steps up and a shallow groove that the tool does not fit into: all is bridged, nothing refused.
    contour = polyline(
        (10, 0), (11, 0.5), (12, 0.7), (14, 0.7), (14.5, 0.2), (15, 0.2), (15.5, 0.7), (20, 0.7)
    )
    policy = replace(LINES, read_blocks=8)
    recorder = compensate(policy, contour, 1, 4.0)
    assert deepest_cut(recorder, contour, 1, 4.0, 8) < 1e-3


def test_an_arc_in_front_of_a_short_step_is_not_cut() -> None:
    points = [
        (-20, 0),
        (0, 0),
        (10, 0),
        (11, 0),
        (12, 1),
        (13, 1),
        (14, 1),
        (15, 2),
        (16, 2),
        (26, 2),
        (36, 2),
    ]
    contour = [
        Piece(one, two, 0.10355339059327376 if one == (11, 0) else 0.0) for one, two in pairwise(points)
    ]
    policy = replace(LINES, outer=Outer(0.0, Joint.ARC), read_blocks=5)
    assert deepest_cut(compensate(policy, contour, 1, 7.0), contour, 1, 7.0, 5) < CUT_MM
