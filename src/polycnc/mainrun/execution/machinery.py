"""What the machine does with the events of a program: auxiliary functions with their time, tool, spindle, messages."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from polycnc.mainrun.signals.guard import Guard, word_of
from polycnc.motion.waits import ORIENT

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine.model import Machine
    from polycnc.mainrun.preparation.items import Block, Happening
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.toolpath import Context, Event

    Reports = tuple[
        Callable[[Event], None],
        Callable[[str], None],
        Callable[[Block], None],
        Callable[[str], None],
        Callable[[], None],
        Guard,
    ]

#: Stops that the operator's switch decides on.
OPTIONAL_STOPS = frozenset({"M01", "M1"})
#: The input that ends a skip move.
SKIP_SIGNAL = "SKIP"
MESSAGES = frozenset({"message", "print"})
PROGRAM_ENDS = frozenset({"M2", "M30"})


class Machinery:
    """Carries out a program's events.

    Args:
        machine: How long its functions take.
        signals: The signal image; its rules may finish functions.
        clock: Gives the simulated time.
        report: Called with each event that is carried out, with the code of a programmed stop (or `alarm`), with
            each block that begins, with the reason when the run has halted, and before the program reads signals;
            last, what the machine's controller refuses.

    Attributes:
        optional_stop: M01 stops.
        mst_lock: M, S and T do not reach the machine.
        next_tool: The tool that stands by, by number or name; 0 for none.
        messages: Texts of the program since it began.
    """

    def __init__(
        self,
        machine: Machine,
        signals: SignalImage,
        clock: Callable[[], float],
        report: Reports,
    ) -> None:
        self.optional_stop = self.mst_lock = False
        self.next_tool: int | str = 0
        self.messages: list[str] = []
        self._machine = machine
        self._signals = signals
        self._clock = clock
        self._report, self._stop, self.enter, self.halted, self.synchronise, self._guard = report
        self._running: dict[int, float] = {}

    @property
    def busy(self) -> bool:
        """Whether functions are under way that the next block waits for."""
        return bool(self._running)

    @property
    def due(self) -> float:
        """When a function is done, or a rule of the machine acts."""
        if not self._running:
            return self._signals.due
        if any(end == inf and self._signals.is_done(code) for code, end in self._running.items()):
            return self._clock()
        return min(min(self._running.values(), default=inf), self._signals.due)

    def advance(self, time: float) -> None:
        """Let functions end and rules act."""
        self._signals.advance(time)
        for code in [code for code, end in self._running.items() if end <= time]:
            del self._running[code]
            self._signals.finish(code)
        for code in [code for code in self._running if self._signals.is_done(code)]:
            del self._running[code]
            self._signals.finish(code)

    def skip(self) -> None:
        """The skip input comes, and goes."""
        self._signals[SKIP_SIGNAL] = 1.0
        self._signals[SKIP_SIGNAL] = 0.0

    def perform(self, happening: Happening) -> None:
        """Carry out an event."""
        event = happening.event
        if event.type == "ask":
            self._guard.refuses(str(event.data["word"]))
            return
        self._report(event)
        if event.type == "t":
            self.next_tool = event.data.get("tool") or 0
        word = word_of(event)
        if word and ((self.mst_lock and word not in PROGRAM_ENDS) or self._guard.refuses(word)):
            return
        if event.type == "m":
            self._begin(event.data.get("code"), happening.context)
        elif word:
            self._guard.answer(word)
        elif event.type == "signal":
            self._signals[str(event.data["name"])] = float(event.data["value"])
        elif event.type in MESSAGES:
            self.messages.append(str(event.data.get("text", "")))
        elif event.type == "alarm":
            self._stop("alarm")
        elif event.type == "stop":
            code = str(event.data.get("code", ""))
            if code not in OPTIONAL_STOPS or self.optional_stop:
                self._stop(code)

    def _begin(self, code: object, context: Context) -> None:
        """An M function goes out to the machine."""
        if not isinstance(code, int):
            return
        function = self._machine.m_functions.get(code)
        seconds = function.seconds if function is not None else 0.0
        if code == ORIENT:
            spindle = self._machine.spindle.get(context.spindle)
            seconds += spindle.orient_s if spindle is not None else 0.0
        awaited = self._signals.begin(code)
        if awaited:
            self._running[code] = inf
        elif seconds > 0.0:
            self._running[code] = self._clock() + seconds
        else:
            self._signals.finish(code)

    def reset(self) -> None:
        """Forget functions under way and messages."""
        self._running.clear()
        self.messages.clear()
        self._signals.reset()
