"""Threads block by block: G32, G34, G35, G36 with lead, start angle and rules (0i-TF Plus II.3.1 to 3.3)."""

from __future__ import annotations

from math import hypot

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.fanuc.lathe.coordinates.systems import feed_number, plane_axes
from polycnc.control.fanuc.lathe.tools.offsets import THREADS
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.motion.arcs import center_by_radius
from polycnc.control.word_address.motion.path import CENTER_WORDS, reach
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs
from polycnc.geometry.planes import PLANES
from polycnc.geometry.tolerances import NO_WAY
from polycnc.geometry.units import INCH_MM
from polycnc.toolpath import Kind
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control.fanuc.lathe.motion import drawing

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.channel.stack import Level
    from polycnc.channel.steps import Step as ProgramStep
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.frames import Vector
    from polycnc.toolpath import Context

MAX_START_ANGLE = 360_000
#: What a thread takes out of the operator's hands: on a thread overrides and feed hold, on the way off it feed hold.
#: The first move off the thread of a cycle, its retract, has a speed of its own besides.
#: In the cycles G92 and G76 thread and retract have an acceleration of their own.
ON_THREAD, ON_CYCLE_THREAD, OFF_THREAD, RETRACT = "thread", "cycle", "off", "retract"
#: Least and largest lead (II.3.1, table 3.1(a)).
LEADS_MM, LEADS_INCH = (0.0001, 500.0), (0.000001, 9.999999)
CHAMFERS = (",C", ",R", ",A")
#: What makes a chamfer or a corner R, or a line of drawing dimensions.
CORNER_WORDS = (*CHAMFERS, "R", "C", "I", "J", "K")


# ---- straight ----------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class ThreadState(State, lifetime=Lifetime.RESET):
    """What threads keep from block to block.

    Attributes:
        step: Step of the last block that cut a thread.
        lock: What a thread, or the way off it, keeps from the operator.
        held: The feed hold that a setup presses in a thread has come.
        retract_axes: Axes on which G10.6 wants the tool to retract.
        retracts: A thread runs along one of them.
    """

    step: int = -1
    lock: str = ""
    held: bool = False
    retract_axes: frozenset[int] = frozenset()
    retracts: bool = False


def plan_thread(builder: Builder, plan: Plan) -> Step | None:
    """G32 (B, C: G33): straight at the lead F, locked to the spindle; Q is the start angle of this block only."""
    return _plan_straight(builder, plan, grows=False)


def plan_growing_thread(builder: Builder, plan: Plan) -> Step | None:
    """G34: as G32, the lead grows by K each revolution."""
    return _plan_straight(builder, plan, grows=True)


def _plan_straight(builder: Builder, plan: Plan, *, grows: bool) -> Step | None:
    words = (("K", grows), (",A", drawing.is_on(builder)))
    allowed = [address for address, has_meaning in words if has_meaning]
    refuse_corners(builder, plan, tuple(a for a in CORNER_WORDS if a not in allowed))
    angle_of = plan_start_angle(builder)
    builder.take("K")
    growth_slot = builder.slot("K") if grows else None
    growth_of = builder.length("K") if growth_slot is not None else None
    if not plan.axis_words:
        return None
    end_of = drawing.plan_end(builder, plan)

    def cut(channel: LatheChannel, values: list[float]) -> None:
        lead = lead_in_force(channel)
        programmed = end_of(channel, values)
        growth = 0.0
        if growth_slot is not None:
            growth = growth_of(values[growth_slot]) if growth_of else values[growth_slot]
            check_last_lead(channel, programmed, lead, growth)
        end = channel.coordinates.to_position(programmed)
        note_retract(channel, end)
        thread_move(channel, end, (lead, angle_of(channel, values), growth), programmed)
        ThreadState.of(channel).step = channel.level.current

    return cut


# ---- circular ----------------------------------------------------------------------------------------------------


def plan_circular_thread_cw(builder: Builder, plan: Plan) -> Step | None:
    """G35: a thread along a clockwise arc; R, or the centre by I and K as in G02."""
    return _plan_arc(builder, plan, ccw=False)


def plan_circular_thread_ccw(builder: Builder, plan: Plan) -> Step | None:
    """G36 (3405#3 = 1): a thread along a counter-clockwise arc."""
    return _plan_arc(builder, plan, ccw=True)


