"""Blocks that the channel has run: where each begins and ends among the items, and what its rows mean for it.

Rows may come later than their block, where a stage of the path holds them back.
"""

from __future__ import annotations

from collections import deque
from math import inf

from polycnc.channel.waits import Why
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.mainrun.preparation.items import Block, BlockEnd
from polycnc.motion.kernels.columns import LARGEST_OVERRIDE
from polycnc.motion.standing.waits import ORIENT
from polycnc.toolpath import Kind
from polycnc.toolpath.events import Auxiliary, Circle, Deed, Pen, SignalWrite
from polycnc.toolpath.kinds import CURVE_WIDTH

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.intervention import TakesBack
    from polycnc.channel.stack import Level
    from polycnc.channel.waits import Wait
    from polycnc.deferred.typing import Any
    from polycnc.mainrun.preparation.items import Item
    from polycnc.motion.standing.beside import Step
    from polycnc.toolpath import Event
    from polycnc.toolpath.events import BuilderCode
    from polycnc.toolpath.table import Chunk

#: Waits of the channel that only let others look in.
PASSING = frozenset({Why.CHUNK, Why.BLOCK, Why.SINGLE_BLOCK})
#: Program and line.
Key = tuple[int, int]
#: What a row waits for, a share of the time and seconds; or what begins beside the axes, and is waited for.
Delay: TypeAlias = "tuple[str, float] | Step"


class RunBlocks:
    """Puts the beginnings and ends of blocks among the items.

    Args:
        items: What is prepared, in order.
        programs: Names of programs by number.
    """

    def __init__(self, items: deque[Item], programs: list[str]) -> None:
        self._items, self._programs = items, programs
        self._run: deque[tuple[Key, BlockEnd, Mapping[str, str], TakesBack, tuple[Key, ...], bool]] = deque()
        self._open: tuple[Key, BlockEnd] | None = None
        self._is_over = False

    def clear(self) -> None:
        """No block has been run."""
        self._run.clear()
        self._open, self._is_over = None, False

    def note(
        self,
        key: Key,
        end: BlockEnd,
        modal: Mapping[str, str],
        takes_back: TakesBack,
        callers: tuple[Key, ...],
        *,
        is_part: bool,
    ) -> None:
        """The channel has run a block; its `end` has no code where single block does not halt behind it."""
        self._run.append((key, end, modal, takes_back, callers, is_part))

    def enter(self, key: Key, *, is_silent: bool = False) -> None:
        """A row of a block comes: every block run before that one is over."""
        goes_on, self._is_over = not self._is_over, False
        if goes_on and self._open is not None and self._open[0] == key:
            return
        if not any(block[0] == key for block in self._run):
            return  # a row that a stage has added counts for the block before it
        self._end()
        while self._run:
            found, end, modal, back, called_from, is_part = self._run.popleft()
            silent, names = is_silent and found == key, self._programs
            callers = tuple((names[program], line) for program, line in called_from)
            self._items.append(Block(names[found[0]], found[1], modal, back, silent, callers, is_part))
            self._open = (found, end)
            if found == key:
                return
            self._end()

    def end_held_block(self) -> None:
        """The next row is of another block than the last one, though of the same line perhaps."""
        self._is_over = True

    def _end(self) -> None:
        if self._open is not None and self._open[1].code:
            self._items.append(self._open[1])
        self._open = None

    def close(self) -> None:
        """Nothing is held back: every block that was run is over."""
        if self._run:
            self.enter(self._run[-1][0])
        self._end()


def is_silent(event: Event | None) -> bool:
    """Whether a row only begins or ends an action, writes a variable, or draws."""
    return isinstance(event, SignalWrite | Pen | Circle) or (isinstance(event, Deed) and event.is_silent)


def acts_on_machine(chunk: Chunk, *, waits: bool) -> bool:
    """Whether a block does something on the machine; `waits`: it is one even without rows."""
    if not len(chunk):
        return waits
    return any(kind != Kind.EVENT for kind in chunk.kind) or not all(map(is_silent, chunk.events))


def without_function(delays: list[Delay], event: Auxiliary | BuilderCode) -> list[Delay]:
    """Delays of a row without what its function takes: that is up to the machine's own controller."""
    kept = [delay for delay in delays if delay[0] != "auxiliary_s"]
    return kept[:-1] if event.code == ORIENT and kept else kept


def waits_for_move(channel: Channel, wait: Wait | None) -> bool:
    """Whether the last rows are a function beside the motion of its block, whose moves a stage may hold yet.

    They are taken with the rows to come: the axes do not stand for a function whose block moves.
    """
    goes_on = wait is not None and wait.reason in PASSING and channel.path.head is not None
    chunk = channel.toolpath.chunk
    if not goes_on or not len(chunk):
        return False
    last, is_found = len(chunk) - 1, False
    place = chunk.line[last], chunk.program[last]
    while last >= 0 and (chunk.line[last], chunk.program[last]) == place:
        if chunk.kind[last] != Kind.EVENT:
            return False
        event = chunk.events[chunk.curve[last]]
        is_found = is_found or (isinstance(event, Auxiliary) and channel.machine.goes_beside(event.code))
        last -= 1
    return is_found


def largest_override(chunk: Chunk, row: int) -> float:
    """Of a tap, by its record of parameters; any for other moves."""
    if chunk.kind[row] != Kind.TAP or chunk.curve[row] < 0:
        return inf
    return chunk.curves[chunk.curve[row] * CURVE_WIDTH + LARGEST_OVERRIDE] or inf


def callers_of(stack: Sequence[Level[Any]]) -> tuple[tuple[int, int], ...]:
    """Number and line of the blocks that have called the program on top, from the main program on."""
    if len(stack) == 1:
        return ()
    return tuple((level.program_number, level.line_of(level.current)) for level in stack[:-1])
