"""Face milling compensated in space: CUT3DF, CUT3DFS, CUT3DFF.

The program tells points of the surface and its normals (A4, A5); the tip goes where the tool with its shape touches
them. CUT3DF takes the tool as the transformation stands it, CUT3DFS along the third axis of the plane on the machine,
CUT3DFF along that of the frame. Where the point of contact jumps between two blocks, a straight move joins them.

Source: job planning 7.5.1 to 7.5.4.
"""

from __future__ import annotations

from math import acos, hypot, radians, sin, sqrt

from polycnc.channel.moves.knots import join
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.compensation.spatial.chords import CHORD_ERROR_MM, Directions, bends, doubled, strays
from polycnc.control.sinumerik.tools.edges import DP_CORNER_RADIUS, DP_RADIUS, DP_SIDE_ANGLE
from polycnc.control.sinumerik.tools.spatial import ToolOnWork
from polycnc.control.sinumerik.transformations import seat
from polycnc.control.sinumerik.transformations.directions import SQUARE
from polycnc.control.sinumerik.transformations.posture import Orienting
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import parts_for_chord_error
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, dot
from polycnc.machine.kinematics import unit
from polycnc.messages import AlarmError
from polycnc.toolpath.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.control.sinumerik.tools.memory import Tools
    from polycnc.geometry.frames import Vector

#: Shapes by type of the tool: what touches, and whether a cone limits it. Other types count as a ball (110).
BALL, LENS, EDGE, TORUS = "ball", "lens", "edge", "torus"
SHAPES = {
    110: (BALL, False), 111: (LENS, False), 120: (EDGE, False), 130: (EDGE, False), 121: (TORUS, False),
    131: (TORUS, False), 155: (EDGE, True), 156: (TORUS, True), 157: (BALL, True),
}  # fmt: skip
#: Sines, cosines and shares of a millimetre that are nothing.
NOTHING = 1e-9


@dataclass(frozen=True, slots=True)
class Cutter:
    """The shape of a face mill.

    Attributes:
        shape: What touches the surface.
        radius: R, mm.
        corner: r, mm.
        steepest: Largest sine of the angle between tool and normal.
    """

    shape: str
    radius: float
    corner: float
    steepest: float = 1.0

    @classmethod
    def of(cls, edge: Edge, *, inverts: bool = False) -> Cutter:
        """The shape of an edge; 10774 where its data break the limits of its type (7.5.3)."""
        shape, is_cone = SHAPES.get(edge.type, SHAPES[110])
        radius, corner, angle = (
            edge.total(parameter, inverts=inverts)
            for parameter in (DP_RADIUS, DP_CORNER_RADIUS, DP_SIDE_ANGLE)
        )
        allowed = radius > 0.0 and (angle > 0.0 or not is_cone)
        if shape == LENS:
            allowed = allowed and corner > radius
        elif shape == TORUS:
            allowed = allowed and corner > 0.0 and (is_cone or radius > corner)
        if not allowed:
            raise AlarmError("10774", type=edge.type)
        return cls(shape, radius, corner, sin(radians(90.0 - angle)) if is_cone else 1.0)

    def offset(self, normal: Vector, tool: Vector) -> Vector:
        """From the point of the surface to the tip; 10768 where the tool cannot touch it there."""
        along = dot(normal, tool)
        across = [n - along * d for n, d in zip(normal, tool, strict=True)]
        steep = hypot(*across)
        if along < -NOTHING or steep > self.steepest + NOTHING:
            raise AlarmError("10768")
        side = [value / steep if steep > NOTHING else 0.0 for value in across]
        out, up, down = self._parts(steep)
        x, y, z = (up * n + out * e - down * d for n, e, d in zip(normal, side, tool, strict=True))
        return (x, y, z)

    def _parts(self, steep: float) -> tuple[float, float, float]:
        """How far the tip lies out to the side, up along the normal, and down along the tool."""
        if self.shape == BALL:
            return 0.0, self.radius, self.radius
        if self.shape == TORUS:
            return self.radius - self.corner, self.corner, self.corner
        if self.shape == LENS and steep * self.corner <= self.radius:
            return 0.0, self.corner, self.corner
        if self.shape == LENS:
            return self.radius, 0.0, self.corner - sqrt(self.corner**2 - self.radius**2)
        return self.radius, 0.0, 0.0


@dataclass(frozen=True, slots=True)
class Standing:
    """A tool that keeps its direction in the work."""

    direction: Vector

    def tool_at(self, position: Sequence[float]) -> Vector:  # noqa: ARG002 - the same everywhere
        """Direction along the tool."""
        return self.direction


