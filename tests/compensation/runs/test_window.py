"""Runs of lines through the window of compensation give what moves one by one give, to the last bit."""

from __future__ import annotations

from array import array
from math import cos, radians, sin
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.channel.moves.path import Move, PlacedEvent, Run, Sink
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.plane import Plane
from polycnc.compensation.runs import window as runs
from polycnc.compensation.runs.kernels import lead
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Auxiliary
from polycnc.toolpath.kinds import NO_CURVE, Kind
from tests.compensation.policies import FANUC_A, MELDAS, SINUMERIK_NORM_G450, SYNTEC
from tests.compensation.support import CODES, into
from tests.kernels.strict import strict

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.compensation.policy import Policy

Row = tuple[Kind, str, int, tuple[str, ...]]
POLICIES = (FANUC_A, MELDAS, SYNTEC, SINUMERIK_NORM_G450)
PLANES = (Plane(0, 1, 2), Plane(2, 0, 1), Plane(2, 0, 1, (0, -1, 1)))


class Rows(Sink):
    """Keeps rows; takes no more of a run at once than it is told."""

    def __init__(self, most: int = 10**9) -> None:
        self.rows: list[Row] = []
        self.most = most

    def move(self, move: Move) -> None:
        self._keep(move.kind, move.feed, move.line, move.end)

    def run(self, run: Run) -> int:
        count, axes = min(len(run.kinds), self.most), len(run.start)
        for i in range(count):
            end = run.ends[i * axes : (i + 1) * axes].tolist()
            self._keep(Kind(run.kinds[i]), run.feeds[i], run.lines[i], end)
        return count

    def _keep(self, kind: Kind, feed: float, line: int, end: list[float]) -> None:
        self.rows.append((kind, feed.hex(), line, tuple(number.hex() for number in end)))


def stage(
    policy: Policy, plane: Plane, rows: Rows, radius: float, tip: tuple[float, float]
) -> CutterCompensation:
    made = into(rows, CutterCompensation(plane, policy, CODES))
    made.engage(1 if radius > 0.0 else -1, abs(radius), tip)
    return made


def moves_of(ends: list[list[float]]) -> list[Move]:
    kinds = [Kind.RAPID if i % 7 == 3 else Kind.FEED for i in range(len(ends))]
    starts = [[0.0] * 3, *ends]
    return [
        Move(kind, start, end, 10.0 + i % 3, 0, i + 1, 0)
        for i, (kind, start, end) in enumerate(zip(kinds, starts, ends, strict=False))
    ]


def run_of(moves: list[Move]) -> Run:
    return Run(
        array("B", [move.kind for move in moves]),
        array("I", [move.line for move in moves]),
        array("d", [move.feed for move in moves]),
        array("d", [number for move in moves for number in move.end]),
        array("i", [NO_CURVE] * len(moves)),
        moves[0].start,
        0,
        0,
    )


def one_by_one(stage: CutterCompensation, moves: list[Move]) -> str:
    try:
        for move in moves:
            stage.move(move)
            stage.block()
    except AlarmError as alarm:
        return f"{alarm.code} {alarm.line}"
    return ""


def in_runs(stage: CutterCompensation, moves: list[Move]) -> tuple[str, int]:
    """The alarm, and how many moves were taken at once."""
    at = taken = 0
    while at < len(moves):
        count = stage.run(run_of(moves[at:]))
        taken, at = taken + count, at + count
        if at < len(moves):
            alarm = one_by_one(stage, [moves[at]])
            at += 1
            if alarm:
                return alarm, taken
    return "", taken


@st.composite
def contours(draw: st.DrawFn) -> list[list[float]]:
    """Chords that turn a little; now and then a sharp corner, a short way or none, a way of another axis."""
    angle, x, y, z = draw(st.floats(0, 360)), 0.0, 0.0, 0.0
    digits = draw(st.sampled_from((3, 4, 17)))
    ends = []
    for _ in range(draw(st.integers(4, 40))):
        most = draw(st.sampled_from((0.0, 8.0, 8.0, 8.0, 8.0, 8.0, 60.0, 180.0)))
        angle += draw(st.floats(-most, most))
        way = draw(st.sampled_from((0.4, 2.0, 2.0, 9.0, 0.0)))
        x, y = round(x + way * cos(radians(angle)), digits), round(y + way * sin(radians(angle)), digits)
        z += draw(st.sampled_from((0.0, 0.0, 0.5)))
        ends.append([x, y, z])
    return ends


