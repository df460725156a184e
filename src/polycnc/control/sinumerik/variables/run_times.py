"""How long programs run: `$AC_CYCLE_TIME`, `$AC_CUTTING_TIME`, `$AC_PROG_NET_TIME_TRIGGER` and the like (14.8.2).

Times are those of the main run. A program that reads one is executed in time from its first block on; which timers run
says MD27860.
"""

from __future__ import annotations

import re

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import CLOCK
from polycnc.control.sinumerik.actions.actions import SynchronisedActions
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.sinumerik.names.values import Type
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.variables.row import Indices, Reader, RowWithStop

MODE, TRIGGER = "$MC_PROCESSTIMER_MODE", "$AC_PROG_NET_TIME_TRIGGER"
ACTUAL_NET = "$AC_ACT_PROG_NET_TIME"
#: Bits of MD27860.
OPERATING, CYCLE, CUTTING, WITHOUT_TOOL = 0, 1, 2, 7
NEUTRAL, EXIT, START, STOP, GO_ON = range(5)
MINUTE_S = 60.0
#: What a program says that is timed from its start.
_NAMES = regex(
    r"\$A[CN]_(SETUP|POWERON|OPERATING|CYCLE|CUTTING|(ACT|OLD)_PROG_NET)_TIME|\$AC_PROG_NET_TIME_TRIGGER",
    re.IGNORECASE,
)
#: Programs of more lines are not looked through.
LONG = 100_000


@dataclass(slots=True)
class RunTimes(PassiveWatcher, State, lifetime=Lifetime.POWER):
    """The timers of a channel, by simulated time in seconds; satisfies the channel's `Watcher`.

    Attributes:
        channel: Whose timers they are.
        powered: When the power was switched on.
        started: When the program began.
        running: A program is under way.
        is_wanted: A program of the channel reads timers.
        is_late: The program has begun without a clock: nobody knows how long it has run.
        cycle: Duration of the last program.
        operating: Duration of all programs before the present one.
        cutting: Duration of all cuts up to the present block.
        net: `$AC_ACT_PROG_NET_TIME` when its measurement was last started or stopped.
        net_since: When it was started; None while it is stopped.
        old: `$AC_OLD_PROG_NET_TIME`.
        count: How often that was written.
        is_triggered: The program measures by itself, so its end does not.
        since: When the block in execution began.
        place: Where the axes were then; empty for a block that cuts not.
    """

    channel: Channel[Any, Any, Any]
    powered: float = 0.0
    started: float = 0.0
    running: bool = False
    is_wanted: bool = False
    is_late: bool = False
    cycle: float = 0.0
    operating: float = 0.0
    cutting: float = 0.0
    net: float = 0.0
    net_since: float | None = None
    old: float = 0.0
    count: int = 0
    is_triggered: bool = False
    since: float = 0.0
    place: list[float] = field(default_factory=list)

    @classmethod
    def first(cls, channel: Channel[Any, Any, Any]) -> RunTimes:
        """The power has just come."""
        made = cls(channel)
        made.powered = made.now
        return made

    def compared(self) -> object:
        """They count by themselves."""
        return ()

    @property
    def now(self) -> float:
        """Simulated time."""
        clocked = self.channel.actual.clocked
        return clocked.time if clocked is not None else 0.0

    def begin(self) -> None:
        """A program begins."""
        self.started, self.running, self.is_triggered = self.now, True, False
        self.net, self.net_since = 0.0, self.now

    @property
    def of_program(self) -> float:
        """Duration of the program, or of the last one."""
        return self.now - self.started if self.running else self.cycle

    @property
    def actual_net(self) -> float:
        """`$AC_ACT_PROG_NET_TIME`."""
        return self.net + (self.now - self.net_since if self.net_since is not None else 0.0)

    def trigger(self, what: int) -> None:
        """Measure a section of the program: 1 ends, 2 starts, 3 stops, 4 goes on."""
        actual, now = self.actual_net, self.now
        self.is_triggered = self.is_triggered or what != NEUTRAL
        if what == EXIT:
            self._keep(actual)
        if what in (EXIT, START):
            self.net, self.net_since = 0.0, now
        elif what == STOP:
            self.net, self.net_since = actual, None
        elif what == GO_ON:
            self.net, self.net_since = actual, now

    def _keep(self, seconds: float) -> None:
        self.old = seconds
        self.count += 1

    # ---- the main run --------------------------------------------------------------------------------------

    def _positions(self) -> list[float]:
        clocked = self.channel.actual.clocked
        return [clocked.machine(i) for i in range(len(self.channel.axes))] if clocked is not None else []

    def look(self) -> None:
        """Timers ask for no cycle."""

    def block_begins(self) -> None:
        """A block begins that may cut: with a tool, or without one where machine data say so."""
        clocked, memory = self.channel.actual.clocked, self.channel.memory
        any_tool = memory.data.integer(MODE) >> WITHOUT_TOOL & 1 or memory.tools.active
        if clocked is not None and clocked.modal.get("motion") != "G0" and any_tool:
            self.since, self.place = self.now, self._positions()

    def block_ends(self) -> None:
        """Its time counts if it has moved an axis."""
        self.cutting, self.place = self.of_cuts, []

    @property
    def of_cuts(self) -> float:
        """`$AC_CUTTING_TIME`, that of the block in execution included."""
        moves = self.place and self._positions() != self.place
        return self.cutting + (self.now - self.since if moves else 0.0)

    @property
    def is_quiet(self) -> bool:
        """Nothing is looked at."""
        return True

    def abandon(self, *, reset: bool) -> None:
        """The program has ended; its net time is kept, unless it has measured by itself or was broken off."""
        if not self.running:
            return
        self.block_ends()
        self.cycle, self.running = self.of_program, False
        self.operating += self.cycle
        if not reset and not self.is_triggered:
            self._keep(self.actual_net)
        self.net, self.net_since = self.actual_net, None


