"""What cycles in a plane yield: strokes of the tool, one after the other."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point


@dataclass(frozen=True, slots=True)
class PlaneStroke:
    """One motion of a cycle to a point of its plane.

    Points are (first axis, second axis) of the plane, mm; on a lathe's ZX plane (Z, X as radius).

    Attributes:
        kind: RAPID, FEED, CW, CCW (seen so that the first axis turns into the second counter-clockwise) or THREAD.
        end: Where it ends.
        center: Centre of an arc.
        start_angle_deg: Spindle angle at which a thread begins.
    """

    kind: Kind
    end: Point
    center: Point | None = None
    start_angle_deg: float = 0.0


def rapid(first: float, second: float) -> PlaneStroke:
    """A rapid move."""
    return PlaneStroke(Kind.RAPID, (first, second))


def feed(first: float, second: float) -> PlaneStroke:
    """A straight cut."""
    return PlaneStroke(Kind.FEED, (first, second))
