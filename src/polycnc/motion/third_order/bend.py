"""A programmed path becomes bent paths: one from each standstill to the next."""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.third_order.bent_path import BentPath
from polycnc.motion.third_order.compiled import kernels
from polycnc.motion.third_order.parts import Room, bent_part, cut_out

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.parts import Part


def bend(path: Stretches) -> list[BentPath]:
    """Bend a programmed path within its tolerance.

    Args:
        path: From rest to rest; the tangents of lines that are chords of a curve are set.

    Returns:
        Bent paths in order; between two of them the axes rest, for the path turns back there, or may not be left.

    Raises:
        ValueError: The tolerance is not kept: it is too small for the numbers of the path.
    """
    room = Room()
    return [as_path(bent_part(leg, array("d", (0.0,)) * 4, room)) for leg in legs(path)]


def legs(path: Stretches) -> Iterator[Stretches]:
    """The parts of a path between places where the axes must rest."""
    first, count = 0, len(path.form)
    while first < count:
        last = kernels().next_rest(path, first)
        yield path if last - first == count else cut_out(path, first, last, path.way[first])
        first = last


def as_path(part: Part) -> BentPath:
    """A bent part as arrays of numpy."""
    import numpy as np

    count = len(part.way)
    place, first, second = (
        np.asarray(values).reshape(count, -1) for values in (part.place, part.first, part.second)
    )
    return BentPath(
        np.asarray(part.way),
        place,
        first,
        second,
        np.asarray(part.cap2),
        np.asarray(part.ease),
        np.asarray(part.row),
        np.asarray(part.rows),
        np.asarray(part.row_way),
    )
