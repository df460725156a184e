"""Room for stretches: what is taken out of it and what stays."""

from __future__ import annotations

import pytest

from polycnc.motion.limits import axis_limits
from polycnc.motion.settings import DEFAULT
from polycnc.motion.third_order.laying.room import ROOM, RunRoom, axes_of, tops_of
from tests.motion.paths import MILL


def filled(count: int) -> RunRoom:
    """Lines of 1 mm along X."""
    room = RunRoom(3)
    while len(room.path.form) < count:
        room.laid.stretches = len(room.path.form)
        room.widen()
    for e in range(count):
        room.path.way[e + 1] = e + 1.0
        room.path.place[3 * (e + 1)] = e + 1.0
        room.path.leave[3 * e] = room.path.arrive[3 * e] = 1.0
        room.path.row[e] = e
    room.laid.stretches = count
    return room


def test_the_last_stretches_stay_and_go_on() -> None:
    room = filled(5)
    taken = room.cut_off(1)
    assert list(taken.way) == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert list(taken.row) == [0, 1, 2, 3]
    assert room.laid.stretches == 1
    assert list(room.path.way[:2]) == [4.0, 5.0]
    assert list(room.path.place[:6]) == [4.0, 0.0, 0.0, 5.0, 0.0, 0.0]
    assert room.path.row[0] == 4
    assert list(room.cut_off(0).way) == [4.0, 5.0]
    assert not room.is_open


def test_room_grows_and_keeps_what_is_in_it() -> None:
    room = filled(ROOM + 1)
    assert len(room.path.form) >= ROOM + 1
    before = list(room.path.way[: ROOM + 2])
    room.widen()
    assert list(room.path.way[: ROOM + 2]) == before
    assert not room.grow()  # stretches must be taken out first
    room.cut_off(1)
    assert room.grow()


def test_rapids_may_be_a_part_of_a_run_where_they_do_not_stop() -> None:
    stops = axis_limits(MILL, 1, ("X", "Y", "Z"), DEFAULT)
    stops.path.rapid_stops = 1.0
    assert list(tops_of(stops)) == list(stops.top_feed)
    stops.path.rapid_stops = 0.0
    assert list(axes_of(stops).speed) == [
        max(a, b) for a, b in zip(stops.top_feed, stops.top_rapid, strict=True)
    ]
    assert list(axes_of(stops).jerk) == pytest.approx([axis.jerk for axis in MILL.axes[:3]])
