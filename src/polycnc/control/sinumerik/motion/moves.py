"""Motion of a block: rapid, straight, threads, tapping, dwell, reference and fixed points, positioning axes.

Source: Fundamentals (G0, G1, G4, G33 to G35, G331/G332, G63, G74, G75, POS, POSA, ANG, AP, RP).
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, isnan, nan, radians, sin, tan

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik import tables
from polycnc.control.sinumerik.block import plain
from polycnc.control.sinumerik.block.outside_feeds import take_block_feed
from polycnc.control.sinumerik.block.positions import AxisTerm, Dimension, axis_term, number, target
from polycnc.control.sinumerik.limits import working_area
from polycnc.control.sinumerik.motion.last_move import LastMove
from polycnc.control.sinumerik.motion.polar import Polar
from polycnc.control.sinumerik.signals import measuring
from polycnc.control.sinumerik.tables import length_factor
from polycnc.control.sinumerik.transformations import seat
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.units import INCH_MM
from polycnc.language.bulk import Straight, declare
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.sinumerik.actions import axes as action_axes
    from polycnc.control.sinumerik.transformations import point_to_point
    from polycnc.control.sinumerik.variables.clock import Clock

if TYPE_CHECKING:
    from polycnc.control.sinumerik.block.draft import Draft, Goal, Step, Values
    from polycnc.control.sinumerik.family import SinumerikChannel


@dataclass(slots=True)
class OpenLine(State, lifetime=Lifetime.RESET):
    """A line whose end the next block tells (ANG).

    Attributes:
        angle: Of the line to the first axis of the plane, degrees.
        corners: Inserts the chamfers and roundings at its end.
    """

    angle: float = 0.0
    corners: list[Callable[[], None]] = field(default_factory=list)


# ---- straight lines


def rapid(draft: Draft) -> Step | None:
    """G0: rapid traverse; the row names a feed only if the block does."""
    straight = _told(draft, rapid=True)
    goal = goal_of(draft)
    if goal is None:
        return None
    names_feed, go = draft.has("F"), _by_axes if draft.by_axes else line

    def run(channel: SinumerikChannel, values: Values) -> None:
        go(channel, Kind.RAPID, goal(channel, values), channel.feed if names_feed else nan)

    return run if straight is None else declare(run, straight._replace(names_feed=names_feed))


def linear(draft: Draft) -> Step | None:
    """G1: straight with path feed; FB for the block's own feed."""
    block_feed = take_block_feed(draft) if draft.has("FB", "FD") else None
    is_plain = draft.lead is None and not draft.by_axes and not draft.has("AP", "RP", "ANG")
    if block_feed is None and is_plain:
        return _plain_linear(draft)
    told = _told(draft) if block_feed is None else None
    goal = goal_of(draft)
    if goal is None:
        return None
    factor, go = feed_factor(draft), _by_axes if draft.by_axes else line

    def run(channel: SinumerikChannel, values: Values) -> None:
        feed = channel.feed if block_feed is None else number(values, block_feed) * factor
        go(channel, Kind.FEED, goal(channel, values), checked_feed(feed))

    return run if told is None else declare(run, told)


def _told(draft: Draft, *, rapid: bool = False) -> Straight | None:
    """A straight block as data, with the direction of the tool that it names; None for one that says more."""
    if (draft.lead is not None and draft.direction is None) or draft.by_axes or draft.has("AP", "RP", "ANG"):
        return None
    straight = plain.straight(draft.axis_terms(), rapid=rapid)
    return None if straight is None else straight._replace(direction=draft.direction)


def _plain_linear(draft: Draft) -> Step | None:
    """G1 with axis words alone; where all are absolute, in one function with F: most blocks of most programs."""
    terms = draft.take_axes()
    if not terms:
        return None
    if any(term.way is not Dimension.ABSOLUTE or term.coded for term in terms):
        return _incremental_linear(terms)
    places = [(term.position, term.column, term.factor) for term in terms]
    is_constant = draft.mode["feed"] != "G931" and draft.mode["feed_profile"] == "FNORM"
    own_feed = draft.take_plain("F") if is_constant else None
    last = LastMove.of(draft.channel)
    feed_place, feed_to_internal = -1 if own_feed is None else own_feed, feed_factor(draft)

    def run(channel: SinumerikChannel, values: Values) -> None:
        if feed_place >= 0:
            value = values[feed_place]
            if value.__class__ is not float:
                value = number(values, feed_place)
            if value < 0.0:
                raise WordAlarm("14800", feed_place)
            channel.feed = value * feed_to_internal or nan
        coordinates = channel.coordinates
        start = coordinates.position
        end = start.copy()
        moves = False
        for position, column, factor in places:
            value = values[position]
            if value.__class__ is not float:
                value = number(values, position)
            value *= factor
            if not moves and not -NO_WAY < value - end[column] < NO_WAY:
                moves = True
            end[column] = value
        if coordinates.owes:
            for _, column, _ in places:
                coordinates.pending[column] = 0.0
        feed = channel.feed
        if not feed > 0.0:
            raise AlarmError("10860")
        if moves:
            last.start, last.arc = start, None
            channel.straight(Kind.FEED, end, feed)

    own = () if own_feed is None else (plain.feed(own_feed, feed_to_internal),)
    return declare(run, (*own, plain.straight(terms)))


