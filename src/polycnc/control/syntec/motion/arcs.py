"""Arcs on SYNTEC: G02/G03 with helix and spiral (2.4 to 2.6), G02.4/G03.4 through three points (2.3)."""

from __future__ import annotations

from math import hypot

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.syntec.coordinates.systems import ScaleState
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.words_as_data import targets_as_data, word_as_data
from polycnc.control.word_address.coordinates.tip import TIP_CODES
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.arcs import emit_arc
from polycnc.control.word_address.motion.path import CENTER_WORDS
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.planes import PLANES
from polycnc.language.bulk import Arc, declare
from polycnc.toolpath import Kind

with loaded_when_called():
    from polycnc.channel.moves import knots

if TYPE_CHECKING:
    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step as ProgramStep
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.language.bulk import Word

THREE_POINT_CODES = ("G2.4", "G3.4")


@dataclass(slots=True)
class ArcState(State, lifetime=Lifetime.POWER):
    """Centre vector of the last arc, and the mid point of a G02.4 whose end point is still to come."""

    last_center: Vector = (0.0, 0.0, 0.0)
    mid_point: list[float] | None = lasting(Lifetime.RESET, None)


def not_at_mid_point(channel: SyntecChannel, _level: Level, _step: ProgramStep) -> bool | None:
    """Single block does not halt at the mid point of an arc."""
    return None if ArcState.of(channel).mid_point is None else False


def plan_arc_cw(builder: Builder, plan: Plan) -> Step | None:
    """G02: an arc or a helix, clockwise."""
    return _plan_arc(builder, plan, ccw=False)


def plan_arc_ccw(builder: Builder, plan: Plan) -> Step | None:
    """G03: an arc or a helix, counter-clockwise."""
    return _plan_arc(builder, plan, ccw=True)


class ArcWords:
    """The words of an arc block beside its end point.

    Attributes:
        radius: Value slot of R, or None.
        centers: For the first and second plane axis the value slot of I, J or K, or None.
        turns: Value slot of L, or None.
    """

    def __init__(self, builder: Builder) -> None:
        self.plane = PLANES[builder.mode["plane"]]
        u, v, w = self.plane
        present = [letter for letter in (*CENTER_WORDS, "R", "L") if builder.has(letter)]
        builder.take(*present)
        self.radius = builder.slot("R")
        self.radius_of = builder.length("R") if self.radius is not None else None
        self.centers = [builder.slot(CENTER_WORDS[axis]) for axis in (u, v)]
        self.converts = [
            builder.length(CENTER_WORDS[axis]) if builder.has(CENTER_WORDS[axis]) else None for axis in (u, v)
        ]
        self.turns = builder.slot("L")
        self.off_plane = CENTER_WORDS[w] if self.radius is None and builder.has(CENTER_WORDS[w]) else ""
        self.given = self.radius is not None or any(slot is not None for slot in self.centers)

    def centers_as_data(self) -> tuple[Word | None, Word | None]:
        """The centre words, for the scanner."""
        first, second = map(word_as_data, self.centers, self.converts)
        return first, second

    def radius_mm(self, values: list[float]) -> float:
        """R in millimetres, signed; 0 without R."""
        if self.radius is None:
            return 0.0
        value = values[self.radius]
        return self.radius_of(value) if self.radius_of else value

    def shift(self, values: list[float]) -> Point:
        """Centre minus start, mm."""
        result = [0.0, 0.0]
        for i, (slot, convert) in enumerate(zip(self.centers, self.converts, strict=True)):
            if slot is not None:
                result[i] = convert(values[slot]) if convert else values[slot]
        return (result[0], result[1])


