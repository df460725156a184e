"""What a control says of itself: mode, state, alarms; and the trace of everything that happens."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar, TypeVar
from polycnc.mainrun.commands.states import Mode, State
from polycnc.mainrun.reading.snapshot import Record
from polycnc.memory.retained import ALARM_HISTORY, COUNTERS, MESSAGES
from polycnc.messages import Alarm

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import AlarmError

#: States in which nothing is done before the emergency stop is pulled out, or the power is on.
LOCKED_STATES = frozenset((State.EMERGENCY, State.OFF))
#: Alarms, or messages, that a history keeps.
LONGEST_HISTORY = 100


#: Names of counters.
PARTS, RUNNING_S = "parts", "running_s"
_Entry = TypeVar("_Entry")


class Counters(NamedTuple):
    """What a control counts beyond power-off: parts made, and the time for which programs have run, s.

    `cycle_s` is that time of the present or last run alone. Stops and holds count in neither.
    """

    parts: int
    running_s: float
    cycle_s: float = 0.0


def _note(history: dict[int, _Entry], entry: _Entry) -> None:
    """One more entry; the oldest are forgotten."""
    history[max(history, default=0) + 1] = entry
    while len(history) > LONGEST_HISTORY:
        del history[min(history)]


class Status:
    """Mode, state and alarms of a control; each has its signal, and each change its record.

    Args:
        control_id: The control.
        clock: The time.
        signals: The signal image.
        retained: Where the alarms and messages of the past lie, by a running number, and the counters.

    Attributes:
        mode: What the mode switch says.
        state: What the control is doing.
        alarms: Alarms that wait for reset.
        listeners: Called with each `Record`, in order.
    """

    #: A snapshot does not go on to these: they are outside of the control.
    UNFOLLOWED: ClassVar = frozenset({"listeners"})

    def __init__(self, control_id: str, clock: Clock, signals: SignalImage, retained: RetainedStore) -> None:
        self.mode, self.state = Mode.AUTO, State.READY
        self.alarms: tuple[Alarm, ...] = ()
        self.listeners: list[Callable[[Record], object]] = []
        self._control_id = control_id
        self._clock = clock
        self._signals = signals
        self._history: dict[int, Alarm] = retained.table(ALARM_HISTORY)
        self._messages: dict[int, str] = retained.table(MESSAGES)
        self._counters: dict[str, float] = retained.table(COUNTERS)
        self._running_since = self._cycle_s = 0.0

    @property
    def is_locked(self) -> bool:
        """Whether the emergency stop is pressed, or the power off."""
        return self.state in LOCKED_STATES

    def show(self) -> None:
        """Set the signals of mode and state."""
        self._signals[self.mode.upper()] = self._signals[self.state.upper()] = 1.0

    def turn_to(self, mode: Mode) -> None:
        """Another mode."""
        self._signals[self.mode.upper()] = 0.0
        self.mode = mode
        self._signals[mode.upper()] = 1.0
        self.report("mode", mode=mode)

    def become(self, state: State, **data: object) -> None:
        """Another state; `data` says why."""
        if state is not self.state:
            if self.state is State.RUNNING:
                self.count(RUNNING_S, self._runs_for)
                self._cycle_s += self._runs_for
            if state is State.RUNNING:
                self._running_since = self._clock.time
                self._cycle_s = 0.0 if self.state is State.READY else self._cycle_s
            self._signals[self.state.upper()] = 0.0
            self.state = state
            self._signals[state.upper()] = 1.0
            self.report("state", state=state, **data)

    def fail(self, error: AlarmError) -> None:
        """An alarm at power-on."""
        args = dict(error.args_by_name)
        self.show_alarms(
            (Alarm(self._control_id, error.code, args=args, hint=error.hint, detail=error.detail),)
        )
        self.state = State.ALARM

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """These wait for reset from now on; new ones go into the history, of which the oldest are forgotten."""
        for alarm in alarms:
            if alarm not in self.alarms:
                _note(self._history, alarm)
        self.alarms = alarms

    @property
    def alarm_history(self) -> tuple[Alarm, ...]:
        """The alarms of the past, the latest first."""
        return tuple(self._history[number] for number in sorted(self._history, reverse=True))

    def keep_message(self, message: str) -> None:
        """A program has put out a text for the operator."""
        _note(self._messages, message)

    @property
    def message_history(self) -> tuple[str, ...]:
        """The texts that programs have put out, the latest first."""
        return tuple(self._messages[number] for number in sorted(self._messages, reverse=True))

    def count(self, counter: str, more: float) -> None:
        """A counter goes on."""
        self._counters[counter] = self._counters.get(counter, 0.0) + more

    @property
    def counters(self) -> Counters:
        """What the counters say."""
        now = self._runs_for
        kept = self._counters
        return Counters(int(kept.get(PARTS, 0.0)), kept.get(RUNNING_S, 0.0) + now, self._cycle_s + now)

    @property
    def _runs_for(self) -> float:
        """How long the program has run since the last start, s."""
        return self._clock.time - self._running_since if self.state is State.RUNNING else 0.0

    def clear_history(self) -> None:
        """The alarms of the past are forgotten."""
        self._history.clear()

    def pulse(self, signal: str) -> None:
        """Something happens that has no length in time; the rules answer."""
        self._signals[signal] = 1.0
        self._signals[signal] = 0.0

    def report(self, what: str, channel: int = 1, /, **data: object) -> None:
        """Tell the listeners what has happened now."""
        if self.listeners:
            if channel != 1:
                data["channel"] = channel
            record = Record(self._clock.time, what, data)
            for listener in self.listeners:
                listener(record)
