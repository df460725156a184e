"""A plane move that waits in the window until the moves behind it tell where it ends."""

from __future__ import annotations

from enum import Enum
from itertools import pairwise
from math import hypot

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.offset import Joint
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from polycnc.channel.moves.path import Item, Move
    from polycnc.compensation.policy import Policy
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector
    from polycnc.geometry.offset import Corner, Edge

NO_VECTOR: Point = (0.0, 0.0)


class Role(Enum):
    """What a plane move is."""

    PLAIN = "not compensated"
    START = "start-up"
    CONTOUR = "contour"
    CANCEL = "cancel"
    GAP = "straight way past blocks that were left out"


#: Radii of one circle differ by no more than rounding, mm.
_SAME_RADIUS_MM = 1e-6


class Contact(NamedTuple):
    """How the path of the tool goes on at the end of the contour, seen from the free point's side.

    Attributes:
        outwards: Unit tangent in the plane's order (u, v, w), away from the contour.
        curvature: Second derivative of the path by its length there, 1/mm; None where only the tangent counts.
    """

    outwards: Vector
    curvature: Vector | None


@dataclass(slots=True)
class Step:
    """A plane move in the window.

    Attributes:
        move: As programmed.
        contour: The line or arc that it cuts.
        edge: What the tool is led along: the same, or the chord of an arc that it does not fit into (5.4.6.3).
        role: Start-up, contour or cancel.
        distance: Signed offset of the contour, left positive.
        shift: Added to every vector (nose centre to tip).
        policy: The control's behaviour when the block was read.
        read: Number of the block.
        first: Vector at its start.
        side: The side that was commanded, 1 left.
        corner: Vectors at its end, once known.
        forced: Direction on which the vector at its end stands square (I, J, K in the block).
        holds: It keeps the vector of its start (G38).
        suspended: It belongs to a stretch that keeps one vector (CUTCONON); arcs are moved by it as they are.
        starts_square: The block in front ends square on itself.
        is_engaged: The side was commanded anew in front of it.
        is_bare: It leads back behind a cancel block without motion (`Policy.bare_cancel_is_square`).
        straight: Its vectors were left out, so it is a straight move.
        is_chord: The chord of an arc that the tool does not fit into takes its place.
        altered: A detour round an interference changed it.
        corner_arc: The block of G39 after it, and the direction on which the arc ends square.
        contact: How the contour goes on where a start-up or cancel block meets it on a polynomial (KONTT, KONTC).
        after: What came after it, in order: held items, and steps that a detour has left out.
    """

    move: Move
    contour: Edge
    edge: Edge
    role: Role
    distance: float
    shift: Point
    policy: Policy
    read: int
    first: Point = NO_VECTOR
    side: int = 1
    corner: Corner | None = None
    forced: Point | None = None
    holds: bool = False
    suspended: bool = False
    starts_square: bool = False
    is_engaged: bool = False
    is_bare: bool = False
    straight: bool = False
    is_chord: bool = False
    altered: bool = False
    corner_arc: tuple[Move, Point | None] | None = None
    contact: Contact | None = None
    after: list[Item | Step] = field(default_factory=list)

    def lead_to(self, following: Step) -> None:
        """Let the following step start where this one ends."""
        u, v = self.corner.vectors[-1] if self.corner else NO_VECTOR
        end, start = self.edge.end, following.edge.start
        following.first = (u + (end[0] - start[0]), v + (end[1] - start[1]))

    @property
    def waits_for(self) -> int:
        """Blocks that are read, itself included, before it is executed."""
        policy = self.policy
        return (self.role is Role.START and policy.start_blocks) or policy.read_blocks

    @property
    def is_commanded(self) -> bool:
        """Whether the program itself says which vector stands at its end; then it is not checked."""
        return self.forced is not None or self.holds or self.corner_arc is not None

    @property
    def runs_back(self) -> bool:
        """Whether its vectors have changed places, so that it would run against the programmed direction."""
        return self.runs_back_by(offset.BACKWARDS_MM)

    def runs_back_by(self, way: float) -> bool:
        """Whether it would run against the programmed direction by more than a way, mm."""
        return self.corner is not None and offset.reverses(self.edge, self.first, self.corner.vectors[0], way)

    @property
    def leaves_its_circle(self) -> bool:
        """Whether its way as an arc would not begin and end on one circle, after a detour has moved its start."""
        center, corner = self.edge.center, self.corner
        if center is None or self.straight or corner is None:
            return False
        start, end = arcs.plus(self.edge.start, self.first), arcs.plus(self.edge.end, corner.vectors[0])
        if arcs.radius_of(start, end) <= NO_WAY:
            return False
        return abs(arcs.radius_of(center, start) - arcs.radius_of(center, end)) > _SAME_RADIUS_MM

    @property
    def joint_arc(self) -> Edge | None:
        """The arc about the corner at its end; None where the corner has none."""
        if self.corner is None or self.corner.joint is not Joint.ARC:
            return None
        one, two = (arcs.plus(self.edge.end, self.corner.vectors[k]) for k in (0, -1))
        row = _row(one, two, self.edge.end, self.distance < 0.0)
        return None if row.center is None else row

    def contact_at(self, column: int, *, at_start: bool, curved: bool) -> Contact:
        """How the tool's path goes on at an end of a block of the contour, for a lead that meets it on a polynomial.

        Args:
            column: Of the axis square on the plane; -1 for none.
            at_start: An approach leads to its start, a retraction from its end.
            curved: The curvature counts as well.
        """
        edge, scale = self.edge, self._parallel_by_contour
        u, v = edge.departing if at_start else edge.arriving
        climb = self.move.end[column] - self.move.start[column] if column >= 0 else 0.0
        rise = climb / (edge.length * scale) if scale > 0.0 else 0.0
        level = 1.0 / hypot(1.0, rise)
        sense = -level if at_start else level
        outwards = (sense * u, sense * v, sense * rise)
        if not curved or edge.center is None or scale <= 0.0:
            return Contact(outwards, (0.0, 0.0, 0.0) if curved else None)
        du, dv = arcs.minus(edge.center, edge.start if at_start else edge.end)
        strength = level * level / ((du * du + dv * dv) * scale)
        return Contact(outwards, (du * strength, dv * strength, 0.0))

    @property
    def _parallel_by_contour(self) -> float:
        """Radius of the tool's arc by that of the contour's; 1 for a line, 0 for an arc that becomes a point."""
        edge = self.edge
        if edge.center is None or self.suspended:
            return 1.0
        radius = arcs.radius_of(edge.center, edge.start)
        led = offset.offset_radius(radius, self.distance, edge.ccw)
        return led / radius if led > NO_WAY else 0.0

    def way(self) -> list[Edge]:
        """The lines and arcs of the tool from the start of the step to the last of its vectors."""
        if self.corner is None:
            raise ValueError("the end of the step is not known yet")
        edge, vectors = self.edge, self.corner.vectors
        points = [arcs.plus(edge.end, vector) for vector in vectors]
        start = arcs.plus(edge.start, self.first)
        along = _row(start, points[0], None if self.straight else edge.center, edge.ccw)
        about = edge.end if self.corner.joint is Joint.ARC else None
        return [along, *(_row(one, two, about, self.distance < 0.0) for one, two in pairwise(points))]


def _row(start: Point, end: Point, center: Point | None, ccw: bool) -> Edge:
    """A line, or an arc about a centre; a tool as large as an inner arc passes through its centre on a line."""
    if center is None or arcs.radius_of(start, end) <= NO_WAY:
        return offset.line(start, end)
    nearest = min(arcs.radius_of(center, point) for point in (start, end))
    return offset.line(start, end) if nearest <= NO_WAY else offset.arc(start, end, center, ccw)