def _plan_arc(builder: Builder, plan: Plan, *, ccw: bool) -> Step | None:
    """An arc, helix, spiral or full circle; without centre and radius the block is a straight cut (2.4.3)."""
    control = builder.control
    words = ArcWords(builder)
    if words.off_plane:
        raise control.fail("center_off_plane", address=words.off_plane)
    if not words.given:
        return path.plan_line(builder, plan)
    polar = builder.mode.codes.get("polar") == "G16"
    u, v, w = words.plane

    def move(channel: SyntecChannel, values: list[float]) -> None:
        c = channel.coordinates
        first, second = c.geometry[u], c.geometry[v]
        if first < 0 or second < 0:
            raise control.fail("plane")
        programmed = _end(channel, plan, values, polar=polar)
        begin = (c.programmed[first], c.programmed[second])
        end = (programmed[first], programmed[second])
        turns = _turns(channel, words, values)
        if words.radius is not None:
            center = _center_by_radius(channel, begin, end, words.radius_mm(values), ccw=ccw)
        else:
            shift = words.shift(values)
            center = (begin[0] + shift[0], begin[1] + shift[1])
            if turns is None:
                control.check_arc(channel, begin, end, center)
        vector = [0.0, 0.0, 0.0]
        vector[u], vector[v] = center[0] - begin[0], center[1] - begin[1]
        ArcState.of(channel).last_center = (vector[0], vector[1], vector[2])
        center = _scaled_center(channel, words, begin, end, center, ccw=ccw)
        emit_arc(
            channel, programmed, center, (u, v, w), ccw=ccw, feed=channel.feed, turns=float((turns or 1) - 1)
        )

    ends = targets_as_data(plan.axis_words)
    if ends is None or polar or words.turns is not None or builder.mode["scaling"] == "G51":
        return move
    return declare(
        move,
        Arc(
            ccw,
            words.plane,
            ends,
            words.centers_as_data(),
            word_as_data(words.radius, words.radius_of),
            needs_feed=False,
            radius_tolerances=2.0,
        ),
    )


def _end(channel: SyntecChannel, plan: Plan, values: list[float], *, polar: bool) -> list[float]:
    """The programmed end point; the start where no axis word is given."""
    if polar:
        return channel.control.polar_target(channel, plan, values)
    return path.reach(channel, plan.axis_words, values)


def _turns(channel: SyntecChannel, words: ArcWords, values: list[float]) -> int | None:
    """L of a spiral: a started turn counts."""
    if words.turns is None:
        return None
    turns = values[words.turns]
    if turns != int(turns) or turns < 1 or words.radius is not None:
        raise channel.control.fail("repeat_count", address="L")
    return int(turns)


def _center_by_radius(channel: SyntecChannel, begin: Point, end: Point, radius: float, *, ccw: bool) -> Point:
    control = channel.control
    try:
        return arcs.center_from_radius(begin, end, radius, ccw, 2.0 * control.arc_tolerance(channel))
    except ValueError as error:
        raise control.fail("arc_end", address="R") from error


def _scaled_center(
    channel: SyntecChannel, words: ArcWords, begin: Point, end: Point, center: Point, *, ccw: bool
) -> Point:
    """The centre under G51 with unequal factors: the radius grows by the largest of them (2.33).

    Points are programmed ones; the answer is such that the programming frame maps it to the right place.
    """
    memory = channel.memory
    u, v, _ = words.plane
    factors: Vector = ScaleState.of(channel).factors
    if channel.mode["scaling"] != "G51" or abs(factors[u]) == abs(factors[v]):
        return center
    frame: Frame = memory.frames.product()
    inverse = frame.inverse()

    def image(point: Point) -> Vector:
        full = [0.0, 0.0, 0.0]
        full[u], full[v] = point
        return frame.apply(full[0], full[1], full[2])

    start, stop = image(begin), image(end)
    radius = hypot(center[0] - begin[0], center[1] - begin[1]) * max(abs(factors[u]), abs(factors[v]))
    if abs(arcs.sweep_angle(begin, end, center, ccw)) > arcs.TAU / 2.0:
        radius = -radius
    sense = ccw != frame.mirrors
    try:
        found = arcs.center_from_radius((start[u], start[v]), (stop[u], stop[v]), radius, sense, 1e-6)
    except ValueError as error:
        raise channel.control.fail("arc_end") from error
    middle = [start[0], start[1], start[2]]
    middle[u], middle[v] = found
    back = inverse.apply(middle[0], middle[1], middle[2])
    return (back[u], back[v])


