"""Every class of corner of FANUC 0i-TF Plus 5.4.2 to 5.4.4 against points found in another way.

Outer corners are told by their bisector; inner ones are searched for along the parallel of the block in front, as the
place where the tool touches the block behind.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, radians, sin

import pytest

from polycnc.channel.moves.path import Move
from polycnc.compensation.cutter import CutterCompensation
from polycnc.compensation.policy import Policy
from polycnc.geometry.offset import Joint, Outer
from polycnc.toolpath import Kind
from tests.compensation import policies
from tests.compensation.support import CODES, G17, Recorder, into

Spot = tuple[float, float]
TOOL, BEND, LENGTH = 4.0, 40.0, 30.0
ARCS = Outer(90.0, Joint.ARC)
#: How the path bends, seen in the direction of travel.
BENDS = {"line": 0, "arc to the left": 1, "arc to the right": -1}
TURNS = [1, 20, 45, 89, 90, 91, 120, 160]


def along(bend: int, way: float) -> Spot:
    """The point after a way from the origin on a path that starts along +u and bends."""
    if not bend:
        return (way, 0.0)
    return (BEND * sin(way / BEND), bend * BEND * (1 - cos(way / BEND)))


def turned(spot: Spot, angle: float) -> Spot:
    return (spot[0] * cos(angle) - spot[1] * sin(angle), spot[0] * sin(angle) + spot[1] * cos(angle))


class Corner:
    """Two edges that meet in the origin: one arrives along +u, the other leaves turned by an angle."""

    def __init__(self, front: int, behind: int, turn_deg: float, side: int) -> None:
        self.front, self.behind, self.turn, self.side = front, behind, radians(turn_deg), side
        self.is_outer = self.turn * side < 0

    def on_front(self, way: float) -> Spot:
        """A point of the edge in front, `way` before the corner."""
        u, v = along(self.front, way)
        return (-u, v)

    def on_behind(self, way: float) -> Spot:
        return turned(along(self.behind, way), self.turn)

    def centers(self) -> tuple[Spot | None, Spot | None]:
        front = (0.0, self.front * BEND) if self.front else None
        behind = turned((0.0, self.behind * BEND), self.turn) if self.behind else None
        return front, behind

    def square(self, angle: float) -> Spot:
        """The vector square on a direction."""
        return (-self.side * TOOL * sin(angle), self.side * TOOL * cos(angle))

    def inner_point(self) -> Spot:
        """Where the tool, sliding back along the edge in front, first touches the line or circle of the one behind."""
        center = self.centers()[1]

        def clear(way: float) -> float:
            """Distance of the tool's centre from the edge behind, less its radius, on the tool's side."""
            u, v = along(self.front, way)
            lean = -self.front * way / BEND
            square = self.square(lean)
            u, v = -u + square[0], v + square[1]
            if center is None:
                return self.side * (-u * sin(self.turn) + v * cos(self.turn)) - TOOL
            return (BEND - hypot(u - center[0], v - center[1])) * self.side * self.behind - TOOL

        low, high = 0.0, 0.0
        while clear(high) < 0.0:
            low, high = high, high + 0.05
            assert high < LENGTH
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if clear(middle) < 0.0 else (low, middle)
        u, v = along(self.front, high)
        square = self.square(-self.front * high / BEND)
        return (-u + square[0], v + square[1])

    def way_round(self, arcs: bool) -> list[Spot]:
        """The points of an outer corner in offset mode."""
        first, last = self.square(0.0), self.square(self.turn)
        if abs(self.turn) > pi / 2 + 1e-9:
            if arcs:
                return [first, last]
            reach = [
                (first[0] + TOOL, first[1]),
                (last[0] - TOOL * cos(self.turn), last[1] - TOOL * sin(self.turn)),
            ]
        else:
            # On the bisector of the two vectors, at r / cos(turn / 2).
            far, middle = TOOL / cos(0.5 * self.turn), 0.5 * self.turn
            reach = [(-self.side * far * sin(middle), self.side * far * cos(middle))]
        return [*([first] if self.front else []), *reach, *([last] if self.behind else [])]


def run(policy: Policy, corner: Corner, roles: str) -> Recorder:
    """Lead-in, front, behind, lead-out; `roles` says which of the two are compensated: "both", "front", "behind"."""
    recorder = Recorder()
    stage = into(recorder, CutterCompensation(G17, replace(policy, least_move_mm=0.0), CODES))
    start, end = corner.on_front(LENGTH), corner.on_behind(LENGTH)
    front, behind = corner.centers()
    slope = corner.front * -LENGTH / BEND
    before = (start[0] - LENGTH * cos(slope), start[1] - LENGTH * sin(slope))
    slope = corner.turn + corner.behind * LENGTH / BEND
    beyond = (end[0] + LENGTH * cos(slope), end[1] + LENGTH * sin(slope))
    edges = [(before, start, None, 0), (start, (0.0, 0.0), front, corner.front),
             ((0.0, 0.0), end, behind, corner.behind), (end, beyond, None, 0)]  # fmt: skip
    engages = {"both": 0, "front": 0, "behind": 1}[roles]
    cancels = {"both": 3, "front": 2, "behind": 3}[roles]
    for line, (one, two, center, bend) in enumerate(edges):
        if line == engages:
            stage.engage(corner.side, TOOL)
        if line == cancels:
            stage.cancel()
        kind = {0: Kind.FEED, 1: Kind.CCW, -1: Kind.CW}[bend]
        place = None if center is None else (*center, 0.0)
        if line <= cancels:
            stage.move(Move(kind, [*one, 0.0], [*two, 0.0], 1.0, line=line, center=place))
            stage.block()
    stage.flush()
    return recorder


def points(recorder: Recorder, line: int) -> list[Spot]:
    """Where the rows of a line end, without those that lie in the same place."""
    found = [(move.end[0], move.end[1]) for move in recorder.moves if move.line == line]
    return [pytest.approx(point, abs=1e-6) for point in found]  # type: ignore[misc]


@pytest.mark.parametrize("front", BENDS.values(), ids=[f"{name} first" for name in BENDS])
@pytest.mark.parametrize("behind", BENDS.values(), ids=[f"then {name}" for name in BENDS])
@pytest.mark.parametrize("side", [1, -1], ids=["G41", "G42"])
@pytest.mark.parametrize("arcs", [False, True], ids=["CCC=0", "CCC=1"])
def test_corners_in_offset_mode(front: int, behind: int, side: int, arcs: bool) -> None:
    policy = replace(policies.FANUC_A, outer=ARCS) if arcs else policies.FANUC_A
    for turn in (*TURNS, *(-turn for turn in TURNS)):
        corner = Corner(front, behind, turn, side)
        if not corner.is_outer and abs(turn) > 120:
            # The parallels of these lengths do not meet any more.
            continue
        rows = points(run(policy, corner, "both"), 1)
        assert (corner.way_round(arcs) if corner.is_outer else [corner.inner_point()]) == rows, turn


@pytest.mark.parametrize("other", BENDS.values(), ids=BENDS)
@pytest.mark.parametrize("side", [1, -1], ids=["G41", "G42"])
@pytest.mark.parametrize("turn", [*TURNS, *(-turn for turn in TURNS)])
def test_start_up_of_types_a_and_b(other: int, side: int, turn: float) -> None:
    corner = Corner(0, other, turn, side)
    square = [corner.square(corner.turn)]
    assert square == points(run(policies.FANUC_A, corner, "behind"), 1)
    assert (corner.way_round(False) if corner.is_outer else square) == points(
        run(policies.FANUC_B, corner, "behind"), 1
    )


@pytest.mark.parametrize("other", BENDS.values(), ids=BENDS)
@pytest.mark.parametrize("side", [1, -1], ids=["G41", "G42"])
@pytest.mark.parametrize("turn", [*TURNS, *(-turn for turn in TURNS)])
def test_cancel_of_types_a_and_b(other: int, side: int, turn: float) -> None:
    corner = Corner(other, 0, turn, side)
    square = [corner.square(0.0)]
    assert square == points(run(policies.FANUC_A, corner, "front"), 1)
    assert (corner.way_round(False) if corner.is_outer else square) == points(
        run(policies.FANUC_B, corner, "front"), 1
    )


@pytest.mark.parametrize("side", [1, -1], ids=["G41", "G42"])
@pytest.mark.parametrize("arcs", [False, True], ids=["CCC=0", "CCC=1"])
def test_a_path_that_turns_right_back_is_an_outer_corner(side: int, arcs: bool) -> None:
    policy = replace(policies.FANUC_A, outer=ARCS) if arcs else policies.FANUC_A
    reach = 0.0 if arcs else TOOL
    rows = points(run(policy, Corner(0, 0, 180, side), "both"), 1)
    assert [(reach, side * TOOL), (reach, -side * TOOL)] == rows


@pytest.mark.parametrize("side", [1, -1], ids=["G41", "G42"])
def test_a_path_that_goes_straight_on_has_one_vector(side: int) -> None:
    assert [(0.0, side * TOOL)] == points(run(policies.FANUC_A, Corner(0, 0, 0, side), "both"), 1)
