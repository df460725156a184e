"""The alarm table of the machine's own controller, asked with the live signals."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Auxiliary, BuilderCode, SecondAuxiliary, SpindleSpeed, ToolSelection

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine.plc import Plc, PlcAlarm
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.toolpath import Event

#: Words of a program's events that are not M codes.
EVENT_WORDS = {SpindleSpeed: "S_CODE", ToolSelection: "T_CODE", SecondAuxiliary: "B_CODE"}


def word_of(event: Event) -> str:
    """The word that an event asks the machine for; empty where it asks for none."""
    if isinstance(event, Auxiliary):
        return f"M{event.code}"
    return event.code if isinstance(event, BuilderCode) else EVENT_WORDS.get(type(event), "")


class Interlocks:
    """Refuses words and raises alarms.

    Args:
        plc: The tables.
        signals: The signal image.

    Attributes:
        on_alarm: Called with the number of an alarm that comes.
    """

    def __init__(self, plc: Plc, signals: SignalImage) -> None:
        self._plc = plc
        self._signals = signals
        self.on_alarm: Callable[[str], None] | None = None
        self._refused = ""
        self._by_signal: dict[str, list[PlcAlarm]] = {}
        for row in plc.standing:
            for name in row.signals if row.stops else ():
                self._by_signal.setdefault(name, []).append(row)
        self.drives_spindle = any(rule.output == "SPINDLE_TURNS" for rule in plc.rules)

    @property
    def messages(self) -> tuple[str, ...]:
        """Numbers of the messages that hold now, the one that refused the last command first."""
        standing = [row.code for row in self._plc.standing if not row.stops and row.condition(self._signal)]
        return tuple(dict.fromkeys([*filter(None, [self._refused]), *standing]))

    def refuses(self, word: str) -> str:
        """Ask for a word: the number of what refuses it, an alarm or a message; empty where it is carried out."""
        row = self._plc.refusal(word, self._signal) if self._plc.knows(word) else None
        self._refused = row.code if row is not None and not row.stops else ""
        if row is not None and row.stops:
            self._alarm(row.code)
        return row.code if row is not None else ""

    def answer(self, word: str) -> None:
        """Let the rules answer to a word that is carried out at once."""
        if self._plc.knows(word):
            self._signals[word] = 1.0
            self._signals[word] = 0.0

    def watch(self, name: str) -> None:
        """A signal has changed: raise the alarms that it brings."""
        for row in self._by_signal.get(name, ()):
            if row.condition(self._signal):
                self._alarm(row.code)

    def look(self) -> None:
        """Raise every alarm that is there: at power-on, and when a reset has not helped."""
        for row in self._plc.standing:
            if row.stops and row.condition(self._signal):
                self._alarm(row.code)

    def _alarm(self, code: str) -> None:
        if self.on_alarm is not None:
            self.on_alarm(code)

    def _signal(self, name: str) -> float:
        return self._signals[name]
