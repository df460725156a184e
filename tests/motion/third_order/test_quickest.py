"""Room for laws: what it costs, and that nothing that a law leaves there reaches another one."""

from __future__ import annotations

import platform
import subprocess
import sys
from array import array

import pytest

from polycnc.motion.third_order.laws.courses import Axes
from polycnc.motion.third_order.laws.quickest import Found, Room, course_of, quickest

AXES = Axes(array("d", (200.0, 200.0)), array("d", (2000.0, 2000.0)), array("d", (40000.0, 40000.0)))


def law_of_line(length: float, room: Room | None = None) -> Found:
    """From rest to rest in one piece."""
    course = course_of(
        array("d", (0.0, length)),
        array("d", (0.8, 0.6) * 2),
        array("d", (0.0,) * 4),
        array("d", (100.0**2,)),
        array("d", (1.0,)),
    )
    found = quickest(course, AXES, array("d", (0.0,) * 4), room=room)
    assert found is not None
    return found


def test_room_that_is_no_longer_used_is_that_of_the_next() -> None:
    room = Room()
    kept = room.numbers("test", 5000, 1, 2)
    assert [len(each) for each in kept] == [5000, 10000]
    del room
    assert Room().numbers("test", 4000, 1, 2) is kept


def test_two_rooms_in_use_share_nothing() -> None:
    one, other = Room(), Room()
    assert one.numbers("test", 10, 1)[0] is not other.numbers("test", 10, 1)[0]


def test_what_a_law_has_left_does_not_matter() -> None:
    room = Room()
    law_of_line(500.0, room)
    arrays = [each for found in room._arrays.values() for each in found]
    assert len(arrays) > 10
    for each in arrays:
        each[:] = array("d", (float("nan"),)) * len(each)
    assert law_of_line(50.0, room).phases == law_of_line(50.0, Room()).phases


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="other C libraries keep memory, or never do")
def test_memory_of_laws_is_not_given_back_between_them() -> None:
    script = """
from array import array
from resource import RUSAGE_SELF, getrusage
from polycnc.motion.third_order.laws.quickest import Room, numbers
Room()
for warm in range(2):
    before = getrusage(RUSAGE_SELF).ru_minflt
    for _ in range(20):
        found = [numbers(100_000) for _ in range(5)]
        del found
print(getrusage(RUSAGE_SELF).ru_minflt - before)
"""
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert int(told.stdout) < 1000  # five times 800 kB are as many pages, each time
