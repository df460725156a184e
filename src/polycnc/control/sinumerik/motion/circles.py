"""Arcs: G2 and G3 with centre, radius, opening angle or polar coordinates, helices, CIP and CT.

Source: Fundamentals (G2/G3, I J K, CR, AR, AP RP, TURN, CIP, CT).
"""

from __future__ import annotations

from functools import partial
from math import cos, hypot, pi, radians, sin

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Move
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block import plain
from polycnc.control.sinumerik.block.outside_feeds import take_block_feed
from polycnc.control.sinumerik.block.positions import Dimension, is_diameter, number, target
from polycnc.control.sinumerik.motion import moves
from polycnc.control.sinumerik.motion.last_move import ArcOfMove, LastMove
from polycnc.control.sinumerik.motion.polar import Polar
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.tools.tool_plane import CHORD_ERROR_MM, bends_arcs
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.language.bulk import Arc as ArcAsData
from polycnc.language.bulk import declare
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import CCW_KINDS, arc_kind

with loaded_when_called():
    from polycnc.channel.moves import knots
    from polycnc.channel.moves.chord_path import ChordPath
    from polycnc.control.sinumerik.motion import contour_reading

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.geometry.frames import Vector

LETTERS = "IJK"


class RoundACentre:
    """A block that goes round a centre in the plane.

    Attributes:
        columns: Columns of the plane's axes, the third may be -1.
        axes: Its geometry axes.
        factor: From a programmed length to mm.
        centre: The words of the centre.
    """

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self.columns = moves.plane_columns(draft)
        self.axes = PLANES[draft.mode["plane"]]
        self.factor = length_factor(draft.mode)
        self.centre = centre_words(draft, LETTERS)

    def programmed_centre(self, channel: SinumerikChannel, values: Values, begin: arcs.Point) -> arcs.Point:
        """Centre from I, J, K: from the start point, or absolute with AC."""
        shift, absolute = [0.0, 0.0], dict[int, float]()
        for index, position, modifier in self.centre:
            if index not in self.axes[:2]:
                raise AlarmError("14040")
            i = self.axes.index(index)
            value = number(values, position)
            if modifier == "AC":
                absolute[i] = value * absolute_factor(channel, self.draft, self.columns[i])
            else:
                shift[i] = value * self.factor
        u, v = (absolute.get(i, begin[i] + shift[i]) for i in (0, 1))
        return u, v


