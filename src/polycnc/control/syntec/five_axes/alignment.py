"""Standing the tool on a tilted plane: G53.1, G53.3, G53.6 (manual 2.35, 2.36, 2.75).

The rotary axes turn until the tool points along Z of the plane. A table that turns takes the plane with it, a head that
turns takes the tool's length with it; so the frame of the plane is worked out anew for the angles reached.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.control.syntec.coordinates.turns import TurnState, renew_preset_frame
from polycnc.control.syntec.five_axes import mechanism
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.tools import length
from polycnc.control.word_address.tools.length import LengthState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.tilted_plane import check_compensation
from polycnc.machine.kinematics import Kinematics
from polycnc.toolpath import Kind
from polycnc.transformation.orientation import choice
from polycnc.transformation.orientation.solutions import solutions_for
from polycnc.transformation.planes.tilted import about_tip, table_turn

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Vector

SHORTEST = 0
#: Sense of the first rotary axis by P: the shortest way, up, down.
SENSES: dict[float | None, int] = {SHORTEST: 0, 1: 1, 2: -1}
Angles = dict[str, float]


def align_tool(channel: SyntecChannel, words: Words) -> None:
    """G53.1 [P]: the rotary axes turn at rapid; X, Y and Z stay."""
    angles = _angles(channel, words, "G53.1")
    end = _turned(channel, angles)
    _stand_on_plane(channel, angles)
    channel.straight(Kind.RAPID, channel.coordinates.from_machine(end), nan)


def align_and_position(channel: SyntecChannel, words: Words) -> None:
    """G53.3 [X] [Y] [Z] [H] [P]: with the length of H on, all axes move at rapid to a point of the plane."""
    number = words.integer("H")
    angles = _angles(channel, words, "G53.3")
    if number is not None:
        LengthState.of(channel).number = number
    end = _turned(channel, angles)
    channel.mode = channel.mode.with_code("length", "G43")
    _stand_on_plane(channel, angles)
    c = channel.coordinates
    position = c.from_machine(end)
    for axis, value, incremental in words.axes():
        if axis not in c.geometry:
            raise words.fail("argument", channel.axes[axis])
        position[axis] = c.position[axis] + value if incremental else value
    channel.straight(Kind.RAPID, position, nan)


def align_about_tip(channel: SyntecChannel, words: Words) -> None:
    """G53.6 [H] [P] [R]: the tip, or the point R above it, stays where it is on the work while the tool turns."""
    state = LengthState.of(channel)
    c = channel.coordinates
    if RadiusState.of(channel).side:
        raise words.fail("tip_in_compensation", "G53.6")
    number = words.integer("H")
    state.number = state.number if number is None else number
    if not state.number:
        raise words.fail("tip_without_length", "G53.6")
    angles = _angles(channel, words, "G53.6")
    kinematics = Kinematics.of(channel.machine)
    before = dict(zip(channel.axes, c.machine, strict=True))
    arm = channel.control.length_value(channel, state.number) - (words.length("R") or 0.0)
    end = _turned(channel, angles)
    here = [end[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    for axis, value in zip(c.geometry, about_tip(kinematics, before, angles, here, arm), strict=True):
        if axis >= 0:
            end[axis] = value
    channel.mode = channel.mode.with_code("length", "G43")
    _stand_on_plane(channel, angles)
    channel.straight(Kind.RAPID, c.from_machine(end), nan)


def _turned(channel: SyntecChannel, angles: Angles) -> list[float]:
    """Machine positions with the rotary axes at their new angles."""
    end = channel.coordinates.machine
    for name, angle in angles.items():
        end[channel.axis_index[name]] = angle
    return end


def _stand_on_plane(channel: SyntecChannel, angles: Angles) -> None:
    """The plane as the table has turned it, the length along the tool; the machine stays."""
    memory = channel.memory
    kinematics = Kinematics.of(channel.machine)
    c = channel.coordinates
    TurnState.of(channel).table = table_turn(kinematics, angles, (0.0, 0.0, 0.0))
    renew_preset_frame(memory)
    LengthState.of(channel).direction = kinematics.tool_on_machine(angles)
    length.renew_direction(channel)
    refresh_zero(channel)
    # The length is named with the plane: no later word travels it.
    c.pending = [0.0] * len(channel.axes)
    c.owes = False


# ---- angles ----------------------------------------------------------------------------------------------


def _angles(channel: SyntecChannel, words: Words, code: str) -> Angles:
    """Angles of the rotary axes that P chooses: with P0 the other solution where the first one is out of reach."""
    mechanism.check(channel, words, code)
    check_compensation(channel, words, code)
    state = TurnState.of(channel)
    c = channel.coordinates
    if channel.mode["rotation"] not in ("G68.2", "G68.3") and not state.by_table:
        raise words.fail("tilt_missing", code)
    if TipState.of(channel).active is not None:
        raise channel.control.not_yet(f"{code} G43.4")
    way = words.typed("P") if "P" in words else SHORTEST
    if way not in SENSES:
        raise words.fail("align_way", "P")
    channel.flush()
    near = dict(zip(channel.axes, c.machine, strict=True))
    wanted: Vector = state.plane.direct(0.0, 0.0, 1.0)
    kinematics = Kinematics.of(channel.machine)
    if not kinematics.axes and wanted[2] > 1.0 - 1e-9:
        return {}
    joints = (*kinematics.work, *kinematics.tool) if kinematics.work else kinematics.tool
    names = [joint.axis for joint in joints if joint.axis in channel.axis_index]
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
