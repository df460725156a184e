"""An edge that cuts between two angles: a contour that it could not cut alone is refused.

Contour tools have several such edges, of which the next one would cut where the contour leaves the angles of one
(SINUMERIK, job planning 7.1). While the contour touches one edge only, its radius is all that compensation needs.
"""

from __future__ import annotations

from math import atan2, degrees, tau
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from polycnc.channel.moves.path import Rank, Stage

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Move
    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.geometry import offset
    from polycnc.geometry.arcs import Point

#: An edge cuts as far beside its limits, degrees.
BESIDE_DEG = 1e-4
TURN_DEG = 360.0


class Range(NamedTuple):
    """Between which angles an edge cuts.

    Attributes:
        reference: Direction in the plane from which angles count, clockwise as seen against its third axis.
        least: Least angle; `largest` the largest one, degrees.
    """

    reference: Point
    least: float
    largest: float

    def holds(self, touch: Point, turn_deg: float) -> bool:
        """Whether the edge cuts where it touches, and while that place turns by an angle, counter-clockwise."""
        (a, b), (x, y) = self.reference, touch
        clockwise = degrees(atan2(b * x - a * y, a * x + b * y))
        width = (self.largest - self.least) % TURN_DEG or TURN_DEG
        first = (clockwise - self.least + BESIDE_DEG) % TURN_DEG - BESIDE_DEG
        last = first - turn_deg
        return max(first, last) <= width + BESIDE_DEG and min(first, last) >= -BESIDE_DEG


class EdgeLimits(Stage):
    """Looks at the moves of a compensated contour and at its outer corners.

    Args:
        cutter: The stage of compensation, behind this one.
        side: 1 where the tool is left of the contour, -1 right.
        angles: Where the edge cuts.
        refuse: Raises an alarm.
    """

    rank: ClassVar[Rank] = Rank.EDGE_LIMITS

    def __init__(
        self, cutter: CutterCompensation, side: int, angles: Range, refuse: Callable[[], None]
    ) -> None:
        self._cutter, self._side, self._angles, self._refuse = cutter, side, angles, refuse
        self._arriving: Point | None = None

    @property
    def active(self) -> bool:
        """Whether compensation acts."""
        return self._cutter.active

    def move(self, move: Move) -> None:
        """Look at a move of the contour, and at the corner in front of it."""
        plane = self._cutter.plane
        edge = plane.edge(move) if self._cutter.on_contour and plane.moves(move) else None
        if edge is not None:
            if self._arriving is not None:
                self._look(self._arriving, self._outer_turn(self._arriving, edge.departing))
            self._look(edge.departing, self._turn(edge, move.turns))
            self._arriving = edge.arriving
        self.after.move(move)

    def _look(self, direction: Point, turn_deg: float) -> None:
        u, v = direction
        if not self._angles.holds((self._side * v, -self._side * u), turn_deg):
            self._refuse()

    def _turn(self, edge: offset.Edge, turns: float) -> float:
        angle = degrees(edge.sweep + tau * turns) if edge.center is not None else 0.0
        return angle if edge.ccw else -angle

    def _outer_turn(self, before: Point, after: Point) -> float:
        """How far the contour turns at a corner that the tool goes round, degrees; nothing at an inner one."""
        (a, b), (c, d) = before, after
        turn = degrees(atan2(a * d - b * c, a * c + b * d))
        return turn if turn * self._side < 0.0 else 0.0
