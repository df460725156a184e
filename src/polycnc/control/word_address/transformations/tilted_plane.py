"""Tilted working planes: G68.2 to G68.4 set a feature system, G53.1 stands the tool on it, G69 ends it (macro B §12).

A feature system is a frame inside the work system. On a machine whose table carries rotary axes the frame turns
with the table when the tool is aligned; on one with a swivel head the length offset follows the tool.
"""

from __future__ import annotations

from math import nan

from polycnc.control.word_address.coordinates import frames, on_table
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.systems import (
    ZeroState,
    frame_on_table,
    lies,
    plane_on_table,
    refresh_zero,
    work_zero,
)
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.motion.planes import choose_basic_axes
from polycnc.control.word_address.states import LengthState, TiltState
from polycnc.control.word_address.tools import length
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, rotation, translation
from polycnc.geometry.vectors import times
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles

#: P of G68.2: how the plane is told.
EULER, ROLL_PITCH_YAW, POINTS, VECTORS, PROJECTION = 0, 1, 2, 3, 4
#: Blocks of the ways that need several, by Q.
BLOCKS = {POINTS: 3, VECTORS: 2}
ORDERS = {123, 132, 213, 231, 312, 321}
MACHINE_ZERO = (0.0, 0.0, 0.0)
#: P of G53.1 and G53.6: the nearest position, or the sense in which the first rotary axis turns.
NEAREST = 0
SENSES = {NEAREST: 0, 1: 1, 2: -1}


def tilt_plane(channel: WordAddressChannel, words: Words) -> None:
    """G68.2 [P0, P1 Q, P4] X Y Z I J K: origin in the work system, and the turn; P2 [Q0 R], P3 in several blocks."""
    _check_state(channel, words, "G68.2")
    plane = _told(channel, words)
    if plane is not None:
        tilt(channel, plane)


def tilt_further(channel: WordAddressChannel, words: Words) -> None:
    """G68.4 …: as G68.2, but in the feature system that acts."""
    _check_state(channel, words, "G68.4")
    before = TiltState.of(channel).plane
    if before is None:
        raise words.fail("tilt_missing", "G68.4")
    plane = _told(channel, words)
    if plane is not None:
        tilt(channel, before @ plane)


def tilt_by_tool(channel: WordAddressChannel, words: Words) -> None:
    """G68.3 X Y Z R: the plane across the tool as it stands; without X Y Z its origin is where the tool is.

    X of the plane is square on the tool and on Z of the machine, or as the control has it; R turns it about the tool.
    """
    from polycnc.transformation.planes.tilted import table_turn

    _check_state(channel, words, "G68.3")
    c, kinematics = channel.coordinates, channel.control.kinematics(channel)
    given = {axis for axis, _, _ in words.axes()}
    if given and len(given & set(c.geometry)) < len(c.geometry):
        raise words.fail("tilt_format", "G68.3")
    angles = dict(zip(channel.axes, c.machine, strict=True))
    zero = work_zero(channel, c.offsets)
    across = channel.control.plane_across(channel, kinematics.tool_on_machine(angles))
    turn = across @ rotation(2, words.angle("R") or 0.0)
    turned = table_turn(kinematics, angles, MACHINE_ZERO)
    table = table_turn(kinematics, angles, zero) @ lies(channel, c.offsets)
    place = table.apply(*named_point(channel, words, "tilt_format"))
    plane = table.inverse() @ translation(*place) @ turn
    _renew(channel, turned, plane, angles)
    if not given:
        here = tuple(c.position[axis] if axis >= 0 else 0.0 for axis in c.geometry)
        place = (translation(*place) @ turn).apply(here[0], here[1], here[2])
        plane = table.inverse() @ translation(*place) @ turn
        _renew(channel, turned, plane, angles)
    TiltState.of(channel).plane = plane