def _plan_arc(builder: Builder, plan: Plan, *, ccw: bool) -> Step | None:
    control, words = builder.control, plan.axis_words
    refuse_corners(builder, plan, CHAMFERS)
    angle_of = plan_start_angle(builder)
    u, v, w = PLANES[builder.mode["plane"]]
    letters = (CENTER_WORDS[u], CENTER_WORDS[v])
    builder.take("R", *letters)
    if not words:
        return None
    if not any(builder.has(letter) for letter in ("R", *letters)):
        raise control.fail("circular_thread", address=builder.mode["motion"])
    amounts = {
        letter: (builder.slots[letter][0], builder.length(letter))
        for letter in ("R", *letters)
        if builder.has(letter)
    }

    def cut(channel: LatheChannel, values: list[float]) -> None:
        given = {
            letter: convert(values[slot]) if convert else values[slot]
            for letter, (slot, convert) in amounts.items()
        }
        lead, c = lead_in_force(channel), channel.coordinates
        programmed = reach(channel, words, values)
        first, second = c.geometry[u], c.geometry[v]
        begin: Point = (c.programmed[first], c.programmed[second])
        end: Point = (programmed[first], programmed[second])
        center: Point | None
        if "R" in given:
            center = center_by_radius(channel, begin, end, given["R"], ccw)
        else:
            center = (begin[0] + given.get(letters[0], 0.0), begin[1] + given.get(letters[1], 0.0))
            control.check_arc(channel, begin, end, center)
        if center is None or not _keeps_long_axis(begin, end, center, ccw):
            raise control.fail("circular_thread", address=channel.mode["motion"])
        middle = [0.0, 0.0, 0.0]
        middle[u], middle[v] = center
        x, y, z = c.programming.apply(middle[0], middle[1], middle[2])
        sense = 1.0 if ccw != c.programming.mirrors else -1.0
        normal: Vector = (sense * (w == 0), sense * (w == 1), sense * (w == 2))
        parameters = (lead, angle_of(channel, values), x, y, z, *normal)
        lock(channel, ON_THREAD)
        channel.curve(
            Kind.THREAD, c.to_position(programmed), lead, parameters=parameters, programmed=programmed
        )
        ThreadState.of(channel).step = channel.level.current

    return cut


def _keeps_long_axis(begin: Point, end: Point, center: Point, ccw: bool) -> bool:
    """Whether the lead counts along one axis all the way: the arc's direction never passes 45 degrees, and it moves."""
    if hypot(end[0] - begin[0], end[1] - begin[1]) <= NO_WAY:
        return False
    diagonals = [(center[0] + a, center[1] + b) for a in (1.0, -1.0) for b in (1.0, -1.0)]
    # The very ends may lie on a diagonal.
    return not any(
        arcs.contains_direction(begin, end, center, ccw, point, slack=-1e-6)
        and abs(arcs.sweep_angle(begin, point, center, ccw)) > 1e-6
        for point in diagonals
    )


# ---- what all threads share ----------------------------------------------------------------------------------------


def refuse_corners(builder: Builder, plan: Plan, addresses: tuple[str, ...]) -> None:
    """Neither a thread nor the block in front of it may have a chamfer or a corner R (PS0050)."""
    for address in addresses:
        if builder.has(address) and not any(word.address == address for word in plan.axis_words):
            raise builder.control.fail("corner_thread", address=address)


def plan_start_angle(builder: Builder) -> Callable[[LatheChannel, list[float]], float]:
    """Q of a thread block, degrees; it needs an integer. Within a continuous thread it has no effect (II.3.2)."""
    builder.take("Q")
    slot = builder.slot("Q")
    if slot is None:
        return lambda _channel, _values: 0.0
    if builder.slots["Q"][1] not in ("", "#"):
        raise builder.control.fail("point", address="Q")
    return lambda channel, values: 0.0 if is_continued(channel) else start_angle(values[slot])


def is_continued(channel: LatheChannel) -> bool:
    """Whether the block in front was a thread too: then the spindle's mark is not waited for (II.3.1)."""
    chunk, line = channel.toolpath.chunk, channel.level.code.line(channel.level.current)
    for row in range(len(chunk) - 1, -1, -1):
        if chunk.kind[row] != Kind.EVENT:
            return bool(chunk.kind[row] == Kind.THREAD)
        if chunk.line[row] != line:
            return False
    return channel.toolpath.kind_before_chunk == Kind.THREAD


def start_angle(thousandths: float) -> float:
    """Q in degrees: the sign does not count, more than a turn is one turn (II.3.3)."""
    return float(min(abs(thousandths), MAX_START_ANGLE)) / 1000.0


def lead_in_force(channel: LatheChannel) -> float:
    """The lead, mm: the number of F, whatever the feed unit; the alarm where a thread cannot have it."""
    lead = feed_number(channel)
    if not lead > 0.0:
        raise channel.control.fail("no_feed", address="F")
    inch = channel.mode["unit"] == "G20"
    least, largest = LEADS_INCH if inch else LEADS_MM
    shown = lead / INCH_MM if inch else lead
    if not least * (1.0 - 1e-9) <= shown <= largest * (1.0 + 1e-9):
        raise channel.control.fail("thread_lead", address="F")
    return lead


def thread_move(
    channel: LatheChannel,
    end: list[float],
    thread: Sequence[float],
    programmed: list[float] | None = None,
    *,
    kind: str = ON_THREAD,
) -> None:
    """One thread stroke: lead, start angle, growth of the lead; without way it is nothing.

    `kind` says whether it is one of a cycle.
    """
    if end == channel.coordinates.position:
        channel.coordinates.arrive(end, programmed)
        return
    lock(channel, kind)
    channel.curve(Kind.THREAD, end, thread[0], parameters=thread, programmed=programmed)


