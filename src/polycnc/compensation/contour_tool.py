"""Edges that cut between two angles each: which of them a contour touches, and a contour that they cannot cut.

Contour tools have several edges (SINUMERIK, job planning 7.1). A line is touched by the edge between whose angles its
normal lies, an arc by one that has all its normals. At an inner corner of two lines the tool touches both, perhaps with
two edges: the left and the right corner of a wheel in a groove. Where no edge touches, two reach to different places,
or an arc or an outer corner would need two of them, the contour is refused.

The nose of each edge has a radius, and a way (shift) to the point that the program means, which is one for all of them.
So that point goes where the edges touch, whichever edge the displays count with. A corner of two edges is that of one
edge with another shift: the one at which both lines are touched.
"""

from __future__ import annotations

from math import atan2, degrees, tau
from typing import TYPE_CHECKING, ClassVar, NoReturn

from polycnc.channel.moves.path import END_OF_BLOCK, Move, Rank, Stage
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.moves.path import Item, PlacedEvent
    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.geometry import offset
    from polycnc.geometry.arcs import Point

#: An edge cuts as far beside its limits, degrees; two edges touch a line alike where they differ by less, mm.
BESIDE_DEG, ALIKE_MM = 1e-4, 1e-6
#: Two lines are parallel where the sine between them is below.
PARALLEL = 1e-9
TURN_DEG = 360.0


class CuttingEdge(NamedTuple):
    """One edge of a tool.

    Attributes:
        reference: Direction in the plane from which its angles count, clockwise as seen against the third axis.
        least: Least angle; `largest` the largest one, degrees.
        radius: Of its nose, with the allowance on the contour, mm.
        shift: From the nose centre to the point of the tool that the program means, mm.
    """

    reference: Point
    least: float
    largest: float
    radius: float
    shift: Point

    def touches(self, at: Point, turn_deg: float = 0.0) -> bool:
        """Whether it cuts in a direction from its centre, and while that turns by an angle, counter-clockwise."""
        (a, b), (x, y) = self.reference, at
        clockwise = degrees(atan2(b * x - a * y, a * x + b * y))
        width = (self.largest - self.least) % TURN_DEG or TURN_DEG
        first = (clockwise - self.least + BESIDE_DEG) % TURN_DEG - BESIDE_DEG
        last = first - turn_deg
        return max(first, last) <= width + BESIDE_DEG and min(first, last) >= -BESIDE_DEG

    def reach(self, at: Point) -> float:
        """How far it reaches in a direction from the point that the program means, mm."""
        return self.radius - self.shift[0] * at[0] - self.shift[1] * at[1]


