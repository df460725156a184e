"""What happens between moves: spindle, tool, auxiliary functions, messages, stops and alarms."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import ClassVar


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
    """M: an auxiliary function, of a spindle where the block names one."""

    type: ClassVar[str] = "m"
    code: int
    spindle: int | None = None


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
class SignalWrite(Event):
    """The program writes a signal of the machine's own controller."""

    type: ClassVar[str] = "signal"
    name: str
    value: float


@dataclass(frozen=True, slots=True)
class InterlockQuery(Event):
    """The machine's own controller is asked, when the axes are there, whether it refuses a word."""

    type: ClassVar[str] = "ask"
    word: str