class Arc(RoundACentre):
    """A G2 or G3 block, worked out for its words.

    Attributes:
        ccw: Sense of rotation.
    """

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.ccw = draft.mode["motion"] == "G3"
        self.feed = take_block_feed(draft) if draft.has("FB", "FD") else None
        self.feed_factor = moves.feed_factor(draft)
        self.polar = draft.take_shape("AP", "AC", "IC"), draft.take_shape("RP", "AC", "IC")
        self.radius, self.angle, self.turn = draft.take("CR"), draft.take("AR"), draft.take("TURN")
        self.terms = draft.take_axes()
        self.lead = draft.take_lead()

    @property
    def is_motion(self) -> bool:
        """Whether the block names an arc at all."""
        alone = (self.radius, self.angle, self.turn)
        return bool(self.terms or self.centre or any(self.polar) or any(word is not None for word in alone))

    def as_data(self) -> ArcAsData | None:
        """The arc as the scanner knows it: end point, and centre from the start or radius; None for any other."""
        beside = (self.feed, self.angle, self.turn, *self.polar)
        targets = plain.targets(self.terms)
        if targets is None or self.lead is not None or any(word is not None for word in beside):
            return None
        if any(modifier or index not in self.axes[:2] for index, _, modifier in self.centre):
            return None
        centers = {index: plain.length(position, self.factor) for index, position, _ in self.centre}
        radius = None if self.radius is None else plain.length(self.radius, self.factor)
        first, second = (centers.get(axis) for axis in self.axes[:2])
        return ArcAsData(self.ccw, self.axes, targets, (first, second), radius)

    def run(self, channel: SinumerikChannel, values: Values) -> None:
        """Check the arc and move along it."""
        start = channel.coordinates.position
        end = target(channel, self.terms, values)
        u, v = self.columns[:2]
        begin = (start[u], start[v])
        if any(self.polar):
            pole = self._pole(channel)
            center = self.programmed_centre(channel, values, begin) if self.centre else pole
            end[u], end[v] = self._polar_end(channel, values, begin, pole)
        elif self.angle is not None:
            center = self._by_angle(channel, values, begin, end)
        elif self.radius is not None:
            center = self._by_radius(values, begin, (end[u], end[v]), channel)
        elif not self.centre and contour_reading.takes_lines_for_arcs(channel):
            moves.line(channel, Kind.FEED, end, moves.checked_feed(channel.feed))
            return
        else:
            center = self.programmed_centre(channel, values, begin)
        check_end(channel, begin, (end[u], end[v]), center)
        turns = number(values, self.turn) if self.turn is not None else 0.0
        if not 0.0 <= turns <= 999.0 or turns != int(turns):
            raise AlarmError("14048")
        feed = channel.feed if self.feed is None else number(values, self.feed) * self.feed_factor
        if self.lead is not None:
            move = _arc(channel, self.columns, self.axes, end, center, self.ccw, turns)
            end = self.lead(channel, values, end, MovePath(move, channel.coordinates.geometry))
        arc(channel, self.columns, self.axes, end, center, moves.checked_feed(feed), self.ccw, turns)

    def _by_radius(
        self, values: Values, begin: arcs.Point, end: arcs.Point, channel: SinumerikChannel
    ) -> arcs.Point:
        """CR: positive for up to 180 degrees, negative for more; no full circle."""
        assert self.radius is not None
        radius = number(values, self.radius) * self.factor
        memory = channel.memory
        if hypot(end[0] - begin[0], end[1] - begin[1]) <= NO_WAY:
            raise AlarmError("14040")
        try:
            tolerance = memory.data.number("$MC_CIRCLE_ERROR_CONST")
            return arcs.center_from_radius(begin, end, radius, self.ccw, tolerance)
        except ValueError:
            raise AlarmError("14095") from None

    def _by_angle(
        self, channel: SinumerikChannel, values: Values, begin: arcs.Point, end: list[float]
    ) -> arcs.Point:
        """AR with the end point, or with the centre."""
        assert self.angle is not None
        angle = number(values, self.angle)
        if not 0.0 < angle < tables.TURN:
            raise AlarmError("14910")
        turned = radians(angle if self.ccw else -angle)
        u, v = self.columns[:2]
        named = any(term.column in (u, v) for term in self.terms)
        if self.centre:
            if named:
                raise AlarmError("14900")
            center = self.programmed_centre(channel, values, begin)
            end[u], end[v] = _turned(begin, center, turned)
            return center
        chord = hypot(end[u] - begin[0], end[v] - begin[1])
        if chord <= NO_WAY:
            raise AlarmError("14040")
        # The centre lies on the chord's bisector, at chord / (2·tan(angle/2)) to the left of the chord.
        height = 0.5 / _tan_half(turned)
        du, dv = end[u] - begin[0], end[v] - begin[1]
        return 0.5 * (begin[0] + end[u]) - height * dv, 0.5 * (begin[1] + end[v]) + height * du

    def _pole(self, channel: SinumerikChannel) -> arcs.Point:
        pole = Polar.of(channel).pole
        return pole[self.axes[0]], pole[self.axes[1]]

    def _polar_end(
        self, channel: SinumerikChannel, values: Values, begin: arcs.Point, center: arcs.Point
    ) -> tuple[float, float]:
        """The end point at angle AP; without RP the radius is the distance from the pole."""
        if self.polar[1] is None:
            Polar.of(channel).radius = arcs.radius_of(center, begin)
        return moves.polar_point(self.draft, channel, values, *self.polar)


def circle(draft: Draft) -> Step | None:
    """G2, G3: arc, full circle or helix in the plane; 12080 for CR beside another word that makes the arc, too."""
    planned = Arc(draft)
    if not planned.is_motion:
        return None
    others = planned.centre or planned.angle is not None or any(planned.polar)
    if planned.radius is not None and others:
        raise WordAlarm("12080", planned.radius, text="CR")
    if any(planned.polar) and planned.angle is not None:
        raise AlarmError("14280")
    told = planned.as_data()
    return planned.run if told is None else declare(partial(planned.run), told)


