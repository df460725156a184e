"""Kernel: positions of two rotary axes that stand the tool along a direction, where a move turns it by little.

The interpreter asks it as the scanner does, so that both have the same bits. It decides where `turning.follow` would
lead the axes evenly from the start of a move to its end without a look at the way between: what turns farther, comes
into the cone about a pole or out of it, or has no solution within reach, is left to that.
"""

from __future__ import annotations

from math import atan2, cos, floor, pi, sin, sqrt

from polycnc.kernels.layout import Floats
from polycnc.transformation.orientation.records import StandRecord

RADIAN, DEGREE = pi / 180.0, 180.0 / pi
#: As `turning` has them: a step (radians), how near to a pole it becomes shorter (degrees), and by how much.
STEP, NEAR_DEG, CLOSEST = 1.5 * RADIAN, 8.0, 0.1
#: Less than this (radians) off the way the tool may be: what turns it by no more has no knots (`turning.TOLERANCE`).
TOLERANCE = 0.0199 * RADIAN
#: A step is as long as allowed with so much to spare.
SPARE = 1.0 - 1e-6
#: As `directions`, `solutions` and `choice` have them.
NO_LENGTH, PARALLEL, SAME, AT_LIMIT, DECIMALS = 1e-9, 1e-9, 1e-6, 1e-9, 1e10


def spun(tool: Floats, at: int, angle: float, x: float, y: float, z: float) -> tuple[float, float, float]:
    """A vector turned by an angle (radians) about the direction at a place of the record (Rodrigues)."""
    a, b, d = tool[at], tool[at + 1], tool[at + 2]
    c, s = cos(angle), sin(angle)
    along = (a * x + b * y + d * z) * (1.0 - c)
    u, v, w = b * z - d * y, d * x - a * z, a * y - b * x
    return c * x + s * u + along * a, c * y + s * v + along * b, c * z + s * w + along * d


def drawn(tool: Floats, inner: float) -> tuple[float, float, float]:
    """The tool as the inner axis turns it, by radians with its sense."""
    at = StandRecord.ALONG
    return spun(tool, StandRecord.INNER_DIRECTION, inner, tool[at], tool[at + 1], tool[at + 2])


def pole_of(tool: Floats, x: float, y: float, z: float) -> float:
    """How far a tool that the inner axis has turned is from the nearest pole, degrees (`solutions.pole_angle`)."""
    at, to = StandRecord.OUTER_DIRECTION, StandRecord.INNER_DIRECTION
    a, b, c = tool[at], tool[at + 1], tool[at + 2]
    d, e, f = tool[to], tool[to + 1], tool[to + 2]
    span = min(abs(x * (b * f - c * e) + y * (c * d - a * f) + z * (a * e - b * d)), 1.0)
    return atan2(span, sqrt(1.0 - span * span)) * DEGREE


def on_turn(angle: float, near: float) -> float:
    """An angle on the turn that is nearest to another one, without the noise of the arcs that it comes from."""
    turned = angle + 360.0 * floor((near - angle) / 360.0 + 0.5)
    return floor(turned * DECIMALS + 0.5) / DECIMALS + 0.0


def stand(tool: Floats, start: Floats, x: float, y: float, z: float, end: Floats) -> bool:
    """Set the two rotary axes in `end` so that the tool stands along a direction; false, and nothing set, for others.

    Args:
        tool: A `StandRecord`.
        start: Positions before the move.
        x: Of the direction as it is programmed, of any length.
        y: Likewise.
        z: Likewise.
        end: Positions behind it.
    """
    outer, inner = int(tool[StandRecord.OUTER]), int(tool[StandRecord.INNER])
    if outer < 0:
        return False
    f = StandRecord.FRAME
    u = tool[f] * x + tool[f + 1] * y + tool[f + 2] * z
    v = tool[f + 3] * x + tool[f + 4] * y + tool[f + 5] * z
    w = tool[f + 6] * x + tool[f + 7] * y + tool[f + 8] * z
    size = sqrt(u * u + v * v + w * w)
    if not size > NO_LENGTH:
        return False
    u, v, w = u / size, v / size, w / size
    near_outer = start[outer] + tool[StandRecord.ADDED]
    near_inner = start[inner] + tool[StandRecord.ADDED + 1]
    p, q, r = drawn(tool, tool[StandRecord.SENSE + 1] * near_inner * RADIAN)
    pole = pole_of(tool, p, q, r)
    angle = 0.0
    if tool[StandRecord.EVENLY] == 0.0:
        p, q, r = spun(
            tool, StandRecord.OUTER_DIRECTION, tool[StandRecord.SENSE] * near_outer * RADIAN, p, q, r
        )
        a, b, c = q * w - r * v, r * u - p * w, p * v - q * u
        angle = atan2(sqrt(a * a + b * b + c * c), p * u + q * v + r * w)
        if angle > SPARE * STEP * min(max(pole / NEAR_DEG, CLOSEST), 1.0):
            return False
    found, new_outer, new_inner, new_pole = nearest_stand(tool, near_outer, near_inner, u, v, w)
    cone = tool[StandRecord.CONE]
    if not found or (angle > TOLERANCE and (pole < cone) != (new_pole < cone)):
        return False
    end[outer] = new_outer - tool[StandRecord.ADDED]
    end[inner] = new_inner - tool[StandRecord.ADDED + 1]
    return True


