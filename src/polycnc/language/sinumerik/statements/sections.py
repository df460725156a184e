"""Program levels: how deep they lie, how they end, and sections of a program as levels."""

from __future__ import annotations

from polycnc.channel.stack import LevelKind
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

    from polycnc.channel.channel import Channel
    from polycnc.channel.steps import Step
    from polycnc.language.sinumerik.executable import SinumerikProgram

#: Subprogram levels below the main program; interrupts have two more (1.25.1.3).
MAX_LEVELS = 15
INTERRUPT_LEVELS = 2


class Section:
    """A part of a program as a program of its own: it ends behind the end block that is run through.

    A jump out of the section does not end it: it goes on until it comes through one of the end blocks, or to
    the block that repeats it (1.11).

    Attributes:
        whole: The program.
        is_through: The pass has come to its end.
    """

    def __init__(self, whole: SinumerikProgram, ends: AbstractSet[int], repeated_by: int = -1) -> None:
        self.whole = whole
        self.program = whole.program
        self.steps: Sequence[Step | None] = ()
        self.is_through = False
        self._ends = ends
        self._repeated_by = repeated_by
        self._last = -1

    def step(self, index: int, *, alone: bool = True) -> Step | None:  # noqa: ARG002 - each is alone
        """The step of a block; None when an end block has been run through."""
        if index == self._repeated_by or (self._last in self._ends and index == self._last + 1):
            self._last = -1
            self.is_through = True
            return None
        self._last = index
        self.is_through = False
        return self.whole.step(index, alone=True)

    def line(self, index: int) -> int:
        """The line of a step, from 1."""
        return self.whole.line(index)

    def counts(self, index: int) -> bool:
        """Whether a step is a block for stages that look ahead."""
        return self.whole.counts(index)

    def text(self, index: int) -> str:
        """The line of a step."""
        return self.whole.text(index)

    def column(self, index: int, address: str) -> int:
        """The column of an address in a step."""
        return self.whole.column(index, address)

    def word_columns(self, channel: Channel, position: int) -> int:
        """The column of a word of the running block."""
        return self.whole.word_columns(channel, position)


#: Among the data of a level: with it something ends that a context of the toolpath tells of.
ENDS_CONTEXT = "ends context"
#: In `data` of a level that ISOCALL has called: the language of its caller.
LANGUAGE = "language"


def count_levels(channel: Channel) -> None:
    """Alarm 14012 if no further program level is possible."""
    interrupts = any(level.kind is LevelKind.INTERRUPT for level in channel.stack)
    if len(channel.stack) > MAX_LEVELS + (INTERRUPT_LEVELS if interrupts else 0):
        raise AlarmError("14012")


def leave(channel: Channel) -> None:
    """End the running level; a subprogram with SAVE brings back the modal functions of its call."""
    level = channel.pop()
    if LANGUAGE in level.data:
        channel.mode = channel.mode.with_code("language", level.data[LANGUAGE])
    if ENDS_CONTEXT in level.data:
        channel.context_changed()
    if level.kind is not LevelKind.SECTION and "saved" in level.data:
        channel.control.restore(channel, level.data["saved"])


def end_of_subprogram(channel: Channel) -> None:
    """A level below the main program ends: by M17, RET, M2, M30, or because it has no further blocks.

    A subprogram runs its next pass (P), or its caller goes on. A repeated section runs its next pass at its
    end; any other end aborts the repetition, and the block behind REPEAT is next (1.11).
    """
    level = channel.level
    section = level.code
    aborted = isinstance(section, Section) and level.kind is LevelKind.SECTION and not section.is_through
    if level.repeats > 0 and not aborted:
        level.repeats -= 1
        level.index = level.entry
    else:
        leave(channel)
