"""What a control says of itself: mode, state, alarms; and the trace of everything that happens."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from polycnc.mainrun.commands.states import Mode, State
from polycnc.mainrun.reading.snapshot import Record
from polycnc.messages import Alarm

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.messages import AlarmError

#: States in which nothing is done before the emergency stop is pulled out, or the power is on.
LOCKED_STATES = frozenset((State.EMERGENCY, State.OFF))


class Status:
    """Mode, state and alarms of a control; each has its signal, and each change its record.

    Args:
        control_id: The control.
        clock: The time.
        signals: The signal image.

    Attributes:
        mode: What the mode switch says.
        state: What the control is doing.
        alarms: Alarms that wait for reset.
        parts: How often a program has come to its end.
        listeners: Called with each `Record`, in order.
    """

    #: A snapshot does not go on to these: they are outside of the control.
    UNFOLLOWED: ClassVar = frozenset({"listeners"})

    def __init__(self, control_id: str, clock: Clock, signals: SignalImage) -> None:
        self.mode, self.state = Mode.AUTO, State.READY
        self.alarms: tuple[Alarm, ...] = ()
        self.parts = 0
        self.listeners: list[Callable[[Record], object]] = []
        self._control_id = control_id
        self._clock = clock
        self._signals = signals

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
            self._signals[self.state.upper()] = 0.0
            self.state = state
            self._signals[state.upper()] = 1.0
            self.report("state", state=state, **data)

    def fail(self, error: AlarmError) -> None:
        """An alarm at power-on."""
        self.alarms = (
            Alarm(
                self._control_id,
                error.code,
                args=dict(error.args_by_name),
                hint=error.hint,
                detail=error.detail,
            ),
        )
        self.state = State.ALARM

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
