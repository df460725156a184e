"""Tool centre point: words name the tip against the work, the linear axes follow the rotary ones (G43.4, TRAORI).

For any chain of rotary joints in the head and in the table, in any direction and with any offsets. The programming
system is fixed to the table and turns with it. A point of the path holds the tip and the positions of the rotary axes,
which the transformation leaves alone; so its Jacobian never degenerates (its determinant is 1). Poles belong to the
orientation: they matter where rotary positions are *found* for a direction (`solutions`).
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import minus, plus
from polycnc.machine.kinematics import unit
from polycnc.transformation.contract import unchanged
from polycnc.transformation.numbers import RADIAN, cosine_and_sine_deg
from polycnc.transformation.orientation.solutions import solutions_for

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Kinematics
    from polycnc.machine.model import Joint
    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.numbers import N
    from polycnc.transformation.pole import Pole

    Point = tuple[N | float, N | float, N | float]

_UNIT: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Link:
    """A rotary joint: column of its axis, unit direction, and offset from the joint before, mm."""

    column: int
    direction: Vector
    offset: Vector


@dataclass(frozen=True, slots=True)
class ToolCentrePoint:
    """How the axes follow the tip.

    Attributes:
        kinematics: The machine's rotary joints.
        axes: Names of the columns; every joint has one.
        geometry: Columns of X, Y and Z; all three exist.
        zero: From the work zero to that of the machine, for every axis, without the tool (mm, degrees).
        tip: From the point that the linear axes move to the tip with the rotary axes at zero, mm.
        hung: From the last joint of the head to the tip: the nose, then the tool.
        apart: From the last joint of the head to the point that the linear axes name, with the rotary axes at zero.
    """

    kinematics: Kinematics
    axes: tuple[str, ...]
    geometry: Geometry
    zero: tuple[float, ...]
    tip: Vector
    hung: Vector = field(init=False, repr=False, compare=False)
    apart: Vector = field(init=False, repr=False, compare=False)
    _head: tuple[Link, ...] = field(init=False, repr=False, compare=False)
    _table: tuple[Link, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        nose = self.kinematics.nose
        object.__setattr__(self, "hung", plus(nose, self.tip))
        object.__setattr__(self, "apart", minus(nose, self.kinematics.to_nose))
        object.__setattr__(self, "_head", self._links(self.kinematics.tool))
        object.__setattr__(self, "_table", self._links(self.kinematics.work))

    def _links(self, joints: Sequence[Joint]) -> tuple[Link, ...]:
        """Joints by columns, from the end of the chain to the base: in that order they turn a point."""
        return tuple(
            Link(self.axes.index(joint.axis), unit(joint.direction), joint.offset)
            for joint in reversed(joints)
        )

    @property
    def chains(self) -> tuple[tuple[Link, ...], tuple[Link, ...]]:
        """Joints of the table and of the head, of each the one at its end first: in that order they turn a point."""
        return self._table, self._head

    @property
    def pole(self) -> Pole | None:
        """No place of the tip leaves an axis without a direction."""
        return None

    def to_machine(self, work: Sequence[N]) -> list[N]:
        """Positions of the axes for one of the tip."""
        point, tip = self._on_table(work), self._arm(work)
        axes = list(work)
        for axis, place, part in zip(self.geometry, point, tip, strict=True):
            axes[axis] = (place - part) - self.zero[axis]  # type: ignore[assignment]  # one is a column, or none
        return axes

    def to_work(self, axes: Sequence[N]) -> list[N]:
        """Position of the tip for those of the axes."""
        arm = self._arm(axes)
        x, y, z = (
            (axes[axis] + self.zero[axis]) + part for axis, part in zip(self.geometry, arm, strict=True)
        )
        point: Point[N] = (x, y, z)
        for link in reversed(self._table):
            point = _turned(link, _moved(point, link.offset, -1.0), self._angle(axes, link), -1.0)
        for link in self._table:
            point = _moved(point, link.offset, 1.0)
        work = list(axes)
        for axis, place in zip(self.geometry, point, strict=True):
            work[axis] = place - self.zero[axis]  # type: ignore[assignment]  # a column if the others are
        return work

    def jacobian(self, work: Sequence[N]) -> list[list[N | float]]:
        """The table's turn for the tip; for each rotary axis how fast it carries the tip, mm a degree."""
        slopes = unchanged(work)
        for column, vector in zip(self.geometry, _UNIT, strict=True):
            turned: Point[N] = vector
            for link in self._table:
                turned = _turned(link, turned, self._angle(work, link), 1.0)
            for axis, slope in zip(self.geometry, turned, strict=True):
                slopes[axis][column] = slope
        for chain, begin, sign in (
            (self._table, self._from_table(work), 1.0),
            (self._head, self.hung, -1.0),
        ):
            for column, ways in self._carried(work, chain, begin).items():
                for axis, slope in zip(self.geometry, ways, strict=True):
                    slopes[axis][column] = slopes[axis][column] + (sign * RADIAN) * slope
        return slopes

    def solutions(self, work: Sequence[float]) -> list[list[float]]:
        """The tip with the same direction of the tool, by every solution of the rotary axes."""
        named = dict(zip(self.axes, work, strict=True))
        offsets = dict(zip(self.axes, self.zero, strict=True))
        angles = {axis: named[axis] + offsets[axis] for axis in self.kinematics.axes}
        points = [list(work)]
        for solution in solutions_for(self.kinematics, self.kinematics.tool_on_work(angles), angles):
            if any(abs(solution[axis] - angle) > 1e-6 for axis, angle in angles.items()):
                turned = {axis: angle - offsets[axis] for axis, angle in solution.items()}
                points.append([turned.get(axis, value) for axis, value in named.items()])
        return [self.to_machine(point) for point in points]

    def orientation(self, work: Sequence[N]) -> list[N | float]:
        """Direction from the tip along the tool, seen from the work: three numbers."""
        direction: Point[N] = self.kinematics.along
        for link in self._head:
            direction = _turned(link, direction, self._angle(work, link), 1.0)
        for link in reversed(self._table):
            direction = _turned(link, direction, self._angle(work, link), -1.0)
        return list(direction)

    def _angle(self, point: Sequence[N], link: Link) -> N:
        return point[link.column] + self.zero[link.column]

    def _from_table(self, work: Sequence[N]) -> Point[N]:
        """The tip seen from the innermost joint of the table."""
        x, y, z = (work[axis] + self.zero[axis] for axis in self.geometry)
        point: Point[N] = (x, y, z)
        for link in self._table:
            point = _moved(point, link.offset, -1.0)
        return point

    def _on_table(self, work: Sequence[N]) -> Point[N]:
        """The tip as the table has moved it."""
        return self._through(work, self._table, self._from_table(work))

    def _arm(self, point: Sequence[N]) -> Point[N]:
        """From the point that the linear axes move to the tip, as the head has turned it."""
        arm = self._through(point, self._head, self.hung)
        for link in self._head:
            arm = _moved(arm, link.offset, -1.0)
        return _moved(arm, self.apart, -1.0)

    def _through(self, angles: Sequence[N], chain: Sequence[Link], point: Point[N]) -> Point[N]:
        """A point that the end of a chain carries, seen from its base."""
        for link in chain:
            point = _moved(_turned(link, point, self._angle(angles, link), 1.0), link.offset, 1.0)
        return point

    def _carried(self, angles: Sequence[N], chain: Sequence[Link], point: Point[N]) -> dict[int, Point[N]]:
        """How the point moves by a radian of each joint."""
        ways: dict[int, Point[N]] = {}
        for link in chain:
            angle = self._angle(angles, link)
            ways = {column: _turned(link, way, angle, 1.0) for column, way in ways.items()}
            point = _turned(link, point, angle, 1.0)
            ways[link.column] = _cross(link.direction, point)
            point = _moved(point, link.offset, 1.0)
        return ways


def _moved(point: Point[N], offset: Vector, sense: float) -> Point[N]:
    x, y, z = point
    u, v, w = offset
    return (x + sense * u, y + sense * v, z + sense * w)


def _cross(k: Vector, v: Point[N]) -> Point[N]:
    return (k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0])


def _turned(link: Link, v: Point[N], angle: N, sense: float) -> Point[N]:
    """A vector turned about a joint: what lies along its axis stays, to the bit (Rodrigues)."""
    k, (x, y, z) = link.direction, v
    c, s = cosine_and_sine_deg(angle * sense)
    size = k[0] * x + k[1] * y + k[2] * z
    along_x, along_y, along_z = k[0] * size, k[1] * size, k[2] * size
    aside_x, aside_y, aside_z = _cross(k, v)
    return (
        along_x + c * (x - along_x) + s * aside_x,
        along_y + c * (y - along_y) + s * aside_y,
        along_z + c * (z - along_z) + s * aside_z,
    )
