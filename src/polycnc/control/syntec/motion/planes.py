"""G17, G18, G19: the plane, and which axes are X, Y and Z of it (manual 2.17)."""

from __future__ import annotations

from polycnc.control.syntec.motion.polar import plane_code
from polycnc.control.word_address.states import PlaneAxes, PolarState
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

with loaded_when_called():
    from polycnc.control.word_address.motion import planes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

#: The direction that the first letter of an axis name stands for; of one direction the earlier letter goes first.
CLASSES = {letter: place for letters in ("XYZ", "UVW", "ABC") for place, letter in enumerate(letters)}
_ORDER = {letter: number for number, letter in enumerate(CLASSES)}
#: Letters whose axes go to the direction of their own name when a plane block names them (2.17.6).
NAMED_FIRST = "XYZUVW"


def select_plane(channel: SyntecChannel, words: Words) -> None:
    """G17, G18, G19; within polar interpolation its plane stays (2.15.2, note 4)."""
    memory = channel.memory
    polar = PolarState.of(channel).plane
    if polar is not None:
        channel.mode = channel.mode.with_code("plane", plane_code(polar))
    else:
        named = [axis for axis, _, _ in words.axes()]
        plane = PLANES[channel.mode["plane"]][:2]
        planes.choose_axes(channel, geometry_axes(channel.axes, named, plane, memory.basic_geometry))
    channel.context_changed()


def same_plane(channel: SyntecChannel) -> bool:
    """Whether the plane that is in force may be written again with any axes: each of them has its place already."""
    basic = channel.memory.basic_geometry
    return (
        PolarState.of(channel).plane is None
        and PlaneAxes.of(channel).parallel is None
        and all(
            axis in basic and CLASSES.get(name[0]) == basic.index(axis)
            for axis, name in enumerate(channel.axes)
        )
    )


def geometry_axes(
    names: Sequence[str], named: Sequence[int], plane: Sequence[int], basic: tuple[int, int, int]
) -> tuple[int, int, int]:
    """The axes that are X, Y and Z after a block with G17 to G19 (2.17.2, 2.17.6).

    Args:
        names: Names of all axes of the channel, in the order of their numbers.
        named: Axes that the block names, by their place in `names`.
        plane: The two directions (0 X, 1 Y, 2 Z) that the plane needs.
        basic: The axes that are X, Y and Z where no block names others; -1 where there is none.

    Returns:
        Places in `names`; -1 where no axis is left.
    """
    if not named:
        return basic
    chosen = [-1, -1, -1]
    own = [axis for axis in named if names[axis][0] in NAMED_FIRST]
    for axis in sorted(own, key=lambda axis: (_ORDER[names[axis][0]], axis)):
        place = CLASSES[names[axis][0]]
        if chosen[place] < 0:
            chosen[place] = axis
    others = sorted(set(named) - set(chosen))
    for place in plane:
        if chosen[place] < 0 and others:
            chosen[place] = others.pop(0)
    for place, axis in enumerate(basic):
        if chosen[place] < 0 and axis not in chosen:
            chosen[place] = axis
    for place in range(3):
        if chosen[place] < 0:
            chosen[place] = _left_over(names, chosen, place)
    return (chosen[0], chosen[1], chosen[2])


def _left_over(names: Sequence[str], chosen: Sequence[int], place: int) -> int:
    """The first free axis of a direction's class by letter and number; without one, the free axis of lowest number."""
    free = [axis for axis in range(len(names)) if axis not in chosen]
    of_class = [axis for axis in free if CLASSES.get(names[axis][0]) == place]
    ordered = sorted(of_class, key=lambda axis: (_ORDER[names[axis][0]], len(names[axis]), names[axis]))
    return next(iter(ordered or free), -1)
