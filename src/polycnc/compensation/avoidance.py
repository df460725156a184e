"""The way round an interference (FANUC 0i-TF Plus 5.4.6): which vectors have changed places, and what replaces them."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from polycnc.geometry import offset

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge


@dataclass(frozen=True, slots=True)
class WayRound:
    """Vectors that lead past the blocks of an interference.

    Attributes:
        leaving: At the end of the block in front.
        arriving: At the end of the gap, straight from `leaving`; None where the block in front runs on to the one
            behind.
        is_dangerous: The way runs against what was commanded, or cuts the work.
    """

    leaving: Point
    arriving: Point | None
    is_dangerous: bool


def crosses(one: Edge, vector: Point, two: Edge, other: Point) -> bool:
    """Whether the tool goes from the end of one block to that of another against the programmed direction."""
    (u0, v0), (u1, v1) = one.end, two.end
    du, dv = u1 - u0, v1 - v0
    return du * (du + other[0] - vector[0]) + dv * (dv + other[1] - vector[1]) < -offset.BACKWARDS_MM


def way_round(
    before: Edge, first: Point, between: Sequence[Edge], beyond: Edge, distance: float
) -> WayRound | None:
    """The way from one block to another past those between; None where there is none.

    The straight gap between the ends stands for the blocks between. Where its two intersections have changed places as
    well, the two blocks meet each other.

    Args:
        before: The block in front.
        first: Vector at its start.
        between: The blocks between.
        beyond: The block behind.
        distance: Signed offset.
    """
    gap_end = between[-1].end
    gap = offset.line(before.end, gap_end)
    one = offset.meet(before, gap, distance, distance) if gap.length else None
    two = offset.meet(gap, beyond, distance, distance) if gap.length else None
    if one is not None and two is not None:
        along = (two[0] - one[0]) * gap.departing[0] + (two[1] - one[1]) * gap.departing[1]
        if along > offset.BACKWARDS_MM:
            leaving = _vector(before.end, one)
            cuts = _cuts([one, two], between, distance)
            return WayRound(leaving, _vector(gap_end, two), cuts or offset.reverses(before, first, leaving))
    point = offset.meet(before, beyond, distance, distance)
    if point is None:
        return None
    leaving = _vector(before.end, point)
    outer = offset.is_outer(before, beyond, distance)
    cuts = _cuts([point, point], between, distance)
    return WayRound(leaving, None, outer or cuts or offset.reverses(before, first, leaving))


def _cuts(way: Sequence[Point], between: Sequence[Edge], distance: float) -> bool:
    """Whether the tool on a straight way comes too near to a corner of the blocks that it leaves out."""
    (u0, v0), (u1, v1) = way
    du, dv = u1 - u0, v1 - v0
    square = du * du + dv * dv
    for u, v in (between[0].start, *(edge.end for edge in between)):
        part = min(max(((u - u0) * du + (v - v0) * dv) / square, 0.0), 1.0) if square else 0.0
        if hypot(u - u0 - part * du, v - v0 - part * dv) < abs(distance) - offset.BACKWARDS_MM:
            return True
    return False


def _vector(start: Point, end: Point) -> Point:
    return (end[0] - start[0], end[1] - start[1])
