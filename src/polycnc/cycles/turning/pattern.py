"""Pattern repeating G73: the whole shape, pass by pass nearer (0i-TF Plus II.4.2.3, 6.4.3)."""

from __future__ import annotations

from polycnc.cycles.turning.contour import shifted
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point


def repeat_pattern(contour: Contour, escape: Point, passes: int, allowance: Point) -> Iterator[PlaneStroke]:
    """Passes from `escape` + `allowance` off the shape to `allowance`, evenly spaced, and back to the start.

    Args:
        contour: From the start point over the shape.
        escape: Distance of the first pass beyond the allowance, along both axes, mm of radius, signed.
        passes: Number of passes.
        allowance: What the last pass leaves, signed.
    """
    start = contour[0].edge.start
    for number in range(passes):
        part = (passes - 1 - number) / (passes - 1) if passes > 1 else 0.0
        moved = shifted(contour, escape[0] * part + allowance[0], escape[1] * part + allowance[1])
        yield PlaneStroke(Kind.RAPID, moved[0].edge.start)
        yield from (piece.stroke() for piece in moved)
    yield PlaneStroke(Kind.RAPID, start)
