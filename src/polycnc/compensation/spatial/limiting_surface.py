"""How far along itself a mill goes that is not the standard one, so that it touches a floor beside a wall as that did.

A mill is a cylinder or a torus, whose tip stands at P with the tool along v. Against the normal n of the floor it
reaches `(R - r)·s + r·(1 - n·v)` beyond P, where s is the sine of the angle between n and v. The tip of the standard
mill tells where the floor is. Another one, moved by `a` off the wall along its normal m, touches it when it goes `(its
reach - the standard's - a·n·m) / (n·v)` along v: with a cylinder nothing where wall and floor leave an obtuse angle.
"""

from __future__ import annotations

from math import sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot, minus, times

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector

#: Cosine below which a floor is as good as parallel to the tool, and limits nothing.
STEEP = 1e-6


class Mill(NamedTuple):
    """Radius of a mill and of its corner, mm; without a corner it is a cylinder."""

    radius: float
    corner: float = 0.0

    def reach(self, floor: Vector, tool: Vector) -> float:
        """How far the mill reaches beyond its tip towards a floor, mm."""
        along = min(max(dot(floor, tool), -1.0), 1.0)
        return (self.radius - self.corner) * sqrt(1.0 - along * along) + self.corner * (1.0 - along)


def infeed(standard: Mill, actual: Mill, moved: float, wall: Vector, tool: Vector, floor: Vector) -> float:
    """The way along the tool, mm; negative towards the floor.

    Args:
        standard: The mill for which the program was made.
        actual: The one that cuts.
        moved: How far its axis stands farther from the wall, mm.
        wall: Direction away from the wall, square on tool and path.
        tool: Direction from the tip along the tool.
        floor: Normal of the floor, square on the path.
    """
    along = dot(floor, tool)
    if along < STEEP:
        return 0.0
    return (actual.reach(floor, tool) - standard.reach(floor, tool) - moved * dot(floor, wall)) / along


def across(floor: Vector, tangent: Vector) -> Vector | None:
    """The normal of a floor without its part along the path, of length 1; None for a floor across the path."""
    flat = minus(floor, times(tangent, dot(floor, tangent)))
    size = sqrt(dot(flat, flat))
    return times(flat, 1.0 / size) if size > STEEP else None
