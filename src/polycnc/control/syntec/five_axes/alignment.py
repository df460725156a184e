"""Standing the tool on a tilted plane: G53.1, G53.3, G53.6 (manual 2.35, 2.36, 2.75).

The rotary axes turn until the tool points along Z of the plane. A table that turns takes the plane with it, a head that
turns takes the tool's length with it; so the frame of the plane is worked out anew for the angles reached. Under tip
control both go by themselves: there the tip is held on the work.
"""

from __future__ import annotations

from math import nan

from polycnc.control.syntec.coordinates.turns import TurnState, keep_plane, renew_preset_frame
from polycnc.control.syntec.five_axes import mechanism
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.coordinates import tip
from polycnc.control.word_address.coordinates.systems import ZeroState, plane_on_table
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.states import LengthState
from polycnc.control.word_address.tools import length
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tilted_plane import (
    check_compensation,
    stand_along,
    turn_about_tip,
)
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.toolpath import Kind
from polycnc.transformation.orientation import choice
from polycnc.transformation.orientation.solutions import solutions_for
from polycnc.transformation.planes.tilted import table_turn

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Vector

SHORTEST = 0
#: Sense of the first rotary axis by P: the shortest way, up, down.
SENSES: dict[float | None, int] = {SHORTEST: 0, 1: 1, 2: -1}
Angles = dict[str, float]


def align_tool(channel: SyntecChannel, words: Words) -> None:
    """G53.1 [P]: the rotary axes turn at rapid; X, Y and Z stay, under tip control the tip does."""
    angles = _angles(channel, words, "G53.1")
    channel.straight(Kind.RAPID, _stood(channel, angles), nan)


def align_and_position(channel: SyntecChannel, words: Words) -> None:
    """G53.3 [X] [Y] [Z] [H] [P]: with the length of H on, all axes move at rapid to a point of the plane."""
    angles = _angles(channel, words, "G53.3")
    _length_on(channel, words)
    position = _stood(channel, angles)
    c = channel.coordinates
    for axis, value, incremental in words.axes():
        if axis not in c.geometry:
            raise words.fail("argument", channel.axes[axis])
        position[axis] = c.position[axis] + value if incremental else value
    channel.straight(Kind.RAPID, position, nan)


def align_about_tip(channel: SyntecChannel, words: Words) -> None:
    """G53.6 [H] [P] [R]: the tip, or the point R above it, stays where it is on the work while the tool turns."""
    if RadiusState.of(channel).side:
        raise words.fail("tip_in_compensation", "G53.6")
    if not (words.integer("H") if "H" in words else LengthState.of(channel).number):
        raise words.fail("tip_without_length", "G53.6")
    angles = _angles(channel, words, "G53.6")
    _length_on(channel, words)
    number, state = LengthState.of(channel).number, TipState.of(channel)
    led, frame = state.active if is_led(channel) else None, state.frame
    arm = channel.control.length_value(channel, number)
    turn_about_tip(channel, angles, arm, above=words.length("R") or 0.0)
    if led is not None:
        tip.lead(channel, led, frame, channel.coordinates.offsets)
    stand_on_plane(channel, angles)


def is_led(channel: SyntecChannel) -> bool:
    """Whether words name the tip already (G43.4, G43.5)."""
    return TipState.of(channel).is_leading(channel)


def _length_on(channel: SyntecChannel, words: Words) -> None:
    """The length of H, or the one before, counts along the tool; tip control goes on with it. The machine stays."""
    number = words.integer("H")
    if number is not None:
        LengthState.of(channel).number = number
    if not is_led(channel):
        channel.mode = channel.mode.with_code("length", "G43")
    elif number is not None:
        length.renew_tip(channel)


# ---- where the axes go to --------------------------------------------------------------------------------


def _stood(channel: SyntecChannel, angles: Angles) -> list[float]:
    """The tool stands on the plane: the position with the rotary axes turned, X Y Z or the tip where they were."""
    c = channel.coordinates
    if not is_led(channel):
        end = _turned(channel, angles)
        stand_on_plane(channel, angles)
        return c.from_machine(end)
    stand_on_plane(channel, angles)
    position = c.position.copy()
    for name, angle in angles.items():
        axis = channel.axis_index[name]
        position[axis] = angle - c.offsets[axis]
    return position


def _turned(channel: SyntecChannel, angles: Angles) -> list[float]:
    """Machine positions with the rotary axes at their new angles."""
    end = channel.coordinates.machine
    for name, angle in angles.items():
        end[channel.axis_index[name]] = angle
    return end


def stand_on_plane(channel: SyntecChannel, angles: Angles) -> None:
    """The plane as the table has turned it, the length along the tool; the machine stays.

    Under tip control both are so already: the plane lies on the work there, and the table turns it.
    """
    c, kinematics = channel.coordinates, channel.control.kinematics(channel)
    if is_led(channel):
        LengthState.of(channel).direction = kinematics.tool_on_machine(angles)
        keep_plane(channel)
        return
    TurnState.of(channel).table = table_turn(kinematics, angles, (0.0, 0.0, 0.0))
    renew_preset_frame(channel.memory)
    stand_along(channel, angles)
    # The length is named with the plane: no later word travels it.
    c.pending = [0.0] * len(channel.axes)
    c.owes = False
    keep_plane(channel)


def leave_table(channel: SyntecChannel) -> None:
    """Tip control begins: it turns the work with the table by itself, and the tool with the head."""
    TurnState.of(channel).table = IDENTITY
    renew_preset_frame(channel.memory)
    ZeroState.of(channel).carried = (0.0, 0.0, 0.0)


# ---- angles ----------------------------------------------------------------------------------------------


def _angles(channel: SyntecChannel, words: Words, code: str) -> Angles:
    """Angles of the rotary axes that P chooses: with P0 the other solution where the first one is out of reach."""
    mechanism.check(channel, words, code)
    check_compensation(channel, words, code)
    state = TurnState.of(channel)
    c = channel.coordinates
    if not state.told_by and not state.by_table:
        raise words.fail("tilt_missing", code)
    way = words.typed("P") if "P" in words else SHORTEST
    if way not in SENSES:
        raise words.fail("align_way", "P")
    channel.flush()
    near = dict(zip(channel.axes, c.machine, strict=True))
    wanted: Vector = plane_on_table(channel, c.offsets).direct(0.0, 0.0, 1.0)
    kinematics = channel.control.kinematics(channel)
    if not kinematics.axes and wanted[2] > 1.0 - 1e-9:
        return {}
    names = [axis for axis in kinematics.ordered if axis in channel.axis_index]
    if not names:
        raise words.fail("tilt_unreachable", code)
    master = names[0]
    led = [
        choice.led(solution, near, master, SENSES[way])
        for solution in solutions_for(kinematics, wanted, near)
    ]
    found = choice.by_way_of(led, near, master)
    chosen = next(
        (s for s in (found if way == SHORTEST else found[:1]) if _reachable(channel, names, near, s)), None
    )
    if chosen is None:
        raise words.fail("tilt_unreachable", code)
    return chosen


def _reachable(channel: SyntecChannel, names: list[str], near: Angles, solution: Angles) -> bool:
    """Whether the angles and the way to them lie within the travel of the rotary axes."""
    parameters = channel.memory.parameters
    unit, travel = least_unit(parameters), parameters.rotary_travel
    for i, name in enumerate(names[:2]):
        low, high = travel[2 * i] * unit, travel[2 * i + 1] * unit
        if low != high and not all(
            choice.is_within(angle, low, high) for angle in (solution[name], near[name])
        ):
            return False
    return True
