"""Threads wait for the spindle's zero mark: the first for half a turn, all others so that they meet it again."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from polycnc.machine import MFunction
from polycnc.machine.text import Text
from polycnc.motion import Settings
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.standing.zero_mark import SpindleAngle, lag_s
from polycnc.toolpath import Context, Kind
from polycnc.toolpath.events import Auxiliary, Message, SpindleWait
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.motion.paths import LATHE, Build
from tests.motion.sampling.test_samples import SOFT, sampled

if TYPE_CHECKING:
    from polycnc.motion.sampling.samples import Samples

BRISK = Settings(acceleration=AccelerationMode.CONSTANT)
LEAD, TOP = 2.0, 5.0
TURNING = Context(spindle_rpm=300.0, spindle_direction=1)
HALF_A_TURN = 0.1


def cut(rows: Build, depth: float, start_deg: float = 0.0, z: float = -60.0) -> Build:
    """A thread from Z5 on, the way off and back."""
    rows.rapid(depth, TOP).row(Kind.THREAD, depth, z, curve=(LEAD, start_deg))
    return rows.rapid(25.0, z).rapid(25.0, TOP)


def phases(samples: Samples, line: int) -> Any:
    """The spindle's angle less what the way of a thread asks for, at full speed, degrees of a turn."""
    speed = np.abs(samples.velocity[:, 1])
    level = (samples.line == line) & (np.abs(speed - speed[samples.line == line].max()) < 1e-6)
    assert level.sum() > 50
    turns = (TOP - samples.position[level, 1]) / LEAD
    sense = np.sign(samples.spindle_rpm[level])
    return (sense * samples.spindle_angle[level] - 360.0 * turns) % 360.0


def apart(one: Any, other: Any) -> float:
    """The largest distance of angles from the first of others, degrees."""
    return float(np.abs((one - other[0] + 180.0) % 360.0 - 180.0).max())


def waits(rows: Build, **options: Any) -> list[float]:
    """What each thread waits for, seconds."""
    result, kinds = rows.plan(LATHE, **options), [row.kind for row in rows.toolpath.rows()]
    return [result.row_waits.get(row, 0.0) for row, kind in enumerate(kinds) if kind is Kind.THREAD]


@pytest.mark.parametrize("lead", [BRISK, SOFT])
def test_every_cut_meets_the_thread_at_any_speed(lead: Settings) -> None:
    rows = cut(cut(Build(axes=("X", "Z"), context=TURNING), 19.0), 18.5)
    cut(rows.set(spindle_rpm=417.0), 18.0)
    cut(rows.set(spindle_rpm=60.0, spindle_direction=0).event(Auxiliary(5)).dwell(0.123), 17.5)
    rows.set(spindle_rpm=231.0, spindle_direction=1).event(Auxiliary(3))
    cut(cut(rows, 17.0), 16.5, start_deg=120.0)
    total, samples = sampled(rows, LATHE, lead=lead)
    assert samples.time[-1] == pytest.approx(total, abs=0.0011)
    lines = [
        line for line in np.unique(samples.line) if (samples.velocity[samples.line == line, 1] < -1.0).any()
    ]
    cuts = [
        line for line in lines if rows.toolpath.row_of(rows.toolpath.chunk, int(line) - 1).kind is Kind.THREAD
    ]
    found = [
        phases(samples, int(line)) for line in cuts if samples.spindle_rpm[samples.line == line].min() > 0.0
    ]
    assert len(found) == 5
    for other in found[:-1]:
        assert apart(other, found[0]) < 1e-3
    assert apart(found[-1], found[0] + 120.0) < 1e-3


def test_a_spindle_that_turns_the_other_way_meets_the_thread_too() -> None:
    rows = Build(axes=("X", "Z"), context=replace(TURNING, spindle_direction=-1))
    _, samples = sampled(cut(cut(rows, 19.0), 18.5, start_deg=90.0), LATHE)
    assert apart(phases(samples, 6), phases(samples, 2) + 90.0) < 1e-3


def test_cuts_alike_take_whole_turns() -> None:
    rows = Build(axes=("X", "Z"), context=TURNING).rapid(25.0, TOP)
    for _ in range(3):
        cut(rows, 19.0)
    result = rows.plan(LATHE)
    turns = sum(result.row_s[4:8]) * 300.0 / 60.0
    assert turns == pytest.approx(round(turns), abs=1e-6)
    assert waits(rows)[0] == pytest.approx(HALF_A_TURN)


def test_how_far_the_axes_get_behind_while_they_take_up_speed() -> None:
    rows = cut(Build(axes=("X", "Z"), context=TURNING), 19.0)
    for lead in (BRISK, SOFT):
        _, samples = sampled(rows, LATHE, period=1e-4, lead=lead)
        row, speed = samples.line == 2, LEAD * 300.0 / 60.0
        moving = row & (samples.velocity[:, 1] != 0.0)
        level = np.flatnonzero(row & (np.abs(samples.velocity[:, 1] + speed) < 1e-6))[0]
        since = samples.time[level] - samples.time[np.flatnonzero(moving)[0]]
        late = since - (TOP - samples.position[level, 1]) / speed
        record = recorded_lag(rows, lead)
        assert record == pytest.approx(late, abs=2e-4)