class FaceStage(Stage):
    """Leads the tip of a face mill over points of the surface.

    Args:
        channel: The channel.
        posture: How the tool stands on the work.
        cutter: Its shape.
        surface: Where the normals are told, in the work.

    Attributes:
        posture: How the tool stands on the work, from the next move on.
    """

    rank = Rank.SPATIAL_COMPENSATION

    def __init__(
        self,
        channel: SinumerikChannel,
        posture: Directions,
        cutter: Cutter,
        surface: Orienting,
    ) -> None:
        self._channel, self._geometry = channel, channel.coordinates.geometry
        self.posture, self._cutter = posture, cutter
        self._surface = surface
        self._at: list[float] | None = None
        self._shift: Vector = (0.0, 0.0, 0.0)

    @property
    def holds_vector(self) -> bool:
        """Whether the tool touches the surface."""
        return self._at is not None

    def beside(self, position: list[float]) -> list[float]:
        """Where the tip stands when the program stands at a point of the surface; see `Stage`."""
        return self._moved(position, 1.0)

    def programmed(self, position: list[float]) -> list[float]:
        """The point of the surface that the program has told when the tip stands at a position; see `Stage`."""
        return self._moved(position, -1.0)

    def _moved(self, position: list[float], sense: float) -> list[float]:
        moved = list(position)
        for column, value in zip(self._geometry, self._shift, strict=True):
            moved[column] += sense * value
        return moved

    def move(self, move: Move) -> None:
        """Take the next move; an arc becomes chords."""
        path = MovePath(move, self._geometry, in_chords=True)
        first, last = self._surface.first_normal, self._surface.normal
        self._surface.first_normal = self._surface.normal
        if self._at is not None:
            self._check_square(path, first, last)
        if self._at is None:
            self._emit(move, move.end, last)
            return
        offset = self._offset(first, move.start)
        if max(abs(a - b) for a, b in zip(offset, self._shift, strict=True)) > CHORD_ERROR_MM:
            self._emit(move, move.start, first)

        def beside(part: float) -> Vector:
            return self._offset(unit(_between(first, last, part)), path.at(part))

        count = self._pieces(move, first, last)
        if move.is_arc:
            count = max(count, parts_for_chord_error(path.radius, path.sweep, CHORD_ERROR_MM))
        count = doubled(count, lambda n: bends(beside, n) or strays(path, self.posture, n))
        pieces = [path.between(k / count, (k + 1) / count) for k in range(count)]
        chords = [replace(piece, kind=Kind.SPLINE, center=None, turns=0.0) for piece in pieces]
        if not move.is_arc:
            chords[-1].kind = move.kind
        join(self._channel, chords)
        for k, chord in enumerate(chords, 1):
            self._emit(chord, chord.end, unit(_between(first, last, k / count)))

    def _check_square(self, path: MovePath, first: Vector, last: Vector) -> None:
        """10769 for a normal that lies along the path, at its start or end (6.2.5)."""
        along = max(abs(dot(first, path.direction(0.0))), abs(dot(last, path.direction(1.0))))
        if along > SQUARE:
            raise AlarmError("10769")

    def _pieces(self, move: Move, first: Vector, last: Vector) -> int:
        """Chords that keep to the way of the tip."""
        tools = self.posture.tool_at(move.start), self.posture.tool_at(move.end)
        sweep = _angle(first, last) + _angle(*tools)
        size = self._cutter.radius + self._cutter.corner
        return parts_for_chord_error(size, sweep, CHORD_ERROR_MM) if sweep > NOTHING else 1

    def _emit(self, move: Move, place: list[float], normal: Vector) -> None:
        shift = self._offset(normal, place)
        end = list(place)
        for column, value in zip(self._geometry, shift, strict=True):
            end[column] += value
        moved = replace(move, start=self._at or move.start, end=end)
        self._at, self._shift = end, shift
        self.after.move(moved)

    def _offset(self, normal: Vector, place: Sequence[float]) -> Vector:
        return self._cutter.offset(normal, self.posture.tool_at(place))


def select(channel: SinumerikChannel) -> None:
    """G41, G42 with CUT3DF …: the next move goes to where the tool touches its point.

    Raises:
        AlarmError: 10765 for CUT3DF without an orientation transformation, and what `Cutter.of` finds.
    """
    tools: Tools = channel.memory.tools
    assert tools.edge is not None, "G41 asks for it"
    cutter = Cutter.of(tools.edge, inverts=tools.rules is not None and tools.rules.inverts_wear)
    channel.flush()
    leave(channel)
    surface = Orienting.of(channel)
    surface.first_normal = surface.normal
    channel.path.put(FaceStage(channel, _posture(channel), cutter, surface))


def stage_of(channel: SinumerikChannel) -> FaceStage | None:
    """The stage, while it compensates."""
    return channel.path.find(FaceStage)


def follow(channel: SinumerikChannel) -> None:
    """Other frames while the compensation is active."""
    stage = stage_of(channel)
    if stage is not None:
        stage.posture = _posture(channel)


def _posture(channel: SinumerikChannel) -> Directions:
    frame = seat.frame_in_front(channel)
    across = axis_vector(PLANES[channel.mode["plane"]][2])
    match channel.mode["tool_offset"]:
        case "CUT3DFS":
            return Standing(unit(frame.inverse().direct(*across)))
        case "CUT3DFF":
            return Standing(across)
    posture = ToolOnWork.of(channel.coordinates.transformation)
    if posture is None:
        raise AlarmError("10765")
    return posture


def leave(channel: SinumerikChannel) -> None:
    """G40: the next move leads back to the programmed points."""
    if stage_of(channel) is not None:
        channel.flush()
        channel.path.take(FaceStage)


def _angle(a: Vector, b: Vector) -> float:
    return acos(max(-1.0, min(1.0, dot(a, b))))


def _between(a: Vector, b: Vector, share: float) -> Vector:
    """A direction between two, on their great circle."""
    sweep = _angle(a, b)
    if sweep < NOTHING:
        return b
    p, q = sin((1.0 - share) * sweep) / sin(sweep), sin(share * sweep) / sin(sweep)
    x, y, z = (p * s + q * t for s, t in zip(a, b, strict=True))
    return (x, y, z)
