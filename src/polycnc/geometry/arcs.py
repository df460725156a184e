"""Circular arcs: the plane arc of every control, and the circle through three points in space.

Points of the plane are `(u, v)` pairs in millimetres, angles are radians counted from +u towards +v, `ccw`
says whether the arc turns that way. An arc whose start and end coincide is a full circle. All functions work
on plain floats.
"""

from __future__ import annotations

from functools import lru_cache
from math import acos, atan2, ceil, cos, hypot, pi, sin, sqrt

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import vectors
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.geometry.frames import Frame, Vector

Point = tuple[float, float]
TAU = 2.0 * pi
#: Parts of a length by which a frame may miss an even scale: rounding.
EVEN = 1e-9


def plus(a: Point, b: Point) -> Point:
    """Sum of two points or vectors."""
    return (a[0] + b[0], a[1] + b[1])


def minus(a: Point, b: Point) -> Point:
    """Difference of two points or vectors."""
    return (a[0] - b[0], a[1] - b[1])


def center_from_radius(start: Point, end: Point, radius: float, ccw: bool, tolerance: float = 1e-6) -> Point:
    """Centre of the arc of a given radius through two points.

    The centre lies on the chord's perpendicular bisector, `h = sqrt(r² - (chord/2)²)` from its middle: to the
    left of the chord for a counter-clockwise arc of up to 180 degrees, to the right for the long way round,
    and the other way about for a clockwise arc.

    Args:
        start: Start point, mm.
        end: End point, mm.
        radius: Positive for an arc of up to 180 degrees, negative for a longer one.
        ccw: Sense of rotation.
        tolerance: A chord longer than the diameter by up to this much (mm) is taken for the diameter.

    Raises:
        ValueError: The radius is zero, start and end coincide (a radius cannot tell where a full circle's
            centre lies), or no circle of this radius reaches both points.
    """
    du, dv = end[0] - start[0], end[1] - start[1]
    chord = sqrt(du * du + dv * dv)  # not hypot: compiled code must find the same bits
    if radius == 0.0 or chord <= NO_WAY:
        raise ValueError("no circle")
    if chord > 2.0 * abs(radius) + tolerance:
        raise ValueError("chord longer than the diameter")
    height = sqrt(max(radius * radius - 0.25 * chord * chord, 0.0))
    if (radius > 0.0) != ccw:
        height = -height
    return (0.5 * (start[0] + end[0]) - height * dv / chord, 0.5 * (start[1] + end[1]) + height * du / chord)


def angle_at(center: Point, point: Point) -> float:
    """Direction from the centre to a point, radians in (-pi, pi]."""
    return atan2(point[1] - center[1], point[0] - center[0])


def point_at(center: Point, radius: float, angle: float) -> Point:
    """The point of a circle in a direction (radians)."""
    return (center[0] + radius * cos(angle), center[1] + radius * sin(angle))


def sweep_angle(start: Point, end: Point, center: Point, ccw: bool) -> float:
    """Angle of an arc, radians: positive counter-clockwise, negative clockwise; start = end is a full circle.

    The angle from `a = start - center` to `b = end - center` is `atan2(a x b, a · b)`: no difference of two
    angles, so that short arcs of large circles keep their digits.
    """
    if hypot(end[0] - start[0], end[1] - start[1]) <= NO_WAY:
        return TAU if ccw else -TAU
    au, av = start[0] - center[0], start[1] - center[1]
    bu, bv = end[0] - center[0], end[1] - center[1]
    angle = atan2(au * bv - av * bu, au * bu + av * bv)
    if ccw:
        return angle if angle > 0.0 else angle + TAU
    return angle if angle < 0.0 else angle - TAU


def radius_of(center: Point, point: Point) -> float:
    """Distance of a point from the centre, mm."""
    return hypot(point[0] - center[0], point[1] - center[1])


def radius_mismatch(start: Point, end: Point, center: Point) -> float:
    """End radius less start radius, mm: what a control compares with its arc tolerance."""
    return radius_of(center, end) - radius_of(center, start)


def stop_on_circle(start: Point, end: Point, center: Point, ccw: bool) -> Point:
    """Where an arc leaves its circle for an end point beside it.

    It runs until one coordinate of the end point is reached in the quadrant of the end point; where the circle reaches
    neither, until it is on the ray from the centre to the end point.
    """
    radius = radius_of(center, start)
    to_end = (end[0] - center[0], end[1] - center[1])
    found: list[Point] = []
    for i in (0, 1):
        other = radius * radius - to_end[i] * to_end[i]
        if other >= 0.0:
            height = sqrt(other) if to_end[1 - i] >= 0.0 else -sqrt(other)
            at = (to_end[i], height) if i == 0 else (height, to_end[i])
            found.append((center[0] + at[0], center[1] + at[1]))
    if not found:
        scale = radius / (hypot(*to_end) or 1.0)
        return (center[0] + to_end[0] * scale, center[1] + to_end[1] * scale)
    return min(found, key=lambda point: abs(sweep_angle(start, point, center, ccw)))


