"""Feeds that something outside of the program changes: inputs (FMA, ST, SR, F2 … F7), the handwheel (FD, FDA).

Source: Fundamentals, several feeds in a block, and travel with handwheel override; MD21220 names the inputs.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import number
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.feed.path_feed import PathFeed
from polycnc.control.sinumerik.tables import axis_feed_factor
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm, WordShape

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Which inputs choose between the feeds of a block; 0: none does.
INPUTS = "$MC_MULTFEED_ASSIGN_FASTIN"
#: Further feeds by their number; ST and SR have 1, F itself is 1.
NUMBERS = range(2, 8)


def chosen_by_input(draft: Draft, position: int, shape: WordShape) -> Step:
    """FMA[n,axis], F2= to F7=, ST, SR, STA, SRA: what holds in the block while an input is on.

    No input is assigned as delivered, so that F and the programmed end hold. With one it is PC0001.

    Raises:
        AlarmError: 12400 for a number or axis that does not fit.
    """
    _check_index(draft, position, shape)

    def run(channel: SinumerikChannel, values: Values) -> None:
        if channel.memory.data.integer(INPUTS):
            raise not_supported(shape.address)
        if shape.address not in ("SR", "SRA") and number(values, position) < 0.0:
            raise WordAlarm(
                "14800" if shape.address in ("F", "FMA") else "12560", position, text=shape.address
            )

    return run


def _check_index(draft: Draft, position: int, shape: WordShape) -> None:
    index = shape.index
    axis: object = index
    if shape.address == "FMA":
        if not isinstance(index, tuple) or len(index) != 2 or index[0] not in NUMBERS:
            raise WordAlarm("12400", position, text=shape.address)
        axis = index[1]
    elif shape.address == "F":
        if index not in NUMBERS:
            raise WordAlarm("12400", position, text=shape.address)
        return
    elif shape.address in ("ST", "SR"):
        if index not in (None, 1):
            raise WordAlarm("12400", position, text=shape.address)
        return
    if not isinstance(axis, Axis):
        raise WordAlarm("12400", position, text=shape.address)
    draft.memory.column(axis.name)


def take_block_feed(draft: Draft) -> int | None:
    """The place of a feed of this block alone: FB, or FD, which the handwheel may change and none does.

    PC0001 for FD=0, where the handwheel alone would move the axes.
    """
    own, by_handwheel = draft.take("FB"), draft.take("FD")
    if by_handwheel is None:
        return own

    def check(_channel: SinumerikChannel, values: Values) -> None:
        if not number(values, by_handwheel):
            raise not_supported("FD=0")

    draft.steps.append(check)
    return by_handwheel


def axis_feed_of_block(draft: Draft, position: int, shape: WordShape) -> Step:
    """FDA[axis]: feed of a positioning axis for this block, which the handwheel may change and none does.

    Raises:
        AlarmError: 14810 below zero; PC0001 for 0, where the handwheel alone would move the axis.
    """
    column = axis_column(draft, position, shape)
    factors = [axis_feed_factor(draft.mode, rotary=rotary) for rotary in (False, True)]

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * factors[channel.axis_data[column].rotary]
        if value < 0.0:
            raise WordAlarm("14810", position, axis=channel.axes[column])
        if not value:
            raise not_supported("FDA=0")
        PathFeed.of(channel).of_block[column] = value

    def end(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        PathFeed.of(channel).of_block.pop(column, None)

    draft.behind_motion.append(end)
    return run


WORDS = {**dict.fromkeys(("FMA", "ST", "SR", "STA", "SRA"), chosen_by_input), "FDA": axis_feed_of_block}
