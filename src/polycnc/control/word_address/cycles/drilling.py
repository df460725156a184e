"""Drilling cycles of word-address controls: words, their lifetimes, levels, repeats (strokes: `cycles`).

A control states a `Drilling`: its cycles by code, how long each word lives, and the few amounts that come
from its parameters. A cycle is modal in the group `cycle`; while one is active, blocks with axis words
position and drill, and a motion code (a row with `ends="cycle"`) ends it. Cycle data are kept in the memory
from the block that enters the mode until the mode ends.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.channel.intervention import TakesBack
from polycnc.channel.states.state import Lifetime, State, lasting
from polycnc.control.word_address.auxiliary.functions import stand
from polycnc.control.word_address.auxiliary.overrides import OverrideState
from polycnc.control.word_address.block.numbers import length_converter
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.block.whole_numbers import DecimalPoint
from polycnc.control.word_address.block.words_as_data import targets_as_data
from polycnc.control.word_address.coordinates.frames import level_of, scale_of
from polycnc.control.word_address.cycles.hole_halts import Halts, halts_nowhere, with_halts
from polycnc.control.word_address.cycles.plunge import STROKES_OF_A_BLOCK, plunges
from polycnc.control.word_address.cycles.shift import shift_by_center_words, shift_off_axis
from polycnc.control.word_address.motion.path import FEED_MODES, reach
from polycnc.control.word_address.tools.radius import suspended
from polycnc.cycles.drilling.holes import TAPS, Action, Cycle, Hole, Stroke
from polycnc.deferred.records import dataclass, field, replace
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.language.bulk import Straight, declare
from polycnc.language.word_address.functions import round_half_away
from polycnc.toolpath import Kind
from polycnc.toolpath.context import NO_OVERLAP, Overlap
from polycnc.toolpath.events import Auxiliary, SpindleWait
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.numbers import NumberRules
    from polycnc.control.word_address.block.plan import AxisWord, Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.frames import Frame

#: A value of the cycle data: in internal units (P as typed), and whether it is an increment.
Datum = tuple[float, bool]
BOTTOM = "bottom"
_M_OF_DIRECTION = {1: 3, -1: 4, 0: 5}
#: The spindle that drilling cycles turn.
_SPINDLE = 1


@dataclass(frozen=True, slots=True)
class DrillCycle:
    """A row of a control's table of drilling cycles.

    Attributes:
        strokes: What the tool does.
        dwells: P is the time at the bottom.
        pecks: Q is the depth of a peck.
        shifts: Q, or I J K, is the shift off the wall.
        needs: Words without which the cycle is the alarm `cycle_word`.
        bottom_from_initial: An incremental bottom counts from the initial level instead of from R.
        axis: Drilling axis by name; empty for what `Drilling.axis` says.
        once: Words that hold in their block only in this cycle.
    """

    strokes: Cycle
    dwells: bool = False
    pecks: bool = False
    shifts: bool = False
    needs: str = ""
    bottom_from_initial: bool = False
    axis: str = ""
    once: Sequence[str] = ""


@dataclass(slots=True)
class CycleState(State, lifetime=Lifetime.RESET):
    """The drilling cycle that is active.

    Attributes:
        data: What it remembers; None before the first one.
        overlap: How the stroke that comes meets the next one (`toolpath.context`).
    """

    data: CycleData | None = None
    overlap: Overlap = lasting(Lifetime.POWER, NO_OVERLAP)

    @property
    def active(self) -> CycleData:
        """What the cycle remembers that works."""
        if self.data is None:
            raise LookupError
        return self.data


def third_axis(builder: Builder) -> int:
    """The axis that stands on the active plane."""
    return builder.channel.coordinates.geometry[PLANES[builder.mode["plane"]][2]]


def in_milliseconds(value: float, _form: str, _rules: NumberRules) -> float:
    """P counts milliseconds."""
    return value / 1000.0


def turn_spindle(channel: WordAddressChannel, direction: int) -> None:
    """The spindle turns the other way, or stops."""
    channel.memory.spindle.direction = direction
    channel.context_changed()


def turn_by_m_code(channel: WordAddressChannel, direction: int) -> None:
    """As `turn_spindle`, and the machine is told by M03, M04 or M05."""
    turn_spindle(channel, direction)
    channel.event(Auxiliary(_M_OF_DIRECTION[direction]))


def orient_spindle(channel: WordAddressChannel) -> None:
    """The spindle stops at its angle; the machine is told by M19."""
    turn_spindle(channel, 0)
    channel.event(Auxiliary(19))


def as_it_is(_channel: WordAddressChannel, _code: str, cycle: Cycle) -> Cycle:
    """The strokes of the cycle and nothing else."""
    return cycle


def lead_from_feed(channel: WordAddressChannel) -> float:
    """Lead of a tap, mm: the feed per revolution, or the feed per minute over the spindle's speed."""
    if FEED_MODES[channel.mode["feed"]] is FeedMode.PER_REVOLUTION:
        return channel.feed
    speed: float = channel.memory.spindle.speed
    return channel.feed * 60.0 / speed if speed > 0.0 else 0.0


