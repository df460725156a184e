"""The path: stages stand by their rank, whatever order they were put in."""

from __future__ import annotations

from itertools import permutations
from typing import TYPE_CHECKING

import pytest

from polycnc.channel.moves.path import Rank, Recorder, Stage
from polycnc.session import open_session
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move, Path


class _Tracing(Stage):
    """Passes on, and says that it has been passed."""

    def __init__(self, seen: list[str]) -> None:
        self.seen = seen

    def move(self, move: Move) -> None:
        self.seen.append(type(self).__name__)
        super().move(move)


class _Corners(_Tracing):
    rank = Rank.CORNERS


class _Compensation(_Tracing):
    rank = Rank.COMPENSATION


class _Zones(_Tracing):
    rank = Rank.ZONES
    lasts = True


class _Idle(_Tracing):
    rank = Rank.SPLINE
    active = False


def _path() -> Path:
    session = open_session("M30\n", control="fanuc-m")
    session.run()
    return session.channel.path


@pytest.mark.parametrize("order", list(permutations((_Corners, _Compensation, _Zones))))
def test_stages_stand_by_their_rank(order: tuple[type[_Tracing], ...]) -> None:
    path, seen = _path(), list[str]()
    for kind in order:
        path.put(kind(seen))
    assert [type(stage) for stage in path.stages] == [_Corners, _Compensation, _Zones]
    assert path.head is path.stages[0]
    assert path.stages[-1].after.after is path.table  # behind the guard of the limits


def test_a_stage_takes_the_place_of_one_of_its_rank() -> None:
    path = _path()
    path.put(_Corners([]))
    second = path.put(_Corners([]))
    assert list(path.stages) == [second]


def test_taking_the_last_stage_out_leaves_no_head() -> None:
    path = _path()
    path.put(_Corners([]))
    path.table.end = [1.0]
    path.take(_Corners)
    assert path.head is None
    assert path.table.end == []


def test_moves_that_are_recorded_pass_only_stages_put_since() -> None:
    path, seen, recorder = _path(), list[str](), Recorder()
    corners = path.put(_Corners(seen))
    with path.diverted(recorder):
        assert path.find(_Corners) is None
        path.put(_Compensation(seen))
        assert [type(stage) for stage in path.stages] == [_Compensation, Recorder]
    assert list(path.stages) == [corners]


def test_a_program_that_is_broken_off_leaves_the_stages_that_last() -> None:
    path = _path()
    path.put(_Corners([]))
    zones = path.put(_Zones([]))
    recorder = Recorder()
    path.divert(recorder)
    path.clear()
    path.resume(recorder)
    assert list(path.stages) == [zones]


def test_relaxing_takes_out_what_has_nothing_to_do() -> None:
    path = _path()
    zones = path.put(_Zones([]))
    path.put(_Idle([]))
    path.relax()
    assert list(path.stages) == [zones]


def test_a_hypothetical_axis_stands_behind_normal_line_control() -> None:
    program = "G1 X10. F100\nG41.1\nG7 Y0\nX20. Y30.\nM30\n"
    session = open_session(program, control="meldas-m", setup={"machine": "mill4-c-head"})
    result = session.run()
    assert not result.alarms
    assert [stage.rank for stage in session.channel.path.stages] == [Rank.NORMAL, Rank.AXES]
    assert result.final["work"]["Y"] == 0.0


def test_an_event_behind_another_zero_stands_where_the_axes_stand() -> None:
    program = "G90 G17 G1 G41 D1 X10. F1000\nY10.\nM8\nG10 L2 P1 X7.\nM9\nM30\n"
    session = open_session(program, control="fanuc-m", setup={"tools": {1: {"radius": 3}}})
    result = session.run()
    rows = result.toolpath.chunks[-1]
    events = [i for i, kind in enumerate(rows.kind) if kind == Kind.EVENT]
    axes = len(result.toolpath.axes)
    assert [list(rows.end[axes * i : axes * i + 2]) for i in events] == [
        [7.0, 10.0],
        [0.0, 10.0],
        [0.0, 10.0],
    ]
