"""How time passes: from event to event, for all channels together."""

from __future__ import annotations

from math import ceil, inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.states import State

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.execution.operation import Operation

#: Cycles that a program runs at least before anybody looks, where nobody has to.
FREE_CYCLES = 256
#: A run without limit ends after a day.
LONGEST_RUN_S = 86400.0


class MainLoop:
    """Lets time pass on the channels of a control.

    Args:
        operation: The channels, and what the control does with them.
        clock: The time.
    """

    def __init__(self, operation: Operation, clock: Clock) -> None:
        self._operation = operation
        self._clock = clock

    @property
    def is_busy(self) -> bool:
        """Whether something runs or moves."""
        operation = self._operation
        moving = operation.runs.move or operation.runs.move_beside_path
        execute = [run.execution for run in operation.runs]
        delayed = any(each.context.stop_delay and each.next_event < inf for each in execute)
        return moving or delayed or operation.status.state in (State.RUNNING, State.BRAKING)

    def step(self, seconds: float | None) -> None:
        """Let the time pass in whole interpolation cycles; one where none is named."""
        clock = self._clock
        clock.cycles += 1 if seconds is None else max(round(seconds / clock.cycle_s), 0)
        self._advance(clock.cycles * clock.cycle_s)

    def run(self, limit_s: float) -> None:
        """Let time pass until nothing runs any more."""
        operation, clock = self._operation, self._clock
        operation.follow_up()
        cycle = clock.cycle_s
        last = clock.cycles + ceil(limit_s / cycle)
        while self.is_busy and clock.cycles < last and (due := self._due) < inf:
            if operation.runs_freely:
                until = min(max(due, (clock.cycles + FREE_CYCLES) * cycle), last * cycle)
                operation.runs.first.execution.advance(until, freely=True)
                due = clock.time
            # Whole pieces in one step: nothing can happen before `due` but by a command.
            clock.cycles = min(max(ceil(due / cycle - 1e-9), clock.cycles + 1), last)
            self._advance(clock.cycles * cycle)

    def run_in_real_time(self, limit_s: float) -> None:
        """As `run`, as fast as time really passes."""
        from time import monotonic, sleep

        self._operation.follow_up()
        began, at = monotonic(), self._clock.time
        while self.is_busy and self._clock.time - at < limit_s:
            self.step(None)
            sleep(max(self._clock.time - at - (monotonic() - began), 0.0))

    def run_until(self, reached: Callable[[], bool], limit_s: float) -> bool:
        """Let time pass, cycle by cycle, until a condition holds; false if it did not within the limit."""
        last = self._clock.cycles + ceil(limit_s / self._clock.cycle_s)
        while not reached():
            if self._clock.cycles >= last:
                return False
            self.step(None)
        return True

    def _advance(self, until: float) -> None:
        """Go from event to event."""
        operation = self._operation
        if operation.runs_freely:
            operation.runs.first.execution.advance(until, freely=True)
            self._move_to(self._clock.time)
        while (due := self._due) < until:
            self._move_to(max(due, self._clock.time))
        self._move_to(until)

    @property
    def _due(self) -> float:
        return min(self._operation.runs.due, self._clock.next_visit)

    def _move_to(self, time: float) -> None:
        operation, since = self._operation, self._clock.time
        for run in operation.runs:
            run.execution.advance(time)
        while [run for run in operation.runs if run.execution.look_up()]:
            for run in operation.runs:
                run.execution.advance(time)
        operation.look_for_deadlock()
        for run in operation.runs:
            run.axes.arrive(time)
        self._clock.look(since)
        operation.follow_up()