def nearest_stand(
    tool: Floats, near_outer: float, near_inner: float, u: float, v: float, w: float
) -> tuple[bool, float, float, float]:
    """Whether there is a solution within reach for a unit vector; the nearest one, and how far it is from a pole."""
    at, to, e = StandRecord.OUTER_DIRECTION, StandRecord.INNER_DIRECTION, StandRecord.ALONG
    a, b, c = tool[at], tool[at + 1], tool[at + 2]
    d, g, h = tool[to], tool[to + 1], tool[to + 2]
    x, y, z = tool[e], tool[e + 1], tool[e + 2]
    along = d * x + g * y + h * z
    first = a * (x - d * along) + b * (y - g * along) + c * (z - h * along)
    second = a * (g * z - h * y) + b * (h * x - d * z) + c * (d * y - g * x)
    size, rest = (
        sqrt(first * first + second * second),
        a * u + b * v + c * w - (a * d + b * g + c * h) * along,
    )
    if size < PARALLEL or abs(rest) > size * (1.0 + PARALLEL):
        return False, 0.0, 0.0, 0.0
    ratio = min(max(rest / size, -1.0), 1.0)
    middle, half = atan2(second, first), atan2(sqrt(1.0 - ratio * ratio), ratio)
    found, best, best_outer, best_inner, best_pole = False, 0.0, 0.0, 0.0, 0.0
    for side in range(2):
        turned = middle + half if side == 0 else middle - half
        x, y, z = drawn(tool, turned)
        is_there, about = about_outer(tool, x, y, z, u, v, w)
        if not is_there:
            return False, 0.0, 0.0, 0.0
        outer = on_turn(tool[StandRecord.SENSE] * about * DEGREE, near_outer)
        inner = on_turn(tool[StandRecord.SENSE + 1] * turned * DEGREE, near_inner)
        way = abs(outer - near_outer) + abs(inner - near_inner)
        if stands_so(tool, outer, inner, u, v, w) and (not found or way < best):
            found, best, best_outer, best_inner, best_pole = True, way, outer, inner, pole_of(tool, x, y, z)
    return found, best_outer, best_inner, best_pole


def about_outer(
    tool: Floats, x: float, y: float, z: float, u: float, v: float, w: float
) -> tuple[bool, float]:
    """The angle about the outer axis from one direction to another, radians; none where one lies along it."""
    at = StandRecord.OUTER_DIRECTION
    a, b, c = tool[at], tool[at + 1], tool[at + 2]
    along = a * x + b * y + c * z
    x, y, z = x - a * along, y - b * along, z - c * along
    along = a * u + b * v + c * w
    u, v, w = u - a * along, v - b * along, w - c * along
    if min(x * x + y * y + z * z, u * u + v * v + w * w) < PARALLEL * PARALLEL:
        return False, 0.0
    sine = a * (y * w - z * v) + b * (z * u - x * w) + c * (x * v - y * u)
    return True, atan2(sine, x * u + y * v + z * w)


def stands_so(tool: Floats, outer: float, inner: float, u: float, v: float, w: float) -> bool:
    """Whether the axes reach two angles, and the tool then stands along a direction."""
    for k in range(2):
        angle = outer if k == 0 else inner
        if not tool[StandRecord.LOW + k] - AT_LIMIT <= angle <= tool[StandRecord.HIGH + k] + AT_LIMIT:
            return False
    x, y, z = drawn(tool, tool[StandRecord.SENSE + 1] * inner * RADIAN)
    x, y, z = spun(tool, StandRecord.OUTER_DIRECTION, tool[StandRecord.SENSE] * outer * RADIAN, x, y, z)
    return abs(x - u) < SAME and abs(y - v) < SAME and abs(z - w) < SAME
