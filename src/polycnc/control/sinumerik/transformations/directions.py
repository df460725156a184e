"""From the words of orientation to directions: where the tool points at the end of a block, and the way there.

All directions are unit vectors of the basic system, from the tip along the tool (6.2.4 to 6.5).
"""

from __future__ import annotations

from math import radians

from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations.words import (
    ANGLES,
    AXIS,
    BETWEEN,
    BY_PATH,
    CONES,
    DIRECTION,
    FIRST_NORMAL,
    LAST_NORMAL,
    LETTERS,
    SECOND,
)
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.geometry.vectors import dot
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.machine.kinematics import unit
from polycnc.messages import AlarmError
from polycnc.transformation.orientation.directions import (
    about,
    angle_between,
    axis_of_opening,
    axis_of_tangent,
    axis_through,
    between_curves,
    cone,
    great_circle,
    leaned,
    polynomial,
    unit_of,
)
from polycnc.transformation.planes.tilted import by_own_axes

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import TipPath, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.transformations.posture import Orienting, Posture
    from polycnc.control.sinumerik.transformations.words import Words
    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles
    from polycnc.transformation.orientation.directions import Way

#: Sense about the axis of a cone, seen along it: clockwise is right-handed.
SENSES = {"ORICONCW": 1, "ORICONCCW": -1}
#: Axis and order of the angles A2, B2, C2 by group 50: pairs of axis and letter, about axes that turn along.
ORDERS: dict[str, tuple[tuple[int, int], ...]] = {
    "ORIEULER": ((2, 0), (0, 1), (2, 2)),
    "ORIRPY": ((2, 2), (1, 1), (0, 0)),
    "ORIRPY2": ((0, 2), (1, 1), (2, 0)),
}
#: Machine data of the virtual axes of ORIVIRT1 and ORIVIRT2: 1, 2, 3 are X, Y, Z.
TURN_TABLES = {"ORIVIRT1": "$MC_ORIAX_TURN_TAB_1", "ORIVIRT2": "$MC_ORIAX_TURN_TAB_2"}
#: A surface normal misses being square on the path by as much (cosine) where no machine datum says.
SQUARE = 0.9
#: Directions that differ by less (radians) are the same.
SAME = 1e-6


# ---- the end


def target_of(
    posture: Posture, state: Orienting, words: Words, mode: Mode, values: Values, path: TipPath, kind: str
) -> Vector | None:
    """The direction at the end of a block; None where its words do not say.

    Raises:
        AlarmError: 14116 for a direction while ORIPATH is active, 14121 for a vector without length.
    """
    by_path = kind in BY_PATH
    if by_path and any(digit in words.triples for digit in (ANGLES, DIRECTION)):
        raise AlarmError("14116")
    leans = by_path or "LEAD" in words.single or "TILT" in words.single
    if not leans and (FIRST_NORMAL in words.triples or LAST_NORMAL in words.triples):
        _normals(posture, state, words, values)
    vector = words.vector(values, DIRECTION)
    if vector is not None:
        return posture.basic(vector)
    if ANGLES in words.triples:
        turned = frame_of_angles(posture, words, mode, values)
        return posture.basic(turned.direct(*posture.point.kinematics.along))
    _note_angles(state, words, values)
    if by_path:
        return None
    if "LEAD" in words.single or "TILT" in words.single:
        tangent = tangent_of(posture, path, 1.0)
        normal = _normals(posture, state, words, values)(1.0)
        if tangent is None:
            return None
        if abs(dot(normal, tangent)) > SQUARE:
            raise AlarmError("14115")
        return leaned(tangent, normal, state.lead, state.tilt, about_normal=_tilts_about_normal(posture))
    if words.columns:
        return posture.direction(posture.angles(path.at(1.0)))
    return None


def frame_of_angles(posture: Posture, words: Words, mode: Mode, values: Values) -> Frame:
    """How A2, B2, C2 turn the tool, by group 50 or machine data (6.2.4)."""
    channel = posture.channel
    a, b, c = words.vector(values, ANGLES) or (0.0, 0.0, 0.0)
    given, definition = (a, b, c), definition_of_angles(channel, mode)
    if definition == "ORIAXPOS":
        kinematics = posture.point.kinematics
        for letter, value in zip(LETTERS, given, strict=True):
            if value and not any(axis.startswith(letter) for axis in kinematics.axes):
                raise AlarmError("12050", axis=f"{letter}2")
        named = {axis: given[LETTERS.index(axis[0])] for axis in kinematics.axes if axis[0] in LETTERS}
        turned = kinematics.work_turn(named).inverse() @ kinematics.head_turn(named)
        return Frame(turned.m)
    order = ORDERS.get(definition)
    if order is None:
        data, table = channel.memory.data, TURN_TABLES[definition]
        axes = [int(data.number(table, i)) if data.is_set(table, i) else i + 1 for i in range(3)]
        order = tuple((axis - 1, i) for i, axis in enumerate(axes) if 1 <= axis <= 3)
    return by_own_axes((axis, given[letter]) for axis, letter in order) if order else IDENTITY


