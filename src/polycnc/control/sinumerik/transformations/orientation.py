"""Where the words of orientation lead: the rotary axes at the end of a block, and on the way there (6.2.4 to 6.3).

Directions are those of the basic system. Words name them in the work (ORIWKS), which a frame may have turned, or in the
basic system itself (ORIMKS). Along the way the direction follows a great circle, a cone or a curve (`directions`), or
the axes go evenly.
"""

from __future__ import annotations

from itertools import pairwise
from math import degrees, dist, nan

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move
from polycnc.channel.moves.turning import TurningStage
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.motion.polynomial_groups import DIRECTION, PolynomialGroups
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations import directions, seat, spin, standing
from polycnc.control.sinumerik.transformations.posture import Orienting, Posture
from polycnc.control.sinumerik.transformations.words import (
    BY_PATH,
    CONES,
    FIRST_NORMAL,
    LAST_NORMAL,
    RETRACTION,
    SECOND,
    Words,
    take,
)
from polycnc.control.sinumerik.transformations.words import DIRECTION as END_DIRECTION
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Idle, declare
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.transformation.orientation.choice import nearest
from polycnc.transformation.orientation.directions import angle_between, tangent_at_end, unit_of
from polycnc.transformation.orientation.turning import Course, Knot, Turning, follow

if TYPE_CHECKING:
    from array import array

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.block.draft import Draft, TipPath, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector
    from polycnc.machine.kinematics import Angles
    from polycnc.transformation.orientation.directions import Way

#: Motions along which the direction has a way of its own; along splines and threads the axes go evenly.
LEADS = ("G0", "G1", "POLY", "G2", "G3", "CIP", "CT", "INVCW", "INVCCW")
#: Those that bend in a way that ORICURVE does not go along with, and that move even where they end where they began.
ROUND = LEADS[3:]
#: Those that are written as chords.
IN_CHORDS = ("POLY", "INVCW", "INVCCW")
#: With these ORICURVE is not allowed either (6.2.9).
NOT_WITH_CURVES = (*ROUND, "ASPLINE", "CSPLINE")
#: Angles that differ by less are the same, degrees.
SAME_DEG = 1e-6
#: Directions that differ by less are the same, radians.
SAME = 1e-6
#: Functions of group 34 that turn the tool at the start of a block, and whether also at its end.
AT_ENDS = {"OSS": False, "OSSE": True}
#: Functions of group 22 for which the tool keeps its direction, with or without a transformation.
WITHOUT_TURNING = ("CUT3DFS", "CUT3DFF")


# ---- while a block is worked out


def plan(draft: Draft) -> None:
    """Take the words of orientation of a block, which then leads its goal.

    Raises:
        AlarmError: 14101 where no orientation transformation acts, PC0001 for a cone where the axes go evenly.
    """
    acts = draft.mode[seat.GROUP] in ("TRAORI", "TRACON")
    point = seat.centre_point(draft.channel) if acts else None
    axes = frozenset() if point is None else frozenset(point.axes.index(a) for a in point.kinematics.axes)
    virtual = point is not None and bool(draft.memory.data.integer("$MC_ORI_DEF_WITH_G_CODE"))
    virtual = virtual and draft.mode["orientation_angles"] != "ORIAXPOS"
    words = take(draft, axes, acts=point is not None, virtual=virtual)
    if words is None:
        return
    if point is None and _tells_a_surface(draft, words):
        draft.lead = lambda channel, values, end, _path: surface(channel, words, values, end)
        return
    if point is None:
        raise AlarmError("14101")
    mode = draft.mode
    by_path = mode["orientation_motion"] in BY_PATH or mode["rotation_vector"] == "ORIROTC"
    if by_path and mode["orientation_smoothing"] != "OSOF":
        raise AlarmError("14133", text=mode["orientation_smoothing"])
    if words.columns and not _is_way(words) and not _matters(mode, draft):
        return
    kind = interpolation(mode, draft.channel, by_axes=bool(words.columns))
    if words.tells_cone and (kind not in CONES or is_point_to_point(mode)):
        raise not_supported(f"{mode['motion']}: {mode['orientation_motion']}")
    _check_polynomials(words, mode, kind)
    draft.lead = lambda channel, values, end, path: turn(channel, words, mode, values, end, path)
    draft.direction = standing.places_of(words, mode, interpolation(mode, draft.channel))


