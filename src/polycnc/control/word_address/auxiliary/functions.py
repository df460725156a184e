"""F, S, T and M: feed, spindle, tool, stops and program end."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, plain
from polycnc.control.word_address.motion.path import FEED_MODES
from polycnc.control.word_address.tools.radius import suspended
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.language.bulk import Conversion, Note, Scaling, SetFeed, Word, declare
from polycnc.toolpath.events import Auxiliary, SecondAuxiliary, SpindleSpeed, ToolSelection
from polycnc.toolpath.modes import FeedMode

with loaded_when_called():
    from polycnc.control import tool_change
    from polycnc.control.word_address.motion import corners

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel


def plan_feed(builder: Builder) -> Step:
    """F: mm/min or inch/min, mm/rev or inch/rev, 1/min, as the feed mode says."""
    slot = builder.slots["F"][0]
    mode = FEED_MODES[builder.mode["feed"]]
    unit = INCH_MM if builder.inch and mode is not FeedMode.INVERSE_TIME else 1.0
    factor = builder.control.feed_factor(builder, builder.slots["F"][1], mode) * unit
    if mode is FeedMode.PER_REVOLUTION:

        def set_feed_per_revolution(channel: WordAddressChannel, values: list[float]) -> None:
            channel.feed = values[slot] * factor

        return declare(set_feed_per_revolution, SetFeed(Word(slot, Conversion(Scaling.TIMES, 1.0, factor))))

    def set_feed(channel: WordAddressChannel, values: list[float]) -> None:
        channel.feed = values[slot] * factor / 60.0

    return declare(set_feed, SetFeed(Word(slot, Conversion(Scaling.RATIO, 60.0, factor))))


def plan_spindle_speed(builder: Builder) -> Step:
    """S: programmed speed of the spindle (surface speed under G96)."""
    slot = builder.slots["S"][0]
    chosen = builder.control.spindle_slot(builder)

    def set_speed(channel: WordAddressChannel, values: list[float]) -> None:
        memory, speed = channel.memory, values[slot]
        if memory.spindle.speed != speed:
            memory.spindle.speed = speed
            channel.context_changed()
        spindle = 1 if chosen is None else int(values[chosen])
        channel.event(SpindleSpeed(speed=_number(speed), spindle=spindle))

    return set_speed if chosen is not None else declare(set_speed, Note(slot, lowest=0.0))


def plan_tool(builder: Builder) -> Step:
    """T: selects the next tool; M06 brings it into the spindle."""
    slot = builder.slots["T"][0]

    def select(channel: WordAddressChannel, values: list[float]) -> None:
        channel.memory.tool.next = int(values[slot])
        channel.event(ToolSelection(_number(values[slot])))

    return declare(select, Note(slot, lowest=0.0))


def plan_second_auxiliary(builder: Builder) -> Step:
    """B (where no axis has that name): second auxiliary function, for the machine's builder."""
    slot = builder.slots["B"][0]

    def send(channel: WordAddressChannel, values: list[float]) -> None:
        channel.event(SecondAuxiliary(_number(values[slot])))

    return send


def _number(value: float) -> float | int:
    return int(value) if value == int(value) else value


def bring_to_change(channel: WordAddressChannel) -> None:
    """The axes go to where tools are changed, without compensation, if the change itself leads them there."""
    if way := tool_change.way_to_change(channel):
        with suspended(channel):
            tool_change.follow(channel, way)


def change_tool(channel: WordAddressChannel, _words: Words) -> None:
    """M06: the selected tool comes into the spindle."""
    bring_to_change(channel)
    channel.memory.tool.number = channel.memory.tool.next
    channel.context_changed()


def spindle_clockwise(channel: WordAddressChannel, _words: Words) -> None:
    """M03."""
    channel.memory.spindle.direction = 1
    channel.context_changed()


