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
    stretches,
    turning,
    within,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Ints
    from polycnc.motion.third_order.bends.controls import Spline
    from polycnc.motion.third_order.bends.knots import Samples
    from polycnc.motion.third_order.bends.pieces import Pieces
    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.bends.turning import Turning

LIBRARY = Library(
    "third_order",
    (stretches, turning, knots, controls, within, levelling, pieces, rests, bending),
    (bending.bend_path, rests.next_rest),
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `bending.py` and `rests.py`."""

    bend_path: Callable[[Stretches, Ints, Turning, Samples, Spline, Pieces, Ints], int]
    next_rest: Callable[[Stretches, int], int]


PLAIN = Kernels(bending.bend_path, rests.next_rest)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    bend_path, next_rest = LIBRARY.compiled(PLAIN.bend_path), LIBRARY.compiled(PLAIN.next_rest)
    return PLAIN if bend_path is None or next_rest is None else Kernels(bend_path, next_rest)