def any_override(_channel: WordAddressChannel) -> float:
    """The machine sets no bound."""
    return 0.0


def no_relief(_channel: WordAddressChannel, _code: str) -> float:
    """Pecks follow each other without a retract."""
    return 0.0


def nothing_to_check(_channel: WordAddressChannel, _code: str) -> None:
    """The control has no conditions of its own."""


def no_overlap(_channel: WordAddressChannel, _code: str) -> None:
    """Every stroke begins when the axes rest."""


def rapid_over(channel: WordAddressChannel, _words: Sequence[AxisWord], end: list[float]) -> None:
    """Rapid to a programmed point."""
    channel.straight(Kind.RAPID, channel.coordinates.to_position(end), nan, end)


@dataclass(frozen=True, slots=True)
class Drilling:
    """How a control drills.

    Attributes:
        cycles: Cycles by code.
        kept: Words that live until the cycle ends; the bottom level always does.
        once: Words that hold in their block only.
        repeats: Words for the number of repeats; 0 only stores the data.
        most_repeats: The largest such number, and only whole numbers from 0 are any; 0 to take any number.
        triggers: Words beside axis words that make a block drill.
        r_is_increment: R counts from the initial level even under G90 (FANUC lathes).
        r_as_axis: R is a diameter where words of the drilling axis are diameters; else a radius value.
        by_r: Rapid retracts stop at R on the way to the initial level.
        dwells_at_r: A tap dwells at R as well.
        axis: The drilling axis.
        seconds: A P word, as typed, how it was written and how numbers are read, in seconds.
        relief: Retract or clearance between pecks of a cycle, mm.
        shift: Shift off the wall along two geometry axes, the first and second of the hole's plane.
        lead: Lead of a tap, mm.
        check: Alarms for what must not be when a cycle begins to drill.
        largest_override: The largest feed override of a tap; 0 for any.
        turn: What a reversal or stop of the spindle within a cycle does.
        least_increments: Words that count least increments even under calculator input.
        choices: Words that choose by a plain number, in taps.
        dress: What the machine makes of the strokes of a hole (clamping an axis), by cycle code.
        halts: Where single block halts in a hole, by cycle code.
        taps_end_at_r: A feed hold within a tap stops it at R; else where the cycle ends.
        overlaps: How far before the place of a hole its first stroke begins, mm, as in `Stroke`, by cycle code; None
            where no strokes overlap.
        over: The way over the hole that words name, to its programmed point.
    """

    cycles: Mapping[str, DrillCycle]
    kept: Sequence[str] = "RQPIJK"
    once: Sequence[str] = ""
    repeats: Sequence[str] = "L"
    most_repeats: int = 0
    triggers: Sequence[str] = ""
    r_is_increment: bool = False
    r_as_axis: bool = False
    by_r: bool = False
    dwells_at_r: bool = False
    axis: Callable[[Builder], int] = third_axis
    seconds: Callable[[float, str, NumberRules], float] = in_milliseconds
    relief: Callable[[Channel, str], float] = no_relief
    shift: Callable[[Channel, CycleData, tuple[int, int]], tuple[float, float]] = shift_by_center_words
    lead: Callable[[Channel], float] = lead_from_feed
    largest_override: Callable[[Channel], float] = any_override
    turn: Callable[[Channel, int], None] = turn_by_m_code
    check: Callable[[Channel, str], None] = nothing_to_check
    least_increments: Sequence[str] = ""
    choices: Sequence[str] = ()
    dress: Callable[[Channel, str, Cycle], Cycle] = as_it_is
    halts: Callable[[Channel, str], Halts] = halts_nowhere
    taps_end_at_r: bool = False
    overlaps: Callable[[Channel, str], float | None] = no_overlap
    over: Callable[[Channel, Sequence[AxisWord], list[float]], None] = rapid_over

    @property
    def words(self) -> tuple[str, ...]:
        """All addresses that a drilling block may hold beside axis words."""
        return (*self.kept, *self.once, *self.choices, *self.repeats)


