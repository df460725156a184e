"""Drilling cycles and hole patterns of SYNTEC (manual 2.47 to 2.60, 2.68 to 2.72, 2.74)."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec import tapping
from polycnc.control.syntec.units import least_unit
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.cycles.drilling import (
    CycleState,
    DrillCycle,
    Drilling,
    is_active,
    lead_from_feed,
)
from polycnc.control.word_address.tools import radius
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.cycles.drilling import holes
from polycnc.cycles.drilling.holes import Action, Stroke
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.messages import AlarmError
from polycnc.toolpath.context import STROKE

with loaded_when_called():
    from polycnc.control.word_address.cycles import hole_patterns
    from polycnc.control.word_address.tools import spatial
    from polycnc.cycles.drilling import patterns

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.codes import Handler, Step
    from polycnc.control.word_address.block.numbers import NumberRules
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.cycles.drilling import CycleData
    from polycnc.cycles.drilling.holes import Cycle, Hole
    from polycnc.geometry.arcs import Point

#: An incremental bottom counts from the initial level where the page of the cycle says so, else from R.
CYCLES = {
    "G73": DrillCycle(holes.peck_breaking_chips, pecks=True, bottom_from_initial=True),
    "G74": DrillCycle(holes.tap, dwells=True, pecks=True, bottom_from_initial=True),
    "G76": DrillCycle(holes.bore_and_shift, dwells=True, bottom_from_initial=True),
    "G81": DrillCycle(holes.drill),
    "G82": DrillCycle(holes.drill, dwells=True, bottom_from_initial=True),
    "G83": DrillCycle(holes.peck_clearing_chips, pecks=True, bottom_from_initial=True),
    "G84": DrillCycle(holes.tap, dwells=True, pecks=True),
    "G85": DrillCycle(holes.bore, bottom_from_initial=True),
    "G86": DrillCycle(holes.bore_and_stop, bottom_from_initial=True),
    "G87": DrillCycle(holes.bore_back, dwells=True),
    "G88": DrillCycle(partial(holes.bore_and_halt, feeds_out=True), dwells=True, bottom_from_initial=True),
    "G89": DrillCycle(holes.bore, dwells=True, bottom_from_initial=True),
}
#: Words for the overlap of the positioning axis and of the drilling axis.
OVERLAPS = {"G81": ("D", "Q"), "G74": ("I", "J"), "G84": ("I", "J")}
#: Pr4020: direction off the wall after the oriented stop, as geometry axis and sense.
SHIFT_DIRECTIONS = {0: (0, 1.0), 1: (0, -1.0), 2: (1, 1.0), 3: (1, -1.0), 4: (2, 1.0), 5: (2, -1.0)}
MAX_HOLES = 9999
#: K of a drilling cycle (2.72.3; the table of 2.72.1 ends at 999).
MOST_REPEATS = 9999


@dataclass(slots=True)
class RetractState(State, lifetime=Lifetime.POWER):
    """F2 of G81, in the unit of the feed; 0 for a rapid."""

    feed: float = 0.0


def relief(channel: SyntecChannel, code: str) -> float:
    """Pr4002 between drilling pecks; between tapping pecks Pr4004, or out to R where Pr4001 is 0."""
    parameters = channel.memory.parameters
    if code not in tapping.CODES:
        return parameters.peck_retract * least_unit(parameters)
    return parameters.tap_peck_retract * least_unit(parameters) if parameters.tap_fast_pecks == 1 else 0.0


def shift_off_wall(channel: SyntecChannel, data: CycleData, plane: tuple[int, int]) -> tuple[float, float]:
    """Q in the direction of Pr4020; G87 shifts against it."""
    axis, sense = SHIFT_DIRECTIONS.get(channel.memory.parameters.bore_shift, (0, 1.0))
    if axis not in plane:
        raise AlarmError("COR-023", address="Q", word="Q", hint="hint.syntec.shift-direction")
    amount = abs(data.amount("Q")) * sense
    if channel.mode["cycle"] == "G87":
        amount = -amount
    return (amount, 0.0) if axis == plane[0] else (0.0, amount)


def dwell_seconds(value: float, form: str, rules: NumberRules) -> float:
    """P: seconds with a point, least input units of time without (Pr17, Pr3241)."""
    return value if form != "" or rules.calculator else value / 10.0**rules.decimals


def overlap(channel: SyntecChannel, code: str) -> float | None:
    """How far before the hole the way to R begins, mm: D of G81, I of taps (2.48.2, 2.52.2).

    Taps and holes without one do not overlap with each other as G00 blocks do by Pr3990; None where that is 0 too.
    """
    return _overlaps(channel, code)[0]


def _overlaps(channel: SyntecChannel, code: str) -> tuple[float | None, float | None]:
    """Overlaps of the positioning and the drilling axis; above R only, so none with G99."""
    parameters, data = channel.memory.parameters, CycleState.of(channel).active
    over, out = (data.amount(word) for word in OVERLAPS.get(code, ("", "")))
    acts = parameters.fast_drilling == 1 and channel.mode.codes.get("return") != "G99"
    if acts and (over > 0.0 or out > 0.0):
        return max(over, STROKE), max(out, STROKE)
    return (STROKE, STROKE) if parameters.rapid_overlap else (None, None)


def dress(channel: SyntecChannel, code: str, cycle: Cycle) -> Cycle:
    """What the control makes of the strokes of a hole: of taps, of the way out of G81, and what overlaps."""
    cycle = tapping.tap(channel, cycle) if code in tapping.CODES else _out_at_feed(channel, code, cycle)
    out = _overlaps(channel, code)[1]
    if out is None:
        return cycle

    def lapping(hole: Hole) -> Iterator[Stroke]:
        for stroke, following in pairwise((*cycle(hole), None)):
            if stroke is not None:
                yield stroke._replace(overlaps=STROKE if following is not None else out)

    return lapping


def _out_at_feed(channel: SyntecChannel, code: str, cycle: Cycle) -> Cycle:
    """Fast drilling (Pr4008 = 1): the tool leaves a hole of G81 at the speed F2 (2.52)."""
    speed: float = RetractState.of(channel).feed
    if code != "G81" or not speed > 0.0 or not channel.feed > 0.0:
        return cycle

    def out(hole: Hole) -> Iterator[Stroke]:
        *inwards, _ = cycle(hole)
        yield from inwards
        yield Stroke(Action.FEED, hole.back, speed / channel.feed)

    return out


DRILLING = Drilling(
    CYCLES,
    kept="RQPIJD",
    repeats="K",
    most_repeats=MOST_REPEATS,
    dwells_at_r=True,
    seconds=dwell_seconds,
    relief=relief,
    shift=shift_off_wall,
    lead=lead_from_feed,
    dress=dress,
    overlaps=overlap,
    taps_end_at_r=True,
)


def _with_cycle_words(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """F2 of G81 and E of the tapping cycles in front of a drilling block."""
    if step is None or builder.mode["cycle"] == "G80":
        return step
    code = builder.mode["cycle"]
    entering = builder.before["cycle"] not in CYCLES
    unit = (INCH_MM if builder.inch else 1.0) / (1.0 if builder.mode["feed"] == "G95" else 60.0)
    retract, threads = builder.slot("F2"), builder.slot("E")
    if code == "G81":
        builder.take("F2")
    if code in tapping.CODES:
        builder.take("E")
    control = builder.control

    def drill(channel: SyntecChannel, values: list[float]) -> None:
        state = RetractState.of(channel)
        if entering:
            state.feed = 0.0
        if retract is not None and code == "G81":
            if values[retract] != int(values[retract]):
                raise control.fail("retract_feed", address="F2")
            fast = channel.memory.parameters.fast_drilling == 1
            state.feed = values[retract] * unit if fast else 0.0
        if threads is not None and code in tapping.CODES and not builder.has("F"):
            _feed_by_threads(channel, values[threads])
        step(channel, values)

    return drill


def _feed_by_threads(channel: SyntecChannel, per_inch: float) -> None:
    """E: threads per inch, the lead is 25.4 mm / E (2.48, 2.55)."""
    if not per_inch > 0.0:
        raise AlarmError("COR-023", address="E", word="E")
    lead = INCH_MM / per_inch
    per_revolution = channel.mode["feed"] == "G95"
    channel.feed = lead if per_revolution else lead * channel.memory.spindle.speed / 60.0


# ---- radius compensation ----------------------------------------------------------------------------


def _unless_drilling(handler: Handler, channel: SyntecChannel, words: Words) -> None:
    """G40, G41 and G42 are ignored while a drilling cycle is active (2.47 ff.)."""
    if channel.mode["cycle"] == "G80":
        handler(channel, words)
        return
    side = {1: "G41", -1: "G42"}.get(RadiusState.of(channel).side, "G40")
    channel.mode = channel.mode.with_code("compensation", side)


def _cancel(channel: SyntecChannel, words: Words) -> None:
    """G40 ends compensation in the plane and in space."""
    spatial.end(channel)
    radius.cancel_compensation(channel, words)


cancel_compensation: Handler = partial(_unless_drilling, _cancel)
compensate_left: Handler = partial(_unless_drilling, radius.compensate_left)
compensate_right: Handler = partial(_unless_drilling, radius.compensate_right)


# ---- hole patterns ---------------------------------------------------------------------------------------


def circle_of_holes(channel: SyntecChannel, words: Words) -> None:
    """G134 X Y I J K: K holes on a circle about X Y, radius I, from angle J; K negative clockwise (2.68)."""
    count = _count(words, "K", signed=True)
    radius = _length(words, "I", positive=True)
    start = words.angle("J") or 0.0
    _drill(channel, patterns.circle(hole_patterns.plane_point(channel, words), radius, start, count))


def line_of_holes(channel: SyntecChannel, words: Words) -> None:
    """G135 X Y I J K: K holes with pitch I along angle J (2.69)."""
    count = _count(words, "K")
    pitch, angle = _length(words, "I"), words.angle("J") or 0.0
    _drill(channel, patterns.line(hole_patterns.plane_point(channel, words), pitch, angle, count))


def arc_of_holes(channel: SyntecChannel, words: Words) -> None:
    """G136 X Y I J P K: K holes on a circle about X Y, radius I, from angle J, pitch P degrees (2.70)."""
    count = _count(words, "K")
    radius = _length(words, "I", positive=True)
    start, pitch = words.angle("J") or 0.0, words.angle("P") or 0.0
    _drill(channel, patterns.arc(hole_patterns.plane_point(channel, words), radius, start, pitch, count))


def grid_of_holes(channel: SyntecChannel, words: Words) -> None:
    """G137.1 X Y I P J K: P holes along X, pitch I, and K along Y, pitch J, row by row to and fro (2.71)."""
    columns, rows = _count(words, "P"), _count(words, "K")
    pitches = _length(words, "I"), _length(words, "J")
    _drill(channel, patterns.grid(hole_patterns.plane_point(channel, words), pitches, columns, rows))


def _count(words: Words, address: str, *, signed: bool = False) -> int:
    value = words.typed(address)
    if value is None or value != int(value) or not 1 <= (abs(value) if signed else value) <= MAX_HOLES:
        raise words.fail("argument", address if value is not None else "")
    return int(value)


def _length(words: Words, address: str, *, positive: bool = False) -> float:
    value = words.length(address)
    if value is None or (positive and value <= 0.0):
        raise words.fail("argument", address if value is not None else "")
    return value


def _drill(channel: SyntecChannel, points: Iterator[Point]) -> None:
    """Position over each point and drill with the data of the active cycle; COR-023 where none is active."""
    if not is_active(channel) or CycleState.of(channel).data is None:
        raise AlarmError("COR-023", word="", hint="hint.syntec.pattern-without-cycle")
    hole_patterns.drill_points(channel, points)


#: Words of drilling blocks that only these cycles have.
RULE = Rule("words of drilling cycles", unless={"cycle": "G80"}, wrap=_with_cycle_words)


#: In G81 D is the overlap of the positioning axis, and chooses no radius (2.52).
OVERLAP_RULE = Rule("overlap of holes", within={"cycle": ("G81",)}, addresses={"D": None})
