"""Motion codes beside arcs: G00 with speed, G31, G33, G45 to G48, G53, feed under G93 (2.1 to 2.37)."""

from __future__ import annotations

from functools import partial
from math import copysign, hypot, nan

from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.syntec.coordinates.turns import POSTURE, TurnState
from polycnc.control.syntec.macros.calls import ModalMacroState
from polycnc.control.syntec.motion import planes
from polycnc.control.syntec.spindles import SpindleState
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.auxiliary import functions
from polycnc.control.word_address.block import repeated_codes
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.frames import PolarCoordinateState, polar_target, scale_of
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.cycles.drilling import CycleState
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.arcs import emit_arc
from polycnc.control.word_address.motion.path import CENTER_WORDS
from polycnc.control.word_address.states import LastSkip
from polycnc.control.word_address.tools import radius
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind
from polycnc.toolpath.context import NO_OVERLAP, STROKE, Overlap
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.word_address.motion import skip
    from polycnc.control.word_address.tools import data_input
    from polycnc.control.word_address.transformations import normal_line, polar_interpolation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.channel.channel import Channel
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Handler, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.language.bulk import Condition
    from polycnc.machine.setup.values import SkipInput
    from polycnc.toolpath import Context

#: Default feeds while none was programmed: mm/s and mm/rev (2.2).
DEFAULT_FEED = {"G93": nan, "G94": 1000.0 / 60.0, "G95": 1.0}
ANGLE_TOLERANCE = 1e-6


@dataclass(slots=True)
class FeedState(State, lifetime=Lifetime.RESET):
    """Feeds beside the one in force.

    Attributes:
        mode: The feed mode that the feed in force belongs to.
        by_mode: The last feed of each feed mode that was left.
        lead: F of G33, mm.
        rapid_speed: F1 of the running G00 P1, mm/s; 0 for none.
        rapid_overlap: Q of the running G00, mm; None for Pr3990.
        overlap: How the running G53 meets the next one.
    """

    mode: str = "G94"
    by_mode: dict[str, float] = field(default_factory=dict)
    lead: float = lasting(Lifetime.POWER, 0.0)
    rapid_speed: float = lasting(Lifetime.POWER, 0.0)
    rapid_overlap: float | None = lasting(Lifetime.POWER, None)
    overlap: Overlap = lasting(Lifetime.POWER, NO_OVERLAP)


def recorded(channel: SyntecChannel, context: Context) -> Context:
    """A context as rows record it: feeds of G93 per minute, the speed of G00 P1, how blocks overlap."""
    by_time = context.feed_mode is FeedMode.INVERSE_TIME
    mode = FeedMode.PER_MINUTE if by_time else context.feed_mode
    state = FeedState.of(channel)
    overlap = max(state.overlap, CycleState.of(channel).overlap)
    rapid = state.rapid_overlap if overlap == NO_OVERLAP else 0.0
    if rapid is None:
        rapid = channel.memory.parameters.rapid_overlap * least_unit(channel.memory.parameters)
    as_it_is = (context.feed_mode, context.rapid_speed, context.overlap, context.rapid_overlap)
    if (mode, state.rapid_speed, overlap, rapid) == as_it_is:
        return context
    return replace(
        context, feed_mode=mode, rapid_speed=state.rapid_speed, overlap=overlap, rapid_overlap=rapid
    )