def _check_state(channel: WordAddressChannel, words: Words, code: str) -> None:
    """A plane is told and the tool stood on it in front of tool centre point control, not under it.

    Radius compensation has its corners between blocks of one plane, so it ends before that changes.
    """
    if TipState.of(channel).active is not None:
        raise words.fail("tip_company", code)
    if OnTable.of(channel).fixture:
        raise words.fail("tilt_mode", code)
    check_compensation(channel, words, code)
    choose_basic_axes(channel)


def check_compensation(channel: WordAddressChannel, words: Words, code: str) -> None:
    """Refuse a code that changes the plane under radius compensation."""
    if RadiusState.of(channel).side:
        raise words.fail("tilt_mode", code)


def _told(channel: WordAddressChannel, words: Words) -> Frame | None:
    """The plane that a block tells, within the system it is told in; None before the last one of several."""
    from polycnc.transformation.planes.tilted import by_euler, by_projections

    way = words.integer("P") if "P" in words else EULER
    if "R" in words and (way != POINTS or words.integer("Q") != 0):
        raise words.fail("tilt_format", "R")
    if way in BLOCKS:
        return _told_in_several(channel, words, way)
    i, j, k = (words.angle(letter) or 0.0 for letter in "IJK")
    if way == EULER:
        turn: Frame | None = by_euler(i, j, k)
    elif way == ROLL_PITCH_YAW:
        turn = _roll_pitch_yaw(words, (i, j, k))
    elif way == PROJECTION:
        turn = by_projections(i, j, k)
    else:
        raise words.fail("tilt_format", "P")
    if turn is None:
        raise words.fail("tilt_format", "I")
    return translation(*named_point(channel, words, "tilt_format")) @ turn


def tilt(channel: WordAddressChannel, plane: Frame) -> None:
    """A plane of the work, with which the tool is not aligned yet."""
    TiltState.of(channel).plane = plane
    _renew(channel, IDENTITY, plane, None)


def _told_in_several(channel: WordAddressChannel, words: Words, way: int) -> Frame | None:
    """One block of P2 (Q1 to Q3: origin, a point of X, a point on the side of Y) or P3 (Q1 origin and X, Q2 Z).

    Q0 in front of them shifts the origin along X, Y, Z of the plane by points, and turns that about Z by R.
    """
    from polycnc.transformation.planes.tilted import by_directions, by_points

    state = TiltState.of(channel)
    number = words.integer("Q") if "Q" in words else None
    if state.way != way:
        state.way, state.told, state.placed = way, [], IDENTITY
    if number == 0 and way == POINTS:
        place, turn = named_point(channel, words, "tilt_format"), rotation(2, words.angle("R") or 0.0)
        state.told, state.placed = [], translation(*place) @ turn
        return None
    told = state.told if number != 1 else []
    if number != len(told) + 1 or number > BLOCKS[way]:
        raise words.fail("tilt_format", "Q")
    # A direction has no unit: it is not cut off at the least increment, as I J K of G43.5 are not.
    i, j, k = ((words.typed if way == VECTORS else words.length)(letter) or 0.0 for letter in "IJK")
    state.told = [*told, (named_point(channel, words, "tilt_format"), (i, j, k))]
    if number < BLOCKS[way]:
        return None
    (origin, first), (second, upright), *others = state.told
    placed, state.told, state.placed = state.placed, [], IDENTITY
    plane = (
        by_points(origin, second, others[0][0]) if way == POINTS else by_directions(origin, first, upright)
    )
    if plane is None:
        raise words.fail("tilt_format", "Q")
    return plane @ placed


def _roll_pitch_yaw(words: Words, angles: Vector) -> Frame:
    """I, J, K about the axes X, Y, Z of the work system, in the order that Q names."""
    from polycnc.transformation.planes.tilted import by_fixed_axes

    order = words.integer("Q") if "Q" in words else 123
    if order not in ORDERS:
        raise words.fail("tilt_format", "Q")
    return by_fixed_axes([int(digit) - 1 for digit in str(order)], angles)


