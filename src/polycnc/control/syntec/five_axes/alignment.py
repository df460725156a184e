"""Standing the tool on a tilted plane: G53.1, G53.3, G53.6 (manual 2.35, 2.36, 2.75).

The rotary axes turn until the tool points along Z of the plane. A table that turns takes the plane with it, a head that
turns takes the tool's length with it; so the frame of the plane is worked out anew for the angles reached.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.control.syntec.coordinates.systems import renew_preset_frame
from polycnc.control.syntec.parameters import decimals
from polycnc.control.word_address.coordinates.systems import refresh_zero
from polycnc.control.word_address.tools import length
from polycnc.geometry.frames import translation
from polycnc.machine.kinematics import Kinematics
from polycnc.toolpath import Kind
from polycnc.transformation.orientation import solutions_for

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.words import Words
    from polycnc.geometry.frames import Vector

SHORTEST, POSITIVE, NEGATIVE = 0, 1, 2
#: Pr3009, Pr3010: travel of the first rotary axis from and to; Pr3011, Pr3012 of the second one.
TRAVEL = 3009
FULL_TURN = 360.0
Angles = dict[str, float]


def align_tool(channel: Channel, words: Words) -> None:
    """G53.1 [P]: the rotary axes turn at rapid; X, Y and Z stay."""
    angles = _angles(channel, words, "G53.1")
    end = _turned(channel, angles)
    _stand_on_plane(channel, angles)
    channel.straight(Kind.RAPID, channel.coordinates.from_machine(end), nan)


def align_and_position(channel: Channel, words: Words) -> None:
    """G53.3 [X] [Y] [Z] [H] [P]: with the length of H on, all axes move at rapid to a point of the plane."""
    number = words.integer("H")
    angles = _angles(channel, words, "G53.3")
    if number is not None:
        channel.memory.h = number
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


def align_about_tip(channel: Channel, words: Words) -> None:
    """G53.6 [H] [P] [R]: the tip, or the point R above it, stays where it is on the work while the tool turns."""
    memory, c = channel.memory, channel.coordinates
    if memory.side:
        raise words.fail("tip_in_compensation", "G53.6")
    number = words.integer("H")
    memory.h = memory.h if number is None else number
    if not memory.h:
        raise words.fail("tip_without_length", "G53.6")
    angles = _angles(channel, words, "G53.6")
    kinematics = Kinematics.of(channel.machine)
    before = dict(zip(channel.axes, c.machine, strict=True))
    arm = channel.control.length_value(channel, memory.h) - (words.length("R") or 0.0)
    end = _turned(channel, angles)
    here = [end[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    old, new = kinematics.tool_on_machine(before), kinematics.tool_on_machine(angles)
    held = [value - arm * part for value, part in zip(here, old, strict=True)]
    turn = kinematics.work_turn(angles) @ kinematics.work_turn(before).inverse()
    held = list(turn.apply(held[0], held[1], held[2]))
    for axis, value, part in zip(c.geometry, held, new, strict=True):
        if axis >= 0:
            end[axis] = value + arm * part
    channel.mode = channel.mode.with_code("length", "G43")
    _stand_on_plane(channel, angles)
    channel.straight(Kind.RAPID, c.from_machine(end), nan)


def _turned(channel: Channel, angles: Angles) -> list[float]:
    """Machine positions with the rotary axes at their new angles."""
    end = channel.coordinates.machine
    for name, angle in angles.items():
        end[channel.axis_index[name]] = angle
    return end


def _stand_on_plane(channel: Channel, angles: Angles) -> None:
    """The plane as the table has turned it, the length along the tool; the machine stays."""
    memory = channel.memory
    kinematics = Kinematics.of(channel.machine)
    c = channel.coordinates
    zero = [c.offsets[axis] - memory.length_offset[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    shift = translation(zero[0], zero[1], zero[2])
    memory.table_turn = shift.inverse() @ kinematics.work_turn(angles) @ shift
    renew_preset_frame(memory)
    memory.tool_direction = kinematics.tool_on_machine(angles)
    length.renew_direction(channel)
    refresh_zero(channel)
    # The length is named with the plane: no later word travels it.
    c.pending = [0.0] * len(channel.axes)
    c.owes = False


# ---- angles ----------------------------------------------------------------------------------------------


def _angles(channel: Channel, words: Words, code: str) -> Angles:
    """Angles of the rotary axes that P chooses: with P0 the other solution where the first one is out of reach."""
    memory, c = channel.memory, channel.coordinates
    if channel.mode["rotation"] not in ("G68.2", "G68.3") and not memory.rotates_work:
        raise words.fail("tilt_missing", code)
    way = words.typed("P") if "P" in words else SHORTEST
    if way not in (SHORTEST, POSITIVE, NEGATIVE):
        raise words.fail("align_way", "P")
    channel.flush()
    near = dict(zip(channel.axes, c.machine, strict=True))
    wanted: Vector = memory.tilt.direct(0.0, 0.0, 1.0)
    kinematics = Kinematics.of(channel.machine)
    if not kinematics.axes and wanted[2] > 1.0 - 1e-9:
        return {}
    joints = (*kinematics.work, *kinematics.tool) if kinematics.work else kinematics.tool
    names = [joint.axis for joint in joints if joint.axis in channel.axis_index]
    master = names[0]
    found = sorted(
        (_led(solution, near, master, way) for solution in solutions_for(kinematics, wanted, near)),
        key=lambda s: (
            round(abs(s[master] - near[master]), 6),
            sum(abs(s[name] - near[name]) for name in names),
        ),
    )
    chosen = next(
        (s for s in (found if way == SHORTEST else found[:1]) if _reachable(channel, names, near, s)), None
    )
    if chosen is None:
        raise words.fail("tilt_unreachable", code)
    return chosen


def _led(solution: Angles, near: Angles, master: str, way: float | None) -> Angles:
    """The solution with the first rotary axis on the turn that lies in the direction asked for."""
    if way == SHORTEST:
        return solution
    delta = solution[master] - near[master]
    if way == POSITIVE and delta < 0.0:
        delta += FULL_TURN
    elif way == NEGATIVE and delta > 0.0:
        delta -= FULL_TURN
    return {**solution, master: near[master] + delta}


def _reachable(channel: Channel, names: list[str], near: Angles, solution: Angles) -> bool:
    """Whether the angles and the way to them lie within the travel of the rotary axes."""
    unit = 10.0 ** -decimals(channel.memory.parameters, inch=False)
    for i, name in enumerate(names[:2]):
        low = channel.memory.parameter(TRAVEL + 2 * i) * unit
        high = channel.memory.parameter(TRAVEL + 2 * i + 1) * unit
        if low != high and not all(
            low - 1e-9 <= angle <= high + 1e-9 for angle in (solution[name], near[name])
        ):
            return False
    return True
