"""The planner's kernels, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.library import Library
from polycnc.motion.kernels import (
    alone,
    arcs,
    chords,
    columns,
    corners,
    demands,
    feeds,
    hold,
    jerk,
    lay,
    led,
    rounding,
    speeds,
)
from polycnc.motion.third_order.bends import rests
from polycnc.motion.third_order.laying import rows
from polycnc.transformation.orientation import linkage

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
from polycnc.motion.kernels.columns import Limits, Rows, State

LIBRARY = Library(
    "motion",
    (
        linkage,
        alone,
        arcs,
        chords,
        columns,
        corners,
        demands,
        feeds,
        hold,
        jerk,
        lay,
        led,
        rounding,
        speeds,
        rests,
        rows,
    ),
    (lay.lay, speeds.backward, speeds.forward, demands.share_rows, rows.lay_runs),
)


class Kernels(NamedTuple):
    """The three kernels that the planner calls; see `kernels/lay.py` and `kernels/speeds.py`."""

    lay: Callable[[Rows, int, Floats, int, Floats, Limits, Floats, State], int]
    backward: Callable[[Floats, int, int, Limits], int]
    forward: Callable[[Floats, int, int, Limits, float, Floats, Floats, int], None]


PLAIN = Kernels(lay.lay, speeds.backward, speeds.forward)


@cache
def share_rows() -> Callable[..., None]:
    """The kernel that bounds rows of a tool's tip, compiled; the plain one where there is none."""
    return LIBRARY.compiled(demands.share_rows) or demands.share_rows


def run_kernel(*, compiled: bool = True) -> Callable[..., int]:
    """The kernel that lays runs out of which some are led by a law (`third_order/laying/rows.py`)."""
    return (LIBRARY.compiled(rows.lay_runs) if compiled else None) or rows.lay_runs


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    laid = LIBRARY.compiled(PLAIN.lay)
    backward, forward = LIBRARY.compiled(PLAIN.backward), LIBRARY.compiled(PLAIN.forward)
    return PLAIN if laid is None or backward is None or forward is None else Kernels(laid, backward, forward)