def lock(channel: LatheChannel, kind: str) -> None:
    """From now on moves are locked against the operator as on a thread, or off it; empty: no more."""
    state = ThreadState.of(channel)
    if state.lock != kind:
        state.lock = kind
        channel.context_changed()


def not_between_threads(channel: LatheChannel, level: Level, _step: ProgramStep) -> bool | None:
    """Single block halts behind the first block that is no thread (II.3.1)."""
    is_thread = ThreadState.of(channel).step == level.current and channel.mode["motion"] in THREADS
    return False if is_thread else None


def locked(channel: LatheChannel, context: Context) -> Context:
    """A context with what threads keep from the operator (II.3.1: feed hold acts behind the first other block)."""
    kind = ThreadState.of(channel).lock
    if not kind:
        return context
    if kind in (ON_CYCLE_THREAD, RETRACT):
        context = _accelerated(channel, context)
    if kind == RETRACT:
        context = _retract(channel, context)
    free = kind not in (ON_THREAD, ON_CYCLE_THREAD)
    return replace(
        context,
        feed_hold=False,
        feed_override=context.feed_override and free,
        spindle_override=context.spindle_override and free,
    )


def _accelerated(channel: LatheChannel, context: Context) -> Context:
    """Acceleration after interpolation of thread cycles: exponential, or as for cuts by 1610#5 THL (II.4.1.2).

    1626 is the time constant in milliseconds, and how far an exponential acceleration is behind at speed; a linear or a
    bell-shaped one is half of it behind. 1627 is the FL speed, which an exponential one alone has.
    """
    lags, speeds = [], []
    for axis in plane_axes(channel):
        of = channel.memory.parameters.of(channel.axes[axis])
        straight = of.THL and (of.CTL or of.CTB)
        lags.append(of.thread_time_constant / (2000.0 if straight else 1000.0))
        speeds.append(0.0 if straight else of.thread_fl_speed / 60.0)
    return replace(context, lag_s=max(lags), lag_from=min(speeds)) if any(lags) else context


def _retract(channel: LatheChannel, context: Context) -> Context:
    """The retract of G92 and G76 runs at 1466, or at rapid traverse; 1403#4 ROC keeps its override off (II.4.1.2)."""
    parameters = channel.memory.parameters
    speed = retract_speed(channel)
    if speed > 0.0:
        context = replace(context, feed_mode=FeedMode.PER_MINUTE, rapid_speed=speed)
    elif parameters.CFR:
        context = replace(context, lag_s=0.0)
    elif context.lag_s:
        context = replace(context, rapid_speed=channel.axis_data[plane_axes(channel)[1]].rapid)
    return replace(context, rapid_override=not parameters.ROC)


def retract_speed(channel: LatheChannel) -> float:
    """1466, mm/s; 0 for rapid traverse, as with 1611#0 CFR."""
    parameters = channel.memory.parameters
    return 0.0 if parameters.CFR else parameters.thread_retract_speed / 60.0


def note_retract(channel: LatheChannel, end: list[float]) -> None:
    """A retract along the long axis of a thread is not made: an alarm follows behind the thread (II.3.1)."""
    ways = [abs(e - p) for e, p in zip(end, channel.coordinates.position, strict=True)]
    if ways.index(max(ways)) in ThreadState.of(channel).retract_axes:
        ThreadState.of(channel).retracts = True


def plan_way_off(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """The step of the first block behind threads: feed hold waits for its end."""
    if builder.before["motion"] not in THREADS or builder.mode["motion"] in THREADS:
        return step

    def move(channel: LatheChannel, values: list[float]) -> None:
        lock(channel, OFF_THREAD)
        if step is not None:
            step(channel, values)
        lock(channel, "")
        if ThreadState.of(channel).retracts:
            ThreadState.of(channel).retracts = False
            # The block itself is executed, so its rows stay.
            channel.fail(channel.control.fail("thread_retract"))

    return move


def check_last_lead(channel: LatheChannel, end: list[float], lead: float, growth: float) -> None:
    """The lead must be possible at the end too: with s the way, `lead² + 2·growth·s` is its square there."""
    way = max(abs(e - p) for e, p in zip(end, channel.coordinates.programmed, strict=True))
    last2 = lead * lead + 2.0 * growth * way
    largest = LEADS_MM[1] if channel.mode["unit"] == "G21" else LEADS_INCH[1] * INCH_MM
    if not 0.0 < last2 <= largest * largest:
        raise channel.control.fail("thread_lead", address="K")


#: Feed hold waits for the end of the block behind threads.
RULE = Rule("the way off a thread", modes={"motion": THREADS}, in_cycles=False, wrap=plan_way_off)