def _check_polynomials(words: Words, mode: Mode, kind: str) -> None:
    """Which polynomials and which second curve go with the motion and the interpolation (6.2.9, 6.3).

    Raises:
        AlarmError: 14136 for polynomials along a spline, 14137 for angles and 14138 for a second curve with another
            interpolation, 14134 for ORICURVE along circles, involutes, splines through points and the compressor.
    """
    second = any(name in words.second or name in words.polynomials for name in SECOND)
    if (
        second
        and kind == "ORICURVE"
        and (mode["motion"] in NOT_WITH_CURVES or mode["compressor"] != "COMPOF")
    ):
        compresses = mode["motion"] not in NOT_WITH_CURVES
        raise AlarmError("14134", text=mode["compressor"] if compresses else mode["motion"])
    if words.polynomials and mode["motion"] in ("ASPLINE", "BSPLINE", "CSPLINE"):
        raise AlarmError("14136", text=mode["motion"])
    if kind in ("ORIAXES", "ORICURVE") and not words.polynomials.keys().isdisjoint(("PHI", "PSI")):
        raise AlarmError("14137", text=kind)
    if second and mode["orientation_motion"] != "ORICURVE":
        raise AlarmError("14138", text=mode["orientation_motion"])


def _tells_a_surface(draft: Draft, words: Words) -> bool:
    """Whether a block without a transformation has normals for a face mill that keeps its direction, and no more."""
    others = words.single or words.second or words.polynomials or words.columns
    normals = {FIRST_NORMAL, LAST_NORMAL} >= words.triples.keys()
    return draft.mode["tool_offset"] in WITHOUT_TURNING and normals and not others


def surface(channel: SinumerikChannel, words: Words, values: Values, end: list[float]) -> list[float]:
    """The normals of a block whose tool keeps its direction; it goes where it is programmed."""
    state = Orienting.of(channel)
    first, last = words.vector(values, FIRST_NORMAL), words.vector(values, LAST_NORMAL)
    found = [None if each is None else unit_of(each) for each in (first, last)]
    if (first is not None and found[0] is None) or (last is not None and found[1] is None):
        raise AlarmError("14121")
    state.first_normal = found[0] or state.normal
    state.normal = found[1] or state.first_normal
    return end


def check(draft: Draft) -> None:
    """PC0001 for a block whose words of orientation no motion takes."""
    if draft.lead is not None and not draft.is_led:
        raise not_supported(f"{draft.mode['motion']}: {draft.mode['orientation_motion']}")


def _is_way(words: Words) -> bool:
    """Whether a block has more to say of the direction than positions of its axes."""
    return bool(words.triples or words.single or words.second or words.polynomials)


def _matters(mode: Mode, draft: Draft) -> bool:
    """Whether axes that are named themselves are led along a way of the direction."""
    return (
        interpolation(mode, draft.channel, by_axes=True) != "ORIAXES"
        or mode["rotation_vector"] == "ORIROTC"
        or mode["orientation_smoothing"] in AT_ENDS
    )


def interpolation(mode: Mode, channel: SinumerikChannel, *, by_axes: bool = False) -> str:
    """The function of group 51 by which the direction goes; MD21104 says whether group 25 decides (6.2.6).

    `by_axes`: the block names the positions of its rotary axes: group 25 does not concern them.
    """
    code = mode["orientation_motion"]
    if mode["motion"] not in LEADS:
        return "ORIAXES"
    if code in (*CONES, *BY_PATH, "ORICURVE"):
        return code
    if channel.memory.data.integer("$MC_ORI_IPO_WITH_G_CODE"):
        return "ORIAXES" if code == "ORIAXES" else "ORIVECT"
    return "ORIAXES" if by_axes or mode["orientation_reference"] == "ORIMKS" else "ORIVECT"