@dataclass(slots=True)
class CycleData:
    """What an active cycle remembers.

    Attributes:
        axis: Drilling axis.
        initial: Level at which the cycle mode was entered, programmed coordinates.
        frame: The frame in which that level counts.
        rigid: Its taps are cut in step with a servo spindle.
        kept: Words that live on.
        now: Words of the running block.
    """

    axis: int
    initial: float
    frame: Frame = IDENTITY
    rigid: bool = False
    kept: dict[str, Datum] = field(default_factory=dict)
    now: dict[str, Datum] = field(default_factory=dict)

    def go_with(self, channel: WordAddressChannel) -> None:
        """The initial level is a place: it stays where a scale or a mirror has begun or ended since."""
        frame = channel.coordinates.programming
        if self.frame is not frame:
            self.initial, self.frame = level_of(channel, self.axis, self.initial, self.frame), frame

    def amount(self, address: str) -> float:
        """Value of a word, of this block or kept; 0 where there is none."""
        return (self.now.get(address) or self.kept.get(address) or (0.0, False))[0]

    def amounts(self) -> dict[str, Datum]:
        """The kept words that hold for another drilling axis too: all but the levels of this one."""
        return {
            address: datum
            for address, datum in self.kept.items()
            if address != BOTTOM and (address != "R" or datum[1])
        }

    def __contains__(self, address: str) -> bool:
        return address in self.now or address in self.kept

    def level(self, address: str, base: float) -> float:
        """A level: absolute, or an increment on `base`; `base` itself where the word is missing."""
        value, incremental = self.kept.get(address, (0.0, True))
        return base + value if incremental else value


def is_active(channel: WordAddressChannel) -> bool:
    """Whether a drilling cycle is modal now."""
    return channel.mode.codes.get("cycle", "") in channel.control.drilling_rules(channel).cycles


def give_way(builder: Builder) -> None:
    """A cycle code that a later motion code of its block cancels: its words have no effect."""
    cycles = builder.footing.cycles
    if any(row.code in cycles.cycles for row in builder.codes):
        builder.take(*(a for a in cycles.words if builder.is_free(a)))


def _takes_back(builder: Builder, _plan: Plan) -> TakesBack | None:
    """A drilling block takes an intervention back axis by axis, each as it moves."""
    return TakesBack(by_move=(1 << len(builder.channel.axes)) - 1) if builder.drills else None


def _plan_axis_words(builder: Builder, plan: Plan) -> Step | None:
    if builder.drills:
        return plan_drilling(builder, plan)
    give_way(builder)
    return None


def plan_drilling(builder: Builder, plan: Plan) -> Step:
    """A block while a drilling cycle is active: store its words, and drill where it has axis words."""
    words = _Words(builder, plan)
    code, rules = words.code, words.rules
    cycle = rules.cycles[code]
    entering = builder.before["cycle"] not in rules.cycles
    control = builder.control

    def run(channel: WordAddressChannel, values: list[float]) -> None:
        state, c = CycleState.of(channel), channel.coordinates
        before = None if entering else state.data
        if before is None or before.axis != words.axis:
            # An offset that waits for the next move is not in the programmed point yet; the level counts with it.
            initial = c.programmed[words.axis] + c.pending[words.axis]
            kept = before.amounts() if before else {}
            before = state.data = CycleData(words.axis, initial, c.programming, kept=kept)
        before.go_with(channel)
        if not words.drills:
            return
        data = before
        words.store(data, values)
        count = words.count(values)
        if count and any(not data.amount(address) for address in cycle.needs):
            raise control.fail("cycle_word", address=cycle.needs, word=cycle.needs, code=code)
        if count:
            rules.check(channel, code)
        with suspended(channel):
            # Radius compensation does not act in drilling cycles.
            halts = rules.halts(channel, code)
            for number in range(count):
                if number:
                    channel.once_more()
                    if halts is not Halts.NONE:
                        channel.halt_inside()
                _meet(channel, rules.overlaps(channel, code))
                words.position(channel, values)
                if halts is not Halts.NONE:
                    channel.halt_inside()
                _perform(channel, code, data, halts)

    brings_more = words.stores or words.polar or builder.mode is not builder.before
    told = None if brings_more else targets_as_data(words.positions)
    return (
        declare(run, Straight(rapid=True, targets=told, absolute=False, drills=words.axis)) if told else run
    )


def drilling_axis(builder: Builder) -> int:
    """Column of the axis along which the active cycle drills; -1 where the machine has none."""
    rules: Drilling = builder.control.drilling_rules(builder.channel)
    name = rules.cycles[builder.mode["cycle"]].axis
    return builder.channel.axis_index[name] if name else rules.axis(builder)


