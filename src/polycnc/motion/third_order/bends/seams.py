"""Seams: places at which a path is bent in parts that go over into each other.

Around a seam at the way S lie seven knots S - 3h to S + 3h, h apart, and no other ones between them; control points lie
on the path. So the spline from S - h to S + h is settled by the path around S alone: the part before the seam and the
part behind it have there the same place, q' and q'', whatever else they are bent by.
"""

from __future__ import annotations

from polycnc.kernels.layout import Floats, Places, place
from polycnc.motion.third_order.bends.stretches import Stretches

#: Distances of knots before and behind a seam; of the path that must be known there, and stretches beyond that.
SIDE, KNOWN, BESIDES = 3, 4, 3


class Seams(Places):
    """Where a part begins and ends: way of a seam and distance h of its knots, which is 0 where the axes rest."""

    HEAD = place()
    HEAD_APART = place()
    TAIL = place()
    TAIL_APART = place()


def free_from(path: Stretches, seams: Floats) -> float:
    """The way of the first knot behind which knots are placed."""
    if seams[Seams.HEAD_APART] > 0.0:
        start: float = seams[Seams.HEAD] + SIDE * seams[Seams.HEAD_APART]
        return start
    rest: float = path.way[0]
    return rest


def free_to(path: Stretches, seams: Floats) -> float:
    """The way of the knot up to which they are."""
    if seams[Seams.TAIL_APART] > 0.0:
        end: float = seams[Seams.TAIL] - SIDE * seams[Seams.TAIL_APART]
        return end
    rest: float = path.way[len(path.form)]
    return rest


def stretch_behind(path: Stretches, way: float) -> int:
    """The stretch behind a way near the start."""
    e = 0
    while path.way[e + 1] <= way:
        e += 1
    return e


def stretch_before(path: Stretches, way: float) -> int:
    """The stretch before a way near the end."""
    e = len(path.form) - 1
    while e > 0 and path.way[e] >= way:
        e -= 1
    return e


def put_head(seams: Floats, knots: Floats) -> int:
    """Write the knots of the head seam but for the last one; their number."""
    if seams[Seams.HEAD_APART] <= 0.0:
        return 0
    for j in range(2 * SIDE):
        knots[j] = seams[Seams.HEAD] + (j - SIDE) * seams[Seams.HEAD_APART]
    return 2 * SIDE


def put_tail(seams: Floats, knots: Floats, made: int) -> int:
    """Write those of the tail seam behind the first one; the number of all knots, -1 where there is no room."""
    if seams[Seams.TAIL_APART] <= 0.0:
        return made
    if made + 2 * SIDE > len(knots):
        return -1
    for j in range(2 * SIDE):
        knots[made + j] = seams[Seams.TAIL] + (j + 1 - SIDE) * seams[Seams.TAIL_APART]
    return made + 2 * SIDE


def first_piece(seams: Floats) -> int:
    """The piece that begins at the head seam."""
    return SIDE if seams[Seams.HEAD_APART] > 0.0 else 0


def pieces_behind(seams: Floats) -> int:
    """Number of pieces behind the tail seam."""
    return SIDE if seams[Seams.TAIL_APART] > 0.0 else 0


def shift_ways(ways: Floats, first: int, count: int, origin: float, to: Floats, at: int) -> None:
    """Copy ways, counted from another place."""
    for k in range(count):
        to[at + k] = ways[first + k] - origin
