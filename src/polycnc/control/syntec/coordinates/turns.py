"""How the work system is turned: G92.1, tilted planes, and the angles of the coordinate rotation page (manual 2.39.2).

A work system turns about Z, then about the new Y, then about the new X. The angles of the page last; they act while
G54.4 P1 is on.
"""

from __future__ import annotations

from math import inf

from polycnc.channel.states.state import Lifetime, State, lasting, retained
from polycnc.control.syntec.parameters import SyntecParameters
from polycnc.control.word_address.coordinates.systems import ZeroState, refresh_zero
from polycnc.control.word_address.coordinates.tip import TIP_CODES, TipState
from polycnc.control.word_address.states import LengthState
from polycnc.control.word_address.tools.radius import active_compensation
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.memory.retained import TILTED_PLANES, WORK_TURNS
from polycnc.toolpath.context import Pace

with loaded_when_called():
    from polycnc.control.word_address.motion import planes
    from polycnc.machine import kinematics
    from polycnc.transformation.planes import tilted

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.syntec.memory import SyntecMemory
    from polycnc.deferred.typing import Self
    from polycnc.toolpath import Context


@dataclass(slots=True)
class TurnState(State, lifetime=Lifetime.RESET):
    """How the work system is turned.

    Attributes:
        angle: Of G92.1 (#1930), degrees, about `axis` (#1931 to #1933).
        tilt: Frame of the tilted plane in the work system; `table` is how the table has turned it since.
        told_by: Code that has told the plane, G68.2 or G68.3; empty without one. A G68 turns within it, and leaves it.
        by_table: G54.4 P1 is active (#1849); a reset leaves it (2.39.4 names power-on, Pr3229 and G54.4 itself only).
        work: How that turns the work system.
    """

    angle: float = lasting(Lifetime.POWER, 0.0)
    axis: list[float] = lasting(Lifetime.POWER, factory=lambda: [0.0, 0.0, 1.0])
    tilt: Frame = IDENTITY
    told_by: str = ""
    table: Frame = IDENTITY
    by_table: bool = lasting(Lifetime.POWER, False)
    work: Frame = IDENTITY

    @property
    def plane(self) -> Frame:
        """The tilted plane in the system of the work offset, before the table turns."""
        return self.work @ self.tilt


#: Modal group: "work" while rotary words of G43.4 tell directions of a work system that is turned.
POSTURE = "posture"


@dataclass(slots=True)
class PostureState(State, lifetime=Lifetime.RESET):
    """Whether directions of the tool refer to the work system under G43.4.

    Attributes:
        in_work: #1848.
        told: Positions of the rotary axes by which words have told the direction in a turned system, by name; empty
            before the first ones.
    """

    in_work: bool = False
    told: dict[str, float] = field(default_factory=dict)

    @classmethod
    def first(cls, channel: SyntecChannel) -> Self:
        """As Pr3057 has it."""
        return cls(SyntecParameters.naming(channel.setup.parameters).posture_in_work == 1)


@dataclass(slots=True)
class WorkTurns(State, lifetime=Lifetime.RETAINED):
    """What the page holds.

    Attributes:
        by_system: Angles X, Y, Z by the name of the work system, degrees.
    """

    by_system: dict[str, list[float]] = retained(WORK_TURNS)


#: Pr3014: the tilted plane is kept over a reset; 2 over power-off too.
OVER_POWER_OFF = 2


@dataclass(slots=True)
class KeptPlane(State, lifetime=Lifetime.RETAINED):
    """The tilted plane where Pr3014 is 2; empty for none.

    Attributes:
        parts: `plane` is the matrix by rows and the origin (mm), `code` the modal code, `stands` whether the tool does.
    """

    parts: dict[str, list[float] | str | bool] = retained(TILTED_PLANES)


@dataclass(slots=True)
class FollowingState(State, lifetime=Lifetime.RESET):
    """How fast the linear axes may follow the rotary ones by I of G43.4, mm/min; 0: as Pr3091 has it."""

    fastest: float = 0.0


def following(channel: SyntecChannel, context: Context) -> Context:
    """A context under tool tip control, with the highest speed of the axes that follow (2.28.3, note 9)."""
    if not leads_tip(channel):
        return context
    fastest = FollowingState.of(channel).fastest or channel.memory.parameters.following_speed
    return replace(context, pace=Pace(following=fastest / 60.0)) if 0.0 < fastest < inf else context


def leads_tip(channel: SyntecChannel) -> bool:
    """Whether tool tip control is active."""
    return channel.mode["length"] in TIP_CODES