def _incremental_linear(terms: list[AxisTerm]) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:
        line(channel, Kind.FEED, target(channel, terms, values), checked_feed(channel.feed))

    told = plain.straight(terms)
    return run if told is None else declare(run, told)


def feed_factor(draft: Draft) -> float:
    """From a programmed feed to internal units, for the feed type and units of the block; a time has no inches."""
    feed = tables.feed_type(draft.mode)
    is_length = feed.mode is not FeedMode.INVERSE_TIME
    return feed.factor * (INCH_MM if is_length and draft.mode["unit"] == "G700" else 1.0)


def checked_feed(feed: float) -> float:
    """The feed of a path move; alarm 10860 without one."""
    if isnan(feed) or feed <= 0.0:
        raise AlarmError("10860")
    return feed


def line(channel: SinumerikChannel, kind: Kind, end: list[float], feed: float) -> None:
    """Move straight to a point; remembers where the move came from, for CT."""
    start = channel.coordinates.position
    if any(abs(a - b) > NO_WAY for a, b in zip(end, start, strict=True)):
        _begin(channel, start)
        channel.straight(kind, end, feed)


def _by_axes(channel: SinumerikChannel, kind: Kind, end: list[float], feed: float) -> None:
    go = line if point_to_point.ends_contour(channel) else point_to_point.go
    go(channel, kind, end, feed)


def _begin(channel: SinumerikChannel, start: list[float]) -> None:
    """A straight path move: CT knows where it came from."""
    last = LastMove.of(channel)
    last.start, last.arc = start, None


def goal_of(draft: Draft) -> Goal | None:
    """How a block's end point follows from its words: axis words, polar coordinates, a contour angle, orientation.

    None if the block names no end point.
    """
    goal, lead = goal_of_tip(draft), draft.take_lead()
    if lead is None:
        return goal

    def led(channel: SinumerikChannel, values: Values) -> list[float]:
        end = channel.coordinates.position.copy() if goal is None else goal(channel, values)
        return lead(channel, values, end, None)

    return led


def goal_of_tip(draft: Draft) -> Goal | None:
    """The same, as far as axis words, polar coordinates and a contour angle say."""
    angle, radius = draft.take_shape("AP", "AC", "IC"), draft.take_shape("RP", "AC", "IC")
    contour_angle = draft.take("ANG")
    terms = draft.take_axes()
    if contour_angle is not None:
        return _contour_angle(draft, terms, contour_angle)
    if angle is not None or radius is not None:
        return _polar(draft, terms, angle, radius)
    if not terms:
        return None
    if all(term.way is Dimension.ABSOLUTE and not term.coded for term in terms):
        return _absolute([(term.position, term.column, term.factor) for term in terms])

    def goal(channel: SinumerikChannel, values: Values) -> list[float]:
        return target(channel, terms, values)

    return goal


def _absolute(places: list[tuple[int, int, float]]) -> Goal:
    """The common case: all words absolute."""

    def goal(channel: SinumerikChannel, values: Values) -> list[float]:
        coordinates = channel.coordinates
        end = coordinates.position.copy()
        owed = coordinates.pending
        for position, column, factor in places:
            value = values[position]
            if value.__class__ is not float:
                value = number(values, position)
            end[column] = value * factor
            owed[column] = 0.0
        return end

    return goal


def _polar(draft: Draft, terms: list[AxisTerm], angle: Any, radius: Any) -> Goal:
    """AP and RP about the pole in the plane; the third axis by its own word."""
    columns = plane_columns(draft)
    if any(term.column in columns[:2] for term in terms):
        raise AlarmError("14280")

    def goal(channel: SinumerikChannel, values: Values) -> list[float]:
        end = target(channel, terms, values)
        u, v = polar_point(draft, channel, values, angle, radius)
        end[columns[0]], end[columns[1]] = u, v
        return end

    return goal


