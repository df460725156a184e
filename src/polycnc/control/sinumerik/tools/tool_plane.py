"""The system in which radius compensation acts: lengths are true there, and its plane is that of the tool.

Frames may scale the programmed contour, but never the tool. CUT2DF compensates in the plane of the frame, CUT2D in that
of the basic system, whichever way the contour is turned (Fundamentals). As long as a frame only turns, mirrors and
scales the plane evenly, all this is a matter of the radius, in units of the program. Otherwise moves are led into the
system of the tool in front of compensation, and back behind it.
"""

from __future__ import annotations

from itertools import pairwise
from math import hypot

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.arcs import EVEN, circle_image, is_even
from polycnc.geometry.frames import IDENTITY, Frame, Vector
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, cross, dot, minus, times
from polycnc.toolpath.kinds import Kind

with loaded_when_called():
    from polycnc.channel.moves import knots

if TYPE_CHECKING:
    from polycnc.compensation.cutter import CutterCompensation
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Chords of an arc that the program sees as an ellipse may be this far off it, mm.
CHORD_ERROR_MM = 0.001


class ToolPlane(NamedTuple):
    """How the programmed plane lies to the tool.

    Attributes:
        scale: Length of a programmed unit in the plane, where it is the same in all directions.
        frame: From the program to the system of the tool, where it is not, or where the plane is tilted; else none.
    """

    scale: float = 1.0
    frame: Frame = IDENTITY


def bends_arcs(channel: SinumerikChannel, normal: Vector) -> bool:
    """Whether frames make an ellipse of an arc about a normal, and no radius compensation acts on it as an arc."""
    zero = channel.coordinates.zero
    if is_even(zero) or circle_image(zero, normal) is not None:
        return False
    from polycnc.compensation.cutter import CutterCompensation

    cutter = channel.path.find(CutterCompensation)
    return cutter is None or not cutter.active


def tool_plane(channel: SinumerikChannel) -> ToolPlane:
    """The system of the tool as plane, frames and CUT2D or CUT2DF have it now."""
    linear = Frame(seat.frame_in_front(channel).m)
    plane, of_frame = channel.mode["plane"], channel.mode["tool_offset"] == "CUT2DF"
    stance = None if of_frame else channel.memory.tools.stance(plane)
    if linear.is_identity and stance is None:
        return ToolPlane()
    u, v, w = PLANES[plane]
    columns = list(zip(*linear.m, strict=True))
    basis = _of_frame(columns, u, v) if of_frame else _of_machine(columns, (u, v, w), stance or IDENTITY)
    rows: list[Vector] = [(0.0, 0.0, 0.0)] * 3
    for axis, direction in zip((u, v, w), basis, strict=True):
        rows[axis] = tuple(dot(direction, column) for column in columns)  # type: ignore[assignment]  # three columns
    (a, b, c), (d, e, f) = ((rows[axis][u], rows[axis][v], rows[axis][w]) for axis in (u, v))
    size = hypot(a, d)
    slack = EVEN * size
    if max(abs(a - e), abs(b + d), abs(c), abs(f), abs(rows[w][u]), abs(rows[w][v])) <= slack:
        return ToolPlane(size)
    return ToolPlane(1.0, Frame((rows[0], rows[1], rows[2])))


def _of_frame(columns: list[Vector], u: int, v: int) -> tuple[Vector, Vector, Vector]:
    """Unit vectors of the plane in which the programmed contour lies."""
    first = times(columns[u], 1.0 / hypot(*columns[u]))
    across = minus(columns[v], times(first, dot(first, columns[v])))
    second = times(across, 1.0 / hypot(*across))
    return first, second, cross(first, second)


def _of_machine(
    columns: list[Vector], plane: tuple[int, int, int], stance: Frame
) -> tuple[Vector, Vector, Vector]:
    """Unit vectors of the plane of the basic system, which a swivelling head, or its edge, turns with the tool.

    A mirrored contour is seen from behind, so that sides stay as the program means them.
    """
    first, second, third = (stance.direct(*axis_vector(axis)) for axis in plane)
    u, v = columns[plane[0]], columns[plane[1]]
    mirrored = dot(first, u) * dot(second, v) - dot(first, v) * dot(second, u) < -EVEN
    return (times(first, -1.0) if mirrored else first), second, third


