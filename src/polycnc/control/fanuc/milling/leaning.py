"""Q of G43.5: the tool leans from the direction of I J K towards where the tip goes (FANUC 30i, A-79348E, page 18).

I J K are then the normal of the surface that is cut. The angle holds until the next G43.5 or until tip control ends.
"""

from __future__ import annotations

from math import cos, radians, sin, sqrt

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.word_address.transformations.tool_center_point import plan_with_direction
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import dot, minus, times

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector

#: Modal group: "Q" while the tool leans.
GROUP = "tip_lean"
#: Ways and directions that are shorter (mm) are none.
SHORTEST = 1e-9


@dataclass(slots=True)
class LeanState(State, lifetime=Lifetime.RESET):
    """Q of G43.5, degrees."""

    angle: float = 0.0


def begin(channel: WordAddressChannel, words: Words) -> None:
    """Q beside G43.5."""
    angle = words.angle("Q") or 0.0
    LeanState.of(channel).angle = angle
    channel.mode = channel.mode.with_code(GROUP, "Q" if angle else "")


def end(channel: WordAddressChannel) -> None:
    """The tool leans no more."""
    channel.mode = channel.mode.with_code(GROUP, "")


def leaned(channel: WordAddressChannel, vector: Vector, position: list[float]) -> Vector:
    """The direction towards where the tip goes, by the angle from the programmed one.

    Where the tip goes along that, or stands, no plane is told in which the tool could lean: it does not.
    """
    c = channel.coordinates
    ways = (position[axis] - c.position[axis] for axis in c.geometry)
    x, y, z = ways
    size = sqrt(dot(vector, vector))
    if size < SHORTEST:
        return vector
    normal = times(vector, 1.0 / size)
    flat = minus((x, y, z), times(normal, dot(normal, (x, y, z))))
    length = sqrt(dot(flat, flat))
    if length < SHORTEST:
        return vector
    angle = radians(LeanState.of(channel).angle)
    i, j, k = (cos(angle) * a + sin(angle) * b / length for a, b in zip(normal, flat, strict=True))
    return (i, j, k)


def plan_leaning(builder: Builder, plan: Plan) -> Step | None:
    """A straight block that leans the tool; without I J K it stays as it stands (15i, B-63323EN-1, page 1053)."""
    if builder.mode["length"] != "G43.5":
        return None
    return plan_with_direction(builder, plan, leaned)