def polar_point(
    draft: Draft, channel: SinumerikChannel, values: Values, angle: Any, radius: Any
) -> tuple[float, float]:
    """The plane point that AP and RP name; both are modal.

    Raises:
        AlarmError: 14200 for a negative radius, 14210 for an angle beyond 360 degrees, 14280 without any
            radius.
    """
    polar = Polar.of(channel)
    incremental = draft.mode["distance"] == "G91"
    if angle is not None:
        value = number(values, angle[0])
        if abs(value) > tables.TURN:
            raise WordAlarm("14210", angle[0])
        relative = angle[1].modifier == "IC" or (incremental and angle[1].modifier != "AC")
        polar.angle = polar.angle + value if relative else value
    if radius is not None:
        value = number(values, radius[0]) * length_factor(draft.mode)
        polar.radius = polar.radius + value if radius[1].modifier == "IC" else value
    if isnan(polar.radius):
        raise AlarmError("14280")
    if polar.radius < 0.0:
        raise AlarmError("14200")
    i, j, _ = PLANES[draft.mode["plane"]]
    turned = radians(polar.angle)
    return polar.pole[i] + polar.radius * cos(turned), polar.pole[j] + polar.radius * sin(turned)


def plane_columns(draft: Draft) -> tuple[int, int, int]:
    """Columns of the plane's first, second and third axis.

    Raises:
        AlarmError: 12050 if the channel has no axis there.
    """
    geometry = draft.channel.coordinates.geometry
    i, j, k = PLANES[draft.mode["plane"]]
    for index in (i, j):
        if geometry[index] < 0:
            raise AlarmError("12050", axis="XYZ"[index])
    return geometry[i], geometry[j], geometry[k]


def _contour_angle(draft: Draft, terms: list[AxisTerm], position: int) -> Goal:
    """ANG: the angle of a straight line to the first axis of the plane.

    With one coordinate the other one follows. Without any, the line ends where that of the next block begins, which
    tells its end point and its own angle.
    """
    columns = plane_columns(draft)
    given = [term.column for term in terms if term.column in columns[:2]]
    if not given and not draft.mode["open_line"]:
        return _open_line(draft, position)
    if len(given) == 2 and draft.mode["open_line"]:
        return _meeting_lines(draft, terms, position, columns)
    if len(given) != 1:
        raise WordAlarm("12080", position, text="ANG")

    def goal(channel: SinumerikChannel, values: Values) -> list[float]:
        start = channel.coordinates.position
        end = target(channel, terms, values)
        slope = tan(radians(number(values, position)))
        u, v = columns[:2]
        if given[0] == u:
            end[v] = start[v] + (end[u] - start[u]) * slope
        elif abs(slope) < NO_WAY:
            raise WordAlarm("14040", position)
        else:
            end[u] = start[u] + (end[v] - start[v]) / slope
        return end

    return goal


def _open_line(draft: Draft, position: int) -> Goal:
    """A line of which only the angle is known yet."""
    draft.opens_line = True

    def goal(channel: SinumerikChannel, values: Values) -> list[float]:
        OpenLine.of(channel).angle = number(values, position)
        channel.mode = channel.mode.with_code("open_line", "ANG")
        return channel.coordinates.position

    return goal


def _meeting_lines(draft: Draft, terms: list[AxisTerm], position: int, columns: tuple[int, int, int]) -> Goal:
    """The second of two lines: the first one is moved to where both meet, before this block does anything else."""
    kind = Kind.RAPID if draft.mode["motion"] == "G0" else Kind.FEED
    u, v = columns[:2]

    def first_line(channel: SinumerikChannel, values: Values) -> None:
        first = OpenLine.of(channel)
        start = channel.coordinates.position
        end = target(channel, terms, values)
        a, b = radians(first.angle), radians(number(values, position))
        across = sin(b - a)
        if abs(across) < NO_WAY:
            raise WordAlarm("14040", position)
        # From start along a and from the end back along b to one point: cross products with direction b.
        way = ((end[u] - start[u]) * sin(b) - (end[v] - start[v]) * cos(b)) / across
        corner = start.copy()
        corner[u], corner[v] = start[u] + way * cos(a), start[v] + way * sin(a)
        channel.mode = channel.mode.with_code("open_line", "")
        for insert in first.corners:
            insert()
        first.corners = []
        feed = channel.feed if kind is Kind.RAPID else checked_feed(channel.feed)
        line(channel, kind, corner, nan if kind is Kind.RAPID else feed)

    draft.steps.append(first_line)
    return lambda channel, values: target(channel, terms, values)


# ---- moves with curve parameters


def special(
    channel: SinumerikChannel, kind: Kind, end: list[float], feed: float, parameters: list[float]
) -> None:
    """A straight move with curve parameters."""
    start = channel.coordinates.position
    if kind is Kind.TAP:
        channel.memory.spindles.get().refuse_leading("G331")
    if any(abs(a - b) > NO_WAY for a, b in zip(end, start, strict=True)):
        _begin(channel, start)
        channel.curve(kind, end, feed, parameters=parameters)