class _Led(Stage):
    """Leads moves through a frame while compensation acts.

    Args:
        frame: The frame.
        geometry: Columns of X, Y and Z.
        cutter: The stage of compensation; without it there is nothing to do.
    """

    def __init__(self, frame: Frame, geometry: tuple[int, int, int], cutter: CutterCompensation) -> None:
        self.frame = frame
        self._geometry = geometry
        self._cutter = cutter

    @property
    def active(self) -> bool:
        """Whether compensation acts."""
        return self._cutter.active

    def move(self, move: Move) -> None:
        """Pass a move on as the frame shows it."""
        start, end = self._point(move.start), self._point(move.end)
        if move.center is None:
            self.after.move(replace(move, start=start, end=end))
        else:
            self.after.move(self._arc(move, start, end, move.center))

    def beside(self, position: list[float]) -> list[float]:
        """A position as the frame shows it."""
        return self._point(position)

    def programmed(self, position: list[float]) -> list[float]:
        """The position that the frame shows so."""
        return self._point(position, self.frame.inverse())

    def _point(self, position: list[float], frame: Frame | None = None) -> list[float]:
        image = (frame or self.frame).apply(*(position[i] if i >= 0 else 0.0 for i in self._geometry))
        moved = position.copy()
        for column, value in zip(self._geometry, image, strict=True):
            if column >= 0:
                moved[column] = value
        return moved

    def _arc(self, move: Move, start: list[float], end: list[float], center: Vector) -> Move:
        return replace(
            move, start=start, end=end, center=self.frame.apply(*center), normal=self._normal(move)
        )

    def _normal(self, move: Move) -> Vector:
        """The normal of an arc's image; PC0001 where that is no arc."""
        normal = circle_image(self.frame, move.normal)
        if normal is None:
            raise not_supported("G2 G3: SCALE G41 G42")
        return normal


class IntoToolPlane(_Led):
    """From the program to the system of the tool; an arc must lie in the tool's plane there."""

    rank = Rank.INTO_TOOL_PLANE

    def _normal(self, move: Move) -> Vector:
        normal = super()._normal(move)
        if abs(normal[self._cutter.plane.w]) < 1.0 - 1e-9:
            raise not_supported("G2 G3: CUT2D")
        return normal


class OutOfToolPlane(_Led):
    """Back to the program, where an arc about a corner may be an ellipse: then it becomes chords."""

    rank = Rank.OUT_OF_TOOL_PLANE

    def __init__(
        self,
        channel: SinumerikChannel,
        frame: Frame,
        geometry: tuple[int, int, int],
        cutter: CutterCompensation,
    ) -> None:
        super().__init__(frame, geometry, cutter)
        self._channel = channel

    def move(self, move: Move) -> None:
        """Pass a move on as the program names it."""
        if move.center is None or circle_image(self.frame, move.normal) is not None:
            super().move(move)
            return
        ends = list(MovePath(move, self._geometry).chords(CHORD_ERROR_MM))
        chords = [
            replace(move, kind=Kind.SPLINE, start=start, end=end, center=None, turns=0.0)
            for start, end in pairwise((move.start, *ends))
        ]
        knots.join(self._channel, chords, shows=True)
        for chord in chords:
            super().move(chord)


def lead(channel: SinumerikChannel, cutter: CutterCompensation, frame: Frame) -> None:
    """Lead the moves that are compensated through the system of the tool; the identity leads them directly."""
    standing = channel.path.find(IntoToolPlane)
    if (IDENTITY if standing is None else standing.frame) == frame:
        return
    if cutter.active and cutter.holds_vector:
        raise not_supported("CUT2D CUT2DF: G41 G42")
    channel.path.take(IntoToolPlane, OutOfToolPlane)
    if frame is not IDENTITY:
        geometry = channel.coordinates.geometry
        channel.path.put(IntoToolPlane(frame, geometry, cutter))
        channel.path.put(OutOfToolPlane(channel, frame.inverse(), geometry, cutter))