def centre_words(draft: Draft, letters: str) -> list[tuple[int, int, str]]:
    """I, J, K (or IP[axis]): geometry axis, place and modifier of each; 12010 for an axis that has both."""
    found = []
    for index, letter in enumerate(letters):
        taken = draft.take_shape(letter, "AC", "IC")
        if taken is not None:
            found.append((index, taken[0], taken[1].modifier))
    while (taken := draft.take_shape("IP", "AC", "IC")) is not None:
        axis = taken[1].index
        column = draft.memory.column(axis.name if isinstance(axis, Axis) else str(axis))
        geometry = draft.channel.coordinates.geometry
        if column not in geometry:
            raise AlarmError("12050", axis=str(axis))
        index = geometry.index(column)
        if any(index == each for each, _, _ in found):
            raise WordAlarm("12010", taken[0], text="IP")
        found.append((index, taken[0], taken[1].modifier))
    return found


def absolute_factor(channel: SinumerikChannel, draft: Draft, column: int) -> float:
    """From an absolute coordinate to mm: diameters of the transverse axis included."""
    factor = length_factor(draft.mode)
    if is_diameter(draft.mode, Dimension.ABSOLUTE, column, channel.memory.transverse):
        factor *= 0.5
    return factor


def check_end(channel: SinumerikChannel, begin: arcs.Point, end: arcs.Point, center: arcs.Point) -> None:
    """14040 if start and end are not equally far from the centre, or there is no radius.

    The difference may be MD21000, or MD21010 times the radius at the start where that is more (general knowledge).
    """
    data, radius = channel.memory.data, arcs.radius_of(center, begin)
    allowed = max(data.number("$MC_CIRCLE_ERROR_CONST"), data.number("$MC_CIRCLE_ERROR_FACTOR") * radius)
    if radius <= NO_WAY or abs(arcs.radius_mismatch(begin, end, center)) > allowed + 1e-9:
        raise AlarmError("14040")


def arc(
    channel: SinumerikChannel,
    columns: tuple[int, int, int],
    axes: tuple[int, int, int],
    end: list[float],
    center: arcs.Point,
    feed: float,
    ccw: bool,
    turns: float = 0.0,
) -> None:
    """Move along an arc of a plane; with a way along the third axis it is a helix."""
    _follow(channel, _arc(channel, columns, axes, end, center, ccw, turns), feed)


def _arc(
    channel: SinumerikChannel,
    columns: tuple[int, int, int],
    axes: tuple[int, int, int],
    end: list[float],
    center: arcs.Point,
    ccw: bool,
    turns: float = 0.0,
) -> Move:
    """The arc of a plane to a point."""
    start = channel.coordinates.position
    third = columns[2]
    rises = third >= 0 and abs(end[third] - start[third]) > NO_WAY
    space, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    space[axes[0]], space[axes[1]] = center
    space[axes[2]] = start[third] if third >= 0 else 0.0
    normal[axes[2]] = 1.0
    kind = arc_kind(ccw=ccw, helix=rises)
    return Move(kind, start, end, center=_vector(space), normal=_vector(normal), turns=turns)


def _follow(channel: SinumerikChannel, move: Move, feed: float) -> None:
    """Move along an arc in space and remember it for CT."""
    sense = 1.0 if move.kind in CCW_KINDS else -1.0
    c, last, center = channel.coordinates, LastMove.of(channel), move.center or (0.0, 0.0, 0.0)
    last.start, last.arc = move.start, ArcOfMove(center, move.normal, sense)
    if not bends_arcs(channel, move.normal):
        channel.curve(move.kind, move.end, feed, center=center, normal=move.normal, turns=move.turns)
        return
    # Factors that differ make an ellipse of it (Fundamentals, SCALE).
    largest = max(hypot(*column) for column in zip(*c.zero.m, strict=True))
    path = MovePath(move, c.geometry)
    points = list(path.chords(CHORD_ERROR_MM / largest))
    parts = [(k / len(points), point) for k, point in enumerate(points, 1)]
    way = ChordPath(move.start, parts, path.direction, c.geometry)
    knots.write_chords(channel, way.led(channel), feed, partial(channel.curve, Kind.SPLINE))


# ---- CIP


