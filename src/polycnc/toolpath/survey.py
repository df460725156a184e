"""Kernel: how far the moves of a chunk reach, arcs included, and which feeds they name.

A function on arrays that runs as it is and as machine code (`kernels/`).
"""

from __future__ import annotations

from array import array
from math import atan2, inf, sqrt, tau

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Words32
from polycnc.toolpath.kinds import CURVE_WIDTH, Kind

RAPIDS, CUTS, STANDS = 0, 1, 2
_ARCS = (int(Kind.CW), int(Kind.CCW), int(Kind.HELIX_CW), int(Kind.HELIX_CCW))
_CCW = (int(Kind.CCW), int(Kind.HELIX_CCW))
#: An arc reaches no further than the box that holds it by so much, mm.
_BEYOND = 1e-9
#: An axis whose share in the normal of an arc is no less than this goes along the normal.
_ALONG = 1.0 - 1e-9


class Moves(NamedTuple):
    """Columns of a chunk."""

    kind: Bytes
    context: Words32
    feed: Floats
    end: Floats
    curve: Ints32
    curves: Floats


class Box(NamedTuple):
    """The least and the greatest position of each axis, and least and greatest feed; it only grows."""

    low: Floats
    high: Floats
    feeds: Floats


def empty_box(axes: int) -> Box:
    """A box that holds nothing yet."""
    return Box(array("d", [inf] * axes), array("d", [-inf] * axes), array("d", (inf, -inf)))


def survey(moves: Moves, first: int, classes: Bytes, geometry: Ints, before: Floats, box: Box) -> int:
    """Widen a box by a run of moves of one context that all cut, or all do not; gives the row behind them.

    Args:
        moves: Columns of a chunk.
        first: Row that the run begins with.
        classes: For each kind RAPIDS, CUTS or STANDS; where no axis moves, the box stays.
        geometry: Columns of X, Y and Z, -1 for a missing one.
        before: Positions in front of the chunk; nothing where none is known.
        box: Of the run.
    """
    low, high = box.low, box.high
    n, row = len(low), first
    context, kind = moves.context[first], classes[moves.kind[first]]
    while row < len(moves.kind) and moves.context[row] == context and classes[moves.kind[row]] == kind:
        if kind != STANDS:
            for i in range(n):
                value = moves.end[row * n + i]
                if value < low[i]:
                    low[i] = value
                if value > high[i]:
                    high[i] = value
        if kind == CUTS:
            feed = moves.feed[row]
            if feed < box.feeds[0]:
                box.feeds[0] = feed
            if feed > box.feeds[1]:
                box.feeds[1] = feed
            if moves.curve[row] >= 0 and moves.kind[row] in _ARCS:
                at, ccw = CURVE_WIDTH * moves.curve[row], moves.kind[row] in _CCW
                if row > 0:
                    widen(moves.end, (row - 1) * n, moves.end, row * n, moves.curves, at, ccw, geometry, box)
                elif len(before) > 0:
                    widen(before, 0, moves.end, row * n, moves.curves, at, ccw, geometry, box)
        row += 1
    return row


def widen(
    start: Floats,
    start_at: int,
    end: Floats,
    end_at: int,
    curves: Floats,
    at: int,
    ccw: bool,
    geometry: Ints,
    box: Box,
) -> None:
    """Widen a box by where an arc turns back along X, Y or Z between its ends.

    Args:
        start: Start point, from place `start_at` on.
        start_at: See `start`.
        end: End point, from place `end_at` on.
        end_at: See `end`.
        curves: From place `at` on curve parameters: centre, normal, further turns.
        at: See `curves`.
        ccw: Counter-clockwise about the normal.
        geometry: Columns of X, Y and Z.
        box: See `survey`.
    """
    for axis in range(3):
        share = curves[at + 3 + axis]
        if abs(share) >= _ALONG:
            right, up = (axis + 1) % 3, (axis + 2) % 3
            u, v = curves[at + right], curves[at + up]
            a, b = _of(start, start_at, geometry[right]) - u, _of(start, start_at, geometry[up]) - v
            c, d = _of(end, end_at, geometry[right]) - u, _of(end, end_at, geometry[up]) - v
            full = curves[at + 6] >= 1.0 or (abs(a - c) < _BEYOND and abs(b - d) < _BEYOND)
            if ccw != (share > 0.0):
                a, b, c, d = c, d, a, b
            _widen_flat(a, b, c, d, full, u, v, geometry[right], geometry[up], box)
            return
    _widen_tilted(start, start_at, end, end_at, curves, at, ccw, geometry, box)