class _Words:
    """The words of a drilling block of one shape."""

    def __init__(self, builder: Builder, plan: Plan) -> None:
        self.control = builder.control
        self.rules: Drilling = self.control.drilling_rules(builder.channel)
        self.code = builder.mode["cycle"]
        self.plan = plan
        self.axis = drilling_axis(builder)
        if self.axis < 0:
            raise self.control.fail("plane")
        self.bottom = next((word for word in plan.axis_words if word.axis == self.axis), None)
        self.positions: tuple[AxisWord, ...] = tuple(w for w in plan.axis_words if w.axis != self.axis)
        foreign = () if self.rules.cycles[self.code].strokes in TAPS else self.rules.choices
        named = [a for a in self.rules.words if a not in foreign and builder.has(a) and builder.is_free(a)]
        builder.take(*named)
        self.repeats = next((a for a in self.rules.repeats if a in named), "")
        self.repeat_slot, self.repeat_form = builder.slots.get(self.repeats, (-1, ""))
        self.drills = bool(plan.axis_words) or any(a in named for a in self.rules.triggers)
        self.incremental = builder.mode["distance"] == "G91" or self.rules.r_is_increment
        self.polar = builder.mode.codes.get("polar") == "G16"
        self.stored = [
            (address, *builder.slots[address], self._converter(builder, address))
            for address in named
            if address not in self.rules.repeats
        ]

    def _converter(self, builder: Builder, address: str) -> Callable[[float], float]:
        if address in self.rules.choices:
            return float
        if address == "P":
            form, rules = builder.slots[address][1], builder.rules
            return lambda value: self.rules.seconds(value, form, rules)
        if address in self.rules.least_increments and builder.slots[address][1] == "":
            return length_converter("", replace(builder.rules, calculator=False), inch=builder.inch) or float
        diameter = (
            address == "R" and self.rules.r_as_axis and self.control.is_diameter(builder.channel, self.axis)
        )
        return builder.length(address, diameter=diameter) or (lambda value: value)

    @property
    def stores(self) -> bool:
        """Whether the block brings more than positions."""
        return bool(self.bottom is not None or self.stored or self.repeats)

    def store(self, data: CycleData, values: list[float]) -> None:
        """Take the words over into the cycle data."""
        data.now.clear()
        if self.bottom is not None:
            value = values[self.bottom.slot]
            value = self.bottom.convert(value) if self.bottom.convert else value
            data.kept[BOTTOM] = (value, self.bottom.incremental)
        for address, slot, _form, convert in self.stored:
            datum = (convert(values[slot]), self.incremental)
            holds_once = address in self.rules.once or address in self.rules.cycles[self.code].once
            (data.now if holds_once else data.kept)[address] = datum

    def count(self, values: list[float]) -> int:
        """How often the block drills."""
        if not self.repeats:
            return 1
        value, most = values[self.repeat_slot], self.rules.most_repeats
        if not most:
            return max(int(value), 0)
        if self.repeat_form == "#":
            value = round_half_away(value)
        elif self.repeat_form:
            point = self.control.POINT_IN_WHOLE_NUMBERS
            is_read_over = point is DecimalPoint.READ_OVER and value.is_integer()
            if point is not DecimalPoint.CUT and not is_read_over:
                raise self.control.fail("point", address=self.repeats)
            value = float(int(value))
        if not 0 <= value <= most:
            raise self.control.fail("minus" if value < 0 else "too_many_digits", address=self.repeats)
        return int(value)

    def position(self, channel: WordAddressChannel, values: list[float]) -> None:
        """Rapid over the hole, at the level where the tool stands."""
        c = channel.coordinates
        if self.polar:
            end = self.control.polar_target(channel, self.plan, values)
            end[self.axis] = c.programmed[self.axis]
        else:
            end = reach(channel, self.positions, values)
        self.rules.over(channel, self.positions, end)


def drill_here(channel: WordAddressChannel) -> None:
    """Drill with the data of the active cycle where the tool stands (hole patterns)."""
    _perform(channel, channel.mode["cycle"], CycleState.of(channel).active, Halts.NONE)


def hole_of(channel: WordAddressChannel, code: str, data: CycleData) -> Hole:
    """Levels and amounts of the next hole; a scale acts on levels only (macro B 10.5)."""
    rules: Drilling = channel.control.drilling_rules(channel)
    cycle = rules.cycles[code]
    r = data.level("R", data.initial)
    bottom = data.level(BOTTOM, data.initial if cycle.bottom_from_initial and BOTTOM in data else r)
    dwell = data.amount("P") if cycle.dwells else 0.0
    scale = scale_of(channel, data.axis)
    return Hole(
        data.initial,
        r,
        bottom,
        back=r if channel.mode.codes.get("return") == "G99" else data.initial,
        dwell_s=dwell,
        dwell_out_s=dwell if rules.dwells_at_r else 0.0,
        peck=abs(data.amount("Q")) / scale if cycle.pecks else 0.0,
        relief=rules.relief(channel, code) / scale,
        by_r=rules.by_r,
    )


