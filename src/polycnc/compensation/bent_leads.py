"""Approach and retraction on a polynomial that meets the contour's parallel without a corner (SINUMERIK KONTT, KONTC).

The curve begins where the tool comes into contact and is read from there outwards: with `s` from 0 at the contour to 1
at the free point, `p(s) = c + L·t·s + L²/2·k·s² + r·sⁿ`. `t` is the tangent of the parallel, `k` its curvature vector
(KONTC; KONTT leaves the term out, and n is 2 for 3), `L` the distance of the two ends, and `r` what is left to the
free point, where nothing is asked of the direction.
"""

from __future__ import annotations

from math import ceil, hypot, sqrt
from typing import TYPE_CHECKING

from polycnc.compensation.step import Contact
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.compensation.plane import Plane
    from polycnc.compensation.step import Step
    from polycnc.geometry.frames import Vector

#: Chords keep within this of the curve.
CHORD_TOLERANCE_MM = 0.001


def contact(step: Step, plane: Plane, *, at_start: bool, curved: bool) -> Contact:
    """The contact at an end of a contour step: at its start for an approach, at its end for a retraction.

    Args:
        step: The block of the contour, with a way in the plane.
        plane: The plane of compensation.
        at_start: The approach leads to its start.
        curved: The curvature counts as well.
    """
    edge = step.edge
    u, v = edge.departing if at_start else edge.arriving
    column, scale = plane.columns[plane.w], _scale(step)
    climb = step.move.end[column] - step.move.start[column] if column >= 0 else 0.0
    rise = climb / (edge.length * scale) if scale > 0.0 else 0.0
    level = 1.0 / hypot(1.0, rise)
    sense = -level if at_start else level
    outwards = (sense * u, sense * v, sense * rise)
    if not curved or edge.center is None or scale <= 0.0:
        return Contact(outwards, (0.0, 0.0, 0.0) if curved else None)
    du, dv = arcs.minus(edge.center, edge.start if at_start else edge.end)
    strength = level * level / ((du * du + dv * dv) * scale)
    return Contact(outwards, (du * strength, dv * strength, 0.0))


def _scale(step: Step) -> float:
    """Radius of the tool's arc by that of the contour's; 1 for a line, 0 for an arc that becomes a point."""
    edge = step.edge
    if edge.center is None or step.suspended:
        return 1.0
    radius = arcs.radius_of(edge.center, edge.start)
    led = offset.offset_radius(radius, step.distance, edge.ccw)
    return led / radius if led > NO_WAY else 0.0


def course(free: Vector, touching: Vector, at: Contact) -> list[tuple[float, Vector]]:
    """Points from the contour to the free point with their shares `s`, without the contour's own.

    Args:
        free: Where nothing is asked of the curve, in the plane's order, mm.
        touching: Where it meets the path beside the contour, mm.
        at: How it meets that.
    """
    way = [b - a for a, b in zip(touching, free, strict=True)]
    size = hypot(*way)
    first = [size * each for each in at.outwards]
    second = [0.5 * size * size * each for each in at.curvature or (0.0, 0.0, 0.0)]
    rest = [a - b - c for a, b, c in zip(way, first, second, strict=True)]
    highest = 2 if at.curvature is None else 3
    # The second derivative is linear, so it is greatest at an end.
    greatest = max(
        hypot(*(2.0 * b + (2.0 if highest == 2 else 6.0 * s) * c for b, c in zip(second, rest, strict=True)))
        for s in (0.0, 1.0)
    )
    count = max(ceil(sqrt(greatest / (8.0 * CHORD_TOLERANCE_MM))), 1)

    def place(s: float) -> Vector:
        x, y, z = (
            a + b * s + c * s * s + d * s**highest
            for a, b, c, d in zip(touching, first, second, rest, strict=True)
        )
        return x, y, z

    return [(k / count, place(k / count)) for k in range(1, count)] + [(1.0, free)]
