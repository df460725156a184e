"""The kernels of bent paths, compiled or as they are."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats, Ints
    from polycnc.motion.third_order.bends.controls import Spline
    from polycnc.motion.third_order.bends.knots import Samples
    from polycnc.motion.third_order.bends.pieces import Pieces
    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.bends.turning import Turning

_BENDS = "polycnc.motion.third_order.bends"
LIBRARY = Library(
    "third_order",
    (
        f"{_BENDS}.stretches",
        f"{_BENDS}.turning",
        f"{_BENDS}.seams",
        f"{_BENDS}.knots",
        f"{_BENDS}.controls",
        f"{_BENDS}.keeping",
        f"{_BENDS}.within",
        f"{_BENDS}.levelling",
        f"{_BENDS}.at_corners",
        f"{_BENDS}.pieces",
        f"{_BENDS}.rests",
        f"{_BENDS}.seeking",
        f"{_BENDS}.bending",
    ),
    (
        f"{_BENDS}.bending.bend_path",
        f"{_BENDS}.rests.next_rest",
        f"{_BENDS}.seams.shift_ways",
        f"{_BENDS}.seeking.find_seam",
        f"{_BENDS}.seeking.far_enough",
    ),
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `bending.py`, `rests.py`, `seams.py` and `seeking.py`."""

    bend_path: Callable[
        [Stretches, Floats, Ints, Turning, Samples, Spline, Pieces, Floats, Ints, Floats, Ints], int
    ]
    next_rest: Callable[[Stretches, int], int]
    shift_ways: Callable[[Floats, int, int, float, Floats, int], object]
    find_seam: Callable[[Stretches, int, int, Ints, Turning, Spline, Floats], int]
    far_enough: Callable[[Stretches, int, int, int, float, int, Floats], int]


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return Kernels._make(map(LIBRARY.kernel, LIBRARY.names))


@cache
def plain() -> Kernels:
    """The kernels as they are written."""
    return Kernels._make(map(LIBRARY.plain, LIBRARY.names))
