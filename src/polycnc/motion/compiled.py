"""The planner's kernels, compiled or as they are."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
    from polycnc.motion.kernels.columns import Limits, Rows, State

_KERNELS, _THIRD_ORDER = "polycnc.motion.kernels", "polycnc.motion.third_order"
#: What rows are laid out by, with all that it rests on.
PLANNING = (
    "polycnc.transformation.orientation.linkage",
    f"{_KERNELS}.alone",
    f"{_KERNELS}.arcs",
    f"{_KERNELS}.chords",
    f"{_KERNELS}.columns",
    f"{_KERNELS}.corners",
    f"{_KERNELS}.demands",
    f"{_KERNELS}.feeds",
    f"{_KERNELS}.hold",
    f"{_KERNELS}.jerk",
    f"{_KERNELS}.lay",
    f"{_KERNELS}.leads",
    f"{_KERNELS}.led",
    f"{_KERNELS}.rounding",
    f"{_KERNELS}.speeds",
)
LIBRARY = Library(
    "motion",
    (
        *PLANNING,
        f"{_THIRD_ORDER}.bends.at_corners",
        f"{_THIRD_ORDER}.bends.rests",
        f"{_THIRD_ORDER}.bends.stretches",
        f"{_THIRD_ORDER}.laying.resting",
        f"{_THIRD_ORDER}.laying.rows",
    ),
    (
        f"{_KERNELS}.lay.lay",
        f"{_KERNELS}.speeds.settled",
        f"{_KERNELS}.speeds.backward",
        f"{_KERNELS}.speeds.forward",
        f"{_KERNELS}.chords.settle",
        f"{_KERNELS}.demands.share_rows",
        f"{_THIRD_ORDER}.laying.rows.lay_runs",
    ),
)


class Kernels(NamedTuple):
    """The kernels that the planner calls; see `kernels/lay.py`, `kernels/speeds.py` and `kernels/chords.py`."""

    lay: Callable[[Rows, int, Floats, int, Floats, Limits, Floats, State], int]
    settled: Callable[[Floats, int, State], int]
    backward: Callable[[Floats, int, int, Limits], int]
    forward: Callable[[Floats, int, int, Limits, float, Floats, Floats, int], None]
    settle: Callable[[Floats, int, Limits, State], None]


@cache
def share_rows() -> Callable[..., None]:
    """The kernel that bounds rows of a tool's tip, compiled; the plain one where there is none."""
    return LIBRARY.kernel("share_rows")


def run_kernel(*, compiled: bool = True) -> Callable[..., int]:
    """The kernel that lays runs out of which some are led by a law (`third_order/laying/rows.py`)."""
    return LIBRARY.kernel("lay_runs") if compiled else LIBRARY.plain("lay_runs")


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return Kernels._make(map(LIBRARY.kernel, Kernels._fields))


@cache
def plain() -> Kernels:
    """The kernels as they are written."""
    return Kernels._make(map(LIBRARY.plain, Kernels._fields))