def named_point(channel: WordAddressChannel, words: Words, mistake: str) -> Vector:
    """X Y Z in the work system, absolute whatever the mode; missing ones are zero, other axes are a `mistake`."""
    geometry = channel.coordinates.geometry
    point = [0.0, 0.0, 0.0]
    for axis, value, _ in words.axes():
        if axis not in geometry:
            raise words.fail(mistake, channel.axes[axis])
        point[geometry.index(axis)] = value
    return (point[0], point[1], point[2])


def align_tool(channel: WordAddressChannel, words: Words) -> None:
    """G53.1 [P]: the rotary axes turn at rapid until the tool stands on the tilted plane; X, Y and Z stay."""
    _align(channel, words, "G53.1", holds_tip=False)


def align_tool_about_tip(channel: WordAddressChannel, words: Words) -> None:
    """G53.6 [P]: as G53.1, while X, Y and Z go along so that the tip stays where it is on the work.

    PC0001 for H where no length acts: whether it switches one on is not known here.
    """
    if "H" in words and channel.mode.codes.get("length") == "G49":
        raise AlarmError("PC0001", hint="hint.not-supported", code="G53.6 H")
    _align(channel, words, "G53.6", holds_tip=True)


def _align(channel: WordAddressChannel, words: Words, code: str, *, holds_tip: bool) -> None:
    from polycnc.transformation.planes.tilted import table_turn

    _check_state(channel, words, code)
    c, plane = channel.coordinates, TiltState.of(channel).plane
    if plane is None:
        raise words.fail("tilt_missing", code)
    kinematics = channel.control.kinematics(channel)
    near = dict(zip(channel.axes, c.machine, strict=True))
    wanted = plane_on_table(channel, c.offsets).direct(0.0, 0.0, 1.0)
    if not kinematics.axes and abs(wanted[2] - 1.0) < 1e-9:
        return
    angles = _angles(channel, words, wanted, near)
    if angles is None or not set(angles) <= set(channel.axes):
        raise words.fail("tilt_unreachable", code)
    table = table_turn(kinematics, angles, MACHINE_ZERO)
    if holds_tip:
        if -1 in c.geometry:
            raise words.fail("tip_machine", code)
        turn_about_tip(channel, angles, length.active_value(channel))
        _renew(channel, table, plane, angles)
        for axis in c.geometry:
            c.pending[axis] = 0.0
        return
    end = c.machine
    for name, angle in angles.items():
        end[channel.axis_index[name]] = angle
    _renew(channel, table, plane, angles)
    channel.straight(Kind.RAPID, c.from_machine(end), nan)


def turn_about_tip(channel: WordAddressChannel, angles: Angles, arm: float, above: float = 0.0) -> None:
    """Rapid of the rotary axes; a point of the tool stays where it is on the work, for tip control leads meanwhile.

    Behind it nothing leads the axes: the caller says what lies between display and machine.

    Args:
        channel: All three linear axes exist.
        angles: Where the rotary axes go to, degrees by name.
        arm: From the tip along the tool to the nose, mm.
        above: From the tip along the tool to the point, mm.
    """
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
    from polycnc.transformation.seated import Seated

    c = channel.coordinates
    channel.flush()
    offsets = c.offsets.copy()
    if "length" in channel.mode.codes:  # on lathes they do not count along the tool
        for axis, place in zip(c.geometry, work_zero(channel, offsets), strict=True):
            offsets[axis] = place
    kinematics = channel.control.kinematics(channel)
    tip = times(kinematics.along, above - arm)
    led = ToolCentrePoint(kinematics, channel.axes, c.geometry, tuple(offsets), tip)
    frame = frame_on_table(channel, c.offsets) @ translation(0.0, 0.0, above)
    c.transform(Seated(led, frame), None, (IDENTITY, offsets))
    channel.context_changed()
    end = c.position.copy()
    for name, angle in angles.items():
        axis = channel.axis_index[name]
        end[axis] = angle - offsets[axis]
    channel.straight(Kind.RAPID, end, nan)
    channel.flush()
    c.transform(None)


