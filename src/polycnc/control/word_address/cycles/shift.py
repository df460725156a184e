"""The shift of G76 and G87 off the wall, while the spindle stands at its angle."""

from __future__ import annotations

from math import nan

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.cycles.drilling import CycleData
    from polycnc.control.word_address.family import WordAddressChannel


def shift_by_center_words(
    _channel: WordAddressChannel, data: CycleData, plane: tuple[int, int]
) -> tuple[float, float]:
    """I, J, K are the shift along X, Y, Z."""
    return data.amount("IJK"[plane[0]]), data.amount("IJK"[plane[1]])


def shift_by_i_and_j(
    channel: WordAddressChannel, data: CycleData, plane: tuple[int, int]
) -> tuple[float, float]:
    """I is the shift along X, J along Y (Hartford manual 3.3.3), where they belong to the plane."""
    for axis, letter in enumerate("IJ"):
        if data.amount(letter) and axis not in plane:
            raise channel.control.fail("address", address=letter)
    return shift_by_center_words(channel, data, plane)


def shift_off_axis(channel: WordAddressChannel, center: list[float], data: CycleData, part: float) -> None:
    """Off the hole's axis by the shift, or back over it; only the axes of the plane.

    The spindle stands as the machine orients it, so that no scale, mirror or rotation of the program acts on the shift.
    """
    c = channel.coordinates
    w = c.geometry.index(data.axis)
    plane = ((w + 1) % 3, (w + 2) % 3)
    middle = c.programmed[:]
    for i in plane:
        if (axis := c.geometry[i]) >= 0:
            middle[axis] = center[axis]
    end = c.to_position(middle)
    if not part:
        channel.straight(Kind.RAPID, end, nan, middle)
        return
    shift = channel.control.drilling_rules(channel).shift(channel, data, plane)
    for i, amount in zip(plane, shift, strict=True):
        if (axis := c.geometry[i]) >= 0:
            end[axis] += part * amount
    channel.straight(Kind.RAPID, end, nan, c.to_programmed(end))
