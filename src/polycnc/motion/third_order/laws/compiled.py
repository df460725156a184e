"""The kernels of jerk laws, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.library import Library
from polycnc.motion.third_order.laws import barrier, courses, grid, joining, phases, records, search

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
    from polycnc.motion.third_order.laws.courses import Axes, Course, Known, Nodes
    from polycnc.motion.third_order.laws.records import RowEnds, Track, Walk

LIBRARY = Library(
    "jerk_laws",
    (courses, grid, barrier, phases, search, joining, records),
    (
        search.place_nodes,
        grid.merge,
        search.find_law,
        joining.look_ahead,
        joining.cut_law,
        records.put_records,
        records.add_times,
    ),
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `search.py`, `grid.py`, `joining.py` and `records.py`."""

    place_nodes: Callable[[Course, Axes, Floats, Floats, Floats, Floats, Floats], int]
    merge: Callable[[Floats, Floats, int, Floats], int]
    find_law: Callable[[Course, Axes, Floats, Floats, Floats, Nodes, Known, Floats, Floats, Floats], int]
    look_ahead: Callable[[Course, Axes, Floats, float, Floats], int]
    cut_law: Callable[[Floats, float, float, float, Floats], int]
    put_records: Callable[[Track, Floats, RowEnds, Walk, Floats], int]
    add_times: Callable[[Floats, RowEnds, Walk, Floats, Floats, int], None]


PLAIN = Kernels._make(LIBRARY.kernels)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return PLAIN if LIBRARY.lack is not None else Kernels._make(map(LIBRARY.compiled, PLAIN))
