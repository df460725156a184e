"""Runs by law in the hands of an operator: where they end, rest and go on, and how much of them is known."""

from __future__ import annotations

from math import cos, sin

import pytest

from polycnc.mainrun import State
from polycnc.mainrun.motion.law_motion import LawMotion
from tests.mainrun.support import execution_of, power_on

SINUMERIK = "sinumerik-840d"
LINES = "SOFT G642 G1 X20 F6000\nY20\nX40 Y25\nY0\nX60\nX61 Y3\nM30\n"


def facets(count: int) -> str:
    lines = "".join(f"X{50 * sin(k / 50):.4f} Y{50 - 50 * cos(k / 50):.4f}\n" for k in range(1, count + 1))
    return f"SOFT G642 G1 F6000\n{lines}M30\n"


def test_single_block_from_the_start_halts_at_the_programmed_ends() -> None:
    virtual = power_on(LINES, SINUMERIK)
    virtual.set_switches(single_block=True)
    ends = []
    for _ in range(6):
        virtual.cycle_start()
        assert virtual.run() is State.STOPPED
        ends.append(tuple(virtual.machine_position[:2]))
    assert ends == [(20.0, 0.0), (20.0, 20.0), (40.0, 25.0), (40.0, 0.0), (60.0, 0.0), (61.0, 3.0)]


def test_single_block_on_the_way_halts_behind_the_first_block_for_which_the_axes_can() -> None:
    virtual = power_on(facets(200), SINUMERIK)
    virtual.cycle_start()
    virtual.step(0.6)
    line = virtual.active_block.line
    virtual.set_switches(single_block=True)
    assert virtual.run() is State.STOPPED
    halted = virtual.active_block.line
    assert line + 3 < halted < line + 9, "a facet of 1 mm is too short at 100 mm/s"
    virtual.cycle_start()
    assert virtual.run() is State.STOPPED
    assert virtual.active_block.line == halted + 1
    virtual.set_switches(single_block=False)
    virtual.cycle_start()
    assert virtual.run() is State.READY


def test_axes_rest_before_a_rapid_whose_override_is_zero() -> None:
    virtual = power_on("SOFT G645 G1 X20 F6000\nY20\nG0 X60 Y21\nG1 X80\nM30\n", SINUMERIK)
    virtual.override(rapid=0.0)
    virtual.cycle_start()
    virtual.step(2.0)
    assert virtual.machine_position == pytest.approx([20.0, 20.0, 0.0], abs=0.01)
    virtual.override(rapid=0.5)
    assert virtual.run() is State.READY
    assert virtual.machine_position == [80.0, 20.0 + 1.0, 0.0]


@pytest.mark.parametrize("after", [0.02, 0.13, 0.3, 0.41, 0.77])
def test_without_feed_the_axes_rest_and_go_on_where_they_are(after: float) -> None:
    virtual = power_on(LINES, SINUMERIK)
    virtual.cycle_start()
    virtual.step(after)
    virtual.override(feed=0.0)
    virtual.step(0.3)
    stands = virtual.machine_position
    virtual.step(1.0)
    assert virtual.machine_position == stands
    assert execution_of(virtual).speed == 0.0
    virtual.override(feed=1.0)
    assert virtual.run() is State.READY
    assert virtual.machine_position == [61.0, 3.0, 0.0]


def test_a_lower_override_is_reached_without_coming_below_it() -> None:
    virtual = power_on("SOFT G642 G1 X100 F6000\nX200 Y1\nM30\n", SINUMERIK)
    virtual.cycle_start()
    virtual.step(0.5)
    virtual.override(feed=0.8)
    feeds = []
    for _ in range(40):
        virtual.step()
        feeds.append(virtual.feed)
    assert min(feeds) > 4600.0
    assert feeds[-1] == pytest.approx(4800.0, rel=0.01)


def test_a_higher_override_is_reached_at_once() -> None:
    virtual = power_on(facets(300), SINUMERIK)
    virtual.override(feed=0.1)
    virtual.cycle_start()
    virtual.step(1.0)
    virtual.override(feed=1.0)
    feeds = []
    for _ in range(60):
        virtual.step()
        feeds.append(virtual.feed)
    assert feeds == sorted(feeds) or max(feeds) - feeds[-1] < 30.0
    assert feeds[30] > 5900.0


def test_a_channel_that_computes_without_end_lets_the_run_end() -> None:
    virtual = power_on("SOFT G642 G1 X20 F6000\nY20\nAGAIN: R1=R1+1\nGOTOB AGAIN\nM30\n", SINUMERIK)
    virtual.cycle_start()
    virtual.step(2.0)
    assert virtual.machine_position == [20.0, 20.0, 0.0]


def test_a_long_run_is_known_a_part_at_a_time() -> None:
    virtual = power_on(facets(6000), SINUMERIK)
    virtual.cycle_start()
    rows, pieces = 0, 0
    while virtual.state is State.RUNNING:
        virtual.step(0.2)
        by_law = execution_of(virtual)._by_law
        if by_law._run is not None:
            rows = max(rows, len(by_law._rows.rows))
            pieces = max(pieces, sum(len(part.way) for part in by_law._run._parts))
    assert rows < 5000
    assert pieces < 5000


def test_a_function_that_is_done_in_time_leaves_the_run_as_it_is() -> None:
    virtual = power_on("SOFT G642 G1 X20 F6000\nX40 Y1 M8\nX60\nM30\n", SINUMERIK)
    virtual.cycle_start()
    virtual.step(0.2)
    execution = execution_of(virtual)
    assert isinstance(execution.motion, LawMotion)
    execution.gate(closed=True)
    virtual.step(0.02)
    execution.gate(closed=False)
    assert virtual.run() is State.READY
    assert virtual.machine_position == [60.0, 1.0, 0.0]
