"""What a program must be for the scanner."""

from __future__ import annotations

from polycnc.channel.stack import Executable
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol, TypeAlias

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel


class Scannable(Executable, Protocol):
    """A program whose steps are lines of text."""

    def line_of_step(self, index: int) -> int:
        """Index of a step's line in the program's text."""

    def step_of_line(self, line: int) -> int:
        """The first step at or behind a line of the text."""

    def scannable_to(self, line: int) -> int:
        """The line behind those that may be read as one block each, from a line of the text on."""


#: A channel whose programs are such.
ScannedChannel: TypeAlias = "Channel[Any, Any, Scannable]"
