"""Lines of a contour through the window of radius compensation, many at a time.

These functions do with columns what `ends`, `interference` and `rows` do with steps, and give the same numbers to the
last bit. They end in front of a move that is anything but ordinary: one that is no line, has no way, ends with several
vectors or none, or runs against another one. What is left is a matter of the stage.
"""

from __future__ import annotations

from math import atan2, cos, pi, sqrt

from polycnc.geometry.tolerances import NO_WAY, SMOOTH_MM
from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Bytes, Floats, record
from polycnc.toolpath.kinds import Kind

RAPID, STRAIGHT = int(Kind.RAPID), int(Kind.FEED)
#: Ways up to this (mm) are in doubt.
SHORT = 10.0 * NO_WAY
#: The share of two normals below which parallels hardly meet (`geometry.offset`): in doubt.
FLAT = 1e-11
#: Angles (radians) and degrees nearer than this to a limit are in doubt.
NEAR = 1e-6
DEGREES = 180.0 / pi


@record
class Offset(Structure):
    """How lines are compensated.

    Attributes:
        axes: Numbers of a position.
        u: Column of the plane's first axis; `v` of its second one.
        window: Moves that wait; those are the first ones of the columns.
        distance: Signed offset, mm, left positive.
        shift_u: Added to every vector, mm (nose centre to tip); `shift_v` likewise.
        start_u: Where the first of the moves begins, mm; `start_v` likewise.
        beside_u: How far the tool stands beside that, mm; `beside_v` likewise.
        outer_deg: Outer corners up to this angle are passed at the intersection.
        checks: Whether moves may not run against the program.
    """

    axes: int
    u: int
    v: int
    window: int
    distance: float
    shift_u: float
    shift_v: float
    start_u: float
    start_v: float
    beside_u: float
    beside_v: float
    outer_deg: float
    checks: int


def lead(at: Offset, kinds: Bytes, ends: Floats, ways: Floats, vectors: Floats, rows: Floats) -> int:
    """Read move after move behind the window; each passes on the first one that waits.

    Args:
        at: How.
        kinds: Kinds of the moves.
        ends: Their ends, flat.
        ways: For each move the direction and length of its way in the plane, 3 numbers; filled here.
        vectors: For each move the vector at its end, 2 numbers. Those of the window are there, but for the last
            one's; filled here.
        rows: As `ends`; of the moves that are passed on, the plane's columns become those of the tool.

    Returns:
        How many moves were read.
    """
    axes, u, v, window = at.axes, at.u, at.v, at.window
    for i in range(window):
        if not measure(at, kinds, ends, ways, i):
            return 0
    place_u, place_v = at.start_u + at.beside_u, at.start_v + at.beside_v
    for i in range(window, len(kinds)):
        if not measure(at, kinds, ends, ways, i) or not close(at, ends, ways, vectors, i):
            return i - window
        first = i - window
        vector_u, vector_v = vectors[2 * first] + at.shift_u, vectors[2 * first + 1] + at.shift_v
        end_u, end_v = ends[axes * first + u] + vector_u, ends[axes * first + v] + vector_v
        du, dv = end_u - place_u, end_v - place_v
        if du * du + dv * dv <= SHORT * SHORT:
            return i - window
        rows[axes * first + u], rows[axes * first + v] = end_u, end_v
        place_u, place_v = ends[axes * first + u] + vector_u, ends[axes * first + v] + vector_v
    return len(kinds) - window


def measure(at: Offset, kinds: Bytes, ends: Floats, ways: Floats, i: int) -> bool:
    """Direction and length of a move; false where it is no line that the plane sees."""
    if kinds[i] != STRAIGHT and kinds[i] != RAPID:
        return False
    axes, u, v = at.axes, at.u, at.v
    begin_u, begin_v = at.start_u, at.start_v
    if i > 0:
        begin_u, begin_v = ends[axes * (i - 1) + u], ends[axes * (i - 1) + v]
    du, dv = ends[axes * i + u] - begin_u, ends[axes * i + v] - begin_v
    length = sqrt(du * du + dv * dv)
    if not length > SHORT:
        return False
    ways[3 * i], ways[3 * i + 1], ways[3 * i + 2] = du / length, dv / length, length
    return True


def close(at: Offset, ends: Floats, ways: Floats, vectors: Floats, i: int) -> bool:
    """Find the vector that ends the move in front of one; false where that is not one which nothing objects to."""
    found, vector_u, vector_v = corner(at, ends, ways, i)
    if not found:
        return False
    if at.checks:
        last = i - 1
        before = 2 * (last - 1)
        along = (vector_u - vectors[before]) * ways[3 * last]
        along += (vector_v - vectors[before + 1]) * ways[3 * last + 1]
        if ways[3 * last + 2] + along < 0.0:
            return False
        for earlier in range(i - at.window, last - 1):
            if crosses(at, ends, vectors, earlier, last, vector_u, vector_v):
                return False
    vectors[2 * (i - 1)], vectors[2 * (i - 1) + 1] = vector_u, vector_v
    return True


def corner(at: Offset, ends: Floats, ways: Floats, i: int) -> tuple[bool, float, float]:
    """The one vector between two lines (`geometry.offset.corner`)."""
    au, av = ways[3 * (i - 1)], ways[3 * (i - 1) + 1]
    bu, bv = ways[3 * i], ways[3 * i + 1]
    angle = atan2(au * bv - av * bu, au * bu + av * bv)
    distance = at.distance
    second_u, second_v = -distance * bv, distance * bu
    if abs(distance * angle) <= SMOOTH_MM:
        return True, second_u, second_v
    first_u, first_v = -distance * av, distance * au
    if abs(angle) > pi - NEAR:
        return False, 0.0, 0.0
    if angle * distance < -SMOOTH_MM:
        if abs(angle) * DEGREES > at.outer_deg - NEAR:
            return False, 0.0, 0.0
        share = 1.0 + cos(abs(angle))
        return share > FLAT, (first_u + second_u) / share, (first_v + second_v) / share
    share = 1.0 + au * bu + av * bv
    if share < FLAT:
        return False, 0.0, 0.0
    end_u, end_v = ends[at.axes * (i - 1) + at.u], ends[at.axes * (i - 1) + at.v]
    point_u, point_v = end_u + (first_u + second_u) / share, end_v + (first_v + second_v) / share
    return True, point_u - end_u, point_v - end_v


def crosses(
    at: Offset, ends: Floats, vectors: Floats, one: int, two: int, vector_u: float, vector_v: float
) -> bool:
    """Whether the tool hardly goes on, or goes back, from the end of one move to that of another."""
    axes, u, v = at.axes, at.u, at.v
    du, dv = ends[axes * two + u] - ends[axes * one + u], ends[axes * two + v] - ends[axes * one + v]
    along: float = du * (du + vector_u - vectors[2 * one]) + dv * (dv + vector_v - vectors[2 * one + 1])
    return along < 0.0
