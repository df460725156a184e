"""Single turning cycles: four strokes from a start point round a corner and back (FANUC 0i-TF Plus II.4.1)."""

from __future__ import annotations

from polycnc.cycles.turning.stroke import PlaneStroke, feed, rapid
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.geometry.arcs import Point


def longitudinal(start: Point, corner: Point, taper: float) -> Iterator[PlaneStroke]:
    """G90: cut along the first axis; `taper` is how much further along the second axis the cut begins."""
    yield rapid(start[0], corner[1] + taper)
    yield feed(*corner)
    yield feed(corner[0], start[1])
    yield rapid(*start)


def facing(start: Point, corner: Point, taper: float) -> Iterator[PlaneStroke]:
    """G94: cut along the second axis; `taper` is how much further along the first axis the cut begins."""
    yield rapid(corner[0] + taper, start[1])
    yield feed(*corner)
    yield feed(start[0], corner[1])
    yield rapid(*start)
