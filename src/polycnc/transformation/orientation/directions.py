"""Ways of a direction: how the tool turns along a move, seen from the work (ORIVECT, ORICONCW, ORICURVE, LEAD, TILT).

A way gives the direction after a share of the move, 0 at its start and 1 at its end. Directions are unit vectors from
the tip along the tool. Angles of polynomials are degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, hypot, radians, sin, sqrt, tau

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import cross, dot, minus, times
from polycnc.machine.kinematics import turn_about
from polycnc.transformation.numbers import DEGREE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector

#: From a share of the move to the direction of the tool.
Way = Callable[[float], "Vector"]
#: Sines of angles below this are none.
NONE = 1e-9
#: Further coefficients of a polynomial: of u², u³ …
Higher = tuple[float, ...]


def unit_of(vector: Sequence[float]) -> Vector | None:
    """The vector of length 1 in a direction; None for no length."""
    size = hypot(*vector)
    return times(vector, 1.0 / size) if size > NONE else None


def angle_between(a: Vector, b: Vector) -> float:
    """Angle between two directions, radians."""
    return atan2(hypot(*cross(a, b)), dot(a, b))


def polynomial(start: float, end: float, higher: Higher) -> Callable[[float], float]:
    """`p(u) = start + a1·u + a2·u² + …`: a1 is what leads to the end."""
    first = end - start - sum(higher)

    def value(u: float) -> float:
        total = 0.0
        for factor in reversed((first, *higher)):
            total = (total + factor) * u
        return start + total

    return value


def great_circle(start: Vector, end: Vector, within: Higher = (), aside: Higher = ()) -> Way | None:
    """In the plane of start and end; None where they are opposite and so have no plane.

    Args:
        start: Direction at the start.
        end: Direction at the end.
        within: Coefficients of the angle in the plane (PO[PHI]).
        aside: Those of the angle out of it (PO[PSI]); it is zero at both ends.
    """
    angle = angle_between(start, end)
    normal = unit_of(cross(start, end))
    if normal is None:
        if dot(start, end) < 0.0:
            return None
        return lambda _u: end
    beside = cross(normal, start)
    turned, tilted = polynomial(0.0, angle * DEGREE, within), polynomial(0.0, 0.0, aside)

    def direction(u: float) -> Vector:
        phi, psi = radians(turned(u)), radians(tilted(u))
        c, s, out = cos(psi) * cos(phi), cos(psi) * sin(phi), sin(psi)
        x, y, z = (c * a + s * b + out * n for a, b, n in zip(start, beside, normal, strict=True))
        return (x, y, z)

    return direction


def about(axis: Vector, start: Vector, end: Vector, sense: int, *, whole: bool = False) -> float:
    """Angle about an axis from one direction to another, radians: positive for sense 1, negative for -1.

    `whole`: directions that are the same are a whole turn apart.
    """
    a, b = _across(axis, start), _across(axis, end)
    angle = atan2(dot(axis, cross(a, b)), dot(a, b))
    if sense * angle < -NONE or (whole and abs(angle) <= NONE):
        angle += sense * tau
    return angle


def cone(
    axis: Vector, start: Vector, end: Vector, angle: float, turning: Higher = (), opening: Higher = ()
) -> Way:
    """About an axis by an angle (radians); where start and end lie on different cones, evenly from one to the other.

    Args:
        axis: Of the cone.
        start: Direction at the start.
        end: Direction at the end.
        angle: From the start to the end about the axis, with its sign.
        turning: Coefficients of the angle about the axis (PO[PHI]).
        opening: Those of the angle to it (PO[PSI]).
    """
    first, last = angle_between(axis, start), angle_between(axis, end)
    out = unit_of(_across(axis, start)) or unit_of(_across(axis, end)) or (0.0, 0.0, 0.0)
    turned = polynomial(0.0, angle * DEGREE, turning)
    opened = polynomial(first * DEGREE, last * DEGREE, opening)

    def direction(u: float) -> Vector:
        away, psi = turn_about(axis, turned(u)).direct(*out), radians(opened(u))
        x, y, z = (cos(psi) * a + sin(psi) * b for a, b in zip(axis, away, strict=True))
        return (x, y, z)

    return direction


def axis_of_opening(start: Vector, end: Vector, opening: float, side: int) -> Vector | None:
    """Axis of the cone with an opening angle (radians) on which two directions lie; None where there is none.

    Of the two the one on the side (1) of `start × end`, or on the other one (-1).
    """
    half = angle_between(start, end) / 2.0
    middle = unit_of([a + b for a, b in zip(start, end, strict=True)])
    normal = unit_of(cross(start, end))
    if middle is None or normal is None:
        return None
    along = cos(opening / 2.0) / cos(half)
    if abs(along) > 1.0 + NONE:
        return None
    beside = side * sqrt(max(0.0, 1.0 - along * along))
    return unit_of([along * m + beside * n for m, n in zip(middle, normal, strict=True)])


def axis_through(start: Vector, middle: Vector, end: Vector) -> Vector | None:
    """Axis about which a positive turn leads from start over middle to end; None where two of them are the same."""
    return unit_of(cross(minus(middle, start), minus(end, middle)))


def axis_of_tangent(start: Vector, tangent: Vector, end: Vector) -> Vector | None:
    """Axis about which a positive turn begins along a tangent and leads to an end; None where there is none."""
    axis = unit_of(cross(tangent, minus(end, start)))
    if axis is None:
        return None
    return axis if dot(cross(axis, start), tangent) > 0.0 else times(axis, -1.0)


def between_curves(tip: Way, second: Way) -> Way:
    """From one curve to another: the line through both points (ORICURVE)."""

    def direction(u: float) -> Vector:
        return unit_of(minus(second(u), tip(u))) or (0.0, 0.0, 1.0)

    return direction


def leaned(
    tangent: Vector, normal: Vector, lead: float, tilt: float, *, about_normal: bool = False
) -> Vector:
    """The surface normal, leaned towards the path by `lead`, then turned by `tilt` about path or normal; degrees."""
    aside = unit_of(cross(normal, tangent)) or (0.0, 0.0, 0.0)
    forward = turn_about(aside, lead).direct(*normal) if any(aside) else normal
    return turn_about(normal if about_normal else tangent, tilt).direct(*forward)


def tangent_at_end(way: Way) -> Vector | None:
    """How the direction changes at the end of a way; None where it does not."""
    step = 1e-4
    return unit_of(times(minus(way(1.0), way(1.0 - step)), 1.0 / step))


def _across(axis: Vector, direction: Vector) -> Vector:
    return minus(direction, times(axis, dot(axis, direction)))