def recorded_lag(rows: Build, lead: Settings) -> float:
    """`lag_s` of the thread's first piece."""
    found: list[float] = []

    def note(pieces: Any, count: int) -> None:
        for at in range(0, count * piece_width(2), piece_width(2)):
            if pieces[at + PieceRecord.ROW] == 1.0 and not found:
                found.append(lag_s(pieces, at))

    Planner(rows.toolpath, LATHE, settings=lead, on_pieces=note).finish()
    return found[0]


@pytest.mark.parametrize("soft", [False, True])
def test_a_chain_waits_once(soft: bool) -> None:
    rows = Build(axes=("X", "Z"), context=TURNING).rapid(20.0, TOP)
    rows.row(Kind.THREAD, 20.0, -10.0, curve=(LEAD, 0.0)).event(Message("part"))
    rows.row(Kind.THREAD, 22.0, -20.0, curve=(LEAD, 90.0)).row(Kind.THREAD, 22.0, -30.0, curve=(1.0, 0.0))
    found = waits(rows, settings=SOFT if soft else BRISK)
    assert found[0] == pytest.approx(HALF_A_TURN)
    assert found[1:] == [0.0, 0.0]


@pytest.mark.parametrize("rest", ["function", "dwell", "speed", "move", "exact stop"])
def test_a_thread_behind_a_rest_meets_the_mark_again(rest: str) -> None:
    rows = Build(axes=("X", "Z"), context=TURNING).rapid(20.0, TOP)
    rows.set(corner_mode=CornerMode.EXACT_STOP if rest == "exact stop" else CornerMode.CONTINUOUS)
    rows.row(Kind.THREAD, 20.0, -10.0, curve=(LEAD, 0.0))
    if rest == "function":
        rows.event(Auxiliary(8))
    elif rest == "dwell":
        rows.dwell(0.0123)
    elif rest == "speed":
        rows.set(spindle_rpm=250.0)
    elif rest == "move":
        rows.feed(20.0, -10.5)
    rows.row(Kind.THREAD, 20.0, -20.0, curve=(LEAD, 0.0))
    assert waits(rows)[1] > 0.0


@pytest.mark.parametrize("why", ["surface", "tap", "orient", "wait", "beside"])
def test_an_angle_that_nobody_knows_takes_half_a_turn_again(why: str) -> None:
    rows = cut(Build(axes=("X", "Z"), context=TURNING), 19.0)
    machine = LATHE
    if why == "surface":
        rows.set(surface_speed=True, spindle_rpm=50.0).feed(25.0, 4.0)
        rows.set(surface_speed=False, spindle_rpm=300.0)
    elif why == "tap":
        rows.row(Kind.TAP, 25.0, -5.0, curve=(1.0, 0.0)).row(Kind.TAP, 25.0, TOP, curve=(1.0, 0.0))
    elif why == "orient":
        rows.event(Auxiliary(19))
    elif why == "wait":
        rows.event(SpindleWait(1, 0.3))
    else:
        machine = replace(LATHE, spindles=(replace(LATHE.spindles[0], speed_wait="never"),))
        rows.set(spindle_rpm=200.0).rapid(25.0, 3.0).set(spindle_rpm=300.0)
    rows.rapid(18.5, TOP).row(Kind.THREAD, 18.5, -60.0, curve=(LEAD, 0.0))
    result = rows.plan(machine)
    assert result.row_waits[len(rows.toolpath) - 1] == pytest.approx(HALF_A_TURN, abs=1e-9)


def test_what_the_row_waits_for_besides_comes_first() -> None:
    """The axes settle and a function runs on before the thread begins: it still meets the first one."""
    function = MFunction(8, Text("coolant"), 0.777, "with")
    machine = replace(LATHE, settle_fine_s=0.05, m_functions={8: function})
    rows = Build(axes=("X", "Z"), context=replace(TURNING, corner_mode=CornerMode.EXACT_STOP))
    cut(rows, 19.0)
    rows.event(Auxiliary(8)).line -= 1
    cut(rows, 18.5)
    _, samples = sampled(rows, machine)
    assert apart(phases(samples, 6), phases(samples, 2)) < 1e-3


def test_chunks_do_not_matter() -> None:
    found = []
    for chunk_rows in (1, 65_536):
        rows = Build(axes=("X", "Z"), context=TURNING, chunk_rows=chunk_rows)
        for depth in (19.0, 18.5, 18.0):
            cut(rows.set(spindle_rpm=200.0 + 10.0 * depth), depth)
        found.append(list(rows.plan(LATHE).row_s))
    assert found[0] == pytest.approx(found[1], abs=1e-12)


def test_an_override_turns_the_spindle_on_at_another_speed() -> None:
    angle = SpindleAngle()
    assert angle.until_start(60.0, 0.0, 0.0, 1.0) == 0.5
    assert angle.until_start(60.0, 0.0, 0.0, 1.5) == 0.0
    angle.turn_with(0.5, 2.0)  # half a turn further it slows down
    assert angle.until_start(60.0, 0.0, 0.0, 2.5) == pytest.approx(0.5)
    assert angle.until_start(60.0, 90.0, 0.0, 2.5) == pytest.approx(1.0)
    assert angle.until_start(0.0, 0.0, 0.0, 2.5) == 0.0