def spindle_counter_clockwise(channel: WordAddressChannel, _words: Words) -> None:
    """M04."""
    channel.memory.spindle.direction = -1
    channel.context_changed()


def spindle_stop(channel: WordAddressChannel, _words: Words) -> None:
    """M05."""
    channel.memory.spindle.direction = 0
    channel.context_changed()


def notes(_plan: Plan) -> Note:
    """What a handler does that only changes the context, or nothing but outputs of the machine."""
    return Note()


for _handler in (spindle_clockwise, spindle_counter_clockwise, spindle_stop):
    declare(_handler, notes)


@dataclass(frozen=True, slots=True)
class RigidTapping:
    """Where the axes stood and how fast the spindle was to turn when rigid tapping was commanded."""

    machine: tuple[float, ...]
    speed: float


@dataclass(slots=True)
class RigidTappingState(State, lifetime=Lifetime.RESET):
    """What M29 found, until the tapping cycle that it is meant for."""

    armed: RigidTapping | None = None


def arm_rigid_tapping(channel: WordAddressChannel, words: Words) -> None:
    """M29 S: the next tapping cycle is rigid; nothing may move in between."""
    speed = words.typed("S")
    memory = channel.memory
    RigidTappingState.of(channel).armed = RigidTapping(
        tuple(channel.coordinates.machine), memory.spindle.speed if speed is None else speed
    )


def stop(channel: WordAddressChannel, _words: Words) -> None:
    """M00: stop until the operator starts again."""
    channel.stop("M00")


def optional_stop(channel: WordAddressChannel, _words: Words) -> None:
    """M01: as M00 while the operator's switch is on; else a function as any other, for which the axes stand."""
    if channel.optional_stop:
        channel.stop("M01")
    else:
        channel.event(Auxiliary(1))


def end_program(channel: WordAddressChannel, _words: Words) -> None:
    """M02, M30: the run is over."""
    channel.end()


def dwell(channel: WordAddressChannel, words: Words, *, in_revolutions: bool = False) -> None:
    """G04 X or U (seconds; without a point least increments of time) or P (milliseconds); or so many revolutions."""
    for word in words.plan.axis_words:
        if word.address not in "XU":
            raise words.fail("address", word.address)
    times = [address for address in "XUP" if address in words]
    if len(times) > 1:
        raise words.fail("address", times[1])
    if channel.path.head is not None:
        corners.dwell(channel)
    milliseconds = words.integer("P")
    if milliseconds is None:
        value = next((_seconds(words, address) for address in ("X", "U") if address in words), None)
    else:
        value = milliseconds / 1000.0
    if value is None:
        return
    if in_revolutions:
        channel.dwell(revolutions=value)
    else:
        stand(channel, value)


@dataclass(slots=True)
class Clocks(State, lifetime=Lifetime.POWER):
    """The clocks that programs read (#3001, #3002).

    Attributes:
        seconds: What they have counted.
        zero: At which second each of them read zero, by its name.
        is_read: Whether a program has looked at one.
    """

    seconds: float = 0.0
    zero: dict[str, float] = field(default_factory=dict)
    is_read: bool = False

    def compared(self) -> object:
        """What was counted matters to a program that has looked."""
        return super().compared() if self.is_read else plain(self.zero)


def stand(channel: WordAddressChannel, seconds: float) -> None:
    """A dwell, which the clocks of the macro variables count."""
    Clocks.of(channel).seconds += max(seconds, 0.0)
    channel.dwell(seconds=seconds)


def _seconds(words: Words, address: str) -> float:
    """The time of an X or U word; written before G04 it has been read with the decimals of a length."""
    value = words.typed(address) or 0.0
    rules = words.plan.rules
    order = words.plan.order
    if words.plan.inch and order.index(address) < order.index("G4"):
        return value if words.form(address) == "" else value * 10.0**rules.decimals_inch / 1000.0
    return value / 1000.0 if words.form(address) == "" and not rules.calculator else value
