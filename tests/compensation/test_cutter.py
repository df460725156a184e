"""Radius compensation: corner cases worked out by hand, one table for each situation."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from polycnc.compensation.policy import Policy, Violation
from polycnc.geometry.offset import Joint, Outer
from polycnc.messages import AlarmError
from tests.compensation import policies
from tests.compensation.support import CODES, Reader, run

if TYPE_CHECKING:
    from collections.abc import Mapping

FANUC_ARCS = replace(policies.FANUC_A, outer=Outer(0.0, Joint.ARC))

# Radius 5, tool left of +X, the path turns right by 90 degrees at (20, 0): an outer corner of 90 degrees.
RIGHT_ANGLE = """
G1 G41 X10 Y0
X20
Y-20
X0
"""
# Turning right by 135 degrees: an acute outer corner.
ACUTE = """
G1 G41 X10 Y0
X20
X0 Y-20
"""
INNER = """
G1 G41 X10 Y0
X40
Y30
X0
"""


@pytest.mark.parametrize(
    ("policy", "program", "rows"),
    [
        (policies.FANUC_A, RIGHT_ANGLE, [("feed", 10, 5), ("feed", 25, 5), ("feed", 25, -25)]),
        (FANUC_ARCS, RIGHT_ANGLE, [("feed", 10, 5), ("feed", 20, 5), ("cw", 25, 0), ("feed", 25, -20)]),
        (
            policies.SINUMERIK_NORM_G450,
            RIGHT_ANGLE,
            [("feed", 10, 5), ("feed", 20, 5), ("cw", 25, 0), ("feed", 25, -20)],
        ),
        (policies.SINUMERIK_NORM_G451, RIGHT_ANGLE, [("feed", 10, 5), ("feed", 25, 5), ("feed", 25, -25)]),
        # Both lines run on by 5: (25, 5) and, back from (20, 0) + right of (-1, -1): (20+3.5355+3.5355, 0).
        (policies.FANUC_A, ACUTE, [("feed", 10, 5), ("feed", 25, 5), ("feed", 27.0711, 0)]),
        # Above MD20210 = 100 degrees an arc: from (20, 5) to (20, 0) + 5 (1, -1)/sqrt 2.
        (policies.SINUMERIK_NORM_G451, ACUTE, [("feed", 10, 5), ("feed", 20, 5), ("cw", 23.5355, -3.5355)]),
        (policies.FANUC_A, INNER, [("feed", 10, 5), ("feed", 35, 5), ("feed", 35, 25)]),
        (policies.SINUMERIK_NORM_G450, INNER, [("feed", 10, 5), ("feed", 35, 5), ("feed", 35, 25)]),
    ],
)
def test_corners_between_lines(policy: Policy, program: str, rows: list[tuple[str, float, float]]) -> None:
    assert run(policy, program).rows[: len(rows)] == rows


# A semicircle of radius 20 about the origin over the top, counter-clockwise seen from inside.
@pytest.mark.parametrize(
    ("policy", "program", "rows"),
    [
        # Inner: the line y = 5 meets the circle of 15 at x = sqrt 200.
        (
            policies.FANUC_A,
            "G1 G41 X-30 Y0\nX20\nG3 X-20 Y0 I-20 J0\nG1 X-30",
            [("feed", -30, 5), ("feed", 14.1421, 5), ("ccw", -15, 0)],
        ),
        # Tangent line into arc and out of it: one vector each.
        (
            policies.FANUC_A,
            "G1 G41 X20 Y-30\nY0\nG3 X-20 Y0 I-20 J0\nG1 Y-30",
            [("feed", 15, -30), ("feed", 15, 0), ("ccw", -15, 0), ("feed", -15, -30)],
        ),
        # Outer, obtuse: line to the intersection with the arc's tangent, then to the arc's own vector.
        (
            policies.FANUC_A,
            "G1 G42 X-30 Y0\nX20\nG3 X-20 Y0 I-20 J0\nG1 X-30",
            [("feed", -30, -5), ("feed", 25, -5), ("feed", 25, 0), ("ccw", -24.4949, 5)],
        ),
        (
            policies.SINUMERIK_NORM_G450,
            "G1 G42 X-30 Y0\nX20\nG3 X-20 Y0 I-20 J0\nG1 X-30",
            [("feed", -30, -5), ("feed", 20, -5), ("ccw", 25, 0), ("ccw", -24.4949, 5)],
        ),
        # G451 goes on as a circle: y = -5 meets the circle of 25 at x = sqrt 600.
        (
            policies.SINUMERIK_NORM_G451,
            "G1 G42 X-30 Y0\nX20\nG3 X-20 Y0 I-20 J0\nG1 X-30",
            [("feed", -30, -5), ("feed", 24.4949, -5), ("ccw", -24.4949, 5)],
        ),
        # Arc to arc, inner: circles of 15 about (0, 0) and (24, 0) meet at (12, 9).
        (
            policies.FANUC_A,
            "G1 G41 X0 Y-20\nG3 X12 Y16 I0 J20\nG3 X4 Y0 I12 J-16\nG1 Y-5",
            [("feed", 0, -15), ("ccw", 12, 9), ("ccw", 9, 0)],
        ),
        # Arc to arc, outer by 34.7 degrees: both arcs end square, their tangents meet between.
        (
            policies.SYNTEC,
            "G1 G41 X12 Y-16\nG3 X12 Y16 I-12 J16\nG3 X-12 Y16 I-12 J-4\nG1 Y0",
            [("feed", 9, -12), ("ccw", 9, 12), ("feed", 7.7505, 12.9371), ("feed", 7.2566, 14.4189)],
        ),
    ],
)
def test_corners_with_arcs(policy: Policy, program: str, rows: list[tuple[str, float, float]]) -> None:
    assert run(policy, program).rows[: len(rows)] == rows


def test_a_full_circle_stays_a_full_circle() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nG3 X20 Y0 I-20 J0\nG1 G40 X0 Y0")
    assert recorder.rows == [("feed", 15, 0), ("ccw", 15, 0), ("feed", 0, 0)]
    assert recorder.moves[1].center == (0, 0, 0)


@pytest.mark.parametrize(
    ("policy", "rows"),
    [
        (policies.FANUC_A, [("feed", 25, 0), ("feed", 25, -20), ("feed", 0, -20)]),
        (policies.FANUC_B, [("feed", 25, 5), ("feed", 25, -25), ("feed", 0, -20)]),
        (policies.SINUMERIK_NORM_G450, [("feed", 25, 0), ("feed", 25, -20), ("feed", 0, -20)]),
        # The line from the start point touches the circle of 5 about (20, 0) at asin(5/20) degrees.
        (
            policies.SINUMERIK_KONT_G450,
            [
                ("feed", 18.75, 4.8412), ("cw", 25, 0), ("feed", 25, -20),
                ("cw", 18.75, -24.8412), ("feed", 0, -20),
            ],
        ),
    ],
)  # fmt: skip
def test_start_up_and_cancel_at_outer_corners_are_mirror_images(
    policy: Policy, rows: list[tuple[str, float, float]]
) -> None:
    assert run(policy, "G1 G41 X20 Y0\nY-20\nG40 X0").rows == rows


@pytest.mark.parametrize("policy", [policies.FANUC_A, policies.FANUC_B, policies.SINUMERIK_KONT_G451])
def test_start_up_and_cancel_at_inner_corners_are_square_for_every_type(policy: Policy) -> None:
    assert run(policy, "G1 G41 X20 Y0\nY30\nG40 X0").rows == [
        ("feed", 15, 0),
        ("feed", 15, 30),
        ("feed", 0, 30),
    ]


def test_type_b_at_an_acute_corner_needs_two_vectors() -> None:
    rows = run(policies.FANUC_B, "G1 G41 X20 Y0\nX0 Y-20\nX30").rows
    assert rows[:2] == [("feed", 25, 5), ("feed", 27.0711, 0)]


def test_type_c_shifts_in_blocks_without_motion() -> None:
    recorder = run(policies.FANUC_C, "G1 X5\nG41\nX20\nY-20\nG40\nX0")
    assert recorder.rows == [
        ("feed", 5, 0), ("feed", 5, 5), ("feed", 25, 5),
        ("feed", 25, -20), ("feed", 20, -20), ("feed", 0, -20),
    ]  # fmt: skip
    assert [move.line for move in recorder.moves] == [1, 2, 3, 4, 5, 6]


def test_types_a_and_b_wait_for_the_next_motion_when_g41_and_g40_have_none() -> None:
    recorder = run(policies.FANUC_A, "G1 X5\nG41\nX20\nY-20\nG40\nM5\nX0")
    assert recorder.rows == [("feed", 5, 0), ("feed", 25, 0), ("feed", 25, -20), ("feed", 0, -20)]
    assert recorder.order.index("m5") > recorder.order.index("feed 4")


@pytest.mark.parametrize(
    ("wall", "end"), [("I0 J10", (35, 5)), ("I0 J-10", (45, 5)), ("I10 J0", (40, 5)), ("I-10 J0", (40, 5))]
)
def test_g40_with_a_wall_ends_on_the_intersection_or_else_square(wall: str, end: tuple[float, float]) -> None:
    recorder = run(policies.FANUC_A, f"G1 G41 X20 Y0\nX40\nG40 X60 Y40 {wall}")
    assert recorder.points == [(20, 5), end, (60, 40)]


def test_a_negative_radius_changes_the_sides() -> None:
    left = run(policies.FANUC_A, INNER, radius=5.0).rows
    assert run(policies.FANUC_A, INNER.replace("G41", "G42"), radius=-5.0).rows == left


def test_another_radius_holds_at_the_end_of_its_block() -> None:
    recorder = run(policies.SYNTEC, "G1 G41 X20 Y0\nX40\nD8 X60\nX80\nG40 X90")
    assert recorder.points == [(20, 5), (40, 5), (60, 8), (80, 8), (90, 0)]


def test_another_radius_makes_an_arc_a_spiral() -> None:
    recorder = run(policies.SYNTEC, "G1 G41 X0 Y0\nX5\nX10\nD3 G2 X15 Y-5 I0 J-5\nG1 Y-6\nG40 X90")
    assert recorder.rows[1:4] == [("feed", 10, 5), ("cw", 18, -5), ("feed", 18, -6)]


def test_a_change_of_side_takes_the_intersection_of_both_offset_paths() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nX40\nG42 Y30\nX60\nG40 X80")
    assert recorder.points[:3] == [(20, 5), (45, 5), (45, 25)]


def test_a_change_of_side_without_intersection_is_square_on_the_new_block() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nX40\nG42 X60\nX80\nG40 X90")
    assert recorder.points == [(20, 5), (40, -5), (60, -5), (80, -5), (90, 0)]


def test_g41_written_again_ends_the_block_in_front_square() -> None:
    program = "G1 G41 X10 Y0\nX20\nG41 Y-20\nX0"
    assert run(policies.FANUC_A, program).points[1] == (20, 5)
    assert run(policies.SYNTEC, program).points[1] == (25, 5)


def test_g41_written_again_right_after_the_start_up_changes_nothing() -> None:
    assert run(policies.FANUC_A, "G1 G41 X20 Y0\nG41 Y-20\nX0").points[0] == (25, 0)


def test_g38_keeps_the_square_vector_of_the_block_in_front() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nX40\nG38 X45 Y-2\nY-20\nX80")
    assert recorder.points[:3] == [(20, 5), (40, 5), (45, 3)]


def test_g39_turns_about_the_corner_in_a_row_of_its_own_block() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nX40\nG39\nY-20\nX80")
    assert recorder.rows[:4] == [("feed", 20, 5), ("feed", 40, 5), ("cw", 45, 0), ("feed", 45, -15)]
    assert (recorder.moves[2].line, recorder.moves[2].center) == (3, (40, 0, 0))


def test_g39_with_a_direction_ends_square_on_it() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y0\nX40\nG39 I1 J-1\nY-20\nX80")
    assert recorder.rows[1:4] == [("feed", 40, 5), ("cw", 43.5355, 3.5355), ("feed", 45, -15)]


def test_i_and_j_in_a_straight_block_force_its_end_vector() -> None:
    recorder = run(policies.FANUC_A, "G41 X20 Y20 I1 J0\nM4\nM5\nM6\nX40\nY-20\nG40 Y-40")
    assert recorder.points[:2] == [(20, 25), (45, 25)]


def test_a_forced_vector_without_motion_shifts_the_tool() -> None:
    recorder = run(policies.FANUC_A, "G41 I1 J0\nX20\nX40\nG40 X60")
    assert recorder.points == [(0, 5), (20, 5), (40, 5), (60, 0)]


def test_a_dropped_vector_ends_the_block_on_the_programmed_point_and_comes_back() -> None:
    reader = Reader(policies.FANUC_A)
    for text in ("G1 G41 X10 Y0", "X40", "Y-20"):
        reader.block(text)
    reader.stage.drop_vector()
    recorder = reader.run("X60\nX80\nY0")
    assert recorder.points == [(10, 5), (45, 5), (40, -20), (60, -15), (75, -15), (75, 0)]


def test_the_nose_centre_offset_stands_as_long_as_the_vector() -> None:
    reader = Reader(policies.FANUC_A)
    reader.stage.engage(-1, 2.0, tip=(-1.0, -1.0))
    recorder = reader.run("G1 X20\nX30\nG3 X40 Y10 I0 J10\nG40 G1 X50 Y10")
    assert recorder.points == [(18, -4), (28, -4), (40, 8), (50, 10)]
    assert recorder.moves[2].center == (28, 8, 0)


@pytest.mark.parametrize(
    ("policy", "idle", "end"),
    [
        (policies.FANUC_A, 1, (25, 5)),
        (policies.FANUC_A, 2, (20, 5)),
        (replace(policies.FANUC_A, read_blocks=5), 3, (25, 5)),
        (replace(policies.FANUC_A, read_blocks=5), 4, (20, 5)),
        (policies.MELDAS, 3, (25, 5)),
        (policies.SINUMERIK_NORM_G451, 5, (25, 5)),
        (policies.SINUMERIK_NORM_G451, 6, (20, 5)),
    ],
)
def test_more_blocks_without_motion_than_are_read_ahead_end_the_block_square(
    policy: Policy, idle: int, end: tuple[float, float]
) -> None:
    program = "G1 G41 X10 Y0\nX20\n" + "M8\n" * idle + "Y-20\nX80"
    assert run(policy, program).points[1] == end


@pytest.mark.parametrize(
    ("policy", "end"), [(policies.HARTFORD, (20, 20)), (policies.FANUC_A, (16.4645, 23.5355))]
)
def test_a_start_up_that_does_not_see_the_next_motion(policy: Policy, end: tuple[float, float]) -> None:
    recorder = run(policy, "G0 G41 X20 Y20\nZ-25\nG1 Z-30\nY60\nX0")
    assert recorder.points[:3] == [end, end, end]
    assert recorder.points[3] == (15 if policy is policies.FANUC_A else 20, 55)


def test_moves_of_other_axes_and_events_keep_their_order() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X10 Y0\nX20 M8\nZ-5\nY-20 M9\nX80")
    assert recorder.order == [
        "feed 1", ";", "feed 2", "m8", ";", "feed 3", ";", "feed 4", "m9", ";", "feed 5", ";",
    ]  # fmt: skip
    assert recorder.moves[2].start[:2] == recorder.moves[2].end[:2] == [25, 5]
    assert recorder.moves[2].end[2] == -5


def test_rows_are_continuous_through_everything() -> None:
    recorder = run(policies.SINUMERIK_NORM_G450, RIGHT_ANGLE + "Z-5\nG42 X-20\nD7 Y-40\nG40 Y-50")
    for one, two in zip(recorder.moves, recorder.moves[1:], strict=False):
        assert one.end == pytest.approx(two.start)


def test_a_helix_keeps_its_depth() -> None:
    recorder = run(policies.FANUC_A, "G1 G41 X20 Y-30\nY0\nG3 X-20 Y0 Z-8 I-20 J0\nG1 Y-30")
    assert recorder.moves[2].end == pytest.approx([-15, 0, -8])


def test_disc_raises_the_arc_towards_the_intersection() -> None:
    half = replace(policies.SINUMERIK_NORM_G450, outer=Outer(0.0, Joint.ARC, disc_percent=50.0))
    recorder = run(half, RIGHT_ANGLE)
    spline = [move for move in recorder.moves if move.kind.name == "SPLINE" and move.line == 2]
    top = spline[len(spline) // 2 - 1].end
    # On the bisector, half way between the arc (3.5355) and the intersection (5).
    assert top[0] - 20 == pytest.approx((3.5355 + 5) / 2, abs=1e-3)
    assert top[1] == pytest.approx(top[0] - 20)
    full = replace(policies.SINUMERIK_NORM_G450, outer=Outer(0.0, Joint.ARC, disc_percent=100.0))
    assert (25, 5) in run(full, RIGHT_ANGLE).points


def test_corner_motion_below_the_limit_is_left_out_but_not_before_a_long_arc() -> None:
    slight = "G1 G42 X-30 Y0\nX20\nG3 X{} Y{} I-0.02 J20\nG1 X0"
    short = run(replace(policies.FANUC_A, least_move_mm=0.1), slight.format(19.96, 40))
    assert [row[0] for row in short.rows[:4]] == ["feed", "feed", "feed", "ccw"]
    quarter = "G1 G42 X-30 Y0\nX20\nG3 X39.98 Y20 I-0.02 J20\nG1 Y50"
    assert [r[0] for r in run(replace(policies.FANUC_A, least_move_mm=0.1), quarter).rows[:3]] == [
        "feed", "feed", "ccw",
    ]  # fmt: skip


# ---- what is refused ---------------------------------------------------------------------------------------

AVOIDS = replace(policies.FANUC_A, avoids=True)
SLOT = "G1 G41 X20 Y0\nX40\nY-20\nX{}\nY0\nX80\nG40 Y20"


def refused(policy: Policy, program: str, violations: Mapping[Violation, str] = CODES) -> tuple[str, int]:
    with pytest.raises(AlarmError) as caught:
        run(policy, program, violations=violations)
    return caught.value.code, caught.value.line


@pytest.mark.parametrize(
    ("policy", "program", "alarm"),
    [
        (policies.FANUC_A, "G41 G3 X20 Y0 I10 J0\nG1 X30", ("ARC_START", 1)),
        (policies.FANUC_A, "G1 G41 X20 Y0\nX30\nG40 G3 X40 Y0 I5 J0", ("ARC_CANCEL", 3)),
        (policies.FANUC_A, "G1 G41 X20 Y0\nX30\nG3 X34 Y4 I0 J4\nG1 Y20", ("INNER_RADIUS_TOO_SMALL", 3)),
        (policies.FANUC_A, "G1 G41 X20 Y0\nX30\nG3 X34 Y4 I0 J0\nG1 Y20", ("INNER_RADIUS_TOO_SMALL", 3)),
        (policies.FANUC_A, SLOT.format(49), ("INTERFERENCE", 4)),
        (AVOIDS, SLOT.format(49), ("NO_AVOIDANCE", 4)),
        # A groove wider at its bottom than at its mouth: without the bottom the walls lead outwards.
        (
            AVOIDS,
            "G1 G41 X20 Y0\nX40\nX38 Y-20\nX48\nX46 Y0\nX80\nG40 Y20",
            ("AVOIDANCE_DANGEROUS", 4),
        ),
    ],
)
def test_violations_name_the_line_at_fault(policy: Policy, program: str, alarm: tuple[str, int]) -> None:
    assert refused(policy, program) == alarm


def test_a_slot_as_wide_as_the_tool_is_no_interference() -> None:
    assert (45, -15) in run(policies.FANUC_A, SLOT.format(50)).points


def test_the_tool_stops_before_the_block_in_front_of_the_interference() -> None:
    reader = Reader(policies.FANUC_A)
    with pytest.raises(AlarmError):
        reader.run(SLOT.format(49))
    assert reader.recorder.points == [(20, 5), (45, 5)]


def test_a_control_that_does_not_check_runs_on() -> None:
    unchecked = {v: c for v, c in CODES.items() if v is not Violation.INTERFERENCE}
    assert len(run(policies.FANUC_A, SLOT.format(49), violations=unchecked).moves) == 7


def test_an_interference_is_avoided_by_leaving_the_move_out() -> None:
    recorder = run(AVOIDS, "G1 G41 X0 Y0\nX20\nX40\nX41 Y1\nY60\nX0\nG40 Y-20")
    assert recorder.rows[:3] == [("feed", 20, 5), ("feed", 36, 5), ("feed", 36, 55)]


def test_events_of_a_move_that_was_left_out_are_kept() -> None:
    recorder = run(policies.SINUMERIK_NORM_G450, "G1 G41 X0 Y0\nX20\nX40\nX41 Y1 M7\nY60\nX0\nG40 Y-20")
    assert "m7" in recorder.order
    assert recorder.order.index("feed 3") < recorder.order.index("m7") < recorder.order.index("feed 5")


def test_crossing_vectors_of_a_small_step_are_left_out() -> None:
    # At an acute corner, then another: the second and third vector cross, the first and fourth do not.
    recorder = run(policies.FANUC_A, "G1 G41 X10 Y0\nX40\nX39 Y-3\nX0 Y-8\nY-30")
    for one, two in zip(recorder.moves, recorder.moves[1:], strict=False):
        assert one.end == pytest.approx(two.start)


def test_a_step_below_the_radius_goes_straight_to_the_second_vector_on_fanuc() -> None:
    recorder = run(FANUC_ARCS, "G1 G41 X20 Y0\nX40\nY3\nX60\nG40 Y20")
    assert recorder.rows[1:4] == [("feed", 35, 5), ("feed", 40, 8), ("feed", 60, 8)]


def test_a_step_below_the_radius_meets_the_transition_circle_on_sinumerik() -> None:
    # y = 5 meets the circle of 5 about (40, 3) at x = 40 - sqrt 21.
    recorder = run(policies.SINUMERIK_NORM_G450, "G1 G41 X20 Y0\nX40\nY3\nX60\nG40 Y20")
    assert recorder.rows[1:4] == [("feed", 35.4174, 5), ("cw", 40, 8), ("feed", 60, 8)]
    assert recorder.moves[2].center == (40, 3, 0)


def test_discard_forgets_everything() -> None:
    reader = Reader(policies.FANUC_A)
    reader.block("G1 G41 X20 Y0")
    reader.stage.discard()
    assert not reader.stage.active
    assert reader.run("X30").points == [(30, 0)]


def test_inner_arcs_that_do_not_meet_stop_at_the_end_of_the_block_in_front() -> None:
    # Two arcs of radius 8 inside a dent, centres 12 apart: parallels of 3 mm radius cannot meet.
    reader = Reader(policies.FANUC_A)
    with pytest.raises(AlarmError) as caught:
        reader.run("G1 G41 X-20 Y0\nX-14\nG3 X0 Y5.2915 I8 J0\nG3 X14 Y0 I6 J-5.2915\nG1 X30")
    assert caught.value.code == "NO_INTERSECTION"


def test_flush_leaves_the_tool_square_and_goes_on_from_there() -> None:
    reader = Reader(policies.SYNTEC)
    reader.block("G42 G1 X10 Y10")
    reader.stage.flush()
    recorder = reader.run("X100\nY100")
    assert recorder.points == [(13.5355, 6.4645), (105, 5), (105, 100)]
    assert recorder.flushed == 2


def test_g40_with_a_wall_and_a_nose_tip_gives_the_positions_of_the_manual_s_lathe_program() -> None:
    # FANUC 0i-TF Plus 5.2.4, radius 2 and tip 3: Z and X (radius) as first and second axis.
    reader = Reader(policies.FANUC_A, start=(0.0, 150.0, 0.0))
    reader.stage.engage(-1, 2.0, tip=(-1.0, -1.0))
    recorder = reader.run("X0 Y30\nG1 X-150 Y60\nG40 G0 X0 Y150 I-30 J40")
    assert recorder.points == [
        (pytest.approx(-1.608, abs=1e-3), pytest.approx(29.961, abs=1e-3)),
        (pytest.approx(-150.858, abs=1e-3), pytest.approx(59.8115, abs=1e-3)),
        (0, 150),
    ]


def test_what_comes_after_a_move_that_was_left_out_happens_where_the_tool_stands() -> None:
    far = replace(policies.FANUC_A, avoids=True, read_blocks=8)
    recorder = run(far, "G1 G41 X0 Y0\nX20\nX40\nX41 Y1\nZ-3\nY60\nX0\nG40 Y-20")
    plunge = next(move for move in recorder.moves if move.end[2] != move.start[2])
    assert plunge.start[:2] == plunge.end[:2] == pytest.approx([36, 5])
    for one, two in zip(recorder.moves, recorder.moves[1:], strict=False):
        assert one.end == pytest.approx(two.start)


def test_a_slot_narrower_than_the_tool_is_bridged_where_all_of_it_is_seen() -> None:
    recorder = run(policies.SINUMERIK_NORM_G450, SLOT.format(49))
    assert [row for row in recorder.rows if row[1] < 80] == [("feed", 20, 5), ("feed", 49, 5)]


@pytest.mark.parametrize("policy", [AVOIDS, replace(AVOIDS, read_blocks=8), policies.SINUMERIK_NORM_G451])
def test_the_way_out_may_cross_the_way_in(policy: Policy) -> None:
    # Round a square: in along X0 from below, out along Y0 to the left; the two ways cross in its corner.
    recorder = run(policy, "G1 G41 X0 Y-20\nY50\nX50\nY0\nX-20\nG40 Y-30")
    assert recorder.points == [(-5, -20), (-5, 55), (55, 55), (55, -5), (-20, -5), (-20, -30)]


@pytest.mark.parametrize("policy", [AVOIDS, replace(AVOIDS, read_blocks=8), policies.SINUMERIK_NORM_G451])
def test_a_contour_may_overlap_its_beginning(policy: Policy) -> None:
    recorder = run(policy, "G1 G41 X0 Y0\nY50\nX50\nY0\nX0\nY3\nG40 X-20", start=(-30.0, 0.0, 0.0))
    assert recorder.points == [(-5, 0), (-5, 55), (55, 55), (55, -5), (-5, -5), (-5, 3), (-20, 3)]


@pytest.mark.parametrize("policy", [policies.FANUC_A, policies.SINUMERIK_NORM_G451])
def test_a_corner_is_that_of_the_machine_where_the_zero_is_moved_in_front_of_it(policy: Policy) -> None:
    reader = Reader(policy)
    reader.block("G1 G41 X10 Y0")
    reader.block("X40")
    reader.position = [-60.0, 30.0, 0.0]  # what was X40 Y0
    recorder = reader.run("Y60\nX-100")
    assert recorder.rows[:3] == [("feed", 10, 5), ("feed", 35, 5), ("feed", -65, 55)]
