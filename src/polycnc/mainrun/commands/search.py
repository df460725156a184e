"""Block search with calculation: the program is run through without motion up to a block."""

from __future__ import annotations

from enum import StrEnum

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.preparation.items import Block, Happening, Move
from polycnc.toolpath import Context
from polycnc.toolpath.events import Auxiliary, Raised, Shown, SignalWrite, SpindleSpeed, ToolSelection

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.mainrun.preparation.items import Places
    from polycnc.mainrun.preparation.preprocessing import Preprocessing

#: M functions of which the last one before the block is put out, by what they switch. Others belong to their block.
LASTING = ((3, 4, 5, 13, 14, 19), (7, 8, 9), (50,), (10, 11), (68, 69))
#: How often the program may compute for an interpolation cycle without coming to a block.
PATIENCE = 10_000
#: What is looked through at most without a block that was not there before: a program that begins again at its end
#: (M99) never comes to an end.
LONGEST = 200_000


@dataclass(slots=True)
class Found:
    """What holds at the start of the block.

    Attributes:
        position: Machine position.
        context: What holds for moves.
        modal: Active codes.
        functions: Auxiliary functions to be put out.
    """

    position: list[float]
    context: Context
    modal: Mapping[str, str] = field(default_factory=dict)
    functions: list[Happening] = field(default_factory=list)


class SearchMode(StrEnum):
    """How a block is searched."""

    CONTOUR = "contour"
    """With calculation: the axes are led to where the block begins."""
    END_POINT = "end-point"
    """With calculation of the block too: the axes are led to where it ends."""
    WITHOUT = "without-calculation"
    """Nothing in front of the block is calculated: it begins where the axes are, with what holds now."""
    TEST = "program-test"
    """With program test (SINUMERIK's SERUPRO): the program runs, with its actions and waits, while the axes stand."""


@dataclass(slots=True)
class Wanted:
    """The block that is looked for: of the main program, or of a subprogram with the blocks that call it.

    Attributes:
        levels: Where it stands.
        part_of: Line of a block that runs it as its own part, such as the shape of a turning cycle; 0 for none so far.
    """

    levels: Places
    part_of: int = 0

    def is_met_by(self, block: Block) -> bool:
        """Whether it is this one, or one of the subprogram that it calls."""
        lies_in_part = block.is_part and len(self.levels) == len(block.levels)
        if block.levels[: len(self.levels)] == self.levels and not lies_in_part:
            return True
        if block.callers and (block.program, block.line) == self.levels[-1]:
            self.part_of = self.part_of or block.callers[-1][1]
        return False

    def missed(self, named: object) -> CommandRefused:
        """The refusal where the program has ended without it."""
        if self.part_of:
            return CommandRefused("mainrun.search-part", target=named, line=self.part_of)
        return CommandRefused("mainrun.search", target=named)


@dataclass(slots=True)
class ProgramTest:
    """A search that runs the program.

    Attributes:
        channel: Number of the channel.
        wanted: Where the block is.
        here: Where the axes stand, machine position.
        target: The block as it was named.
    """

    channel: int
    wanted: Wanted
    here: tuple[float, ...]
    target: int | str
    _functions: dict[object, Happening] = field(default_factory=dict)

    def is_at(self, number: int, block: Block) -> bool:
        """Whether the block of a channel is the one that is looked for."""
        return number == self.channel and self.wanted.is_met_by(block)

    def keeps(self, happening: Happening) -> None:
        """What the program switches on the machine is kept, and put out later."""
        _keep(self._functions, happening)

    @property
    def functions(self) -> list[Happening]:
        """What holds at the block."""
        return list(self._functions.values())


def at_line(line: int) -> Callable[[Channel], None]:
    """A program begins at a line of its file: its definitions are made, nothing else in front of it is run."""

    def enter(channel: Channel) -> None:
        level = channel.level
        define = getattr(level.code, "run_definitions", None)  # a language without definitions has none
        if define is not None:
            define(channel)
        level.index = level.current = level.code.step_of_line(line - level.code.program.first_line)

    return enter


def search(preprocessing: Preprocessing, wanted: Wanted, *, behind: bool = False) -> Found | None:
    """Go on in what is prepared to a block; it is then the next item. None where the program ends before it.

    With `behind` the block is calculated too, and what comes next is the next item.
    """
    reached = False
    found = Found(preprocessing.position, Context())
    functions: dict[object, Happening] = {}
    patience, left = PATIENCE, LONGEST
    blocks: set[tuple[str, int]] = set()
    while patience > 0 and left > 0:
        left -= 1
        patience = PATIENCE if preprocessing.fill() else patience - 1
        if not preprocessing.items:
            if preprocessing.finished:
                return _at(found, functions) if reached else None
            if preprocessing.waiting is not None:
                if preprocessing.waiting.until is not None and not preprocessing.waiting.until():
                    return None  # another channel, which does not run, would have to do something first
                preprocessing.proceed()
            continue
        item = preprocessing.items[0]
        if isinstance(item, Block):
            is_wanted = wanted.is_met_by(item)
            if (reached and not is_wanted) if behind else is_wanted:
                return _at(found, functions)
            reached = reached or is_wanted
            found.modal = item.modal
            left = left if (item.program, item.line) in blocks else LONGEST
            blocks.add((item.program, item.line))
        if isinstance(item, Move):
            piece, _ = preprocessing.queue.pop_piece()
            found.position, found.context = piece.at(1.0), piece.context
            continue
        preprocessing.items.popleft()
        if isinstance(item, Happening):
            found.context = item.context
            if isinstance(item.event, Raised) and not isinstance(item.event, Shown):
                return None
            _keep(functions, item)
    return None


def _keep(functions: dict[object, Happening], happening: Happening) -> None:
    key = _what_it_switches(happening)
    if key is not None:
        functions.pop(key, None)
        functions[key] = happening


def _at(found: Found, functions: Mapping[object, Happening]) -> Found:
    found.functions = list(functions.values())
    return found


def _what_it_switches(happening: Happening) -> object:
    """What a later event of the same kind makes meaningless; None for what is not put out later."""
    event = happening.event
    if isinstance(event, SpindleSpeed):
        return SpindleSpeed, event.spindle
    if isinstance(event, ToolSelection):
        return ToolSelection
    if isinstance(event, SignalWrite):
        return SignalWrite, event.name
    if isinstance(event, Auxiliary):
        return next((group for group in LASTING if event.code in group), None)
    return None