def through_point(draft: Draft) -> Step | None:
    """CIP: the arc from here over I1, J1, K1 to the end point, in any plane."""
    middle = centre_words(draft, "")
    words = [(i, draft.take_shape(f"{letter}1", "AC", "IC")) for i, letter in enumerate(LETTERS)]
    middle += [(i, word[0], word[1].modifier) for i, word in words if word is not None]
    terms, lead = draft.take_axes(), draft.take_lead()
    if not terms and not middle:
        return None
    incremental = draft.mode["distance"] == "G91"

    def run(channel: SinumerikChannel, values: Values) -> None:
        start = channel.coordinates.position
        end = target(channel, terms, values)
        via = start.copy()
        for index, position, modifier in middle:
            column = channel.coordinates.geometry[index]
            if column < 0:
                raise AlarmError("12050", axis="XYZ"[index])
            value = number(values, position)
            if modifier == "IC" or (incremental and modifier != "AC"):
                via[column] += value * length_factor(draft.mode)
            else:
                via[column] = value * absolute_factor(channel, draft, column)
        move = _three_points(channel, draft, start, via, end)
        if lead is not None:
            move.end = lead(channel, values, end, MovePath(move, channel.coordinates.geometry))
        _follow(channel, move, moves.checked_feed(channel.feed))

    return run


def _three_points(
    channel: SinumerikChannel, draft: Draft, start: list[float], via: list[float], end: list[float]
) -> Move:
    geometry = channel.coordinates.geometry
    a, b, c = (_vector([p[i] if i >= 0 else 0.0 for i in geometry]) for p in (start, via, end))
    try:
        center, normal = arcs.three_point_circle(a, b, c)
    except ValueError:
        raise AlarmError("14920") from None
    kind = Kind.CCW
    if normal[PLANES[draft.mode["plane"]][2]] < -1e-12:
        kind, normal = Kind.CW, (-normal[0], -normal[1], -normal[2])
    return Move(kind, start, end, center=center, normal=normal)


# ---- CT


def tangential(draft: Draft) -> Step | None:
    """CT: the arc that leaves the previous move without a kink; straight ahead it is a line."""
    columns = moves.plane_columns(draft)
    axes = PLANES[draft.mode["plane"]]
    goal, lead = moves.goal_of_tip(draft), draft.take_lead()
    if goal is None and lead is None:
        return None

    def run(channel: SinumerikChannel, values: Values) -> None:
        start = channel.coordinates.position
        tangent = last_direction(channel, columns, axes)
        end = start.copy() if goal is None else goal(channel, values)
        feed = moves.checked_feed(channel.feed)
        u, v = columns[:2]
        du, dv = end[u] - start[u], end[v] - start[v]
        # Distance of the end point from the tangent; the centre is |chord|² / (2·distance) away on that side.
        side = tangent[0] * dv - tangent[1] * du
        chord = hypot(du, dv)
        if chord <= NO_WAY:
            raise AlarmError("14045")
        if abs(side) <= 1e-9 * chord:
            if tangent[0] * du + tangent[1] * dv < 0.0:
                raise AlarmError("14045")
            end = end if lead is None else lead(channel, values, end, None)
            moves.line(channel, Kind.FEED, end, feed)
            return
        reach = chord * chord / (2.0 * side)
        center = (start[u] - tangent[1] * reach, start[v] + tangent[0] * reach)
        move = _arc(channel, columns, axes, end, center, side > 0.0)
        if lead is not None:
            move.end = lead(channel, values, end, MovePath(move, channel.coordinates.geometry))
        _follow(channel, move, feed)

    return run


def last_direction(
    channel: SinumerikChannel, columns: tuple[int, int, int], axes: tuple[int, int, int]
) -> arcs.Point:
    """Direction in the plane in which the previous move ended; alarm 14045 if there was none."""
    last = LastMove.of(channel)
    start = last.start
    if start is None:
        raise AlarmError("14045")
    end = channel.coordinates.position
    u, v = columns[:2]
    if last.arc is not None:
        center, normal, sense = last.arc
        ccw = sense * normal[axes[2]] > 0.0
        return arcs.tangent_at((center[axes[0]], center[axes[1]]), (end[u], end[v]), ccw)
    du, dv = end[u] - start[u], end[v] - start[v]
    length = hypot(du, dv)
    if length <= NO_WAY:
        raise AlarmError("14045")
    return du / length, dv / length


def _turned(point: arcs.Point, center: arcs.Point, angle: float) -> arcs.Point:
    u, v = point[0] - center[0], point[1] - center[1]
    return center[0] + u * cos(angle) - v * sin(angle), center[1] + u * sin(angle) + v * cos(angle)


def _tan_half(angle: float) -> float:
    return sin(angle / 2.0) / cos(angle / 2.0) if abs(abs(angle) - pi) > 1e-12 else 1e300


def _vector(values: list[float]) -> Vector:
    return values[0], values[1], values[2]