def keep_plane(channel: SyntecChannel) -> None:
    """Note the tilted plane as it is now, for the time behind power-off."""
    state, kept = TurnState.of(channel), channel.memory.parameters.keeps_tilt == OVER_POWER_OFF
    parts = KeptPlane.of(channel).parts
    parts.clear()
    if kept and not state.tilt.is_identity:
        plane = [*(value for row in state.tilt.m for value in row), *state.tilt.t]
        stands = LengthState.of(channel).direction is not None
        parts.update({"plane": plane, "code": state.told_by, "stands": stands})


def angle(channel: Channel, system: str, axis: int) -> float:
    """An angle of the page, degrees; `axis` is 0 to 2 for X, Y, Z."""
    return WorkTurns.of(channel).by_system.get(system, [0.0] * 3)[axis]


def set_angle(channel: Channel, system: str, axis: int, value: float) -> None:
    """Another angle, degrees. It acts when the rotation, the system or the tool length is called next (2.39.3)."""
    WorkTurns.of(channel).by_system.setdefault(system, [0.0] * 3)[axis] = value


def turn_of(channel: Channel, system: str) -> Frame:
    """How a work system is turned."""
    x, y, z = WorkTurns.of(channel).by_system.get(system, (0.0, 0.0, 0.0))
    if x == y == z == 0.0:
        return IDENTITY
    return tilted.by_own_axes(((2, z), (1, y), (0, x)))


def renew_preset_frame(memory: SyntecMemory) -> None:
    """The zero frame follows #1930 to #1933 and the tilted plane."""
    state = TurnState.of(memory.channel)
    x, y, z = state.axis
    turns = state.angle != 0.0 and x * x + y * y + z * z != 0.0
    turn = kinematics.turn_about((x, y, z), state.angle) if turns else IDENTITY
    zero = ZeroState.of(memory.channel)
    zero.turn, zero.frame = state.work, state.work @ turn
    zero.table, zero.plane = state.table, state.tilt


def turn_preset_frame(channel: SyntecChannel, angle: float, axis: list[float], code: str) -> None:
    """The turn of G92.1 is another one, told by a code or a variable.

    Raises:
        AlarmError: As `_refuse_turn`, where the work system turns otherwise by it.
    """
    state = TurnState.of(channel)
    if (angle or state.angle) and (angle, axis) != (state.angle, state.axis):
        _refuse_turn(channel, code)
        refuse_posture(channel, angle)
    state.angle, state.axis = angle, axis
    renew_preset_frame(channel.memory)


def _refuse_turn(channel: SyntecChannel, code: str) -> None:
    """PC0001 for a work system that turns under a transformation, or in radius compensation.

    Tip control goes on in it; a corner of compensation would lie between two directions.
    """
    if channel.coordinates.transformation is not None and not TipState.of(channel).is_leading(channel):
        raise channel.control.not_yet(f"{code} G12.1", code)
    if active_compensation(channel) is not None:
        raise channel.control.not_yet(f"{code} {channel.mode['compensation']}", code)


def end_turns(channel: SyntecChannel) -> None:
    """Power-on where nothing is kept over it: no plane is tilted, no work system turns."""
    renew_preset_frame(channel.memory)
    refresh_zero(channel)
    keep_plane(channel)


def refer_posture(channel: SyntecChannel, turn: Frame) -> None:
    """Whether rotary words tell the tool's direction in a work system that is turned (2.28.3, note 8).

    Under G43.5 none do: vectors always count in the program's system (2.29.1).
    """
    state = PostureState.of(channel)
    acts = channel.mode["length"] == "G43.4" and state.in_work and not turn.is_identity
    state.told = {}
    channel.mode = channel.mode.with_code(POSTURE, "work" if acts else "")


def refuse_posture(channel: SyntecChannel, angle: float) -> None:
    """PC0001 for directions of G43.4 in the work system where G92.1 turns that: the manual speaks of G54.4 alone."""
    if angle and channel.mode["length"] == "G43.4" and PostureState.of(channel).in_work:
        raise channel.control.not_yet("G43.4 Q1: G92.1")


def renew_work_turn(channel: SyntecChannel) -> bool:
    """The angles of the chosen work system act from here on, with G54.4 P1; gives whether it turns otherwise now.

    Raises:
        AlarmError: As `_refuse_turn`.
    """
    state = TurnState.of(channel)
    turn = turn_of(channel, ZeroState.of(channel).system) if state.by_table else IDENTITY
    if turn == state.work:
        return False
    _refuse_turn(channel, "G54.4")
    if TipState.of(channel).is_leading(channel):
        refer_posture(channel, turn)
    if not turn.is_identity:
        planes.choose_basic_axes(channel)
    state.work = turn
    renew_preset_frame(channel.memory)
    return True
