"""What turning leaves of a stock: its heights, lowered along every cut.

Seen upside down, what a nose takes away along a way is what a circle covers that is moved along it: heights of the
stock are the envelope of both, exact with their arcs.
"""

from __future__ import annotations

from polycnc.cycles.plunging.profile import Profile, cropped, dilated, envelope, moved, swept, upright
from polycnc.cycles.turning.contour import Piece, slopes
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: The way of a tool without width over a place has this length, mm: a place alone is none.
_SHORT_MM = 1e-5
_HAIR = 1e-7


@dataclass(frozen=True, slots=True)
class Edges:
    """The edges of a turning tool: the radius of its noses, how wide it is, and the first nose as seen from its point.

    Attributes:
        radius: Of the noses, mm.
        width: From edge to edge, towards larger `a`; 0 for one nose.
        center: From the tool's point to the middle of its first nose, (a, h).
    """

    radius: float
    width: float
    center: Point


def left_by(stock: Profile, cuts: Iterable[Edge], tool: Edges) -> Profile:
    """Heights of the stock behind cuts of the tool's point, in (a, h)."""
    below = _turned_over(stock)
    for cut in cuts:
        taken = cropped(_taken(cut, tool), below.begin, below.end)
        if taken.curves:
            below = Profile(envelope([*below.curves, *taken.curves]))
    return _turned_over(below)


def _turned_over(profile: Profile) -> Profile:
    pieces = upright([Piece(curve) for curve in profile.curves], 1.0)
    return Profile(tuple(piece.edge for piece in pieces))


def _taken(cut: Edge, tool: Edges) -> Profile:
    """What a cut takes away, upside down."""
    pieces = upright(slopes([Piece(cut.moved(tool.center))]), 1.0)
    curves = tuple(p.edge for p in pieces if p.edge.end[0] - p.edge.start[0] > _HAIR)
    if not curves:
        # Straight down or up: the deepest place says it all.
        a, h = max(
            (point for p in pieces for point in (p.edge.start, p.edge.end)), key=lambda point: point[1]
        )
        curves = (offset.line((a - _SHORT_MM, h), (a + _SHORT_MM, h)),)
    flat = max(tool.width - 2.0 * tool.radius, 0.0)
    reached = dilated(Profile(curves), tool.radius)
    return moved(swept(reached, flat), flat, 0.0) if flat > NO_WAY else reached