def _angles(
    channel: WordAddressChannel, words: Words, wanted: Vector, near: Angles
) -> dict[str, float] | None:
    """Positions of the rotary axes: the nearest ones, by P1 and P2 those to which the first axis turns up or down.

    The first axis is the one that carries the other, or is in the head.
    """
    from polycnc.transformation.orientation import choice
    from polycnc.transformation.orientation.solutions import solutions_for

    kinematics = channel.control.kinematics(channel)
    way = words.integer("P") if "P" in words else NEAREST
    if way not in SENSES:
        raise words.fail("tilt_format", "P")
    if way == NEAREST or not kinematics.axes:
        return nearest_angles(channel, wanted, near)
    first, ranges = kinematics.ordered[0], channel.control.rotary_ranges(channel)
    led = [
        choice.led(solution, near, first, SENSES[way]) for solution in solutions_for(kinematics, wanted, near)
    ]
    found = [solution for solution in led if choice.all_within(solution, ranges)]
    return next(iter(choice.by_way_of(found, near, first)), None)


def nearest_angles(channel: WordAddressChannel, wanted: Vector, near: Angles) -> dict[str, float] | None:
    """The nearest positions of the rotary axes within their ranges that stand the tool along a direction."""
    from polycnc.transformation.orientation import choice
    from polycnc.transformation.orientation.solutions import solutions_for

    ranges = channel.control.rotary_ranges(channel)
    found = solutions_for(channel.control.kinematics(channel), wanted, near)
    placed = (choice.on_turns_within(solution, near, ranges) for solution in found)
    return choice.nearest([solution for solution in placed if solution is not None], near)


def turn_to(channel: WordAddressChannel, wanted: Vector, near: Angles, goal: list[float]) -> bool:
    """Let the rotary axes of a programmed target stand the tool along a direction; False where they cannot.

    Args:
        channel: The channel.
        wanted: The direction on the table.
        near: Positions of the machine that the nearest ones are looked for from, degrees.
        goal: Programmed positions of all axes; those of the rotary axes are set.
    """
    c, angles = channel.coordinates, nearest_angles(channel, wanted, near)
    for name, angle in (angles or {}).items():
        axis = channel.axis_index[name]
        goal[axis] = angle - c.offsets[axis]
        c.pending[axis] = 0.0
    return angles is not None


def end_tilt(channel: WordAddressChannel, words: Words) -> None:
    """G69: ends the rotation of G68 and the tilted plane."""
    state = TiltState.of(channel)
    if state.plane is not None:
        check_compensation(channel, words, "G69")
    frames.end_rotation(channel, words)
    if state.plane is not None:
        state.plane = None
        _renew(channel, IDENTITY, IDENTITY, None)


def _renew(channel: WordAddressChannel, table: Frame, plane: Frame, angles: Angles | None) -> None:
    """Another plane of the work, which the table may have turned; the machine stays.

    With angles the tool stands on it as the rotary axes turn it.
    """
    state = ZeroState.of(channel)
    state.table, state.plane = table, plane
    stand_along(channel, angles)
    if OnTable.of(channel).error:
        on_table.follow(channel)


def stand_along(channel: WordAddressChannel, angles: Angles | None) -> None:
    """The length counts along the tool as the rotary axes turn it; without angles as they stand it at zero.

    The display follows: an incremental word travels what was owed to it before, and no other direction of the length.
    """
    from polycnc.transformation.planes.tilted import tool_carrier

    c, kinematics = channel.coordinates, channel.control.kinematics(channel)
    owed = c.pending.copy()
    ZeroState.of(channel).carried = (0.0, 0.0, 0.0) if angles is None else tool_carrier(kinematics, angles).t
    refresh_zero(channel)  # a change of the plane is not travelled, one of the length is
    LengthState.of(channel).direction = None if angles is None else kinematics.tool_on_machine(angles)
    length.renew_direction(channel)
    refresh_zero(channel)
    c.pending, c.owes = owed, any(owed)
