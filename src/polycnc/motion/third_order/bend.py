"""A programmed path becomes bent paths: one from each standstill to the next."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from polycnc.motion.third_order.bends.bending import NO_ROOM, NOT_WITHIN
from polycnc.motion.third_order.bends.controls import Spline
from polycnc.motion.third_order.bends.knots import Samples
from polycnc.motion.third_order.bends.pieces import Pieces
from polycnc.motion.third_order.bends.stretches import Stretches
from polycnc.motion.third_order.bends.turning import Turning
from polycnc.motion.third_order.bent_path import BentPath
from polycnc.motion.third_order.compiled import kernels

if TYPE_CHECKING:
    from collections.abc import Iterator

#: Room for knots: a stretch has so many at first, and the path so many besides; fourfold where that is too little.
PER_STRETCH, BESIDES = 3, 64


def bend(path: Stretches) -> list[BentPath]:
    """Bend a programmed path within its tolerance.

    Args:
        path: From rest to rest; the tangents of lines that are chords of a curve are set.

    Returns:
        Bent paths in order; between two of them the axes rest, for the path turns back there, or may not be left.

    Raises:
        ValueError: The tolerance is not kept: it is too small for the numbers of the path.
    """
    return [_bent(leg) for leg in legs(path)]


def legs(path: Stretches) -> Iterator[Stretches]:
    """The parts of a path between places where the axes must rest."""
    first, count = 0, len(path.form)
    while first < count:
        last = kernels().next_rest(path, first)
        yield path if last - first == count else _part(path, first, last)
        first = last


def _part(path: Stretches, first: int, last: int) -> Stretches:
    """The stretches from `first` to before `last`."""
    n, start = len(path.rotary), path.way[first]
    return path._replace(
        way=array("d", [way - start for way in path.way[first : last + 1]]),
        place=path.place[first * n : (last + 1) * n],
        leave=path.leave[first * n : last * n],
        arrive=path.arrive[first * n : last * n],
        **{
            name: getattr(path, name)[first:last]
            for name in ("form", "tolerance", "turn_tolerance", "cap2", "row")
        },
    )


def _bent(path: Stretches) -> BentPath:
    """One leg."""
    count, n = len(path.form), len(path.rotary)
    room = PER_STRETCH * count + BESIDES
    smooth, told = _whole(count + 1), _whole(3)
    while True:
        turning = Turning(
            before=_numbers(count + 1),
            behind=_numbers(count + 1),
            area=_numbers(count + 1),
            weight=array("d", (1.0,)) * count,
        )
        samples = Samples(_numbers(room), _numbers(room), *(_whole(room) for _ in range(3)))
        spline = Spline(*(_numbers(room) for _ in range(3)), *(_numbers((room + 3) * n) for _ in range(4)))
        pieces = Pieces(_numbers(room), _whole(room))
        found = kernels().bend_path(path, smooth, turning, samples, spline, pieces, told)
        if found != NO_ROOM:
            break
        room *= 4
    if found == NOT_WITHIN:
        msg = f"rows {path.row[0]} to {path.row[-1]} cannot be bent within their tolerance"
        raise ValueError(msg)
    return _as_arrays(path, spline, pieces, found)


def _as_arrays(path: Stretches, spline: Spline, pieces: Pieces, count: int) -> BentPath:
    """What the kernel has found."""
    import numpy as np

    n = len(path.rotary)
    of_row, way = np.asarray(path.row), np.asarray(path.way)
    last = np.append(of_row[1:] != of_row[:-1], True)
    place, first, second = (
        np.asarray(values)[: (count + 1) * n].reshape(-1, n)
        for values in (spline.place, spline.first, spline.second)
    )
    return BentPath(
        np.asarray(spline.way)[: count + 1],
        place,
        first,
        second,
        np.asarray(pieces.cap2)[:count],
        np.asarray(pieces.row)[:count],
        of_row[last],
        way[1:][last],
    )


def _numbers(count: int) -> array[float]:
    return array("d", bytes(8 * count))


def _whole(count: int) -> array[int]:
    return array("q", bytes(8 * count))