def _of(point: Floats, at: int, column: int) -> float:
    return point[at + column] if column >= 0 else 0.0


def _widen_flat(
    a: float, b: float, c: float, d: float, full: bool, u: float, v: float, right: int, up: int, box: Box
) -> None:
    """An arc about an axis, counter-clockwise from spoke (a, b) to (c, d) about (u, v)."""
    turn = a * d - b * c
    if full:
        east = north = west = south = True
    elif turn > 0.0 or (turn == 0.0 and a * c + b * d < 0.0):
        # Half a turn at most: a direction is passed if it lies behind the first spoke and in front of the second.
        east, north = b <= 0.0 and d >= 0.0, c <= 0.0 and a >= 0.0
        west, south = d <= 0.0 and b >= 0.0, a <= 0.0 and c >= 0.0
    else:
        east, north = not (d < 0.0 and b > 0.0), not (a < 0.0 and c > 0.0)
        west, south = not (b < 0.0 and d > 0.0), not (c < 0.0 and a > 0.0)
    radius = sqrt(a * a + b * b)
    if east:
        _include(box, right, u + radius)
    if west:
        _include(box, right, u - radius)
    if north:
        _include(box, up, v + radius)
    if south:
        _include(box, up, v - radius)


def _include(box: Box, column: int, value: float) -> None:
    if column >= 0:
        if value < box.low[column]:
            box.low[column] = value
        if value > box.high[column]:
            box.high[column] = value


def _widen_tilted(
    start: Floats,
    start_at: int,
    end: Floats,
    end_at: int,
    curves: Floats,
    at: int,
    ccw: bool,
    geometry: Ints,
    box: Box,
) -> None:
    side = 1.0 if ccw else -1.0
    nx, ny, nz = side * curves[at + 3], side * curves[at + 4], side * curves[at + 5]
    sx = _of(start, start_at, geometry[0]) - curves[at]
    sy = _of(start, start_at, geometry[1]) - curves[at + 1]
    sz = _of(start, start_at, geometry[2]) - curves[at + 2]
    ex = _of(end, end_at, geometry[0]) - curves[at]
    ey = _of(end, end_at, geometry[1]) - curves[at + 1]
    ez = _of(end, end_at, geometry[2]) - curves[at + 2]
    along = sx * nx + sy * ny + sz * nz
    sx, sy, sz = sx - along * nx, sy - along * ny, sz - along * nz
    along = ex * nx + ey * ny + ez * nz
    ex, ey, ez = ex - along * nx, ey - along * ny, ez - along * nz
    radius = sqrt(sx * sx + sy * sy + sz * sz)
    sweep = tau
    if curves[at + 6] < 1.0:
        sweep = _angle(sx, sy, sz, ex, ey, ez, nx, ny, nz)
        if sweep == 0.0:
            sweep = tau
    for axis in range(3):
        share = nx if axis == 0 else ny if axis == 1 else nz
        flat = sqrt(max(1.0 - share * share, 0.0))
        for turned in range(2):
            sign = 1.0 - 2.0 * turned
            wx = sign * ((1.0 if axis == 0 else 0.0) - share * nx)
            wy = sign * ((1.0 if axis == 1 else 0.0) - share * ny)
            wz = sign * ((1.0 if axis == 2 else 0.0) - share * nz)
            if _angle(sx, sy, sz, wx, wy, wz, nx, ny, nz) <= sweep:
                _include(box, geometry[axis], curves[at + axis] + sign * radius * flat)


def _angle(
    ax: float,
    ay: float,
    az: float,
    bx: float,
    by: float,
    bz: float,
    nx: float,
    ny: float,
    nz: float,
) -> float:
    """From one direction to another about a normal, 0 to 2π."""
    across = nx * (ay * bz - az * by) + ny * (az * bx - ax * bz) + nz * (ax * by - ay * bx)
    angle = atan2(across, ax * bx + ay * by + az * bz)
    if angle > _BEYOND:
        return angle
    return angle + tau if angle < -_BEYOND else 0.0
