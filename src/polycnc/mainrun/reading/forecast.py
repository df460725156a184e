"""What a program will do, calculated beside the control and in pieces: nothing of the control changes by it.

A page that draws the path of a program, or looks for its alarms, lets the calculation go on a little whenever it has
time. It begins with the data of the control as they are now, with its axes where they stand, and in the modal state of
power-on. Where the program needs the clock or another channel it ends.
"""

from __future__ import annotations

from functools import cached_property

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT, Channel
from polycnc.channel.states.passes import Passes
from polycnc.channel.states.standstill import Standstill
from polycnc.channel.waits import CHUNK, Why
from polycnc.control.registry import control as control_of
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.settings import Bulk
from polycnc.memory.retained import copied
from polycnc.toolpath import Toolpath

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.memory.retained import InMemoryStore, RetainedStore
    from polycnc.messages import Alarm
    from polycnc.program import Program, ProgramStore
    from polycnc.toolpath.table import Chunk

#: Blocks after which a calculation hands over.
SLICE = 64
#: What a calculation cannot wait for.
_OUT_OF_REACH = frozenset({Why.CLOCK, Why.CHANNEL, Why.PREPROCESSING})


@dataclass(frozen=True)
class Job:
    """What a calculation begins with: data that nothing of the control changes any more.

    Attributes:
        control: Id of the control.
        machine: The machine.
        setup: What the channel starts from.
        store: The programs that calls find.
        retained: What programs read and write of the control's memory.
        number: Number of the channel.
        axes: Its axes, and `position` where they stand, machine position.
        position: See `axes`.
        block_limit: The calculation ends after so many blocks.
        name: Name of the program, and `text` its text, where that is not in the memory as it is now.
        text: See `name`.
        main: The program where it is in the memory.
    """

    control: str
    machine: Machine
    setup: Setup
    store: ProgramStore
    retained: InMemoryStore
    number: int
    axes: tuple[str, ...]
    position: tuple[float, ...]
    block_limit: int
    name: str
    text: str | None
    main: Program | None


class Forecast:
    """The calculation of a program; its text is read when the calculation begins.

    Args:
        job: What is calculated.
        control: The control; None for the one that the job names.

    Attributes:
        job: What is calculated: it can be sent to another process, which begins it there.
        take: Called with every chunk of rows that is full, and with the last one; the rows are dropped then.
        is_over: Nothing more comes.
        is_complete: The program was calculated to its end, or to an alarm.
    """

    def __init__(self, job: Job, control: Control | None = None) -> None:
        self.job = job
        self.take: Callable[[Chunk], object] = _dropped
        self.is_over = self.is_complete = False
        self._control = control

    @cached_property
    def main(self) -> Program:
        """The program."""
        job = self.job
        if job.text is None and job.main is not None:
            return job.main
        return job.store.add_text(job.name, job.text or "\n")

    @cached_property
    def _channel(self) -> Channel:
        """A channel that nobody else has."""
        job, control, _ = self.job, self._control or control_of(self.job.control), self.main

        def on_full(chunk: Chunk) -> bool:
            self.take(chunk)
            return True

        channel = Channel(
            control, job.machine, job.setup, job.store, number=job.number, block_limit=job.block_limit,
            toolpath=Toolpath(job.axes, on_full=on_full), bulk=Bulk(), retained=job.retained,
        )  # fmt: skip
        channel.coordinates.arrive_machine(list(job.position))
        channel.burst = range(SLICE)
        channel.passes, channel.standstill = Passes(), _HandsOver()
        return channel

    @cached_property
    def _run(self) -> Iterator[Wait]:
        return self._channel.run(self.main)

    @property
    def toolpath(self) -> Toolpath:
        """Its rows."""
        return self._channel.toolpath

    @property
    def alarms(self) -> tuple[Alarm, ...]:
        """The alarms that have been found so far."""
        return tuple(self._channel.alarms)

    @property
    def has_reached_limit(self) -> bool:
        """Whether it has ended at the limit of blocks, not at what the program does."""
        return self._channel.blocks >= self._channel.block_limit

    def go_on(self) -> bool:
        """Calculate some further blocks; gives whether there is more to come."""
        if self.is_over:
            return False
        wait = next(self._run, None)
        if wait is not None and wait.reason not in _OUT_OF_REACH:
            return True
        self.is_over, self.is_complete = True, wait is None
        self.take(self.toolpath.chunk)
        return False

    def finish(self) -> None:
        """Calculate all that is left."""
        while self.go_on():
            pass


class _HandsOver(Standstill):
    """Lets a channel hand over after a few blocks; a program that waits for ever ends as in any calculation."""

    __slots__ = ("_compares_at",)

    def __init__(self) -> None:
        super().__init__()
        self._compares_at, self.next_look = self.next_look, 0

    def look(self, channel: Channel) -> None:
        """Look behind a block; raises as `Standstill.look` does."""
        if channel.blocks >= self._compares_at:
            super().look(channel)
            self._compares_at = self.next_look
        self.next_look = min(self._compares_at, channel.blocks + SLICE)
        channel.wait = channel.wait or CHUNK


def forecast_of(
    run: ChannelRun,
    programs: Programs,
    retained: RetainedStore,
    main: Program | None,
    *,
    text: str | None = None,
    name: str = "",
    block_limit: int = DEFAULT_BLOCK_LIMIT,
) -> Forecast:
    """The calculation of a program in the place of a channel.

    Args:
        run: The channel whose data count.
        programs: The programs that calls find.
        retained: What outlives the power.
        main: The program; None where `text` is the program.
        text: Its text, where it is not in the memory as it is now; `name` is its name there.
        name: See `text`.
        block_limit: The calculation ends after so many blocks.
    """
    like = run.channel
    kept, key = copied(retained, like.number), programs.key_of(name or "MAIN")
    job = Job(
        like.control.id, like.machine, like.setup, programs.copy(), kept, like.number, tuple(like.axes),
        tuple(run.machine_position), block_limit, key, text, main,
    )  # fmt: skip
    return Forecast(job, like.control)


def _dropped(_chunk: Chunk) -> None:
    """Nobody wants the rows."""
