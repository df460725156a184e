"""A program that is ready to run, and its run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT, Channel
from polycnc.channel.group import ChannelGroup
from polycnc.channel.states.passes import Passes
from polycnc.channel.states.standstill import Standstill
from polycnc.channel.states.unchanging import unchanging
from polycnc.channel.waits import Why
from polycnc.language.bulk.settings import Bulk
from polycnc.machine.layout import axis_layout
from polycnc.session.result import Result
from polycnc.toolpath import Toolpath
from polycnc.toolpath.trace import Display

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.mainrun.continuation import Continuation
    from polycnc.memory.retained import RetainedStore
    from polycnc.motion.explain import TimeAccount
    from polycnc.motion.sampling.samples import Sampler, Samples
    from polycnc.program import Program, ProgramStore
    from polycnc.session.result import Lead
    from polycnc.toolpath.events import Raised
    from polycnc.toolpath.table import Chunk


class Session:
    """A program that is ready to run on a control and a machine.

    Args:
        control: The control.
        machine: The machine.
        setup: Offsets, tools, parameters, switches that the run starts from.
        store: Where the control finds subprograms.
        program: The main program.
        block_limit: The run ends with the control's alarm after so many blocks.
        keep: Keep the whole toolpath; without it, each chunk is planned, consumed and dropped.
        timed: Plan chunks before they are dropped; without it, there is no cycle time.
        bulk: Scan plain blocks of long programs in bulk: faster, with the same result.
        retained: The control's memory. Where it holds something, the setup does not count; what the program leaves
            behind lasts from the end of the run on. None for one that ends with the session.

    Attributes:
        consumers: Called with each chunk of the toolpath, in order, while the program runs.
        result: What `run` gives.
        main_run: What executes the program in time, from the first block on that needs the clock; None until then.
    """

    def __init__(
        self,
        control: Control,
        machine: Machine,
        setup: Setup,
        store: ProgramStore,
        program: Program,
        *,
        block_limit: int = DEFAULT_BLOCK_LIMIT,
        keep: bool = True,
        timed: bool = True,
        bulk: bool = True,
        retained: RetainedStore | None = None,
    ) -> None:
        self.consumers: list[Callable[[Chunk], object]] = []
        toolpath = Toolpath(machine.channel_axes(1), on_full=self._take)
        self.channel = Channel(
            control, machine, setup, store, block_limit=block_limit, toolpath=toolpath,
            bulk=Bulk() if bulk else None, retained=retained,
        )  # fmt: skip
        self._keep = keep
        self._in_time = False
        self.main_run: Continuation | None = None
        self.channel.move_times = Planned()
        self.channel.passes = Passes()
        self.channel.standstill = Standstill()
        self.group = ChannelGroup(self.channel)
        display = Display(toolpath, axis_layout(machine, 1), self._event_text, control.display_names)
        lead: Lead = {
            "start": self.channel.coordinates.machine,
            "tool": setup.tool_at_start(1),
            "settings": control.motion_settings(self.channel),
        }
        self.result = Result(program, control, machine, self.channel, display, lead)
        self.result.timed = keep or timed
        if self.result.timed and not keep:
            from polycnc.motion.planner import Planner

            self.result.planner = Planner(toolpath, machine, keep_rows=False, **self.result.lead)

    def run(self) -> Result:
        """Run to the end of the program or to an alarm. Programmed stops are recorded and started again.

        Raises:
            MemoryFileError: What is to last could not be written into its file.
        """
        for wait in self.group.run(self.result.program):
            if wait.reason is Why.CLOCK:
                self._go_on_in_time()
                break
            if wait.reason is Why.SINGLE_BLOCK:
                self.result.stops.extend([*self.channel.inner_halts, self._halt(wait)])
                self.channel.inner_halts.clear()
        self.channel.retained.commit()
        for consume in self.consumers:
            consume(self.channel.toolpath.chunk)
        return self.result

    def _go_on_in_time(self) -> None:
        """The program needs the clock: a main run executes the rest of it.

        Its rows are handed on behind it: what an action drops of a move is known when the axes stand.
        """
        from polycnc.mainrun.continuation import Continuation  # programs without actions do not pay for it

        toolpath = self.channel.toolpath
        first, self._in_time = len(toolpath.chunks) - 1, True
        main_run = self.main_run = Continuation(self.group)
        main_run.run()
        self._in_time = False
        self.result.stops.extend(main_run.halts)
        self.result.main_run_s = main_run.seconds
        for chunk in toolpath.join_chunks(first):
            if self._take(chunk):
                toolpath.chunks.remove(chunk)

    def sample(self, period_s: float, give: Callable[[Samples], None]) -> Sampler:
        """Have the motion sampled while it is planned (`keep=False`). Needs NumPy.

        When the result is planned to its end (`result.plan`), `close` of what this returns gives the last samples.
        """
        from polycnc.motion.sampling.samples import Sampler

        result = self.result
        if result.planner is None:
            raise ValueError("only a session that keeps no toolpath is planned while it runs")
        settings = result.lead["settings"]
        sampler = Sampler(result.toolpath, result.machine, result.planner, settings, period_s, give)
        self.consumers.append(sampler.take)
        return sampler

    def explain_time(self) -> TimeAccount:
        """Have it counted, while the program is planned (`keep=False`), which limit holds for how long."""
        from polycnc.motion.explain import TimeAccount

        result = self.result
        if result.planner is None:
            raise ValueError("only a session that keeps no toolpath is planned while it runs")
        return TimeAccount(result.toolpath, result.planner)

    def _take(self, chunk: Chunk) -> bool:
        if self._in_time:
            return False
        for consume in self.consumers:
            consume(chunk)
        if self.result.planner is not None:
            self.result.planner.take(chunk)
        return not self._keep

    def _event_text(self, raised: Raised) -> str:
        """The text of an alarm of the toolpath."""
        same = (
            alarm for alarm in self.channel.alarms if (alarm.code, alarm.line) == (raised.code, raised.line)
        )
        return next((self.result.alarm_text(alarm) for alarm in same), "")

    def _halt(self, wait: Wait) -> str:
        """The N word of the block at which the run has halted, or its line."""
        if wait.code:
            return wait.code
        level = self.channel.level
        return level.block_name()


@unchanging
class Planned:
    """The planner's `MoveTimes`; it is imported when it is first asked."""

    def share_after(self, channel: Channel, end: list[float], feed: float, seconds: float) -> float | None:
        """As `motion.sampling.timing` has it."""
        from polycnc.motion.sampling.timing import share_after

        return share_after(channel, end, feed, seconds)

    def later_on_row(
        self, channel: Channel, mark: int, start: list[float], share: float, seconds: float
    ) -> tuple[float | None, float]:
        """As `motion.sampling.timing` has it."""
        from polycnc.motion.sampling.timing import later_on_row

        return later_on_row(channel, mark, start, share, seconds)
