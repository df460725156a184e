"""An axis is where the sum of its sources is: the path, the hand, and what is added to them."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import pytest

from polycnc.mainrun import State, VirtualControl
from polycnc.mainrun.axes.channel_axes import ChannelAxes
from polycnc.motion.phases.axis_move import AxisMove, axis_move
from tests.mainrun.support import power_on

#: Half a minute along X.
LINE = "O1\nG90 G1 X100. F200.\nM30\n"


class Superimposed:
    """A motion from 0 to a way, which stays then."""

    def __init__(self, move: AxisMove) -> None:
        self._move = move
        self.due = move.end

    def at(self, time: float) -> float:
        return self._move.after(time)[0]

    def arrive(self, time: float) -> None:
        if time >= self.due:
            self.due = inf


@dataclass
class Coupled:
    """Where another axis is, times a factor."""

    axes: ChannelAxes
    leader: int
    factor: float
    due: float = inf

    def at(self, time: float) -> float:
        return self.factor * self.axes[self.leader].setpoint(time)

    def arrive(self, time: float) -> None:
        """The leader has its own time."""


def axes_of(virtual: VirtualControl) -> ChannelAxes:
    return virtual._operation.runs.first.axes


def superimpose(virtual: VirtualControl, axis: int, way: float, speed: float) -> Superimposed:
    source = Superimposed(axis_move(0.0, 0.0, way, speed, 1000.0, virtual.time))
    axes_of(virtual)[axis].add(source)
    return source


def test_a_superimposed_motion_is_added_to_the_path_that_runs() -> None:
    virtual, alone = power_on(LINE), power_on(LINE)
    for each in (virtual, alone):
        each.cycle_start()
        each.step(1.0)
    superimpose(virtual, 0, 5.0, 10.0)
    seen = []
    for _ in range(20):
        virtual.step(0.05)
        alone.step(0.05)
        seen.append(round(virtual.machine_position[0] - alone.machine_position[0], 9))
    assert seen == sorted(seen)
    assert 0.0 < seen[0] < 1.0 < seen[9] < 5.0
    assert seen[-1] == 5.0
    assert virtual.positions.work["X"] == alone.positions.work["X"], "the program does not know of it"
    assert virtual.positions.machine["X"] == pytest.approx(alone.positions.machine["X"] + 5.0)


def test_a_run_lasts_until_every_source_rests() -> None:
    virtual = power_on("O1\nG1 X1. F6000.\nM30\n")
    virtual.cycle_start()
    source = superimpose(virtual, 1, 20.0, 10.0)
    end = source.due
    assert virtual.run() is State.READY
    assert virtual.time == pytest.approx(end, abs=virtual.machine.interpolation_cycle_s)
    assert virtual.machine_position[:2] == [1.0, 20.0]


def test_a_source_that_is_removed_takes_its_share_with_it() -> None:
    virtual = power_on(LINE)
    source = superimpose(virtual, 2, 3.0, 10.0)
    virtual.run()
    assert virtual.machine_position[2] == 3.0
    axes_of(virtual)[2].remove(source)
    assert virtual.machine_position[2] == 0.0


def test_a_coupled_axis_follows_another_one_by_hand_and_on_its_path() -> None:
    virtual = power_on(LINE)
    axes = axes_of(virtual)
    axes[1].add(Coupled(axes, 0, -0.5))
    virtual.select_mode("handle")
    virtual.handle("X", 4000, 0.001)
    virtual.step(0.1)
    x, y, _ = virtual.machine_position
    assert 0.0 < x < 4.0
    assert y == pytest.approx(-0.5 * x)
    virtual.run()
    assert virtual.machine_position[:2] == pytest.approx([4.0, -2.0])
    virtual.select_mode("auto")
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[:2] == pytest.approx([100.0, -50.0])


def test_a_program_begins_where_the_sum_of_the_sources_is() -> None:
    virtual = power_on("O1\nG91 G1 X1. F6000.\nM30\n")
    superimpose(virtual, 0, 3.0, 10.0)
    virtual.run()
    virtual.select_mode("handle")
    virtual.handle("X", 2000, 0.001)
    virtual.run()
    virtual.select_mode("auto")
    virtual.cycle_start()
    virtual.run()
    assert virtual.machine_position[0] == pytest.approx(6.0)
    assert virtual.positions.work["X"] == pytest.approx(3.0), (
        "of the hand it knows, of the motion that is added not"
    )
