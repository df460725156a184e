"""A plane move that waits in the window until the moves behind it tell where it ends."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.path import Move
    from polycnc.compensation.policies import Policy
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Corner, Edge

NO_VECTOR: Point = (0.0, 0.0)


class Role(Enum):
    """What the next plane move is."""

    PLAIN = "not compensated"
    START = "start-up"
    CONTOUR = "contour"
    CANCEL = "cancel"


@dataclass(slots=True)
class Step:
    """A plane move in the window.

    Attributes:
        move: As programmed.
        edge: Its edge.
        role: Start-up, contour or cancel.
        distance: Signed offset of the contour, left positive.
        shift: Added to every vector (nose centre to tip).
        policy: The control's behaviour when the block was read.
        read: Number of the block.
        first: Vector at its start.
        corner: Vectors at its end, once known.
        forced: Direction on which the vector at its end stands square (I, J, K in the block).
        holds: It keeps the vector of its start (G38).
        starts_square: The block in front ends square on itself.
        straight: Its vectors were left out, so it is a straight move.
        avoided: Its end was moved to avoid an interference.
        behind_avoidance: Its start was.
        corner_arc: The block of G39 after it, and the direction on which the arc ends square.
        after: What came after it, in order.
    """

    move: Move
    edge: Edge
    role: Role
    distance: float
    shift: Point
    policy: Policy
    read: int
    first: Point = NO_VECTOR
    corner: Corner | None = None
    forced: Point | None = None
    holds: bool = False
    starts_square: bool = False
    straight: bool = False
    avoided: bool = False
    behind_avoidance: bool = False
    corner_arc: tuple[Move, Point | None] | None = None
    after: list[Callable[[], None]] = field(default_factory=list)

    def lead_to(self, following: Step) -> None:
        """Let the following step start where this one ends."""
        u, v = self.corner.vectors[-1] if self.corner else NO_VECTOR
        end, start = self.edge.end, following.edge.start
        following.first = (u + end[0] - start[0], v + end[1] - start[1])
