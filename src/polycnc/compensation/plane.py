"""The working plane of a stage: which columns of a position it changes, and how its arcs turn."""

from __future__ import annotations

from math import hypot

from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath.kinds import CCW_KINDS, Kind, arc_kind

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Move
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector


@dataclass(frozen=True, slots=True)
class Plane:
    """A working plane: geometry axes `u` and `v` span it, `w` stands on it (u, v, w right-handed).

    Attributes:
        u: Geometry axis 0, 1 or 2 (X, Y, Z) that comes first: X in G17, Z in G18, Y in G19.
        v: The second one: Y in G17, X in G18, Z in G19.
        w: The third one.
        columns: For each geometry axis its column in a position, or -1 where the channel has none. A parallel
            axis that is compensated in place of X, Y or Z is named here.
    """

    u: int = 0
    v: int = 1
    w: int = 2
    columns: tuple[int, int, int] = (0, 1, 2)

    def point(self, position: list[float]) -> Point:
        """The plane point of a position."""
        return position[self.columns[self.u]], position[self.columns[self.v]]

    def compensates(self, column: int) -> bool:
        """Whether an axis, by its column in a position, is one of the plane's two."""
        return column in (self.columns[self.u], self.columns[self.v])

    def at(self, position: list[float], point: Point) -> list[float]:
        """A position with its plane point replaced."""
        moved = list(position)
        moved[self.columns[self.u]], moved[self.columns[self.v]] = point
        return moved

    def center(self, move: Move) -> Point | None:
        """The plane point of an arc's centre; None for a straight move."""
        return None if move.center is None else (move.center[self.u], move.center[self.v])

    def vector(self, u: float, v: float, w: float) -> Vector:
        """A vector of the three geometry axes from its components in the plane's order."""
        components = [0.0, 0.0, 0.0]
        components[self.u], components[self.v], components[self.w] = u, v, w
        return components[0], components[1], components[2]

    def moved_center(self, move: Move, by: Point) -> Vector | None:
        """The centre of an arc, moved in the plane; None for a straight move."""
        if move.center is None:
            return None
        center = move.center
        return self.vector(center[self.u] + by[0], center[self.v] + by[1], center[self.w])

    def moved(self, move: Move, by: Point) -> Move:
        """A move elsewhere in the plane."""
        start, end = (self.at(place, arcs.plus(self.point(place), by)) for place in (move.start, move.end))
        return replace(move, start=start, end=end, center=self.moved_center(move, by))

    @property
    def normal(self) -> Vector:
        """Unit vector of the third axis."""
        return self.vector(0.0, 0.0, 1.0)

    def lift(self, point: Point, position: list[float]) -> Vector:
        """A point of the plane in space, at the height of a position."""
        column = self.columns[self.w]
        return self.vector(*point, position[column] if column >= 0 else 0.0)

    def is_ccw(self, move: Move) -> bool:
        """Whether an arc turns from u to v."""
        return (move.kind in CCW_KINDS) == (move.normal[self.w] > 0.0)

    def moves(self, move: Move) -> bool:
        """Whether a move has a way in the plane: a full circle has, an arc of another plane has not."""
        if move.center is not None:
            return abs(move.normal[self.w]) > 1.0 - 1e-9
        (u0, v0), (u1, v1) = self.point(move.start), self.point(move.end)
        return hypot(u1 - u0, v1 - v0) > NO_WAY

    def moves_elsewhere(self, move: Move) -> bool:
        """Whether a move has a way along other axes than the plane's."""
        return self.at(move.start, (0.0, 0.0)) != self.at(move.end, (0.0, 0.0))

    def edge(self, move: Move) -> offset.Edge | None:
        """The plane edge of a move; None for an arc without a radius."""
        start, end, center = self.point(move.start), self.point(move.end), self.center(move)
        if center is None:
            return offset.line(start, end)
        if min(arcs.radius_of(center, start), arcs.radius_of(center, end)) <= NO_WAY:
            return None
        return offset.arc(start, end, center, self.is_ccw(move))

    def arc_kind(self, ccw: bool, start: list[float], end: list[float]) -> Kind:
        """The row kind of an arc from u to v (or back) between two positions, with this plane's normal."""
        column = self.columns[self.w]
        return arc_kind(ccw=ccw, helix=column >= 0 and abs(start[column] - end[column]) > NO_WAY)