def definition_of_angles(channel: SinumerikChannel, mode: Mode) -> str:
    """The function of group 50 that holds; MD21102 and MD21103 both 0: Euler or RPY angles by MD21100."""
    data = channel.memory.data
    by_axes = data.integer("$MC_ORI_DEF_WITH_G_CODE")
    told = data.is_set("$MC_ORI_DEF_WITH_G_CODE") and not data.is_set("$MC_ORI_ANGLE_WITH_G_CODE")
    by_code = by_axes or (data.integer("$MC_ORI_ANGLE_WITH_G_CODE") and not told)
    if by_code:
        return mode["orientation_angles"]
    return "ORIEULER" if data.integer("$MC_ORIENTATION_IS_EULER") else "ORIRPY"


def _note_angles(state: Orienting, words: Words, values: Values) -> None:
    """LEAD and TILT hold for later blocks too."""
    lead, tilt = words.value(values, "LEAD"), words.value(values, "TILT")
    state.lead = state.lead if lead is None else lead
    state.tilt = state.tilt if tilt is None else tilt


def _tilts_about_normal(posture: Posture) -> bool:
    """MD21094, tens: TILT turns about the normal; else about the path (6.5.1)."""
    return posture.channel.memory.data.integer("$MC_ORIPATH_MODE") // 10 % 10 == 1


def tangent_of(posture: Posture, path: TipPath, part: float) -> Vector | None:
    """Direction in which the tip goes after a part of its way; None where it stands still."""
    return unit_of(posture.seated.frame.direct(*path.direction(part)))


def _normals(posture: Posture, state: Orienting, words: Words, values: Values) -> Way:
    """The surface normal along a block: constant with A4 alone, else on a great circle (6.2.5)."""
    first, last = words.vector(values, FIRST_NORMAL), words.vector(values, LAST_NORMAL)
    begin = state.normal if first is None else posture.normal(first)
    end = begin if last is None else posture.normal(last)
    state.first_normal, state.normal = begin, end
    frame = posture.seated.frame
    return great_circle_between(unit(frame.direct(*begin)), unit(frame.direct(*end)))


# ---- the way


def way_of(
    posture: Posture,
    state: Orienting,
    words: Words,
    values: Values,
    path: TipPath,
    kind: str,
    target: Vector | None,
    near: Angles,
) -> Way | None:
    """The way of the direction along a block; None where the rotary axes go evenly, or nothing turns."""
    start = posture.direction(near)
    turning, aside = words.coefficients(values, "PHI"), words.coefficients(values, "PSI")
    if kind == "ORIAXES":
        return None
    if kind in CONES:
        return _cone(posture, state, words, values, start, target, kind)
    if kind == "ORICURVE":
        return _second_curve(posture, state, words, values, path, start)
    if target is None or (angle_between(start, target) < SAME and not aside):
        return None
    way = great_circle(start, target, turning, aside)
    if way is None:
        raise AlarmError("14120")
    return way


def _cone(
    posture: Posture,
    state: Orienting,
    words: Words,
    values: Values,
    start: Vector,
    target: Vector | None,
    kind: str,
) -> Way | None:
    """ORICONCW, ORICONCCW, ORICONTO, ORICONIO (6.2.8).

    Raises:
        AlarmError: 14117 without axis and opening, 14118 without an end, 14119 without a direction between, 14123 for
            an opening that start and end do not have, 14124 without a tangent to begin with.
    """
    turning, opening = words.coefficients(values, "PHI"), words.coefficients(values, "PSI")
    named = words.vector(values, AXIS)
    axis = None if named is None else posture.basic(named)
    if kind == "ORICONIO":
        return _through(posture, words, values, start, target)
    if kind == "ORICONTO":
        target = axis if target is None else target
        if target is None:
            raise AlarmError("14118")
        if state.tangent is None:
            raise AlarmError("14124")
        found = axis_of_tangent(start, state.tangent, target)
        if found is None:
            return great_circle(start, target)
        return cone(found, start, target, about(found, start, target, 1), turning, opening)
    sense = SENSES[kind]
    if axis is not None:
        end = start if target is None else target
        angle = about(axis, start, end, sense, whole=target is None)
        return cone(axis, start, end, angle, turning, opening)
    nut = words.value(values, "NUT")
    if nut is None:
        raise AlarmError("14117")
    if target is None:
        raise AlarmError("14118")
    side = sense if nut >= 0.0 else -sense
    axis = axis_of_opening(start, target, radians(abs(nut)), side)
    if axis is None:
        raise AlarmError("14123")
    return cone(axis, start, target, about(axis, start, target, sense), turning, opening)