def arc_length(
    start: Point, end: Point, center: Point, ccw: bool, turns: float = 0.0, rise: float = 0.0
) -> float:
    """Length of an arc, helix or spiral, mm.

    Args:
        start: Start point, mm.
        end: End point, mm.
        center: Centre, mm.
        ccw: Sense of rotation.
        turns: Full turns beyond the first part.
        rise: Way across the plane, mm.

    A radius that grows from start to end counts with its mean: exact for arcs, and for spirals to second
    order in the growth per turn.
    """
    angle = abs(sweep_angle(start, end, center, ccw)) + TAU * turns
    mean = 0.5 * (radius_of(center, start) + radius_of(center, end))
    growth = radius_mismatch(start, end, center)
    return hypot(mean * angle, growth, rise)


def point_on_arc(
    start: Point, end: Point, center: Point, ccw: bool, fraction: float, turns: float = 0.0
) -> Point:
    """The point after a fraction (0 to 1) of the angle; a radius that differs changes in proportion."""
    angle = sweep_angle(start, end, center, ccw) + (TAU if ccw else -TAU) * turns
    radius = radius_of(center, start) + fraction * radius_mismatch(start, end, center)
    return point_at(center, radius, angle_at(center, start) + fraction * angle)


def tangent_at(center: Point, point: Point, ccw: bool) -> Point:
    """Unit direction of travel at a point of an arc: the radius turned by 90 degrees in its sense."""
    u, v = point[0] - center[0], point[1] - center[1]
    radius = hypot(u, v)
    return (-v / radius, u / radius) if ccw else (v / radius, -u / radius)


def contains_direction(
    start: Point, end: Point, center: Point, ccw: bool, point: Point, slack: float = 1e-12
) -> bool:
    """Whether the ray from the centre through `point` meets the arc; `slack` (radians) widens both ends."""
    total = abs(sweep_angle(start, end, center, ccw))
    if hypot(point[0] - start[0], point[1] - start[1]) <= NO_WAY:
        return True
    part = abs(sweep_angle(start, point, center, ccw))
    return part <= total + slack or part >= TAU - slack


def split(start: Point, end: Point, center: Point, ccw: bool, parts: int) -> list[Point]:
    """End points of `parts` pieces of equal angle; the last one is `end` itself."""
    points = [point_on_arc(start, end, center, ccw, k / parts) for k in range(1, parts)]
    return [*points, end]


def parts_for_chord_error(radius: float, sweep: float, error: float) -> int:
    """How many equal pieces keep the chord within `error` (mm) of the arc.

    The sagitta of a piece of angle `a` is `r·(1 - cos(a/2))`; no piece is longer than half a turn.
    """
    piece = 2.0 * acos(max(1.0 - error / radius, 0.0))
    return max(1, ceil(abs(sweep) / piece - 1e-9))


def three_point_circle(a: Vector, b: Vector, c: Vector) -> tuple[Vector, Vector]:
    """Centre and unit normal of the circle through three points in space.

    The arc from `a` over `b` to `c` is counter-clockwise seen from the normal's tip. With `p = b - a`,
    `q = c - a` and `n = p x q` the point of the plane that is equally far from all three is
    `a + (|p|²·(q x n) + |q|²·(n x p)) / (2·|n|²)`.

    Raises:
        ValueError: The points lie on one straight line, or two of them coincide.
    """
    p, q = vectors.minus(b, a), vectors.minus(c, a)
    n = vectors.cross(p, q)
    nn, pp, qq = vectors.dot(n, n), vectors.dot(p, p), vectors.dot(q, q)
    # |n| = |p||q| sin: below a sine of 1e-9 the centre has no digit left.
    if nn <= 1e-18 * pp * qq or min(pp, qq) <= NO_WAY**2:
        raise ValueError("points on a line")
    qn, np = vectors.cross(q, n), vectors.cross(n, p)
    center = tuple(a[i] + (pp * qn[i] + qq * np[i]) / (2.0 * nn) for i in range(3))
    length = sqrt(nn)
    return (center[0], center[1], center[2]), (n[0] / length, n[1] / length, n[2] / length)


def circle_image(frame: Frame, normal: Vector) -> Vector | None:
    """Unit normal of the image of a circle with a unit normal; None where the image is an ellipse."""
    axis = (max(range(3), key=lambda i: abs(normal[i])) + 1) % 3
    along = vectors.minus(vectors.axis_vector(axis), vectors.times(normal, normal[axis]))
    p = vectors.times(along, 1.0 / hypot(*along))
    a, b = frame.direct(*p), frame.direct(*vectors.cross(normal, p))
    size = hypot(*a)
    if abs(hypot(*b) - size) > EVEN * size or abs(vectors.dot(a, b)) > EVEN * size * size:
        return None
    across = vectors.cross(a, b)
    return vectors.times(across, 1.0 / hypot(*across))


@lru_cache(maxsize=64)
def is_even(frame: Frame) -> bool:
    """Whether the frame leaves every circle and sphere one: it turns, mirrors, shifts and scales alike all round."""
    return frame.is_identity or all(
        circle_image(frame, normal) is not None
        for normal in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    )
