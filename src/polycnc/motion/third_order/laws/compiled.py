"""The kernels of jerk laws, compiled or as they are."""

from __future__ import annotations

from functools import cache

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
    from polycnc.motion.third_order.laws.courses import Axes, Course, Known, Nodes, Work
    from polycnc.motion.third_order.laws.records import RowEnds, Track, Walk

_LAWS = "polycnc.motion.third_order.laws"
LIBRARY = Library(
    "jerk_laws",
    (
        f"{_LAWS}.courses",
        f"{_LAWS}.grid",
        f"{_LAWS}.stencils",
        f"{_LAWS}.barrier",
        f"{_LAWS}.newton",
        f"{_LAWS}.phases",
        f"{_LAWS}.search",
        f"{_LAWS}.joining",
        f"{_LAWS}.records",
    ),
    (
        f"{_LAWS}.search.place_nodes",
        f"{_LAWS}.grid.merge",
        f"{_LAWS}.search.find_law",
        f"{_LAWS}.joining.look_ahead",
        f"{_LAWS}.joining.cut_law",
        f"{_LAWS}.records.put_records",
        f"{_LAWS}.records.add_times",
    ),
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `search.py`, `grid.py`, `joining.py` and `records.py`."""

    place_nodes: Callable[[Course, Axes, Floats, Floats, Floats, Floats, Floats, Floats], int]
    merge: Callable[[Floats, Floats, int, Floats], int]
    find_law: Callable[[Course, Axes, Floats, Floats, Floats, Nodes, Known, Work, Floats, Floats], int]
    look_ahead: Callable[[Course, Axes, Floats, float, Floats], int]
    cut_law: Callable[[Floats, float, float, float, Floats, int], int]
    put_records: Callable[[Track, Floats, RowEnds, Walk, Floats], int]
    add_times: Callable[[Floats, RowEnds, Walk, Floats, Floats, int], None]


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    return Kernels._make(map(LIBRARY.kernel, LIBRARY.names))


@cache
def plain() -> Kernels:
    """The kernels as they are written."""
    return Kernels._make(map(LIBRARY.plain, LIBRARY.names))
