"""The kernels of bent paths, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.library import Library
from polycnc.motion.third_order.bends import (
    bending,
    controls,
    knots,
    levelling,
    pieces,
    rests,
    seams,
    seeking,
    stretches,
    turning,
    within,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats, Ints
    from polycnc.motion.third_order.bends.controls import Spline
    from polycnc.motion.third_order.bends.knots import Samples
    from polycnc.motion.third_order.bends.pieces import Pieces
    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.bends.turning import Turning

LIBRARY = Library(
    "third_order",
    (stretches, turning, seams, knots, controls, within, levelling, pieces, rests, seeking, bending),
    (
        bending.bend_path,
        rests.next_rest,
        pieces.end_rows,
        seams.shift_ways,
        seeking.find_seam,
        seeking.far_enough,
    ),
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `bending.py`, `rests.py`, `pieces.py`, `seams.py` and `seeking.py`."""

    bend_path: Callable[[Stretches, Floats, Ints, Turning, Samples, Spline, Pieces, Ints], int]
    next_rest: Callable[[Stretches, int], int]
    end_rows: Callable[[Stretches, float, float, Ints, Floats], int]
    shift_ways: Callable[[Floats, int, int, float, Floats, int], object]
    find_seam: Callable[[Stretches, int, int, Ints, Turning, Spline, Floats], int]
    far_enough: Callable[[Stretches, int, int, int, float, int, Floats], int]


PLAIN = Kernels._make(LIBRARY.kernels)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return PLAIN if LIBRARY.lack is not None else Kernels._make(map(LIBRARY.compiled, PLAIN))