@dataclass(slots=True)
class SkipState(State, lifetime=Lifetime.POWER):
    """Moves that signals end.

    Attributes:
        flags: #1608.
        machine: Machine position where the last skip move was cut (#1441 on); None where none was. `LastSkip` has the
            same as the absolute display shows it (#1361 on).
        groups: Groups of G31.10 that G31.11 will move; `groups_end` is the step behind the last one.
    """

    flags: int = lasting(Lifetime.RESET, 0)
    machine: list[float] | None = lasting(Lifetime.RESET, None)
    groups: list[SkipGroup] = lasting(Lifetime.RESET, factory=list)
    groups_end: int = 0

    def forget(self, channel: SyntecChannel) -> None:
        """Another skip move begins (2.77.3)."""
        self.flags, self.machine = 0, None
        LastSkip.of(channel).position = None

    def note(self, channel: SyntecChannel, flags: int) -> None:
        """A skip move is over: its signal has cut it where flags are set."""
        self.flags = flags
        if flags:
            self.machine = channel.coordinates.machine
            LastSkip.of(channel).position = list(channel.coordinates.position)

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset forgets where a skip move was cut."""
        super().end(channel, lifetime)
        if lifetime >= Lifetime.RESET:
            LastSkip.of(channel).position = None


@dataclass(frozen=True, slots=True)
class SkipGroup:
    """Axes that move and skip together: programmed end of each, and where their signal comes."""

    ends: dict[int, float]
    signal: object


# ---- G00, G53 --------------------------------------------------------------------------------------------


def plan_rapid(builder: Builder, plan: Plan) -> Step | None:
    """G00 [P1] [F1=] [Q=]: F1 is a speed per minute, effective with P1; Q the overlap with the next G00."""
    step = path.plan_rapid(builder, plan)
    if step is not None or not builder.m_codes:
        builder.take("P", "F1", "Q")  # beside an M code alone they are the M code's
    speed, switch, overlap = builder.slot("F1"), builder.slot("P"), builder.slot("Q")
    if step is None or (overlap is None and (speed is None or switch is None)):
        return step
    unit = (INCH_MM if builder.inch else 1.0) / 60.0
    polar = builder.mode.codes.get("polar") == "G16"
    to_mm = (builder.length("Q") if overlap is not None else None) or float

    def move(channel: SyntecChannel, values: list[float]) -> None:
        way = None if overlap is None else to_mm(values[overlap])
        if speed is None or switch is None or values[switch] != 1:
            with rapid_as(channel, nan, way):
                step(channel, values)
            return
        c = channel.coordinates
        if polar:
            programmed = channel.control.polar_target(channel, plan, values)
        else:
            programmed = path.reach(channel, plan.axis_words, values)
        with rapid_as(channel, values[speed] * unit, way) as feed:
            channel.straight(Kind.RAPID, c.to_position(programmed), feed, programmed)

    return move


def move_in_machine_system(channel: SyntecChannel, words: Words) -> None:
    """G53 [P1] X Y Z [F1=] [Q=]: rapid to machine coordinates, under G91 by machine increments.

    Q is the overlap with the next G53 (2.37.3, notes 12 and 13).
    """
    c = channel.coordinates
    machine = c.machine
    for axis, value, _ in words.axes():
        machine[axis] = machine[axis] + value if channel.mode["distance"] == "G91" else value
    speed = words.typed("F1")
    if speed is None or words.typed("P") != 1:
        speed = nan
    unit = (INCH_MM if words.plan.inch else 1.0) / 60.0
    axes = [axis for axis, _, _ in words.axes()]
    with (
        radius.suspended(channel, axes),
        rapid_as(channel, speed * unit, None, max(words.length("Q") or 0.0, STROKE)) as feed,
    ):
        channel.straight(Kind.RAPID, c.from_machine(machine), feed)


@contextmanager
def rapid_as(
    channel: SyntecChannel, speed: float, rapid_overlap: float | None, overlap: Overlap = NO_OVERLAP
) -> Iterator[float]:
    """A rapid with a speed (mm/s; NaN for rapid traverse) and an overlap of its own."""
    state = FeedState.of(channel)
    state.rapid_speed = max(0.0, speed)
    state.rapid_overlap, state.overlap = rapid_overlap, overlap
    channel.context_changed()
    try:
        yield speed
    finally:
        state.rapid_speed, state.rapid_overlap, state.overlap = 0.0, None, NO_OVERLAP
        channel.context_changed()


# ---- feed ------------------------------------------------------------------------------------------------


def plan_lead(builder: Builder) -> Step:
    """F under G33: the lead; in a block that leaves it the feed."""
    if builder.mode["motion"] != "G33":
        return functions.plan_feed(builder)
    slot, form = builder.slots["F"]
    factor = builder.control.feed_factor(builder, form, FeedMode.PER_REVOLUTION) * (
        INCH_MM if builder.inch else 1.0
    )

    def set_lead(channel: SyntecChannel, values: list[float]) -> None:
        FeedState.of(channel).lead = values[slot] * factor

    return set_lead


def change_feed_mode(channel: SyntecChannel, words: Words) -> None:
    """G93, G94, G95: each mode has its own F; without one it is 1000 per minute, 1 per revolution."""
    state = FeedState.of(channel)
    mode = channel.mode["feed"]
    if mode != state.mode:
        if "F" not in words:
            state.by_mode[state.mode] = channel.feed
            channel.feed = state.by_mode.get(mode, DEFAULT_FEED[mode])
        state.mode = mode
    channel.context_changed()


def _feed_is_in_force(channel: SyntecChannel) -> bool:
    """G93 to G95: the feed in force is that of the code."""
    return bool(FeedState.of(channel).mode == channel.mode["feed"])


def _frame_is_in_force(channel: SyntecChannel) -> bool:
    """G69: nothing is rotated or tilted."""
    return channel.coordinates.direct and TurnState.of(channel).tilt is IDENTITY


def _length_is_in_force(channel: SyntecChannel) -> bool:
    """G49: as on every control; no direction is led to the path either."""
    return (channel.path.head is None or not normal_line.acts(channel)) and repeated_codes.length(channel)


def _has_no_modal_call(channel: SyntecChannel) -> bool:
    """G67: there is no modal call."""
    return not ModalMacroState.of(channel).calls


def _surface_axis_is_linear(channel: SyntecChannel) -> bool:
    """G96: a linear axis gives the diameter."""
    return not channel.axis_data[SpindleState.of(channel).surface_axis].rotary


#: Codes that change nothing where they are in force already; see `word_address/block/repeated_codes.py`.
REPEATED: dict[str, Condition] = {
    **repeated_codes.MILLING,
    "G49": _length_is_in_force,
    "G67": _has_no_modal_call,
    "G96": _surface_axis_is_linear,
    "G69": _frame_is_in_force,
    **dict.fromkeys(("G17", "G18", "G19"), planes.same_plane),
    **dict.fromkeys(("G93", "G94", "G95"), _feed_is_in_force),
}


_TIMED = frozenset({"G1", "G2", "G3"})


def _with_inverse_time(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """G93: F times the block length, on arcs F times the radius; F stands in every block (2.64)."""
    if step is None or builder.mode["feed"] != "G93" or builder.mode["motion"] not in _TIMED:
        return step
    arc = builder.mode["motion"] in ("G2", "G3")
    u, v, _ = PLANES[builder.mode["plane"]]
    radius_slot = builder.slot("R")
    centers = [(CENTER_WORDS[axis], builder.slot(CENTER_WORDS[axis])) for axis in (u, v)]
    if not builder.has("F"):
        raise builder.control.fail("inverse_time_feed", address="F")
    if _tells_direction(builder, plan):

        def lead(channel: SyntecChannel, values: list[float]) -> None:
            """How far rotary axes turn is known when the tool is stood (`feed_to`), and not to the bulk scanner."""
            step(channel, values)

        return lead

    def move(channel: SyntecChannel, values: list[float]) -> None:
        rate, c = channel.feed, channel.coordinates
        if not arc or (radius_slot is None and not any(slot is not None for _, slot in centers)):
            channel.feed = rate * _way(channel, c.to_position(_end(channel, plan, values)))
        else:
            words = [("R", radius_slot)] if radius_slot is not None else centers
            told = [
                convert(values[slot]) if (convert := builder.length(letter)) else values[slot]
                for letter, slot in words
                if slot is not None
            ]
            channel.feed = rate * hypot(*told) * max(scale_of(channel, c.geometry[i]) for i in (u, v))
        try:
            step(channel, values)
        finally:
            channel.feed = rate

    return move


def _tells_direction(builder: Builder, plan: Plan) -> bool:
    """Whether a block says how the tool stands, so that rotary axes turn without their words or beside them."""
    if builder.mode["length"] == "G43.5":
        return any(builder.has(letter) for letter in "IJK") and builder.mode["motion"] == "G1"
    standing = builder.channel.control.kinematics(builder.channel).axes
    return builder.mode[POSTURE] != "" and any(
        builder.channel.axes[word.axis] in standing for word in plan.axis_words
    )


def feed_to(channel: SyntecChannel, end: list[float]) -> float:
    """Feed of a straight cut to a position (absolute display): F, under G93 F times the way (2.64)."""
    return channel.feed * (_way(channel, end) if channel.mode["feed"] == "G93" else 1.0)


def _end(channel: SyntecChannel, plan: Plan, values: list[float]) -> list[float]:
    """Where a straight block will end, programmed coordinates; what G16 keeps of its words stays as it is."""
    if channel.mode["polar"] != "G16":
        return path.target(channel, plan.axis_words, values)
    state = PolarCoordinateState.of(channel)
    before = state.radius, state.angle, state.pole
    end = polar_target(channel, plan, values)
    state.radius, state.angle, state.pole = before
    return end


def _way(channel: SyntecChannel, end: list[float]) -> float:
    """The straight way to a position, as its feed counts it: over all axes, under tip control that of a tip that moves.

    Under G70 a degree is an inch.
    """
    ways = [e - s for s, e in zip(channel.coordinates.position, end, strict=True)]
    if TipState.of(channel).is_leading(channel):
        from polycnc.transformation.orientation.linkage import STANDS_MM

        tip = hypot(*(way for way, data in zip(ways, channel.axis_data, strict=True) if not data.rotary))
        if tip >= STANDS_MM:
            return tip
    if channel.memory.is_inch:
        for axis, data in enumerate(channel.axis_data):
            if data.rotary and not polar_interpolation.is_length(channel, axis):
                ways[axis] *= INCH_MM
    return hypot(*ways)


# ---- G31, G33 --------------------------------------------------------------------------------------------


def skip_move(channel: SyntecChannel, words: Words) -> None:
    """G31 X Y Z F [Q] [P]: a cut that ends where the skip signal comes (2.22)."""
    state = SkipState.of(channel)
    if channel.mode["compensation"] != "G40":
        raise words.fail("comp_skip", "G31")
    deceleration = words.typed("P")
    if deceleration is not None and (deceleration < 0 or deceleration != int(deceleration)):
        raise words.fail("number", "P")
    c = channel.coordinates
    end = c.to_position(path.reach(channel, words.plan.axis_words, words.values))
    stopped = skip.signal_position(channel, c.position, end, skip_source(channel, words))
    state.forget(channel)
    skip.move_to_signal(channel, end, stopped)
    state.note(channel, int(stopped is not None))


def default_input(channel: SyntecChannel) -> SkipInput:
    """When C62 comes: where a setup names that bit, else what comes as the skip input of every control."""
    switches = channel.setup.switches
    as_bit = switches.signals_at.get("C62")
    return switches.skip_input if as_bit is None else replace(switches.skip_input, at=as_bit)


def skip_source(channel: SyntecChannel, words: Words) -> object:
    """Where the signal comes: Q none is C62, 101 to 132 C bits, 201 to 218 inputs of drives."""
    switches = channel.setup.switches
    source = words.typed("Q")
    if source is None:
        return default_input(channel)
    if source == int(source) and 101 <= source <= 132:
        return switches.signals_at.get(f"C{int(source)}")
    if source == int(source) and 201 <= source <= 218:
        return switches.signals_at.get(f"EXT{int(source) - 200}")
    raise words.fail("argument", "Q")


def plan_thread(builder: Builder, plan: Plan) -> Step | None:
    """G33 Z F: a straight cut whose feed follows the spindle, lead F (2.23)."""
    words = plan.axis_words
    if not words:
        return None

    def move(channel: SyntecChannel, values: list[float]) -> None:
        lead = FeedState.of(channel).lead
        if not lead > 0.0:
            raise builder.control.fail("no_feed", address="F")
        c = channel.coordinates
        programmed = path.reach(channel, words, values)
        end = c.to_position(programmed)
        if end != c.position:
            channel.curve(Kind.THREAD, end, lead, parameters=(lead, 0.0), programmed=programmed)

    return move


# ---- G45 to G48 ------------------------------------------------------------------------------------------


def _lengthened_move(factor: float, channel: SyntecChannel, words: Words) -> None:
    """G45 to G48: the move of this block grows by `factor` tool radii, arcs in their radius (2.31)."""
    state = RadiusState.of(channel)
    control = channel.control
    code = f"G{({1.0: 45, -1.0: 46, 2.0: 47, -2.0: 48})[factor]}"
    if channel.mode["compensation"] != "G40":
        raise control.fail("offset_in_compensation", address=code)
    number = words.typed("D")
    if number is not None:
        state.number = int(number)
    growth = factor * control.radius_value(channel, state.number)
    motion = channel.mode["motion"]
    if motion in ("G2", "G3"):
        _lengthened_arc(channel, words, growth, ccw=motion == "G3")
        return
    if motion not in ("G0", "G1"):
        raise control.fail("argument", address=code)
    data_input.refuse_words(words, "IJK", "argument")
    c = channel.coordinates
    end = c.programmed[:]
    for axis, value, incremental in words.axes():
        way = value if incremental else value - c.programmed[axis]
        if way != 0.0 or incremental:
            own = growth / scale_of(channel, axis)
            way += copysign(own, own * copysign(1.0, way))
        end[axis] += way
    rapid = motion == "G0"
    channel.straight(
        Kind.RAPID if rapid else Kind.FEED, c.to_position(end), nan if rapid else channel.feed, end
    )


def _lengthened_arc(channel: SyntecChannel, words: Words, growth: float, *, ccw: bool) -> None:
    """An arc of 90 or 270 degrees with another radius and the same tangent at its start."""
    control, c = channel.control, channel.coordinates
    u, v, w = PLANES[channel.mode["plane"]]
    first, second = c.geometry[u], c.geometry[v]
    programmed = path.reach(channel, words.plan.axis_words, words.values)
    begin = (c.programmed[first], c.programmed[second])
    end = (programmed[first], programmed[second])
    shift = (words.length(CENTER_WORDS[u]) or 0.0, words.length(CENTER_WORDS[v]) or 0.0)
    radius_mm = hypot(*shift)
    if radius_mm == 0.0:
        raise control.fail("offset_arc")
    center = (begin[0] + shift[0], begin[1] + shift[1])
    control.check_arc(channel, begin, end, center)
    quarters = abs(arcs.sweep_angle(begin, end, center, ccw)) / (arcs.TAU / 4.0)
    if min(abs(quarters - 1.0), abs(quarters - 3.0)) > ANGLE_TOLERANCE:
        raise control.fail("offset_arc")
    ratio = (radius_mm + growth / scale_of(channel, first)) / radius_mm
    if ratio <= 0.0:
        raise control.fail("comp_interference")
    programmed[first] = begin[0] + (end[0] - begin[0]) * ratio
    programmed[second] = begin[1] + (end[1] - begin[1]) * ratio
    middle = (begin[0] + shift[0] * ratio, begin[1] + shift[1] * ratio)
    emit_arc(channel, programmed, middle, (u, v, w), ccw=ccw, feed=channel.feed)


lengthened: Handler = partial(_lengthened_move, 1.0)
shortened: Handler = partial(_lengthened_move, -1.0)
lengthened_twice: Handler = partial(_lengthened_move, 2.0)
shortened_twice: Handler = partial(_lengthened_move, -2.0)


#: F of threads.
LEAD_RULE = Rule("lead of a thread", modes={"motion": ("G33",)}, addresses={"F": plan_lead})
#: Feeds of blocks under G93.
INVERSE_TIME_RULE = Rule(
    "inverse time feed", modes={"feed": ("G93",)}, in_cycles=False, wrap=_with_inverse_time
)
