"""Orientation: from a direction of the tool to the positions of the rotary axes.

The joints of a machine, one after the other, turn the tool as it is drawn (mostly along Z) into the tool seen from the
work: `d = R(k1, a1) R(k2, a2) … ez`, those of the table the other way round (`machine.kinematics`). A direction has two
degrees of freedom, so two axes decide it; there are two solutions, or one where they meet.

At the pole, where the tool lies along the first of the two axes, that one may stand anywhere: it stays where it is.
"""

from __future__ import annotations

from itertools import combinations
from math import acos, atan2, degrees, hypot, sqrt

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.vectors import cross, dot, times
from polycnc.machine.kinematics import turn_about, unit
from polycnc.transformation.numbers import RADIAN
from polycnc.transformation.orientation.choice import nearest, on_nearest_turn

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles, Kinematics
    from polycnc.machine.model import Joint

    #: A joint, and 1 or -1 as it turns the tool forward (head) or backward (table).
    Turn = tuple[Joint, float]

#: Directions closer than this (sine of the angle) are the same.
PARALLEL = 1e-9
#: A solution stands the tool as near as this to the direction.
SAME = 1e-6


@dataclass(frozen=True, slots=True)
class Posture:
    """How the tool stands on the work, by positions of the path.

    Attributes:
        kinematics: The machine's rotary joints.
        axes: Names of the columns.
        offsets: From the work zero to that of the machine (mm, degrees).
        frame: How the system of the path is turned on the work.
    """

    kinematics: Kinematics
    axes: tuple[str, ...]
    offsets: tuple[float, ...]
    frame: Frame = IDENTITY

    def tool_at(self, position: Sequence[float]) -> Vector:
        """Direction of the tool in the system of the path at a position."""
        places = zip(self.axes, position, self.offsets, strict=True)
        tool = self.kinematics.tool_on_work({name: value + zero for name, value, zero in places})
        return tool if self.frame.is_identity else self.frame.inverse().direct(*tool)


def angles_for(kinematics: Kinematics, direction: Vector, near: Angles) -> dict[str, float] | None:
    """Angles of the rotary axes that stand the tool along a direction of the work; None where none do.

    Of several solutions the one with the shortest way from `near`.
    """
    return nearest(solutions_for(kinematics, direction, near), near)


def solutions_for(kinematics: Kinematics, direction: Vector, near: Angles) -> list[dict[str, float]]:
    """All angles of the rotary axes, each on its turn nearest to `near`, that stand the tool along a direction.

    Of more than two axes all but two stay at `near`; every two are tried.

    Args:
        kinematics: The rotary joints, any number.
        direction: Of the tool, seen from the work; of any length but zero.
        near: Where the axes are, degrees by name; those that are missing stand at zero.
    """
    wanted, turns = unit(direction), kinematics.turns
    if not turns:
        return []
    pairs: list[tuple[int, ...]] = list(combinations(range(len(turns)), 2)) or [(0,)]
    found: list[dict[str, float]] = []
    for pair in pairs:
        for turned in _pair_angles(kinematics, pair, wanted, near):
            solution = {**near, **turned}
            angles = {
                joint.axis: on_nearest_turn(solution.get(joint.axis, 0.0), near.get(joint.axis, 0.0))
                for joint, _ in turns
            }
            if angles not in found or len(pairs) == 1:
                found.append(angles)
    return [angles for angles in found if _same(kinematics.tool_on_work(angles), wanted)]


def slopes(kinematics: Kinematics, angles: Angles) -> dict[str, Vector]:
    """How the direction of the tool, seen from the work, changes by a degree of each rotary axis."""
    direction: Vector = kinematics.along
    found: dict[str, Vector] = {}
    for joint, sign in reversed(kinematics.turns):
        turn = turn_about(joint.direction, sign * angles.get(joint.axis, 0.0))
        found = {axis: turn.direct(*slope) for axis, slope in found.items()}
        direction = turn.direct(*direction)
        found[joint.axis] = times(cross(unit(joint.direction), direction), sign * RADIAN)
    return found


