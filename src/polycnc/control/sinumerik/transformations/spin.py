"""Spin of the tool about its own axis: THETA, ORIROTA, ORIROTR, ORIROTT, ORIROTC (6.4, 6.5.3).

A machine has it where the last rotary joint of the head turns about the tool. THETA is the angle from a reference,
about the direction of the tool: of ORIROTA the X axis of the tool as it is carried along when the tool leaves its basic
direction the shortest way; of ORIROTR and ORIROTT the direction into which the tool turns; of ORIROTC that of the path.
"""

from __future__ import annotations

from math import atan2, degrees

from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.transformations.directions import tangent_of
from polycnc.control.sinumerik.transformations.words import ANGLES
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.vectors import cross, dot, minus, times
from polycnc.machine.kinematics import turn_about, unit
from polycnc.messages import AlarmError
from polycnc.transformation.orientation.choice import on_nearest_turn
from polycnc.transformation.orientation.directions import angle_between, polynomial, unit_of
from polycnc.transformation.orientation.turning import Knot

if TYPE_CHECKING:
    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import TipPath, Values
    from polycnc.control.sinumerik.transformations.posture import Orienting, Posture
    from polycnc.control.sinumerik.transformations.words import Words
    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles

#: Pieces in which the spin is followed along a block.
PIECES = 16
SAME = 1e-6
ALONG_PATH = "ORIROTC"


def axis_of(posture: Posture) -> str:
    """The rotary axis that spins the tool; empty for none."""
    kinematics = posture.point.kinematics
    if len(kinematics.tool) + len(kinematics.work) < 3 or not kinematics.tool:
        return ""
    last = kinematics.tool[-1]
    return last.axis if angle_between(unit(last.direction), kinematics.along) < SAME else ""


def turned(
    posture: Posture,
    state: Orienting,
    words: Words,
    mode: Mode,
    values: Values,
    path: TipPath,
    near: Angles,
    knots: list[Knot],
) -> list[Knot]:
    """The knots of a block with the spin that it tells.

    Raises:
        AlarmError: 14125 for THETA on a machine that cannot spin the tool, 14128 for a spin by positions or angles
            while ORIROTC is active; PC0001 for an edge with a normal of its own, from which the angle would count.
    """
    axis, code = axis_of(posture), mode["rotation_vector"]
    tells = "THETA" in words.single or "THT" in words.polynomials
    if not axis:
        if tells or code == ALONG_PATH:
            raise AlarmError("14125")
        return knots
    if code == ALONG_PATH and (posture.column(axis) in words.columns or ANGLES in words.triples):
        raise AlarmError("14128")
    if not tells and code != ALONG_PATH:
        return knots
    edge = posture.channel.memory.tools.edge
    if edge is not None and edge.has_normal:
        raise not_supported("$TC_DPVN3: THETA")
    start, end = (posture.direction(each) for each in (near, knots[-1].angles))
    moves = angle_between(start, end) > SAME
    tangent = tangent_of(posture, path, 0.0)
    absolute = (
        code == "ORIROTA" or (code != ALONG_PATH and not moves) or (code == ALONG_PATH and tangent is None)
    )
    into = unit_of(cross(start, end))
    before = state.theta if code == ALONG_PATH else _theta(words, mode, values, state)
    if absolute:  # blocks without THETA, and positions of the axis, have turned it from where it was told
        stands = near[axis] - _spin(posture, near, axis, _carried(posture, start), 0.0)
        before = on_nearest_turn(stands, state.theta)
    state.theta = _theta(words, mode, values, state)
    angle = polynomial(before, state.theta, _higher(words, values))
    found: list[Knot] = []
    last = near[axis]
    for share in sorted({*(k / PIECES for k in range(1, PIECES + 1)), *(knot.share for knot in knots)}):
        angles = _between(near, knots, share)
        along = posture.direction(angles)
        if code == ALONG_PATH and not absolute:
            reference = _across(tangent_of(posture, path, share) or along, along)
        elif absolute or into is None:
            reference = _carried(posture, along)
        else:
            reference = _across(cross(into, along), along)
        last = on_nearest_turn(_spin(posture, angles, axis, reference, angle(share)), last)
        found.append(Knot(share, {**angles, axis: last}))
    return found if _bends(near, found) else found[-1:]


def _theta(words: Words, mode: Mode, values: Values, state: Orienting) -> float:
    """The angle at the end of the block: absolute or by an increment, as G90, G91, AC and IC say.

    Without THETA a polynomial begins with the angle at its end (6.4, example).
    """
    value, numbers = words.value(values, "THETA"), words.coefficients(values, "THT")
    if value is None:
        return numbers[0] if len(numbers) > 1 else state.theta
    by_increment = words.theta == "IC" or (mode["distance"] == "G91" and words.theta != "AC")
    return state.theta + value if by_increment else value


def _higher(words: Words, values: Values) -> tuple[float, ...]:
    """The coefficients of THETA from the second degree on."""
    numbers = words.coefficients(values, "THT")
    return numbers[1:] if "THETA" not in words.single and len(numbers) > 1 else numbers


def _across(direction: Vector, along: Vector) -> Vector:
    """A direction, square on the tool."""
    return unit_of(minus(direction, times(along, dot(direction, along)))) or (1.0, 0.0, 0.0)


def _carried(posture: Posture, along: Vector) -> Vector:
    """The X axis of the tool, carried along the shortest way from the basic direction."""
    drawn = posture.point.kinematics.along
    axis = unit_of(cross(drawn, along))
    x = _drawn_x(posture)
    return x if axis is None else turn_about(axis, degrees(angle_between(drawn, along))).direct(*x)


def _drawn_x(posture: Posture) -> Vector:
    """The X axis of the tool in its basic position; of a tool along X its Y axis."""
    drawn = posture.point.kinematics.along
    x = (1.0, 0.0, 0.0) if abs(drawn[0]) < 0.9 else (0.0, 1.0, 0.0)
    return unit_of(minus(x, times(drawn, dot(x, drawn)))) or x


def _spin(posture: Posture, angles: Angles, axis: str, reference: Vector, theta: float) -> float:
    """Angle of the spinning axis that stands the X axis of the tool at an angle from a reference."""
    kinematics = posture.point.kinematics
    still = {**angles, axis: 0.0}
    turn = kinematics.work_turn(still).inverse()
    x = turn.direct(*kinematics.head_turn(still).direct(*_drawn_x(posture)))
    along = posture.direction(angles)
    return theta + degrees(atan2(dot(along, cross(x, reference)), dot(x, reference)))


def _between(near: Angles, knots: list[Knot], share: float) -> dict[str, float]:
    """Angles after a share of the block, evenly between knots."""
    first = Knot(0.0, dict(near))
    for knot in knots:
        if share <= knot.share:
            part = (share - first.share) / (knot.share - first.share)
            return {a: v + (knot.angles[a] - v) * part for a, v in first.angles.items()}
        first = knot
    return dict(knots[-1].angles)


def _bends(near: Angles, knots: list[Knot]) -> bool:
    """Whether the axes do not go evenly all the way."""
    last = knots[-1]
    return any(
        abs(knot.angles[a] - (near[a] + (last.angles[a] - near[a]) * knot.share)) > SAME
        for knot in knots
        for a in last.angles
    )
