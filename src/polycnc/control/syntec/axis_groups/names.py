"""Axis name codes (Pr321 on: 100 is X, 101 X1, 302 Z2) and virtual axes that stand for several (G10 L801)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.block.plan import AxisWord
from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words

CODES = range(100, 1000)
#: Hundreds of a name code.
LETTERS = {letter: 100 * (i + 1) for i, letter in enumerate("XYZABCUVW")}


@dataclass(slots=True)
class VirtualAxisState(State, lifetime=Lifetime.POWER):
    """Axes that move with a name that is none of theirs."""

    axes: dict[str, list[int]] = field(default_factory=dict)


def name_code(channel: SyntecChannel, axis: int) -> int:
    """The code of an axis: Pr321 on, or what its name stands for."""
    name = channel.axes[axis]
    index = int(name[1:]) if name[1:].isdigit() else 0
    return channel.memory.parameters.axis_names[axis] or LETTERS.get(name[0], 0) + index


def axis_of_code(channel: SyntecChannel, code: float) -> int:
    """The axis with a name code; -1 where there is none."""
    return next((axis for axis in range(len(channel.axes)) if name_code(channel, axis) == code), -1)


def map_virtual_axis(channel: SyntecChannel, words: Words) -> None:
    """G10 L801 P Q: the axis with code Q moves with the virtual axis P; Q0 takes all away."""
    virtual, real = words.typed("P"), words.typed("Q")
    letter = next((each for each, hundreds in LETTERS.items() if virtual == hundreds), "")
    if not letter or letter in channel.axis_index:
        raise words.fail("argument", "P")
    mapped = VirtualAxisState.of(channel).axes.setdefault(letter, [])
    if real == 0:
        mapped.clear()
    else:
        axis = -1 if real is None else axis_of_code(channel, real)
        if axis < 0:
            raise words.fail("argument", "Q")
        mapped.append(axis)
    channel.modes.forget_plans()


def _none_is_virtual(channel: SyntecChannel) -> bool:
    return not VirtualAxisState.of(channel).axes


def _virtual_words(builder: Builder) -> list[AxisWord]:
    """What the words of virtual axes mean: one word for each axis that moves with them."""
    found: list[AxisWord] = []
    incremental = builder.mode["distance"] == "G91"
    for address, axes in VirtualAxisState.of(builder.channel).axes.items():
        if axes and builder.has(address):
            position, form = builder.slots[address]
            builder.take(address)
            for axis in axes:
                convert = builder.axis_converter(axis, form)
                found.append(AxisWord(address, axis, position, convert, incremental))
    return found


#: Words of virtual axes.
RULE = Rule("virtual axes", rests=_none_is_virtual, axis_words=_virtual_words)
