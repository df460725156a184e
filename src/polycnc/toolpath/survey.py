"""Kernel: how far the moves of a chunk reach, arcs included, and which feeds they name.

A function on arrays that runs as it is and as machine code (`kernels/`).
"""

from __future__ import annotations

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


class Contexts(NamedTuple):
    """What the rows of each context count for, by its number.

    Attributes:
        system: Number of the system of coordinates that its positions stand in.
        box: Boxes of its rapids and of its cuts, by their numbers; -1 for none.
    """

    system: Ints
    box: Ints


class Boxes(NamedTuple):
    """Of each box the least and the greatest position of every axis, and least and greatest feed; they only grow."""

    low: Floats
    high: Floats
    feeds: Floats


def add_box(boxes: Boxes, axes: int) -> None:
    """Add a box that holds nothing yet."""
    boxes.low.extend([inf] * axes)
    boxes.high.extend([-inf] * axes)
    boxes.feeds.extend((inf, -inf))


def survey(
    moves: Moves,
    first: int,
    classes: Bytes,
    geometry: Ints,
    before: Floats,
    contexts: Contexts,
    boxes: Boxes,
) -> int:
    """Widen boxes by the moves from a row on that stand in one system of coordinates.

    A cut reaches from where the row in front of it ends, which may be a rapid.

    Args:
        moves: Columns of a chunk.
        first: Row to begin with.
        classes: For each kind RAPIDS, CUTS or STANDS; where no axis moves, boxes stay.
        geometry: Columns of X, Y and Z, -1 for a missing one.
        before: Position in front of the first row, in its system; nothing where none is known.
        contexts: See there.
        boxes: See there.

    Returns:
        The row behind them: the first one of another system, or without a box.
    """
    n, row = len(moves.end) // len(moves.kind), first
    system, cut = contexts.system[moves.context[first]], -1
    while row < len(moves.kind) and contexts.system[moves.context[row]] == system:
        kind, number = classes[moves.kind[row]], -1
        if kind != STANDS:
            number = contexts.box[2 * moves.context[row] + kind]
            if number < 0:
                return row
            reach(boxes, number * n, moves.end, row * n, n)
        if kind == CUTS:
            start, at = moves.end, (row - 1) * n
            if row == first:
                start, at = before, 0
            if number != cut and len(start) > 0:
                reach(boxes, number * n, start, at, n)
            if moves.feed[row] < boxes.feeds[2 * number]:
                boxes.feeds[2 * number] = moves.feed[row]
            if moves.feed[row] > boxes.feeds[2 * number + 1]:
                boxes.feeds[2 * number + 1] = moves.feed[row]
            if moves.curve[row] >= 0 and moves.kind[row] in _ARCS and len(start) > 0:
                curve, ccw = CURVE_WIDTH * moves.curve[row], moves.kind[row] in _CCW
                widen(
                    start, at, moves.end, row * n, moves.curves, curve, ccw, geometry, boxes, number * n
                )  # fmt: skip
        cut = number if kind == CUTS else -1
        row += 1
    return row


def reach(boxes: Boxes, into: int, points: Floats, at: int, axes: int) -> None:
    """Widen a box, from place `into` on, by a point, from place `at` on."""
    for i in range(axes):
        value = points[at + i]
        if value < boxes.low[into + i]:
            boxes.low[into + i] = value
        if value > boxes.high[into + i]:
            boxes.high[into + i] = value


def widen(
    start: Floats,
    start_at: int,
    end: Floats,
    end_at: int,
    curves: Floats,
    at: int,
    ccw: bool,
    geometry: Ints,
    boxes: Boxes,
    into: int,
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
        boxes: See `survey`.
        into: Where the box begins among them.
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
            _widen_flat(a, b, c, d, full, u, v, geometry[right], geometry[up], boxes, into)
            return
    _widen_tilted(start, start_at, end, end_at, curves, at, ccw, geometry, boxes, into)


def _of(point: Floats, at: int, column: int) -> float:
    return point[at + column] if column >= 0 else 0.0


def _widen_flat(
    a: float,
    b: float,
    c: float,
    d: float,
    full: bool,
    u: float,
    v: float,
    right: int,
    up: int,
    boxes: Boxes,
    into: int,
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
        _include(boxes, into, right, u + radius)
    if west:
        _include(boxes, into, right, u - radius)
    if north:
        _include(boxes, into, up, v + radius)
    if south:
        _include(boxes, into, up, v - radius)


def _include(boxes: Boxes, into: int, column: int, value: float) -> None:
    if column >= 0:
        if value < boxes.low[into + column]:
            boxes.low[into + column] = value
        if value > boxes.high[into + column]:
            boxes.high[into + column] = value


def _widen_tilted(
    start: Floats,
    start_at: int,
    end: Floats,
    end_at: int,
    curves: Floats,
    at: int,
    ccw: bool,
    geometry: Ints,
    boxes: Boxes,
    into: int,
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
                _include(boxes, into, geometry[axis], curves[at + axis] + sign * radius * flat)


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
