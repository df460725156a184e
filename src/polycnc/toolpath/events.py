"""What happens between moves: spindle, tool, auxiliary functions, messages, stops and alarms."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, fields
from polycnc.deferred.typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happens at a place of the path; each kind is a class of its own.

    Attributes:
        type: What the trace calls the kind.
    """

    type: ClassVar[str] = ""

    @property
    def data(self) -> dict[str, object]:
        """What the trace shows beside the kind: the fields that are given, by their names."""
        values = ((each.name, getattr(self, each.name)) for each in fields(self))
        return {name: value for name, value in values if value is not None}


@dataclass(frozen=True, slots=True)
class Auxiliary(Event):
    """M: an auxiliary function, of a spindle where the block names one; `words` of its block go along with it."""

    type: ClassVar[str] = "m"
    code: int
    spindle: int | None = None
    words: Mapping[str, float] | None = None


@dataclass(frozen=True, slots=True)
class BuilderCode(Event):
    """A G code of the machine's builder that calls no program.

    Attributes:
        spindle: Whom it turns to an angle beside what follows, and `index_s`: how long that takes, s; 0 for none.
    """

    type: ClassVar[str] = "g"
    code: str
    words: Mapping[str, float] | None = None
    spindle: int = 0
    index_s: float = 0.0

    @property
    def data(self) -> dict[str, object]:
        """Code and words."""
        return {"code": self.code} if self.words is None else {"code": self.code, "words": self.words}


@dataclass(frozen=True, slots=True)
class SecondAuxiliary(Event):
    """B: a second auxiliary function."""

    type: ClassVar[str] = "b"
    code: float


@dataclass(frozen=True, slots=True)
class HFunction(Event):
    """H of SINUMERIK: a number for the machine's own controller."""

    type: ClassVar[str] = "h"
    code: float


@dataclass(frozen=True, slots=True)
class Stroke(Event):
    """A stroke of a press (SINUMERIK, punching and nibbling): the axes stand.

    Attributes:
        interface: Pair of fast outputs and inputs that controls it, 1 or 2.
        delay: Seconds from the position to the stroke; None for at once.
        leader: It is started ahead, in the cycle of the drives.
    """

    type: ClassVar[str] = "stroke"
    interface: int
    delay: float | None = None
    leader: bool | None = None


@dataclass(frozen=True, slots=True)
class SpindleWait(Event):
    """The program waits for a spindle that gets to a speed or a position, s."""

    type: ClassVar[str] = "spindle_wait"
    spindle: int
    seconds: float


@dataclass(frozen=True, slots=True)
class SpindleSpeed(Event):
    """S: speed of a spindle, rpm, or m/min under constant surface speed."""

    type: ClassVar[str] = "s"
    speed: float
    spindle: int


@dataclass(frozen=True, slots=True)
class ToolSelection(Event):
    """T: a tool, by its number or by its name."""

    type: ClassVar[str] = "t"
    tool: float | str


@dataclass(frozen=True, slots=True)
class Message(Event):
    """A text on the screen; an empty one takes it away."""

    type: ClassVar[str] = "message"
    text: str


@dataclass(frozen=True, slots=True)
class Pen(Event):
    """The colour of the path in pictures from here on, `#rrggbb` (SYNTEC SETDRAW)."""

    type: ClassVar[str] = "pen"
    colour: str


@dataclass(frozen=True, slots=True)
class Circle(Event):
    """A circle in pictures about the present point, in the working plane, mm (SYNTEC DRAWHOLE)."""

    type: ClassVar[str] = "circle"
    radius: float
    filled: bool


@dataclass(frozen=True, slots=True)
class Print(Event):
    """A line that the program sends out (DPRNT, PRINT)."""

    type: ClassVar[str] = "print"
    text: str


@dataclass(frozen=True, slots=True)
class Stop(Event):
    """A programmed stop, by the code that asks for it (`M00`, `M01` …)."""

    type: ClassVar[str] = "stop"
    code: str


@dataclass(frozen=True, slots=True)
class Raised(Event):
    """An alarm, with its place."""

    type: ClassVar[str] = "alarm"
    code: str
    line: int
    column: int
    program: str


@dataclass(frozen=True, slots=True)
class Shown(Raised):
    """An alarm that is only shown: the program goes on."""


@dataclass(frozen=True, slots=True)
class SignalWrite(Event):
    """The program writes a signal of the machine's own controller."""

    type: ClassVar[str] = "signal"
    name: str
    value: float


@dataclass(frozen=True, slots=True)
class StoredWrite(SignalWrite):
    """The program writes a number where others read it while it runs."""

    @property
    def data(self) -> dict[str, object]:
        """Name and value; where it is kept is nobody's concern."""
        return {"name": self.name, "value": self.value}

    def store(self) -> None:
        """Put the value where it is kept."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class ValueWrite(StoredWrite):
    """A value of a variable.

    Attributes:
        values: All values, by name and index.
        key: Name and index of this one.
    """

    values: dict[tuple[str, tuple[Any, ...]], Any]
    key: tuple[str, tuple[Any, ...]]

    def store(self) -> None:
        """Put the value among the others."""
        self.values[self.key] = self.value


@dataclass(frozen=True, slots=True)
class MemoryWrite(StoredWrite):
    """A number in a memory of bytes.

    Attributes:
        memory: The memory.
        place: First byte.
        written: The number as the memory keeps it.
    """

    memory: bytearray
    place: int
    written: bytes

    def store(self) -> None:
        """Put the bytes into the memory."""
        self.memory[self.place : self.place + len(self.written)] = self.written


@dataclass(frozen=True, slots=True)
class InterlockQuery(Event):
    """The machine's own controller is asked, when the axes are there, whether it refuses a word."""

    type: ClassVar[str] = "ask"
    word: str


@dataclass(frozen=True, slots=True)
class Deed(Event):
    """Something that happens in the main run when the axes are there: a synchronised action begins or ends.

    Attributes:
        what: Its word.
        number: Of the action, where it has one.
        do: What happens; None for nothing that the path does not tell already.
        is_silent: Its block is none of those that do something on the machine.
        stands: The axes stand for it all the same.
        awaits: Nothing follows while this says so; None where it goes on at once.
        places: Where the path has some axes from here on, by column: machine positions.
    """

    type: ClassVar[str] = "action"
    what: str
    number: int | None
    do: Callable[[], None] | None
    is_silent: bool = True
    awaits: Callable[[], bool] | None = None
    places: tuple[tuple[int, float], ...] = ()
    stands: bool = False

    @property
    def takes_effect_late(self) -> bool:
        """Whether what is read behind it may be asked for in the next cycle only: not where axes say it at any time."""
        return self.do is not None and not self.places

    @property
    def data(self) -> dict[str, object]:
        """Word and number."""
        shown: dict[str, object] = {"what": self.what}
        return shown if self.number is None else {**shown, "number": self.number}


@dataclass(frozen=True, slots=True)
class AxesPositioned(Deed):
    """Axes go to their `places` by themselves, beside what follows (POS, POSA, SPOS of SINUMERIK).

    Attributes:
        starts: Machine positions where they rest before, in the order of `places`.
        speeds: How fast they go, mm/s or degrees/s.
    """

    starts: tuple[float, ...] = ()
    speeds: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class AxesAwaited(Deed):
    """Nothing follows until axes that go to a place by themselves are there.

    Attributes:
        columns: Whose.
    """

    columns: tuple[int, ...] = ()