def pole_angle(kinematics: Kinematics, angles: Angles) -> float:
    """How far the tool is from the nearest pole, degrees: there no axis turns it in one of the directions.

    The axes turn it in two directions at a right angle where this is 90; with less than two axes it is always 0.
    """
    ways = list(slopes(kinematics, angles).values())
    spans = (hypot(*cross(a, b)) / RADIAN**2 for a, b in combinations(ways, 2))
    return degrees(atan2(size := min(max(spans, default=0.0), 1.0), sqrt(1.0 - size * size)))


def _pair_angles(
    kinematics: Kinematics, pair: tuple[int, ...], wanted: Vector, near: Angles
) -> list[dict[str, float]]:
    """Angles of one or two axes, the others standing at `near`.

    With `d = R(k1, a1) R(k2, a2) e` the component of `d` along k1 depends on a2 alone; a1 then turns the rest about k1.
    """
    turns, drawn = kinematics.turns, kinematics.along
    outer, outer_sign = turns[pair[0]]
    k1 = unit(outer.direction)
    wanted = _turned_back(turns[: pair[0]], wanted, near)
    if len(pair) == 1:
        turned = _angle_about(k1, drawn, wanted)
        return [{} if turned is None else {outer.axis: outer_sign * turned}]
    inner, inner_sign = turns[pair[1]]
    between = turns[pair[0] + 1 : pair[1]]
    k2 = _turned(between, unit(inner.direction), near)
    tool = _turned(between, _turned(turns[pair[1] + 1 :], drawn, near), near)
    found = []
    stays = inner_sign * near.get(inner.axis, 0.0)
    for inner_deg in _inner_angles(k1, k2, tool, wanted, stays):
        angles = {inner.axis: inner_sign * inner_deg}
        outer_deg = _angle_about(k1, turn_about(k2, inner_deg).direct(*tool), wanted)
        if outer_deg is not None:
            angles[outer.axis] = outer_sign * outer_deg
        found.append(angles)
    return found


def _turned(turns: Sequence[Turn], direction: Vector, angles: Angles) -> Vector:
    """A direction as some joints turn it, the last one first."""
    for joint, sign in reversed(turns):
        direction = turn_about(joint.direction, sign * angles.get(joint.axis, 0.0)).direct(*direction)
    return direction


def _turned_back(turns: Sequence[Turn], direction: Vector, angles: Angles) -> Vector:
    """The direction that some joints turn into this one."""
    for joint, sign in turns:
        direction = turn_about(joint.direction, -sign * angles.get(joint.axis, 0.0)).direct(*direction)
    return direction


def _inner_angles(k1: Vector, k2: Vector, tool: Vector, wanted: Vector, stays: float) -> tuple[float, ...]:
    """Angles about k2 for which the turned tool has the same component along k1 as the wanted direction.

    Where k2 lies along the tool, or along k1, none of its angles changes that component: it stays where it is.
    """
    along = dot(k2, tool)
    across = (tool[0] - k2[0] * along, tool[1] - k2[1] * along, tool[2] - k2[2] * along)
    a, b = dot(k1, across), dot(k1, cross(k2, tool))
    size, rest = hypot(a, b), dot(k1, wanted) - dot(k1, k2) * along
    if size < PARALLEL:
        return (stays,)
    if abs(rest) > size * (1.0 + PARALLEL):
        return ()
    middle, half = degrees(atan2(b, a)), degrees(acos(max(-1.0, min(1.0, rest / size))))
    return (middle + half, middle - half)


def _angle_about(axis: Vector, start: Vector, end: Vector) -> float | None:
    """Angle that turns one direction into another about an axis; None where both lie on the axis."""
    along = dot(axis, start)
    a = tuple(s - k * along for s, k in zip(start, axis, strict=True))
    along = dot(axis, end)
    b = tuple(e - k * along for e, k in zip(end, axis, strict=True))
    u, v = (a[0], a[1], a[2]), (b[0], b[1], b[2])
    if min(dot(u, u), dot(v, v)) < PARALLEL**2:
        return None
    return degrees(atan2(dot(axis, cross(u, v)), dot(u, v)))


def _same(a: Vector, b: Vector) -> bool:
    return all(abs(x - y) < SAME for x, y in zip(a, b, strict=True))