def finish(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
    """The block has moved: the next one turns the tool by itself, and begins with the normal that holds now."""
    channel.turning = None
    state = Orienting.of(channel)
    state.first_normal = state.normal


declare(finish, Idle())  # behind a block that the scanner takes all this is so already


def turn(
    channel: SinumerikChannel,
    words: Words,
    mode: Mode,
    values: Values,
    end: list[float],
    path: TipPath | None,
) -> list[float]:
    """Where a block ends whose tip goes to `end`; the way of the rotary axes there is `channel.turning`.

    `path` is the way of the tip; None for a straight one.
    """
    posture, state = Posture.of(channel, mode), Orienting.of(channel)
    start = channel.coordinates.position
    if path is None:
        path = MovePath(Move(Kind.FEED, start, end), channel.coordinates.geometry)
    words = words._replace(bends=DIRECTION in PolynomialGroups.of(channel).acting)
    quick = _by_little(channel, words, mode, values, end)
    if quick is not None:
        return quick
    kind = interpolation(mode, channel, by_axes=bool(words.columns))
    target = directions.target_of(posture, state, words, mode, values, path, kind)
    near, way, angles = posture.angles(start), None, None
    if is_point_to_point(mode):
        angles = _configured(posture, state, target, near)
    elif kind in BY_PATH:
        way = _along_path(posture, state, words, mode, values, path)
        near = posture.angles(channel.coordinates.position)
    else:
        way = directions.way_of(posture, state, words, values, path, kind, target, near)
    if way is not None:
        knots = follow(posture.point.kinematics, way, near, posture.reaches, standing.pole_limit(channel))
        if knots is None:
            raise AlarmError("14112")
        state.tangent = tangent_at_end(way)
    elif angles is not None:
        knots = [Knot(1.0, angles)]
    elif target is not None and not words.columns:
        knots = [Knot(1.0, nearest(posture.standing(target, near), near) or near)]
    else:
        knots = [Knot(1.0, posture.angles(end))]
    knots = _as_named(posture, words, end, knots)
    knots = spin.turned(posture, state, words, mode, values, path, near, knots)
    if kind == "ORIAXES":  # relative to the path the tool spins at the end of the block alone (6.5.3)
        knots = knots[-1:]
    course = _course(posture, mode, near, knots, (start, end))
    return _placed(channel, posture, mode, knots, end, course)


def _by_little(
    channel: SinumerikChannel, words: Words, mode: Mode, values: Values, end: list[float]
) -> list[float] | None:
    """The end of a block that names a direction and turns the tool by little, as scanned ones have; None for others."""
    kind = interpolation(mode, channel)
    vector = words.vector(values, END_DIRECTION)
    if vector is None or standing.places_of(words, mode, kind) is None:
        return None
    return standing.turned_end(channel, mode, kind, vector, end)


def _straight_mode(channel: SinumerikChannel) -> Mode:
    """The modal state for straight blocks."""
    return channel.mode if channel.mode["motion"] in LEADS else channel.mode.with_code("motion", "G1")


def tool_record(channel: SinumerikChannel) -> array[float]:
    """What the scanner must know to turn the tool in straight blocks."""
    mode = _straight_mode(channel)
    return standing.record_of(channel, mode, interpolation(mode, channel))


def note_turn(channel: SinumerikChannel, start: list[float], end: list[float]) -> None:
    """The scanner has turned the tool: remember how the last block did, as `turn` does."""
    mode = _straight_mode(channel)
    if interpolation(mode, channel) == "ORIVECT":
        standing.note_tangent(channel, mode, start, end)


def _course(
    posture: Posture, mode: Mode, near: Angles, knots: list[Knot], ends: tuple[list[float], list[float]]
) -> Course | None:
    """On which part of the block the tool turns: OSS, OSSE at the rate ORIS (7.6); None for all of it."""
    both, rate = AT_ENDS.get(mode["orientation_smoothing"]), Orienting.of(posture.channel).rate
    moves = dist(posture.tip(ends[0]), posture.tip(ends[1])) > 0.0 or mode["motion"] in ROUND
    if both is None or rate <= 0.0 or not moves or mode["motion"] not in LEADS:
        return None
    angles = [near, *(knot.angles for knot in knots)]
    tools = [posture.direction(each) for each in angles]
    turned = degrees(sum(angle_between(a, b) for a, b in pairwise(tools)))
    spun = max(abs(knots[-1].angles[axis] - near[axis]) for axis in posture.point.kinematics.axes)
    return Course(turned if turned > SAME_DEG else spun, rate, both)


def _along_path(
    posture: Posture, state: Orienting, words: Words, mode: Mode, values: Values, path: TipPath
) -> Way | None:
    """The way of ORIPATH; where the block before has left the direction otherwise, over on a great circle.

    Under ORIPATHS the tool turns on the spot first, away from the work by A8, B8, C8 (6.5.4).
    """
    channel = posture.channel
    start = channel.coordinates.position
    way = directions.along_path(posture, state, words, values, path)
    standing = posture.direction(posture.angles(start))
    if way is None or angle_between(standing, way(0.0)) < SAME:
        return way
    if mode["orientation_motion"] == "ORIPATH":
        return directions.great_circle_between(standing, way(1.0))
    near = posture.angles(start)
    angles = nearest(posture.standing(way(0.0), near), near) or near
    rapid = mode["motion"] == "G0"
    turned = start.copy()
    for axis, angle in angles.items():
        turned[posture.column(axis)] = posture.place(axis, angle)
    retraction = words.vector(values, RETRACTION)
    points = [turned]
    if retraction is not None and any(retraction):
        away = [(a + b) / 2.0 for a, b in zip(start, turned, strict=True)]
        for column, part in zip(posture.seated.geometry, retraction, strict=True):
            away[column] += part * length_factor(mode)
        points = [away, turned]
    for point in points:
        channel.straight(Kind.RAPID if rapid else Kind.FEED, point, nan if rapid else channel.feed)
    return way


def is_point_to_point(mode: Mode) -> bool:
    """Whether a straight block goes with the axes of the machine (PTP, PTPG0)."""
    code, rapid = mode["point_to_point"], mode["motion"] == "G0"
    if code == "PTPG0":
        return rapid and mode["compensation"] == "G40"
    return code == "PTP" and mode["motion"] in ("G0", "G1")


def _configured(
    posture: Posture, state: Orienting, target: Vector | None, near: Angles
) -> dict[str, float] | None:
    """Of two solutions the nearer one, or with STAT=1 the other one (6.9)."""
    if target is None:
        return None
    found = posture.standing(target, near)
    ordered = sorted(found, key=lambda each: round(sum(abs(each[a] - near[a]) for a in each), 6))
    chosen = ordered[-1] if state.stat & 1 else ordered[0]
    return {axis: _forward(angle, near[axis]) for axis, angle in chosen.items()}


def _forward(angle: float, near: float) -> float:
    """A half turn goes forward."""
    return angle + 360.0 if abs(angle - near + 180.0) < SAME_DEG else angle


def _as_named(posture: Posture, words: Words, end: list[float], knots: list[Knot]) -> list[Knot]:
    """Axes that the block names itself end where it says; along another solution they go evenly.

    Raises:
        AlarmError: PC0001 where that would leave out the cone that the block tells.
    """
    if not words.columns:
        return knots
    named, last = posture.angles(end), knots[-1].angles
    if all(abs(named[axis] - last[axis]) < SAME_DEG for axis in named):
        return knots
    if words.tells_cone:
        kind = posture.channel.mode["orientation_motion"]
        raise not_supported(f"{kind}: {' '.join(posture.point.kinematics.axes)}")
    return [Knot(1.0, named)]


def _placed(
    channel: SinumerikChannel,
    posture: Posture,
    mode: Mode,
    knots: list[Knot],
    end: list[float],
    course: Course | None,
) -> list[float]:
    """The end of the block with its rotary axes; several knots, or a course of its own, are the turning of its move."""
    columns = tuple(posture.column(axis) for axis in posture.point.kinematics.axes)
    end = end.copy()
    for column, place in zip(columns, posture.places(knots[-1].angles), strict=True):
        end[column] = place
        channel.coordinates.pending[column] = 0.0
    channel.turning = None
    if len(knots) > 1 or course is not None or mode["motion"] in IN_CHORDS:
        shares, places = zip(*((knot.share, posture.places(knot.angles)) for knot in knots), strict=True)
        channel.turning = Turning(columns, shares, places, course)
        if channel.path.find(TurningStage) is None:
            channel.path.put(TurningStage(channel))
    return end