# ---- blocks with a function of group 2


def dwell(draft: Draft) -> Step | None:
    """G4: F seconds or S revolutions of the master spindle, not both (12080); the modal F and S stay."""
    seconds, revolutions = draft.take("F"), draft.take_shape("S")
    if seconds is not None and revolutions is not None:
        raise WordAlarm("12080", revolutions[0], text="S")

    def run(channel: SinumerikChannel, values: Values) -> None:
        wait = number(values, seconds) if seconds is not None else 0.0
        turns = number(values, revolutions[0]) if revolutions is not None else 0.0
        channel.dwell(seconds=wait, revolutions=turns)
        Clock.of(channel).waited += max(wait, 0.0)

    return run


def reference_point(draft: Draft) -> Step | None:
    """G74: machine axes go to their reference points; the values are ignored."""
    columns = [column for _, column in draft.take_machine_axes()]
    columns += [term.column for term in draft.take_axes()]

    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - values are ignored by the function
        seat.refuse_transformed(channel, columns, "17630")
        points = {column: channel.axis_data[column].reference_points[0] for column in columns}
        to_machine(channel, Kind.REF, points)

    return run


#: Fixed points of an axis.
FIXED_POINTS = range(1, 5)


def fixed_point(draft: Draft) -> Step | None:
    """G75: machine axes go to fixed point FP (MD30600) in rapid; G751 over an intermediate point first.

    Raises:
        AlarmError: 12560 for a fixed point beyond 1 to 4.
    """
    number_position = draft.take("FP")
    columns = [column for _, column in draft.take_machine_axes()]
    via = goal_of(draft) if draft.codes.get("block_motion") == "G751" else None

    def run(channel: SinumerikChannel, values: Values) -> None:
        memory = channel.memory
        seat.refuse_transformed(channel, columns, "17620")
        if via is not None:
            line(channel, Kind.RAPID, via(channel, values), nan)
        point = int(number(values, number_position)) if number_position is not None else 1
        if point not in FIXED_POINTS:
            raise WordAlarm("12560", number_position or 0, text="FP")
        points = {
            column: memory.data.number("$MA_FIX_POINT_POS", point - 1, channel.axes[column])
            for column in columns
        }
        to_machine(channel, Kind.RAPID, points)

    return run


def to_machine(channel: SinumerikChannel, kind: Kind, points: dict[int, float]) -> None:
    """Move some axes to machine positions, by column; the others stay."""
    coordinates = channel.coordinates
    machine = coordinates.machine
    for column, value in points.items():
        machine[column] = value
    line(channel, kind, coordinates.from_machine(machine), nan)


# ---- positioning axes


def positioning(draft: Draft) -> tuple[list[Step], list[Step]]:
    """POS, POSA, POSP: axes that move with their own feed beside the path; they give no row (FA is their feed).

    Gives what starts them, and what ends the block when they are there (not for POSA).
    """
    steps: list[Step] = []
    awaited: list[Step] = []
    for position, word in draft.open_words():
        if word.address not in ("POS", "POSA", "POSP"):
            continue
        draft.close(position)
        if not isinstance(word.index, Axis):
            raise WordAlarm("12040", position, text=str(word.index))
        column = draft.memory.column(word.index.name)
        by_axes = draft.mode["point_to_point"] != "CP"
        seat.check_positioning(draft.channel, word.index.name, column, by_axes=by_axes)
        term = axis_term(draft.channel, draft.mode, position, column, word.modifier)
        steps.append(_in_parts(term) if word.address == "POSP" else _position_axis(term))
        if word.address != "POSA":
            awaited.append(_await_axis(column))
    return steps, awaited


def _await_axis(column: int) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:  # noqa: ARG001 - steps have one signature
        action_axes.await_positioned(channel, column)

    return run


def _in_parts(term: AxisTerm) -> Step:
    """POSP[axis]=(end, part, mode): as POS, in parts; 12560 for a mode but 0 and 1, a part without length."""
    whole = _position_axis(term)

    def run(channel: SinumerikChannel, values: Values) -> None:
        listed = values[term.position]
        if not isinstance(listed, tuple) or len(listed) != 3 or listed[2] not in (0, 1) or listed[1] <= 0:
            raise WordAlarm("12560", term.position, text="POSP")
        whole(channel, (*values[: term.position], float(listed[0]), *values[term.position + 1 :]))

    return run


def _position_axis(term: AxisTerm) -> Step:
    def run(channel: SinumerikChannel, values: Values) -> None:
        end = target(channel, (term,), values)
        working_area.check_target(channel, end)
        end = measuring.positioned(channel, end)
        action_axes.position_beside(channel, term.column, end)
        channel.coordinates.arrive(end)

    return run