# ---- G02.4, G03.4 ----------------------------------------------------------------------------------------


def plan_three_point_arc(builder: Builder, plan: Plan) -> Step | None:
    """G02.4/G03.4: a row with the mid point, then a row with the end point (2.3)."""
    control = builder.control
    channel = builder.channel
    if not channel.memory.parameters.option_arc_in_space:
        raise control.fail("option", address=builder.mode["motion"], code=builder.mode["motion"])
    forbidden = next((word for word in (",A", ",C", ",R", "R") if builder.has(word)), "")
    if forbidden:
        raise control.fail("three_point_word", address=forbidden)
    if builder.mode["length"] in TIP_CODES:
        raise control.fail("three_point_word", address=builder.mode["motion"])
    if not plan.axis_words:
        return None
    feed_named = builder.has("F")

    def move(channel: SyntecChannel, values: list[float]) -> None:
        state = ArcState.of(channel)
        c = channel.coordinates
        if state.mid_point is None:
            state.mid_point = path.reach(channel, plan.axis_words, values)
            return
        if feed_named:
            raise control.fail("three_point_format", address="F")
        mid = state.mid_point
        state.mid_point = None
        start = c.programmed
        c.programmed = mid
        try:
            end = path.reach(channel, plan.axis_words, values)
        finally:
            c.programmed = start
        _three_point_moves(channel, mid, end)

    return move


def _three_point_moves(channel: SyntecChannel, mid: list[float], end: list[float]) -> None:
    """The arc; two lines where there is no circle, two arcs where further axes move along."""
    c = channel.coordinates
    places = [c.to_position(mid), c.to_position(end)]
    points = [tuple(point[i] if i >= 0 else 0.0 for i in c.geometry) for point in (c.position, *places)]
    feed = channel.feed
    try:
        center, normal = arcs.three_point_circle(*points)  # type: ignore[arg-type]
    except ValueError:
        with channel.under(knots.passing(channel.context)):
            channel.straight(Kind.FEED, places[0], feed, mid)
        channel.straight(Kind.FEED, places[1], feed, end)
        return
    kind = Kind.CCW
    if next(value for value in reversed(normal) if abs(value) > 1e-12) < 0.0:
        kind, normal = Kind.CW, (-normal[0], -normal[1], -normal[2])
    others = [i for i in range(len(end)) if i not in c.geometry]
    if any(mid[i] != c.programmed[i] or end[i] != c.programmed[i] for i in others):
        with channel.under(knots.passing(channel.context)):
            channel.curve(kind, places[0], feed, center=center, normal=normal, programmed=mid)
    channel.curve(kind, places[1], feed, center=center, normal=normal, programmed=end)


def check_pair_complete(channel: SyntecChannel) -> None:
    """COR-134: a three-point arc whose end point never came."""
    state = ArcState.of(channel)
    if state.mid_point is not None:
        state.mid_point = None
        raise channel.control.fail("three_point_format")


def _behind(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """A step behind the check that the last three-point arc is whole."""
    if builder.before["motion"] not in THREE_POINT_CODES or builder.mode["motion"] in THREE_POINT_CODES:
        return step

    def run(channel: SyntecChannel, values: list[float]) -> None:
        check_pair_complete(channel)
        if step is not None:
            step(channel, values)

    return run


#: A three-point arc is whole when another motion code comes.
RULE = Rule("three-point arcs", modes={"motion": THREE_POINT_CODES}, in_cycles=False, wrap=_behind)
