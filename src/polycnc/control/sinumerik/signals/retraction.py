"""Fast retraction from the contour: LIFTFAST with ALF, LFTXT, LFWP and LFPOS, POLF (job planning 1.14.6, 1.14.7).

The way is an ideal rapid move of the length DILF (else MD21200) in a direction that ALF chooses in steps of 45 degrees.
LFTXT: in the plane across the path's tangent, ALF=1 along the tool, ALF=3 to the right of the path, ALF=7 to its left.
LFWP: in the working plane, ALF=1 along its first axis, ALF=3 along its second. ALF=0: no retraction.
LFPOS: the axes of POLFMASK or POLFMLIN go to the positions of POLF.
Right and left are those of the machine; with MD21202 a mirror in the plane swaps them, as it swaps the compensation
side. The part along the tool is never mirrored.
"""

from __future__ import annotations

from math import cos, nan, radians, sin

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.block.draft import axis_column
from polycnc.control.sinumerik.block.positions import axis_term, number
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, cross
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.language.sinumerik.words import WordShape

DIRECTIONS = range(9)
STEP_DEG = 45.0
#: Directions of LFTXT that would lead into the contour beside which the tool runs.
INTO_CONTOUR = {"G41": range(2, 5), "G42": range(6, 9)}


@dataclass(slots=True)
class Retraction(State, lifetime=Lifetime.POWER):
    """How a fast retraction goes.

    Attributes:
        direction: ALF.
        length_mm: DILF, 0 for that of the machine data.
        positions: POLF by column, and whether it is a way.
        enabled: Columns of the axes that POLFMASK or POLFMLIN names.
    """

    direction: int = 1
    length_mm: float = 0.0
    positions: dict[int, tuple[float, bool]] = field(default_factory=dict)
    enabled: tuple[int, ...] = ()


def lift(channel: SinumerikChannel, tangent: Vector) -> None:
    """Retract from where the channel stands; `tangent` is the direction of the interrupted path, zero for none."""
    end = _positions(channel) if channel.mode["retraction_plane"] == "LFPOS" else _along(channel, tangent)
    if end is not None:
        channel.straight(Kind.RAPID, end, nan)


def _positions(channel: SinumerikChannel) -> list[float]:
    """LFPOS: the positions of POLF for the axes that are enabled."""
    state = Retraction.of(channel)
    end = channel.coordinates.position.copy()
    for column in state.enabled:
        value, relative = state.positions.get(column, (end[column], False))
        end[column] = end[column] + value if relative else value
    return end


def _along(channel: SinumerikChannel, tangent: Vector) -> list[float] | None:
    memory = channel.memory
    state = Retraction.of(channel)
    direction = state.direction
    if direction == 0:
        return None
    if (
        direction in INTO_CONTOUR.get(channel.mode["compensation"], ())
        and channel.mode["retraction_plane"] == "LFTXT"
    ):
        raise AlarmError("12560", text="ALF")
    angle = radians((direction - 1) * STEP_DEG)
    first, second, third = PLANES[channel.mode["plane"]]
    if channel.mode["retraction_plane"] == "LFWP":
        along, across = axis_vector(first), axis_vector(second)
    else:
        signs = [-1.0 if mirrored else 1.0 for mirrored in memory.frames.total().mirrored]
        right = cross(_signed(tangent, signs), axis_vector(third))
        along, across = _signed(axis_vector(third), signs), _signed(right, signs)
        if signs[first] * signs[second] < 0.0 and memory.data.integer("$MC_LIFTFAST_WITH_MIRROR"):
            across = _signed(across, [-1.0, -1.0, -1.0])
    distance = state.length_mm or memory.data.number("$MC_LIFTFAST_DIST")
    end = channel.coordinates.position.copy()
    for k, column in enumerate(channel.coordinates.geometry):
        if column >= 0:
            end[column] += distance * (cos(angle) * along[k] + sin(angle) * across[k])
    return end


def _signed(vector: Vector, signs: list[float]) -> Vector:
    return (vector[0] * signs[0], vector[1] * signs[1], vector[2] * signs[2])


# ---- words and procedures


def direction_code(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """ALF: direction of the retraction, 1 to 8; 0 for none."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position)
        if value not in DIRECTIONS:
            raise WordAlarm("12560", position, text="ALF")
        Retraction.of(channel).direction = int(value)

    return run


def length(_draft: Draft, position: int, _shape: WordShape) -> Step:
    """DILF: length of the retraction."""

    def run(channel: SinumerikChannel, values: Values) -> None:
        Retraction.of(channel).length_mm = number(values, position)

    return run


def retraction_position(draft: Draft, position: int, shape: WordShape) -> Step:
    """POLF[axis]: position of the retraction, absolute or with IC."""
    column = axis_column(draft, position, shape)
    modifier = shape.modifier
    term = axis_term(draft.channel, draft.mode, position, column, modifier)

    def run(channel: SinumerikChannel, values: Values) -> None:
        value = number(values, position) * term.factor
        Retraction.of(channel).positions[column] = (value, modifier == "IC")

    return run


def enable(channel: SinumerikChannel, args: tuple[Any, ...]) -> None:
    """POLFMASK(axis, …), POLFMLIN(axis, …): the axes that retract, instead of those of the last call."""
    columns = tuple(arguments.column(channel, axis) for axis in args)
    missing = [axis for axis, column in zip(args, columns, strict=True) if not _has_position(channel, column)]
    if missing:
        raise AlarmError("14020", text="POLFMASK")
    Retraction.of(channel).enabled = columns


def _has_position(channel: SinumerikChannel, column: int) -> bool:
    return column in Retraction.of(channel).positions


PROCEDURES = {"POLFMASK": enable, "POLFMLIN": enable}