def _reads_timers(line: str) -> bool:
    """Whether a line names a timer; most have no variable at all, and cost next to nothing."""
    return ("$A" in line or "$a" in line) and _NAMES.search(line) is not None


def begin(channel: SinumerikChannel) -> None:
    """A main program begins; one that reads timers is executed in time from here on."""
    times = RunTimes.of(channel)
    times.begin()
    programs = (program for program in channel.store if len(program.lines) <= LONG)
    times.is_wanted = any(_reads_timers(line) for program in programs for line in program.lines)
    times.is_late = not times.is_wanted and channel.actual.clocked is None
    if times.is_wanted:
        if channel.actual.clocked is None:
            channel.wait = CLOCK
        else:
            watch(channel)


def watch(channel: SinumerikChannel) -> None:
    """A main run executes the channel's rows: timers that are wanted count in it."""
    times, clocked = RunTimes.of(channel), channel.actual.clocked
    if times.is_wanted and clocked is not None:
        clocked.watch(times)


# ---- variables


def _times(channel: SinumerikChannel) -> RunTimes:
    times = RunTimes.of(channel)
    if not times.is_wanted and channel.actual.clocked is not None:
        times.is_wanted = True
        watch(channel)
    return times


def _timer(name: str, value: Callable[[RunTimes], float], bit: int | None = None) -> Reader:
    """Reads a timer that counts from the start; one that MD27860 has not switched on stays at zero.

    PC0001 in a program whose start was not timed: in one of more than `LONG` lines, or loaded since.
    """

    def read(channel: SinumerikChannel, _indices: Indices) -> float:
        if bit is not None and not channel.memory.data.integer(MODE) >> bit & 1:
            return 0.0
        times = _times(channel)
        if times.is_late and not (times.is_triggered and name == ACTUAL_NET):
            raise not_supported(name)
        return value(times)

    return read


def _triggered(channel: SinumerikChannel, _indices: Indices) -> int:
    """The trigger stands at its neutral state when it has acted."""
    _times(channel)
    return NEUTRAL


def _trigger(channel: SinumerikChannel, _indices: Indices, value: int) -> None:
    """Trigger a measurement: of an action that acts in its block alone once for that block."""
    if value not in range(GO_ON + 1):
        raise AlarmError("12560", text=TRIGGER)
    times = _times(channel)
    if channel.main_run is not None:
        channel.event(Deed(TRIGGER, value, lambda: times.trigger(value)))
        return
    actions = SynchronisedActions.of(channel)
    if channel.actual.clocked is None or not actions.looks or actions.run.action.number is not None:
        times.trigger(value)


_TIMERS: dict[str, tuple[Callable[[RunTimes], float], int | None]] = {
    "$AN_SETUP_TIME": (lambda times: times.now / MINUTE_S, None),
    "$AN_POWERON_TIME": (lambda times: (times.now - times.powered) / MINUTE_S, None),
    "$AC_OPERATING_TIME": (
        lambda times: times.operating + (times.of_program if times.running else 0.0),
        OPERATING,
    ),
    "$AC_CYCLE_TIME": (lambda times: times.of_program, CYCLE),
    "$AC_CUTTING_TIME": (lambda times: times.of_cuts, CUTTING),
    ACTUAL_NET: (lambda times: times.actual_net, None),
}
#: Variables for which a program needs the clock, and those that it may read ahead.
RUN_TIMES: dict[str, RowWithStop] = {
    **{name: (Type.REAL, _timer(name, *row), None, True) for name, row in _TIMERS.items()},
    TRIGGER: (Type.INT, _triggered, _trigger, True),
}
KEPT_TIMES: dict[str, RowWithStop] = {
    "$AC_OLD_PROG_NET_TIME": (Type.REAL, lambda channel, _: _times(channel).old, None, False),
    "$AC_OLD_PROG_NET_TIME_COUNT": (Type.INT, lambda channel, _: _times(channel).count, None, False),
}
