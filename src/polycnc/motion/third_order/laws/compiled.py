"""The kernels of jerk laws, compiled or as they are."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.library import Library
from polycnc.motion.third_order.laws import barrier, courses, grid, phases, search

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.kernels.layout import Floats
    from polycnc.motion.third_order.laws.courses import Axes, Course, Nodes

LIBRARY = Library(
    "jerk_laws", (courses, grid, barrier, phases, search), (search.place_nodes, search.find_law)
)


class Kernels(NamedTuple):
    """The kernels that Python calls; see `search.py`."""

    place_nodes: Callable[[Course, Axes, Floats, Floats, Floats, Floats, Floats], int]
    find_law: Callable[[Course, Axes, Floats, Floats, Floats, Nodes, Floats, Floats, Floats], int]


PLAIN = Kernels(search.place_nodes, search.find_law)


@cache
def kernels() -> Kernels:
    """The compiled kernels; the plain ones where there are none."""
    place_nodes, find_law = LIBRARY.compiled(PLAIN.place_nodes), LIBRARY.compiled(PLAIN.find_law)
    return PLAIN if place_nodes is None or find_law is None else Kernels(place_nodes, find_law)
