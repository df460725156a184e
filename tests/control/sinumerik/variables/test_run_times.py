"""Timers of programs: measured sections, and the clock that a program needs from its start."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.variables.run_times import EXIT, GO_ON, LONG, NEUTRAL, START, STOP, RunTimes
from tests.control.sinumerik.support import codes, run


class Watch(RunTimes):
    """Timers with a clock of their own."""

    time = 0.0

    @property
    def now(self) -> float:
        return self.time


def timers() -> Watch:
    times = Watch(None)  # type: ignore[arg-type]  # it asks its channel for the time alone
    times.begin()
    return times


def test_a_section_leaves_out_what_lies_between_stop_and_go_on() -> None:
    times = timers()
    for time, what in ((5.0, START), (7.0, STOP), (20.0, GO_ON), (21.0, EXIT)):
        times.time = time
        times.trigger(what)
    assert (times.old, times.count, times.actual_net) == (3.0, 1, 0.0)


def test_the_neutral_trigger_does_nothing() -> None:
    times = timers()
    times.time = 2.0
    times.trigger(NEUTRAL)
    assert (times.actual_net, times.is_triggered) == (2.0, False)


@pytest.mark.parametrize(("reset", "old"), [(False, 4.0), (True, 0.0)])
def test_a_program_that_ends_correctly_keeps_its_time(reset: bool, old: float) -> None:
    times = timers()
    times.time = 4.0
    times.abandon(reset=reset)
    assert (times.old, times.running, times.operating) == (old, False, 4.0)


def test_a_program_without_timers_needs_no_clock() -> None:
    assert run("G4 F1").main_run_s is None
    assert run("G4 F1", "R1=$AC_CYCLE_TIME").main_run_s is not None


def test_a_program_too_long_to_be_looked_through_is_refused_what_counts_from_its_start() -> None:
    lines = ["; nothing"] * (LONG + 1)
    assert codes(run(*lines, "R1=$AC_CYCLE_TIME")) == [("PC0001", LONG + 2)]
    assert not run(*lines, "$AC_PROG_NET_TIME_TRIGGER=2", "R1=$AC_ACT_PROG_NET_TIME").alarms