def _with_holds(channel: WordAddressChannel, strokes: Iterator[Stroke]) -> Iterator[Stroke]:
    """Note where a feed hold waits: from the first cut of a tap on, until it is out of the hole."""
    state = OverrideState.of(channel)
    ends_at_r = channel.control.drilling_rules(channel).taps_end_at_r
    for stroke in strokes:
        waits = stroke.action is not Action.RAPID or (state.in_tap and not ends_at_r)
        if state.in_tap is not waits:
            state.in_tap = waits
            channel.context_changed()
        yield stroke


def _perform(channel: WordAddressChannel, code: str, data: CycleData, halts: Halts) -> None:
    """Let the tool make the strokes of the next hole."""
    rules: Drilling = channel.control.drilling_rules(channel)
    cycle, hole = rules.cycles[code].strokes, hole_of(channel, code, data)
    dressed = rules.dress(channel, code, cycle)
    rests = CycleState.of(channel).overlap == NO_OVERLAP
    if dressed is cycle and rests and plunges(channel, data.axis, cycle, hole):
        return
    strokes, state = dressed(hole), OverrideState.of(channel)
    if cycle in TAPS:
        state.tapping = True
        channel.context_changed()
        strokes = _with_holds(channel, strokes)
    try:
        _work(channel, with_halts(channel, strokes, halts), data)
    finally:
        if state.tapping:
            state.tapping = state.in_tap = False
            channel.context_changed()
        _meet(channel, None)


def _meet(channel: WordAddressChannel, overlaps: float | None) -> None:
    """Say how the next stroke ends: how far before that the one behind it may begin."""
    kind = NO_OVERLAP if overlaps is None else overlaps
    state = CycleState.of(channel)
    if state.overlap != kind:
        state.overlap = kind
        channel.context_changed()


def _work(channel: WordAddressChannel, strokes: Iterator[Stroke], data: CycleData) -> None:
    center = channel.coordinates.programmed[:]
    direction = channel.memory.spindle.direction
    rules: Drilling = channel.control.drilling_rules(channel)
    for number, stroke in enumerate(strokes):
        if number % STROKES_OF_A_BLOCK == STROKES_OF_A_BLOCK - 1:
            channel.once_more()
        if stroke.action is Action.SHIFT:
            shift_off_axis(channel, center, data, stroke.value)
        elif stroke.action is Action.DWELL:
            stand(channel, stroke.value)
        elif stroke.action is Action.SPINDLE:
            if direction or not stroke.value:
                rules.turn(channel, int(direction * stroke.value))
        elif stroke.action is Action.ORIENT:
            orient_spindle(channel)
        elif stroke.action is Action.OUTPUT:
            channel.event(Auxiliary(int(stroke.value)))
        elif stroke.action is Action.ARRIVAL:
            channel.event(SpindleWait(_SPINDLE, stroke.value))
        elif stroke.action is Action.HALT:
            channel.stop("M00")
        else:
            _meet(channel, stroke.overlaps)
            _stroke(channel, data.axis, stroke)


def _stroke(channel: WordAddressChannel, axis: int, stroke: Stroke) -> None:
    """Along the drilling axis to a level."""
    c = channel.coordinates
    end = c.programmed[:]
    end[axis] = stroke.value
    c.pending[axis] = 0.0
    position = c.to_position(end)
    if stroke.action is Action.RAPID:
        channel.straight(Kind.RAPID, position, nan, end)
        return
    feed = channel.feed * stroke.factor
    if not feed > 0.0:
        raise channel.control.fail("no_feed")
    if stroke.action is Action.FEED:
        channel.straight(Kind.FEED, position, feed, end)
    elif position != c.position:
        rules: Drilling = channel.control.drilling_rules(channel)
        parameters = (rules.lead(channel), 0.0, stroke.factor, rules.largest_override(channel))
        channel.curve(Kind.TAP, position, feed, parameters=parameters, programmed=end)


#: While a cycle is active the axis words of a block are a hole.
RULE = Rule(
    "drilling cycles",
    unless={"cycle": "G80"},
    groups=("cycle",),
    takes_back=_takes_back,
    motion=_plan_axis_words,
)
