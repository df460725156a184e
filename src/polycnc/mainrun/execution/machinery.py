"""What the machine does with the events of a program: auxiliary functions with their time, tool, spindle, messages."""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.signals.interlocks import word_of
from polycnc.motion.standing.waits import ORIENT
from polycnc.toolpath.events import (
    Auxiliary,
    BuilderCode,
    Deed,
    InterlockQuery,
    Message,
    Print,
    Raised,
    Shown,
    SignalWrite,
    Stop,
    StoredWrite,
    ToolSelection,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.machine.model import Machine
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.preparation.items import Block, Happening
    from polycnc.mainrun.signals.image import SignalImage
    from polycnc.mainrun.signals.interlocks import Interlocks
    from polycnc.toolpath import Context, Event

#: Stops that the operator's switch decides on.
OPTIONAL_STOPS = frozenset({"M01", "M1"})
#: The input that ends a skip move.
SKIP_SIGNAL = "SKIP"
PROGRAM_ENDS = frozenset({"M2", "M30"})


class Observer(Protocol):
    """What is told of the events of a channel's program, by the number of the channel."""

    def performs(self, number: int, event: Event) -> None:
        """An event is carried out."""

    def enters(self, number: int, block: Block) -> None:
        """A block begins."""

    def reads_signals(self, number: int) -> None:
        """The program is about to read signals."""

    def says(self, message: str) -> None:
        """The program has a text for the operator."""

    def shows_alarms(self, number: int) -> None:
        """The program has an alarm for the operator, and goes on."""

    def stops(self, number: int, code: str) -> None:
        """A programmed stop by its code, or `alarm`."""

    def halted(self, number: int, reason: str) -> None:
        """The run has halted of its own accord."""


class Machinery:
    """Carries out a program's events.

    Args:
        number: Number of the channel.
        machine: How long its functions take.
        signals: The signal image; its rules may finish functions.
        clock: The time.
        interlocks: What the machine's controller refuses.
        observer: Is told of everything.

    Attributes:
        optional_stop: M01 stops.
        mst_lock: M, S and T do not reach the machine.
        keeps: Takes what does not reach the machine while a program is tested; None where it does.
        next_tool: The tool that stands by, by number or name; 0 for none.
        messages: Texts of the program since it began.
    """

    def __init__(
        self,
        number: int,
        machine: Machine,
        signals: SignalImage,
        clock: Clock,
        interlocks: Interlocks,
        observer: Observer,
    ) -> None:
        self.optional_stop = self.mst_lock = False
        self.keeps: Callable[[Happening], None] | None = None
        self.next_tool: int | str = 0
        self.messages: list[str] = []
        self._machine = machine
        self._signals = signals
        self._clock = clock
        self._number, self._interlocks, self._observer = number, interlocks, observer
        self._running: dict[str, float] = {}
        self._beside: set[str] = set()

    @property
    def busy(self) -> bool:
        """Whether functions are under way that the next block waits for."""
        return bool(self._running)

    @property
    def stands(self) -> bool:
        """Whether the axes stand for one of them."""
        return not self._running.keys() <= self._beside

    @property
    def is_open(self) -> bool:
        """Whether one of them takes as long as the machine's controller says; else it is known where the axes rest."""
        return inf in self._running.values()

    @property
    def due(self) -> float:
        """When a function is done, or a rule of the machine acts."""
        if not self._running:
            return self._signals.due
        if any(end == inf and self._signals.is_done(word) for word, end in self._running.items()):
            return self._clock.time
        return min(min(self._running.values(), default=inf), self._signals.due)

    def advance(self, time: float) -> None:
        """Let functions end and rules act."""
        self._signals.advance(time)
        for word in [word for word, end in self._running.items() if end <= time]:
            del self._running[word]
            self._signals.finish(word)
        for word in [word for word in self._running if self._signals.is_done(word)]:
            del self._running[word]
            self._signals.finish(word)

    def skip(self) -> None:
        """The skip input comes, and goes."""
        self._signals[SKIP_SIGNAL] = 1.0
        self._signals[SKIP_SIGNAL] = 0.0

    def synchronise(self) -> None:
        """The program is about to read signals."""
        self._observer.reads_signals(self._number)

    def enter(self, block: Block) -> None:
        """A block begins."""
        self._observer.enters(self._number, block)

    def halted(self, reason: str) -> None:
        """The run has halted of its own accord."""
        self._observer.halted(self._number, reason)

    def perform(self, happening: Happening) -> None:
        """Carry out an event."""
        event = happening.event
        if isinstance(event, InterlockQuery):
            if not self._interlocks.refuses(event.word):
                self._interlocks.answer(event.word)
            return
        self._observer.performs(self._number, event)
        if isinstance(event, Deed):
            if event.do is not None:
                event.do()
            return
        if self.keeps is not None:
            self.keeps(happening)
        if isinstance(event, ToolSelection):
            self.next_tool = event.tool if isinstance(event.tool, str) else int(event.tool)
        word = word_of(event)
        if word and (self._is_locked(word) or self._interlocks.refuses(word)):
            return
        (self._beside.discard if happening.stands else self._beside.add)(word)
        if isinstance(event, Auxiliary):
            self._begin(word, self._seconds(event, happening.context))
        elif isinstance(event, BuilderCode):
            function = self._machine.g_functions.get(event.code)
            self._begin(word, function.seconds if function is not None else 0.0)
        elif word:
            self._interlocks.answer(word)
        elif isinstance(event, StoredWrite):
            event.store()
        elif isinstance(event, SignalWrite) and self.keeps is None:
            self._signals[event.name] = event.value
        else:
            self._tell(event)

    def _tell(self, event: Event) -> None:
        """What the operator is told of, and what stops."""
        if isinstance(event, Message | Print):
            self.messages.append(event.text)
            self._observer.says(event.text)
        elif isinstance(event, Shown):
            self._observer.shows_alarms(self._number)
        elif isinstance(event, Raised):
            self._observer.stops(self._number, "alarm")
        elif isinstance(event, Stop) and (event.code not in OPTIONAL_STOPS or self.optional_stop):
            self._observer.stops(self._number, event.code)

    def _is_locked(self, word: str) -> bool:
        """Whether a function does not reach the machine."""
        return self.keeps is not None or (self.mst_lock and word not in PROGRAM_ENDS)

    def _seconds(self, event: Auxiliary, context: Context) -> float:
        """How long an M function takes."""
        function = self._machine.m_functions.get(event.code)
        seconds = function.seconds if function is not None else 0.0
        if event.code == ORIENT:
            spindle = self._machine.spindle.get(context.spindle)
            seconds += spindle.orient_s if spindle is not None else 0.0
        return seconds

    def _begin(self, word: str, seconds: float) -> None:
        """A function goes out to the machine."""
        awaited = self._signals.begin(word)
        if awaited:
            self._running[word] = inf
        elif seconds > 0.0:
            self._running[word] = self._clock.time + seconds
        else:
            self._signals.finish(word)

    def reset(self) -> None:
        """Forget functions under way and messages."""
        self._running.clear()
        self._beside.clear()
        self.messages.clear()
        self._signals.reset()
