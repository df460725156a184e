"""A block while the control works out how it acts: who takes which word, and in which order steps run.

Every word of a block is taken by exactly one function. The result is a `Plan`, kept in `mode.plans[block]`:
the same block in the same modal state is worked out once.
"""

from __future__ import annotations

from collections.abc import Callable

from polycnc.control.sinumerik.block.positions import AxisTerm, axis_term
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any, Protocol
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm, WordShape

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.language.sinumerik.words import Block

    Values = tuple[Any, ...]

#: One thing that a block does.
Step = Callable[["SinumerikChannel", "Values"], None]
#: Where a block ends: a position of all axes.
Goal = Callable[["SinumerikChannel", "Values"], list[float]]


class TipPath(Protocol):
    """How the tip goes along a block; a part of its way is a number from 0 (start) to 1 (end)."""

    def at(self, part: float) -> list[float]:
        """Work coordinates of all axes after a part of the way."""

    def direction(self, part: float) -> Vector:
        """Unit vector of travel on the geometry axes; zero where they stand."""


#: The end of a block with its rotary axes, from the end of its tip and the way there; None for a straight one.
Lead = Callable[["SinumerikChannel", "Values", list[float], TipPath | None], list[float]]


class Draft:
    """A block that is being worked out.

    Attributes:
        channel: The channel, for what does not change while a program runs (axes, machine).
        memory: Its memory.
        block: What is programmed.
        mode: Modal state while the block runs: its own modal functions included.
        codes: Function of the block by group name, modal or not.
        steps: What the block does, in order.
        behind_motion: What words of the block do when its motion is done.
        opens_line: The block begins a straight line whose end the next one tells (ANG).
        lead: Leads the end of the block to where its words of orientation stand the rotary axes; None without any.
            Who makes the move takes it by `take_lead`.
        is_led: Somebody has taken it.
        direction: Where A3, B3 and C3 stand, where the block says no more of the direction; else None.
        by_axes: Its straight move goes with the axes of the machine (PTP).
    """

    def __init__(self, channel: SinumerikChannel, block: Block, mode: Mode, codes: dict[str, str]) -> None:
        self.channel = channel
        self.memory = channel.memory
        self.block = block
        self.mode = mode
        self.codes = codes
        self.steps: list[Step] = []
        self.behind_motion: list[Step] = []
        self.opens_line = False
        self.lead: Lead | None = None
        self.is_led = False
        self.direction: tuple[int, int, int] | None = None
        self.by_axes = False
        self._open = {i: _with_spindle(word) for i, word in enumerate(block.words)}

    def take(self, address: str) -> int | None:
        """Take the word of an address without index; its place, or None if the block does not have it."""
        for position, word in self._open.items():
            if word.address == address and word.index is None:
                if word.modifier:
                    raise WordAlarm("12020", position, text=word.modifier)
                del self._open[position]
                return position
        return None

    def take_plain(self, address: str) -> int | None:
        """Take the word of an address if nothing stands round its value; its place, or None."""
        for position, word in self._open.items():
            if word.address == address and word.index is None and not word.modifier:
                del self._open[position]
                return position
        return None

    def take_shape(self, address: str, *modifiers: str) -> tuple[int, WordShape] | None:
        """Take the first word of an address, with whatever index; `modifiers` may stand round its value."""
        for position, word in self._open.items():
            if word.address == address:
                if word.modifier and word.modifier not in modifiers:
                    raise WordAlarm("12020", position, text=word.modifier)
                del self._open[position]
                return position, word
        return None

    def take_lead(self) -> Lead | None:
        """What leads the end of the move that the taker makes; None without words of orientation."""
        self.is_led = True
        return self.lead

    def has(self, *addresses: str) -> bool:
        """Whether a word of one of these addresses is still open."""
        return any(word.address in addresses for word in self._open.values())

    def take_axes(self, *, path: bool = True) -> list[AxisTerm]:
        """Take all axis words, worked out for the modal state; `path` as for `axis_term`."""
        terms = self.axis_terms(path=path)
        for term in terms:
            del self._open[term.position]
        return terms

    def axis_terms(self, *, path: bool = True) -> list[AxisTerm]:
        """The axis words that nobody has taken yet, worked out for the modal state; `path` as for `axis_term`."""
        columns = self.memory.columns
        return [
            axis_term(self.channel, self.mode, position, columns[word.address], word.modifier, path=path)
            for position, word in self._open.items()
            if word.index is None and word.address in columns
        ]

    def take_machine_axes(self) -> list[tuple[int, int]]:
        """Take all words of machine axes (`X1=`): place and column of each."""
        found = []
        for position, word in list(self._open.items()):
            column = self.memory.machine_columns.get(word.address)
            if column is not None and word.index is None:
                del self._open[position]
                found.append((position, column))
        return found

    def open_words(self) -> list[tuple[int, WordShape]]:
        """The words that nobody has taken yet."""
        return list(self._open.items())

    def is_open(self, position: int) -> bool:
        """Whether nobody has taken the word at a place."""
        return position in self._open

    def close(self, position: int) -> None:
        """Take the word at a place."""
        del self._open[position]


def axis_column(draft: Draft, position: int, shape: WordShape) -> int:
    """Column of the axis in the brackets of a word; alarm 12040 without one."""
    if not isinstance(shape.index, Axis):
        raise WordAlarm("12040", position, text=str(shape.index or ""))
    return draft.memory.column(shape.index.name)


def _with_spindle(word: WordShape) -> WordShape:
    """`S2=` is S with the extension 2, though S2 is also the name of a spindle."""
    if word.index is None and word.address[:1] == "S" and word.address[1:].isdigit():
        return WordShape("S", int(word.address[1:]), word.modifier)
    return word


class Plan(NamedTuple):
    """What a block does.

    Attributes:
        steps: In order.
        acts: Something happens on the machine: motion, dwell, auxiliary functions.
        calls: A modal subprogram (MCALL) follows the block.
        ends: Places of the M words, which may end the program.
        shared: Axes that the block moves and that other channels can use as well, by their columns.
    """

    steps: tuple[Step, ...]
    acts: bool
    calls: bool
    ends: tuple[int, ...]
    shared: tuple[int, ...] = ()
