"""The clock goes from event to event; it visits interpolation cycles only while somebody is armed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import pytest

from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from polycnc.channel.view import View
    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.execution.clock import Clock

LINE = "O1\nG90 G1 X100. F6000.\nG4 P500\nM30\n"


@dataclass
class Passing:
    """A condition on the axes: X comes past a place. It looks until then."""

    clock: Clock
    view: View
    place: float
    looked: list[float] = field(default_factory=list)
    seen: float = -1.0

    def look(self, time: float) -> None:
        self.looked.append(time)
        if self.view.machine[0] >= self.place:
            self.seen = self.view.machine[0]
            self.clock.disarm(self)


def clock_of(virtual: VirtualControl) -> Clock:
    return virtual._operation.clock


def armed(virtual: VirtualControl, place: float) -> Passing:
    clock = clock_of(virtual)
    watch = Passing(clock, virtual.channel.actual, place)
    clock.arm(watch)
    return watch


def test_a_run_for_which_nobody_has_to_look_visits_no_cycle() -> None:
    virtual = power_on(LINE)
    virtual.cycle_start()
    virtual.run()
    assert virtual.time > 1.5
    assert clock_of(virtual).visits == 0


@pytest.mark.parametrize("steps", [0, 1, 7])
def test_who_is_armed_looks_in_every_cycle_until_he_has_seen_enough(steps: int) -> None:
    virtual = power_on(LINE)
    cycle = virtual.machine.interpolation_cycle_s
    virtual.cycle_start()
    watch = armed(virtual, 40.0)
    if steps:
        while virtual.is_busy:
            virtual.step(steps * cycle)
    else:
        virtual.run()
    assert watch.looked == pytest.approx([cycle * (k + 1) for k in range(len(watch.looked))])
    assert 40.0 <= watch.seen < 40.0 + 100.0 * cycle + 1e-9, "in the first cycle behind the place"
    assert clock_of(virtual).visits == len(watch.looked) < 200


def test_who_looks_changes_nothing_for_the_axes() -> None:
    virtual, alone = power_on(), power_on()
    for each in (virtual, alone):
        each.cycle_start()
    armed(virtual, 1e9)
    while alone.is_busy:
        alone.step(0.1)
        virtual.step(0.1)
        assert virtual.machine_position == pytest.approx(alone.machine_position, abs=1e-9)
    assert virtual.state is alone.state


def test_an_actual_position_is_that_of_the_axis_and_not_of_the_blocks_that_are_prepared() -> None:
    virtual = power_on("G90 G0 X0\nTRANS X10\nG1 X100 F6000\nG1 X200\nM30\n", "sinumerik-840d")
    virtual.cycle_start()
    virtual.step(0.5)
    assert virtual.channel.coordinates.machine[0] == 210.0
    assert 10.0 < virtual.machine_position[0] < 100.0
    assert virtual.read_variable("$AA_IM[X]") == virtual.machine_position[0]
    assert virtual.read_variable("$AA_IW[X]") == pytest.approx(virtual.machine_position[0] - 10.0)
    virtual.run()
    assert virtual.read_variable("$AA_IM[X]") == 210.0