@settings(max_examples=300, deadline=None)
@given(
    contours(),
    st.sampled_from(POLICIES),
    st.sampled_from(PLANES),
    st.sampled_from((0.1, -0.5, 1.0, -3.0, 0.0)),
    st.sampled_from(((0.0, 0.0), (1.0, -1.0))),
    st.sampled_from((1, 3, 10**9)),
)
def test_runs_are_what_moves_one_by_one_are(
    ends: list[list[float]], policy: Policy, plane: Plane, radius: float, tip: tuple[float, float], most: int
) -> None:
    single, many = Rows(), Rows(most)
    one, two = stage(policy, plane, single, radius, tip), stage(policy, plane, many, radius, tip)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runs, "lead", lambda: strict(lead))
        alarm, _ = in_runs(two, moves_of(ends))
    assert alarm == one_by_one(one, moves_of(ends))
    assert many.rows == single.rows
    one.cancel()
    two.cancel()
    leave = [Move(Kind.FEED, ends[-1], [-99.0, -99.0, 0.0], 1.0, 0, 99, 0)]
    if not alarm:
        assert one_by_one(one, leave) == one_by_one(two, leave)
        assert many.rows == single.rows


def circle(count: int) -> list[list[float]]:
    return [[50.0 * cos(radians(i)), 50.0 * sin(radians(i)), 0.0] for i in range(count)]


@pytest.mark.parametrize("policy", [FANUC_A, MELDAS, SYNTEC])
@pytest.mark.parametrize("radius", [1.0, -1.0])
def test_an_ordinary_contour_is_taken_at_once(policy: Policy, radius: float) -> None:
    alarm, taken = in_runs(stage(policy, PLANES[0], Rows(), radius, (0.0, 0.0)), moves_of(circle(100)))
    assert not alarm
    assert taken == 100 - policy.read_blocks


def waiting() -> CutterCompensation:
    """A stage in front of which many moves could be given."""
    made = stage(FANUC_A, PLANES[0], Rows(), 1.0, (0.0, 0.0))
    one_by_one(made, moves_of(circle(100))[:10])
    return made


#: What a program may command in front of a move.
COMMANDS: tuple[Callable[[CutterCompensation], None], ...] = (
    lambda stage: stage.change_radius(2.0),
    lambda stage: stage.change_side(-1),
    lambda stage: stage.forced_vector((1.0, 0.0)),
    lambda stage: stage.hold_vector(),
    lambda stage: stage.cancel(),
    lambda stage: stage.event(PlacedEvent(Auxiliary(8), 0, 10, 0)),
    lambda stage: stage.block(),
    lambda stage: stage.flush(),
)


def test_what_a_program_commands_is_left_to_moves_one_by_one() -> None:
    rest = run_of(moves_of(circle(100))[10:])
    assert waiting().run(rest) == 90
    for command in COMMANDS:
        made = waiting()
        command(made)
        assert made.run(rest) == 0


def test_another_context_or_program_is_another_run() -> None:
    rest = moves_of(circle(100))[10:]
    for name in ("context", "program"):
        run = run_of(rest)
        other = Run(**{key: getattr(run, key) for key in Run.__slots__} | {name: 1})
        assert waiting().run(other) == 0


def test_a_run_ends_in_front_of_what_is_no_ordinary_line() -> None:
    moves = moves_of(circle(100))[10:]
    run = run_of(moves)
    run.kinds[20] = Kind.CW
    assert waiting().run(run) == 20
    assert waiting().run(run_of([moves[0], *moves[20:]])) > 0
    back = run_of([*moves[:20], Move(Kind.FEED, moves[19].end, moves[18].end), *moves[21:]])
    assert waiting().run(back) == 20
