"""Tilted working planes: G68.2 sets a feature system, G53.1 stands the tool on it, G69 ends it (FANUC macro B §12).

A feature system is a frame inside the work system. On a machine whose table carries rotary axes the frame turns
with the table when the tool is aligned; on one with a swivel head the length offset follows the tool.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.control.word_address import frames, length
from polycnc.control.word_address.coordinates import refresh_zero
from polycnc.geometry.frames import IDENTITY, Frame, rotation, translation
from polycnc.machine.kinematics import Kinematics
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.words import Words
    from polycnc.geometry.frames import Vector

#: P of G68.2: how I, J, K turn the plane.
EULER, ROLL_PITCH_YAW, OTHERS = 0, 1, (2, 3, 4)
ORDERS = {123, 132, 213, 231, 312, 321}


def tilt_plane(channel: Channel, words: Words) -> None:
    """G68.2 [P0, P1 Q] X Y Z I J K: origin in the work system, and the turn of the plane."""
    way = words.integer("P") if "P" in words else EULER
    if way in OTHERS:
        raise AlarmError("PC0001", address="P", hint="hint.not-supported", code=f"G68.2 P{way}")
    if way not in (EULER, ROLL_PITCH_YAW):
        raise words.fail("tilt_format", "P")
    i, j, k = (words.angle(letter) or 0.0 for letter in "IJK")
    turn = _euler(i, j, k) if way == EULER else _roll_pitch_yaw(words, (i, j, k))
    channel.memory.tilted_plane = translation(*_origin(channel, words)) @ turn
    _renew(channel, channel.memory.tilted_plane, None)


def _euler(i: float, j: float, k: float) -> Frame:
    """I about Z, J about the new X, K about the new Z."""
    return rotation(2, i) @ rotation(0, j) @ rotation(2, k)


def _roll_pitch_yaw(words: Words, angles: Vector) -> Frame:
    """I, J, K about the axes X, Y, Z of the work system, in the order that Q names."""
    order = words.integer("Q") if "Q" in words else 123
    if order not in ORDERS:
        raise words.fail("tilt_format", "Q")
    turn = IDENTITY
    for digit in str(order):
        axis = int(digit) - 1
        turn = rotation(axis, angles[axis]) @ turn
    return turn


def _origin(channel: Channel, words: Words) -> Vector:
    """X Y Z in the work system, absolute whatever the mode; missing ones are zero."""
    geometry = channel.coordinates.geometry
    point = [0.0, 0.0, 0.0]
    for axis, value, _ in words.axes():
        if axis not in geometry:
            raise words.fail("tilt_format", channel.axes[axis])
        point[geometry.index(axis)] = value
    return (point[0], point[1], point[2])


def align_tool(channel: Channel, words: Words) -> None:
    """G53.1: the rotary axes turn at rapid until the tool stands on the tilted plane; X, Y and Z stay."""
    memory, c = channel.memory, channel.coordinates
    if memory.tilted_plane is None:
        raise words.fail("tilt_missing", "G53.1")
    kinematics = Kinematics.of(channel.machine)
    near = dict(zip(channel.axes, c.machine, strict=True))
    wanted = memory.tilted_plane.direct(0.0, 0.0, 1.0)
    if not kinematics.axes and abs(wanted[2] - 1.0) < 1e-9:
        return
    angles = kinematics.angles_for(wanted, near)
    if angles is None or not set(angles) <= set(channel.axes):
        raise words.fail("tilt_unreachable", "G53.1")
    zero = [c.offsets[axis] - memory.length_offset[axis] if axis >= 0 else 0.0 for axis in c.geometry]
    shift = translation(zero[0], zero[1], zero[2])
    turned = shift.inverse() @ kinematics.work_turn(angles) @ shift @ memory.tilted_plane
    end = c.machine
    for name, angle in angles.items():
        end[channel.axis_index[name]] = angle
    _renew(channel, turned, kinematics.tool_on_machine(angles))
    channel.straight(Kind.RAPID, c.from_machine(end), nan)


def end_tilt(channel: Channel, words: Words) -> None:
    """G69: ends the rotation of G68 and the tilted plane."""
    frames.end_rotation(channel, words)
    if channel.memory.tilted_plane is not None:
        channel.memory.tilted_plane = None
        _renew(channel, IDENTITY, None)


def _renew(channel: Channel, frame: Frame, tool: Vector | None) -> None:
    """Another frame of the work system, and the direction in which the tool's length counts; the machine stays."""
    memory = channel.memory
    memory.zero_frame = frame
    memory.tool_direction = tool
    length.renew_direction(channel)
    refresh_zero(channel)
