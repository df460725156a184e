"""What a program will do, calculated beside the control and in pieces: nothing of the control changes by it.

A page that draws the path of a program, or looks for its alarms, lets the calculation go on a little whenever it has
time. It begins with the data of the control as they are now, with its axes where they stand, and in the modal state of
power-on. Where the program needs the clock or another channel it ends.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT, Channel
from polycnc.channel.states.passes import Passes
from polycnc.channel.states.standstill import Standstill
from polycnc.channel.waits import CHUNK, Why
from polycnc.language.bulk.settings import Bulk
from polycnc.memory.retained import copied
from polycnc.toolpath import Toolpath

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun.commands.programs import Programs
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import Alarm
    from polycnc.program import Program
    from polycnc.toolpath.table import Chunk

#: Blocks after which a calculation hands over.
SLICE = 64
#: What a calculation cannot wait for.
_OUT_OF_REACH = frozenset({Why.CLOCK, Why.CHANNEL, Why.PREPROCESSING})


class Forecast:
    """The calculation of a program.

    Args:
        channel: A channel that nobody else has.
        main: The program.

    Attributes:
        main: The program.
        take: Called with every chunk of rows that is full, and with the last one; the rows are dropped then.
        toolpath: Its rows.
        is_over: Nothing more comes.
        is_complete: The program was calculated to its end, or to an alarm.
    """

    def __init__(self, channel: Channel, main: Program) -> None:
        self.main, self.toolpath = main, channel.toolpath
        self.take: Callable[[Chunk], object] = _dropped
        self.is_over = self.is_complete = False
        self._channel = channel
        channel.burst = range(SLICE)
        channel.passes, channel.standstill = Passes(), _HandsOver()
        self._run = channel.run(main)

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
    store = programs.copy()
    if text is not None or main is None:
        main = store.add_text(programs.key_of(name or "MAIN"), text or "\n")
    here = dict(zip(like.axes, run.machine_position, strict=True))
    setup = replace(like.setup, start={**like.setup.start, **here})

    def on_full(chunk: Chunk) -> bool:
        forecast.take(chunk)
        return True

    channel = Channel(
        like.control, like.machine, setup, store, number=like.number, block_limit=block_limit,
        toolpath=Toolpath(like.axes, on_full=on_full), bulk=Bulk(), retained=copied(retained, like.number),
    )  # fmt: skip
    forecast = Forecast(channel, main)
    return forecast


def _dropped(_chunk: Chunk) -> None:
    """Nobody wants the rows."""