class ContourTool(Stage):
    """Says which edge compensation counts with.

    A move waits here for the next one, whose corner decides it.

    Args:
        cutter: The stage of compensation, behind this one.
        side: 1 where the tool is left of the contour, -1 right.
        edges: The edges; of several that touch, the first one cuts.
        counted: The number of a context that counts with another radius, mm.
        refuse: Raises an alarm.
    """

    rank: ClassVar[int] = Rank.EDGES

    def __init__(
        self,
        cutter: CutterCompensation,
        side: int,
        edges: tuple[CuttingEdge, ...],
        counted: Callable[[int, float], int],
        refuse: Callable[[], NoReturn],
    ) -> None:
        self._cutter, self._side, self._edges = cutter, side, edges
        self._counted, self._refuse = counted, refuse
        self._edge = edges[0]
        self._held: list[Item] = []
        self._approaches = False

    @property
    def active(self) -> bool:
        """Whether compensation acts, or a move waits."""
        return bool(self._held) or self._cutter.active

    def move(self, move: Move) -> None:
        """Take a move; one of the contour, or one that leads there, lets that in front go."""
        if not self._cutter.plane.moves(move):
            self._in_order(move)
        elif self._held:
            self._go_on(move)
        elif self._cutter.is_starting or self._cutter.on_contour:
            self._approaches = self._cutter.is_starting
            self._hold(move)
        else:
            self.after.move(move)

    def event(self, event: PlacedEvent) -> None:
        """Take an event; it keeps its place between the moves."""
        self._in_order(event)

    def block(self) -> None:
        """A block has been read."""
        self._in_order(END_OF_BLOCK)

    def flush(self) -> None:
        """Pass on everything; no more moves will come."""
        self.release()
        self.after.flush()

    def release(self) -> None:
        """Pass on what waits; its end touches with the edge that touches at its start."""
        if self._held:
            self._pass(self._edge.radius, self._edge.shift)

    def _pass(self, radius: float, shift: Point) -> None:
        """Pass on what waits; its end lies a radius and a shift beside the contour."""
        self._cutter.change_radius(radius, (shift[0] / radius, shift[1] / radius))
        held, self._held, self._approaches = self._held, [], False
        for item in held:
            self.pass_on(item if self._edge is self._edges[0] else self._with_edge(item))

    def _with_edge(self, item: Item) -> Item:
        if not isinstance(item, Move):
            return item
        return replace(item, context=self._counted(item.context, self._edge.radius))

    def _in_order(self, item: Item) -> None:
        if self._held:
            self._held.append(item)
        else:
            self.pass_on(item)

    def _hold(self, move: Move) -> None:
        """Keep a move; one of the contour is touched by its edge all along."""
        edge = None if self._approaches else self._cutter.plane.edge(move)
        if edge is not None and not self._follows(self._edge, edge, move.turns):
            self._refuse()
        self._held.append(move)

    def _go_on(self, move: Move) -> None:
        """The corner between the move that waits and the next one is known."""
        plane, before = self._cutter.plane, self._held[0]
        assert isinstance(before, Move)
        last, first = plane.edge(before), plane.edge(move)
        if last is None or first is None:
            self.release()
        else:
            able = [edge for edge in self._edges if self._follows(edge, first, move.turns)]
            if not able:
                self._refuse()
            if self._approaches:
                self._edge = able[0]
            following, radius, shift = self._corner(last, first, able)
            self._pass(radius, shift)
            self._edge = following
        self._hold(move)

    def _corner(
        self, last: offset.Edge, first: offset.Edge, able: list[CuttingEdge]
    ) -> tuple[CuttingEdge, float, Point]:
        """The edge that goes on behind a corner, with radius and shift at the end of the move that came there.

        At an inner corner of two lines another edge may touch the second one; the shift is that at which both touch.
        """
        edge, (at, then) = self._edge, (self._at(last.arriving), self._at(first.departing))
        turn = self._outer_turn(last.arriving, first.departing)
        if edge in able and (self._approaches or edge.touches(at, turn)):
            return edge, edge.radius, edge.shift
        across = at[0] * then[1] - at[1] * then[0]
        if turn or last.center is not None or edge in able:
            self._refuse()
        if first.center is not None or abs(across) < PARALLEL:
            both = [each for each in able if each.touches(at)]
            if not both:
                self._refuse()
            return both[0], both[0].radius, both[0].shift
        own, other = edge.radius - edge.reach(at), edge.radius - able[0].reach(then)
        u, v = own * then[1] - other * at[1], other * at[0] - own * then[0]
        return able[0], edge.radius, (u / across, v / across)

    def _follows(self, edge: CuttingEdge, move: offset.Edge, turns: float) -> bool:
        """Whether an edge touches all along a line or an arc, and no other one that touches reaches elsewhere."""
        angle = degrees(move.sweep + tau * turns) if move.center is not None else 0.0
        ends = self._at(move.departing), self._at(move.arriving)
        return edge.touches(ends[0], angle if move.ccw else -angle) and all(
            abs(other.reach(at) - edge.reach(at)) < ALIKE_MM
            for at in ends
            for other in self._edges
            if other.touches(at)
        )

    def _at(self, direction: Point) -> Point:
        """Where the edge touches beside a direction of travel, seen from its centre."""
        return self._side * direction[1], -self._side * direction[0]

    def _outer_turn(self, before: Point, after: Point) -> float:
        """How far the contour turns at a corner that the tool goes round, degrees; nothing at an inner one."""
        (a, b), (c, d) = before, after
        turn = degrees(atan2(a * d - b * c, a * c + b * d))
        return turn if turn * self._side < -BESIDE_DEG else 0.0
