"""G96 and G97 of SYNTEC: constant surface speed (manual 2.66, chapter 6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.words import Words

GEOMETRY_AXES = 3
#: Axis name codes (Pr321): the hundreds are the letter, the last two digits the index, 0 for none.
AXIS_LETTERS = "XYZABCUVW"


def axis_name(code: int) -> str:
    """The axis name of a name code: 100 is X, 101 X1, 302 Z2; empty for none."""
    letter, index = divmod(code, 100)
    if not 1 <= letter <= len(AXIS_LETTERS):
        return ""
    return AXIS_LETTERS[letter - 1] + (str(index) if index else "")


def constant_surface_speed(channel: Channel, words: Words) -> None:
    """G96 S P: surface speed in m/min or feet/min; P names the axis whose position is the diameter."""
    reference = words.typed("P")
    if reference is not None:
        channel.memory.surface_axis = _reference_axis(channel, words, reference)
    axis = channel.memory.surface_axis
    if channel.axis_data[axis].rotary:
        raise words.fail("surface_axis", "P")
    channel.context_changed()


def _reference_axis(channel: Channel, words: Words, reference: float) -> int:
    """P 1 to 3 a geometry axis, 0 the first axis, 100 to 999 an axis name code."""
    if reference != int(reference) or reference < 0:
        raise words.fail("surface_axis", "P")
    if reference == 0:
        return 0
    if reference <= GEOMETRY_AXES:
        axis = channel.coordinates.geometry[int(reference) - 1]
    else:
        axis = channel.axis_index.get(axis_name(int(reference)), -1)
    if axis < 0:
        raise words.fail("surface_axis", "P")
    return axis


def end_surface_speed(channel: Channel, _words: Words) -> None:
    """G97 S: revolutions per minute again; without S the speed that ran last holds."""
    channel.context_changed()
