"""Readings of a whole control: of the moment at which the clock stands."""

from __future__ import annotations

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.commands.states import State
from polycnc.mainrun.reading.snapshot import Overrides, Snapshot
from polycnc.motion.frames import shown_by_hand
from polycnc.toolpath.events import Auxiliary, SpindleSpeed, ToolSelection

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.mainrun.execution.operation import Operation
    from polycnc.mainrun.reading.snapshot import ChannelSnapshot, Positions, SpindleState
    from polycnc.toolpath import Event


def _word(event: Event) -> str:
    """How an auxiliary function is written in a program; empty for what is no such function."""
    if isinstance(event, Auxiliary):
        return f"M{event.code}"
    if isinstance(event, SpindleSpeed):
        return f"S{event.speed:g}"
    if isinstance(event, ToolSelection):
        return f"T{event.tool:g}" if isinstance(event.tool, float | int) else f'T="{event.tool}"'
    return ""


class Readings:
    """What a panel or a factory system reads.

    Args:
        operation: The channels, and what the control does with them.
        programs: What is loaded.
    """

    def __init__(self, operation: Operation, programs: Programs) -> None:
        self._operation = operation
        self._runs = operation.runs
        self._programs = programs

    @property
    def positions(self) -> Positions:
        """Positions as the displays show them."""
        return self._operation.positions(self._runs.first)

    @property
    def channels(self) -> Mapping[int, ChannelSnapshot]:
        """Every channel that has been spoken of, by number."""
        runs = sorted(self._runs, key=lambda run: run.number)
        return {
            run.number: run.snapshot(
                self._loaded_in(run.number), self._operation.positions(run), self._spindle_of(run)
            )
            for run in runs
        }

    def _loaded_in(self, channel: int) -> str:
        """Name of the program that is loaded in a channel; empty for none."""
        program = self._programs.mains.get(channel)
        return program.name if program is not None else ""

    @property
    def program(self) -> str:
        """Name of the loaded program; empty for none."""
        return self._loaded_in(self._runs.first.number)

    @property
    def spindle(self) -> SpindleState:
        """The spindle of the block in execution; where the machine's rules drive it, as they do."""
        return self._spindle_of(self._runs.first)

    def _spindle_of(self, run: ChannelRun) -> SpindleState:
        """The same of any channel; rules drive the machine's first spindle."""
        operation, spindle = self._operation, run.spindle
        signals = operation.signals
        if not operation.interlocks.drives_spindle or spindle.number != min(
            operation.machine.spindle, default=1
        ):
            return spindle
        direction = int(signals["SPINDLE_CW"] - signals["SPINDLE_CCW"])
        if not direction or not signals["SPINDLE_TURNS"]:
            return replace(spindle, rpm=0.0, direction=0)
        return replace(spindle, rpm=run.spindle_rpm(run.execution.context), direction=direction)

    @property
    def restart(self) -> Mapping[str, tuple[float, float]]:
        """Where a program waits while its axes stand elsewhere: axis to position and way that is left, work units."""
        run = self._runs.first
        if not run.axes.by_hand or self._operation.status.state not in (State.HOLD, State.STOPPED):
            return {}
        context = shown_by_hand(run.execution.context)
        here, waits = (
            run.display.on_path(axes, context) for axes in (run.machine_position, run.without_hand)
        )
        target = run.display.positions(waits, waits, waits, context).work
        left = run.display.positions(here, waits, here, context).to_go
        return {axis: (target[axis], left[axis]) for axis in target}

    @property
    def collected(self) -> tuple[str, ...]:
        """What a block search has collected for cycle start to put out: `M3`, `S1000`, `T2`."""
        happenings = self._operation.collected.get(self._runs.first.number, ())
        return tuple(word for each in happenings if (word := _word(each.event)))

    @property
    def feed(self) -> float:
        """Path speed now, mm/min; of the fastest axis where axes are moved by hand."""
        run = self._runs.first
        return 60.0 * max(run.execution.speed, run.axes.hand_speed())

    @property
    def _waiting(self) -> str:
        """What the program of the first channel stands for."""
        run = self._runs.first
        if self._operation.status.state is not State.RUNNING or run.execution.moving:
            return ""
        if run.execution.standing:
            return ""
        return "dwell" if run.execution.stands_for == "dwell_s" and not run.machinery.busy else "function"

    @property
    def snapshot(self) -> Snapshot:
        """Everything at once, of one moment."""
        operation, status, run = self._operation, self._operation.status, self._runs.first
        dials, channels = operation.switches.dials, self.channels
        first = channels[run.number]
        interrupted = run.reached.get(first.program, ())
        return Snapshot(
            time=operation.clock.time,
            mode=status.mode,
            state=status.state,
            halt=operation.halt,
            positions=first.positions,
            feed=self.feed,
            program=first.program,
            block=first.block,
            modal=first.modal,
            spindle=self.spindle,
            tool=first.tool,
            overrides=Overrides(dials.feed, dials.rapid, dials.spindle),
            switches=operation.switches.panel,
            signals=operation.signals.values,
            alarms=status.alarms,
            messages=first.messages,
            parts=first.parts,
            channels=channels,
            notices=operation.interlocks.messages,
            waiting=self._waiting,
            interruption=interrupted[0][1] if interrupted else 0,
            interrupted=interrupted,
        )
