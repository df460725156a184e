"""Chamfers and roundings: tables by hand, and properties of random corners."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, radians, sin
from typing import TYPE_CHECKING

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.channel.moves.path import Move, PlacedEvent
from polycnc.compensation.corner import (
    CornerPolicy,
    CornerStage,
    CornerViolation,
    Shape,
)
from polycnc.compensation.cutter import CutterCompensation
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary
from tests.compensation.policies import FANUC_A, FANUC_CORNERS, SINUMERIK_CORNERS
from tests.compensation.support import G17, Recorder, into

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Stage

CODES = {CornerViolation.NO_NEXT_MOVE: "PS0051", CornerViolation.TOO_SHORT: "PS0055"}


class Path:
    """Moves from point to point, one block each, through a corner stage."""

    def __init__(self, policy: CornerPolicy = FANUC_CORNERS, after: Stage | None = None) -> None:
        self.recorder = Recorder()
        self.stage = into(after or self.recorder, CornerStage(G17, policy, CODES))
        self.position = [0.0, 0.0, 0.0]
        self.line = 0

    def insert(self, shape: Shape, size: float, feed: float = 7.0) -> Path:
        self.stage.insert(shape, size, feed)
        return self

    def to(
        self,
        u: float,
        v: float,
        w: float = 0.0,
        center: tuple[float, float] | None = None,
        kind: Kind = Kind.FEED,
    ) -> Path:
        self.line += 1
        end = [u, v, w]
        middle = None if center is None else (*center, 0.0)
        self.stage.move(Move(kind, self.position, end, 10.0, line=self.line, center=middle))
        self.position = end
        self.stage.block()
        return self

    def idle(self, code: int = 8) -> Path:
        self.line += 1
        self.stage.event(PlacedEvent(Auxiliary(code), 0, self.line, 0))
        self.stage.block()
        return self

    def rows(self) -> list[tuple[str, float, float]]:
        self.stage.flush()
        return self.recorder.rows


def test_a_rounding_is_a_tangent_arc_and_a_chamfer_cuts_both_legs() -> None:
    path = Path().insert(Shape.ROUNDING, 8).to(50, 0).insert(Shape.CHAMFER, 6).to(50, 40).to(10, 40)
    assert path.rows() == [
        ("feed", 42, 0), ("ccw", 50, 8), ("feed", 50, 34), ("feed", 44, 40), ("feed", 10, 40),
    ]  # fmt: skip
    arc = path.recorder.moves[1]
    assert (arc.center, arc.line, arc.feed) == ((42, 8, 0), 1, 7.0)


@pytest.mark.parametrize(
    ("shape", "size", "rows"),
    [
        (Shape.CHAMFER, 4, [("feed", 26, 0), ("feed", 30, 4), ("feed", 30, 30)]),
        (Shape.CHAMFER_LENGTH, 4, [("feed", 27.1716, 0), ("feed", 30, 2.8284), ("feed", 30, 30)]),
        (Shape.ROUNDING, 30, [("ccw", 30, 30)]),
    ],
)
def test_sizes_at_a_right_angle(shape: Shape, size: float, rows: list[tuple[str, float, float]]) -> None:
    assert Path().insert(shape, size).to(30, 0).to(30, 30).rows() == rows


def test_a_rounding_between_line_and_arc_touches_both() -> None:
    # A line along +X into a circle of 20 about (30, 0) at its left point: centre 5 above and 25 away.
    path = Path().insert(Shape.ROUNDING, 5).to(10, 0).to(30, 20, center=(30, 0), kind=Kind.CW)
    rows = path.rows()
    assert [kind for kind, *_ in rows] == ["feed", "ccw", "cw"]
    u = 30 - (25**2 - 5**2) ** 0.5
    assert path.recorder.moves[1].center == pytest.approx((u, 5, 0))
    assert rows[0][1:] == pytest.approx((u, 0), abs=1e-4)
    assert rows[1][1:] == pytest.approx((30 - (30 - u) * 20 / 25, 4), abs=1e-4)


def test_a_chamfer_on_an_arc_is_measured_along_it() -> None:
    path = Path().insert(Shape.CHAMFER, 5).to(20, 20, center=(0, 20), kind=Kind.CCW).to(0, 20)
    first = path.rows()[0]
    angle = pi / 2 - 5 / 20
    assert first[1:] == pytest.approx((20 * sin(angle), 20 - 20 * cos(angle)), abs=1e-4)


def test_other_axes_are_cut_in_proportion_and_the_arc_becomes_a_helix() -> None:
    path = Path().insert(Shape.ROUNDING, 10).to(50, 0, -10).to(50, 40, -10)
    path.rows()
    assert [m.end[2] for m in path.recorder.moves] == pytest.approx([-8, -10, -10])
    assert path.recorder.moves[1].kind is Kind.HELIX_CCW


def test_straight_on_needs_no_corner() -> None:
    assert Path().insert(Shape.ROUNDING, 5).to(20, 0).to(40, 0).rows() == [("feed", 20, 0), ("feed", 40, 0)]


def test_modal_rounding_rounds_every_corner_between_cuts_until_it_is_ended() -> None:
    path = Path(SINUMERIK_CORNERS)
    path.to(1, 0, kind=Kind.RAPID)
    path.stage.round_all(5)
    path.to(20, 0).to(20, 20)
    path.stage.round_all(0)
    path.to(0, 20).to(0, 5)
    assert path.rows() == [
        ("rapid", 1, 0), ("feed", 15, 0), ("ccw", 20, 5), ("feed", 20, 15), ("ccw", 15, 20), ("feed", 0, 20),
        ("feed", 0, 5),
    ]  # fmt: skip


def test_modal_rounding_at_the_end_of_the_contour_is_no_alarm() -> None:
    path = Path()
    path.stage.round_all(5)
    assert path.to(20, 0).rows() == [("feed", 20, 0)]


def refusal(path: Path) -> tuple[str, int]:
    with pytest.raises(AlarmError) as caught:
        path.rows()
    return caught.value.code, caught.value.line


def test_no_next_move_is_refused_at_the_line_of_the_corner() -> None:
    assert refusal(Path().insert(Shape.ROUNDING, 5).to(20, 0)) == ("PS0051", 1)
    path = Path().insert(Shape.ROUNDING, 5).to(20, 0)
    with pytest.raises(AlarmError, match="PS0051"):
        path.idle()


def test_a_rapid_next_move_is_refused() -> None:
    with pytest.raises(AlarmError, match="PS0051"):
        Path().insert(Shape.CHAMFER, 5).to(20, 0).to(20, 20, kind=Kind.RAPID)


def test_a_block_without_plane_motion_cannot_have_a_corner() -> None:
    with pytest.raises(AlarmError, match="PS0051"):
        Path().insert(Shape.CHAMFER, 5).to(0, 0, -5)


def test_blocks_without_motion_are_bridged_where_the_control_reads_on() -> None:
    path = Path(SINUMERIK_CORNERS).insert(Shape.ROUNDING, 5).to(20, 0).idle().to(20, 20)
    assert path.rows() == [("feed", 15, 0), ("ccw", 20, 5), ("feed", 20, 20)]
    assert path.recorder.order == ["feed 1", "ccw 1", ";", "m8", ";", "feed 3", ";"]


@pytest.mark.parametrize(("u", "v"), [(20, 7), (4, 0)])
def test_a_move_shorter_than_the_corner_is_refused(u: float, v: float) -> None:
    path = Path().insert(Shape.CHAMFER, 8).to(4 if v == 0 else 20, 0)
    with pytest.raises(AlarmError, match="PS0055"):
        path.to(u, v or 20)


def test_a_size_that_does_not_fit_is_reduced_where_the_control_does_so() -> None:
    path = Path(SINUMERIK_CORNERS).insert(Shape.ROUNDING, 8).to(20, 0).to(20, 5).to(0, 5)
    assert path.rows() == [("feed", 15, 0), ("ccw", 20, 5), ("feed", 0, 5)]


def test_a_path_that_turns_back_has_no_corner_to_round() -> None:
    with pytest.raises(AlarmError, match="PS0055"):
        Path().insert(Shape.ROUNDING, 5).to(20, 0).to(0, 0)


def test_radius_compensation_takes_the_rounded_corner() -> None:
    recorder = Recorder()
    compensation = into(recorder, CutterCompensation(G17, FANUC_A, {}))
    path = Path(after=compensation)
    compensation.engage(1, 5)
    path.to(10, 0).insert(Shape.ROUNDING, 8).to(50, 0).to(50, 40)
    path.stage.flush()
    assert recorder.rows == [("feed", 10, 5), ("feed", 42, 5), ("ccw", 45, 8), ("feed", 45, 40)]


@given(st.floats(5, 170), st.booleans(), st.floats(0.5, 20), st.sampled_from([Shape.CHAMFER, Shape.ROUNDING]))
def test_every_rounding_is_tangent_and_every_chamfer_has_equal_legs(
    turn_deg: float, left: bool, size: float, shape: Shape
) -> None:
    angle = radians(turn_deg if left else -turn_deg)
    length = 100.0
    leg = size * abs(sin(angle / 2) / cos(angle / 2)) if shape is Shape.ROUNDING else size
    assume(leg < length - 1)
    path = Path().insert(shape, size).to(length, 0).to(length + length * cos(angle), length * sin(angle))
    rows = path.rows()
    assert len(rows) == 3
    first, second = path.recorder.moves[0].end, path.recorder.moves[1].end
    assert hypot(length - first[0], first[1]) == pytest.approx(leg)
    assert hypot(length - second[0], second[1]) == pytest.approx(leg)
    if shape is Shape.ROUNDING:
        center = path.recorder.moves[1].center
        assert center is not None
        assert hypot(center[0] - first[0], center[1] - first[1]) == pytest.approx(size)
        assert hypot(center[0] - second[0], center[1] - second[1]) == pytest.approx(size)
        assert path.recorder.moves[1].kind is (Kind.CCW if left else Kind.CW)


def test_discard_forgets_the_held_move() -> None:
    path = Path().insert(Shape.ROUNDING, 5).to(20, 0)
    path.stage.discard()
    assert not path.stage.active
    assert path.to(30, 0).rows() == [("feed", 30, 0)]


def test_policies_are_data() -> None:
    assert replace(FANUC_CORNERS, idle_blocks=1, shrinks=True, at_rapids=True) == SINUMERIK_CORNERS


def test_a_corner_is_that_of_the_machine_where_the_zero_is_moved_in_front_of_it() -> None:
    path = Path().insert(Shape.CHAMFER, 5).to(20, 0)
    path.position = [-80.0, 30.0, 0.0]  # what was X20 Y0
    assert path.to(-80, 50).rows() == [("feed", 15, 0), ("feed", 20, 5), ("feed", -80, 50)]
    assert path.recorder.moves[2].start == [-80.0, 35.0, 0.0]