def _through(
    posture: Posture, words: Words, values: Values, start: Vector, target: Vector | None
) -> Way | None:
    """ORICONIO: over a direction between; in a plane where that is one of the ends."""
    named = words.vector(values, BETWEEN)
    if named is None:
        raise AlarmError("14119")
    if target is None:
        raise AlarmError("14118")
    middle = posture.basic(named)
    axis = axis_through(start, middle, target)
    if axis is None or min(angle_between(middle, start), angle_between(middle, target)) < SAME:
        way = great_circle(start, target)
        if way is None:
            raise AlarmError("14120")
        return way
    turning, opening = words.coefficients(values, "PHI"), words.coefficients(values, "PSI")
    return cone(axis, start, target, about(axis, start, target, 1), turning, opening)


def _second_curve(
    posture: Posture, state: Orienting, words: Words, values: Values, path: TipPath, start: Vector
) -> Way | None:
    """ORICURVE: the tool leads through a second point, whose curve XH, YH, ZH and PO[XH] … tell (6.2.9).

    Where the tool does not lead through the last one any more, it begins a millimetre along the tool from the tip.
    """
    channel, factor = posture.channel, length_factor(posture.channel.mode)
    columns = posture.seated.geometry
    x, y, z = (path.at(0.0)[i] for i in columns)
    first = (x, y, z)
    given = {**words.second, **words.polynomials}
    if not any(name in given for name in SECOND):
        return None
    back = posture.seated.frame.inverse()
    along = unit_of(back.direct(*start)) or start
    second = state.second or first
    leads = unit_of((second[0] - first[0], second[1] - first[1], second[2] - first[2]))
    if leads is None or angle_between(leads, along) > SAME:
        second = (first[0] + along[0], first[1] + along[1], first[2] + along[2])
    curves = []
    goal = []
    for i, name in enumerate(SECOND):
        numbers = tuple(each * factor for each in words.coefficients(values, name))
        if name in words.second:
            value = values[words.second[name]]
            if not isinstance(value, (int, float)):
                raise WordAlarm("12150", words.second[name], text=name)
            numbers = (float(value) * factor, *numbers[1:])
        end = numbers[0] if numbers else second[i]
        if numbers and channel.mode["distance"] == "G91":
            end += second[i]
        goal.append(end)
        curves.append(polynomial(second[i], end, numbers[1:]))
    state.second = (goal[0], goal[1], goal[2])

    def at(u: float) -> Vector:
        x, y, z = (curve(u) for curve in curves)
        return (x, y, z)

    def tip(u: float) -> Vector:
        x, y, z = (path.at(u)[i] for i in columns)
        return (x, y, z)

    way = between_curves(tip, at)
    frame = posture.seated.frame
    return lambda u: unit_of(frame.direct(*way(u))) or start


def along_path(posture: Posture, state: Orienting, words: Words, values: Values, path: TipPath) -> Way | None:
    """ORIPATH, ORIPATHS: LEAD and TILT hold all along the block (6.5); None where the tip stands still.

    Raises:
        AlarmError: 14115 for a normal along the path.
    """
    tangents = [tangent_of(posture, path, part) for part in (0.0, 1.0)]
    if None in tangents:
        return None
    normals = _normals(posture, state, words, values)
    if max(abs(dot(normals(u), t)) for u, t in enumerate(tangents) if t is not None) > SQUARE:
        raise AlarmError("14115")
    leads = polynomial(state.lead, state.lead, words.coefficients(values, "PHI"))
    tilts = polynomial(state.tilt, state.tilt, words.coefficients(values, "PSI"))
    about_normal = _tilts_about_normal(posture)

    def way(u: float) -> Vector:
        tangent = tangent_of(posture, path, u) or (0.0, 0.0, 0.0)
        return leaned(tangent, normals(u), leads(u), tilts(u), about_normal=about_normal)

    return way


def great_circle_between(start: Vector, end: Vector) -> Way:
    """The great circle; 14120 for opposite directions."""
    way = great_circle(start, end)
    if way is None:
        raise AlarmError("14120")
    return way
