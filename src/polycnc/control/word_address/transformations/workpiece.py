"""G54.2 dynamic fixture offset of a rotary table, G54.4 workpiece setting error (FANUC 30i; macro B reference §12).

The reference has the names of both; what they do is general knowledge of the control. `coordinates/on_table.py` works
out the work zero. Rotary axes of the table may turn in rapids and straight cuts.
"""

from __future__ import annotations

from math import nan

from polycnc.control.word_address.block.codes import Order
from polycnc.control.word_address.coordinates import on_table, tip
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.tip import TIP_CODES, TipState
from polycnc.control.word_address.cycles import drilling
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.path import reach
from polycnc.control.word_address.states import TiltState
from polycnc.control.word_address.tools import data_input
from polycnc.control.word_address.transformations import turned_tool
from polycnc.control.word_address.transformations.tilted_plane import check_compensation
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Idle, declare
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import AxisWord, Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import MillingChannel, WordAddressChannel

#: Modal groups of the two codes; empty while they are off.
FIXTURE, ERROR = "fixture", "workpiece_error"
#: L of G10.
FIXTURE_DATA = 21
STRAIGHT = {"G0": Kind.RAPID, "G1": Kind.FEED}
ARCS = ("G2", "G3")
#: Codes that go to places of the machine.
RETURNS = ("G27", "G28", "G29", "G30", "G53")


def offset_fixture(channel: MillingChannel, words: Words) -> None:
    """G54.2 P: the work zero goes with the fixture on the table, P0 ends it; the tool goes along unless 7570#0 FTP."""
    number = _number(channel, words, "G54.2", on_table.FIXTURES)
    if number and TiltState.of(channel).plane is not None:
        raise words.fail("tilt_mode", "G54.2")
    if number and OnTable.of(channel).error:
        raise words.fail("improper_g", "G54.2")
    OnTable.of(channel).fixture = number
    channel.mode = channel.mode.with_code(FIXTURE, "G54.2" if number else "")
    c, programmed = channel.coordinates, channel.coordinates.programmed[:]
    on_table.follow(channel)
    if channel.control.goes_with_fixture(channel) and c.programmed != programmed:
        kind = STRAIGHT.get(channel.mode["motion"], Kind.FEED)
        channel.straight(kind, c.to_position(programmed), _feed(channel, kind), programmed)


def correct_workpiece(channel: MillingChannel, words: Words) -> None:
    """G54.4 P: the work lies where its error says, P0 ends it; nothing moves."""
    number = _number(channel, words, "G54.4", on_table.ERRORS)
    if number and OnTable.of(channel).fixture:
        raise words.fail("improper_g", "G54.4")
    state = OnTable.of(channel)
    turns = bool(channel.control.kinematics(channel).axes) and channel.control.turns_tool_with_work(channel)
    state.error, state.turns_tool = number, turns
    if state.turns_tool:
        on_table.begin_posture(channel, told=True)
    channel.mode = channel.mode.with_code(ERROR, "G54.4" if number else "")
    on_table.follow(channel)


def input_data(channel: MillingChannel, words: Words) -> None:
    """G10 L21 P: a fixture offset, linear axes by length and rotary ones by reference angle; G91 adds. Else G10."""
    if words.integer("L") != FIXTURE_DATA:
        data_input.input_data(channel, words)
        return
    number = words.integer("P")
    if number is None or not 1 <= number <= on_table.FIXTURES:
        raise words.fail("g10_number", "P" if number is not None else "G10")
    offset = channel.memory.work_offset(on_table.fixture_name(number))
    for axis, value, incremental in words.axes():
        offset[axis] = offset[axis] + value if incremental else value
    if OnTable.of(channel).acts:
        on_table.follow(channel)


def _number(channel: MillingChannel, words: Words, code: str, last: int) -> int:
    number = words.integer("P")
    if number is None or not 0 <= number <= last:
        raise words.fail("offset_number", "P" if number is not None else code)
    if TipState.of(channel).active is not None:
        raise words.fail("tip_company", code)
    check_compensation(channel, words, code)
    channel.flush()
    return number


def _feed(channel: WordAddressChannel, kind: Kind) -> float:
    if kind == Kind.RAPID:
        return nan
    if not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    return channel.feed


def _not_yet(code: str) -> AlarmError:
    return AlarmError("PC0001", hint="hint.not-supported", code=code)


# ---- rotary axes of the table ------------------------------------------------------------------------------


def _turning(builder: Builder, plan: Plan) -> list[int]:
    """Columns of the table's axes that a block names."""
    named = on_table.table_axes(builder.channel)
    return [word.axis for word in plan.axis_words if builder.channel.axes[word.axis] in named]


def plan_turning(builder: Builder, plan: Plan) -> Step | None:
    """The work zero is that of the block's end; the axes go straight to where its words are then."""
    turning = _turning(builder, plan)
    if TipState.of(builder.channel).active is not None:
        return _plan_posture(builder, plan)
    if not turning:
        return None
    motion, words = builder.mode["motion"], plan.axis_words
    if builder.mode["cycle"] != "G80":
        return None
    if motion not in STRAIGHT:
        return None  # `wrap_turning` looks whether the table turns
    kind, names_feed = STRAIGHT[motion], builder.has("F")
    polar = builder.mode.codes.get("polar") == "G16"

    def move(channel: MillingChannel, values: list[float]) -> None:
        feed = channel.feed if names_feed and kind == Kind.RAPID else _feed(channel, kind)
        before = channel.coordinates.programmed
        goal = channel.control.polar_target(channel, plan, values) if polar else reach(channel, words, values)
        _go(channel, (kind, feed), words, before, goal)

    return move


def _go(
    channel: MillingChannel,
    how: tuple[Kind, float],
    words: Sequence[AxisWord],
    before: list[float],
    goal: list[float],
) -> None:
    """Straight to a programmed point, as the work zero lies when the table has turned there; `how` is kind and feed."""
    c, named = channel.coordinates, on_table.table_axes(channel)
    angles = dict(zip(channel.axes, c.machine, strict=True))
    for word in words:
        if channel.axes[word.axis] in named:
            angles[channel.axes[word.axis]] = goal[word.axis] + c.offsets[word.axis]
    on_table.follow(channel, angles)
    if not OnTable.of(channel).fixture or not channel.control.goes_with_fixture(channel):
        end = c.programmed[:]
        for word in words:
            way = goal[word.axis] - before[word.axis]
            end[word.axis] = end[word.axis] + way if word.incremental else goal[word.axis]
        goal = end
    kind, feed = how
    channel.straight(kind, c.to_position(goal), feed, goal)


def go_over_hole(channel: MillingChannel, words: Sequence[AxisWord], end: list[float]) -> None:
    """Rapid over a hole; where axes of the table turn on the way, as the work zero lies when they have."""
    if turned_tool.acts(channel) and turned_tool.must_turn(channel, words):
        turned_tool.go(channel, turned_tool.RAPID, words, channel.coordinates.programmed, end)
        return
    named = on_table.table_axes(channel) if OnTable.of(channel).acts else ()
    if any(channel.axes[word.axis] in named for word in words):
        _go(channel, (Kind.RAPID, nan), words, channel.coordinates.programmed, end)
    else:
        drilling.rapid_over(channel, words, end)


def follow_behind(builder: Builder, plan: Plan) -> Step | None:
    """Behind G28, G53 and their like the work zero is that of where the table has come to."""
    if not _turning(builder, plan):
        return None

    def follow(channel: WordAddressChannel, _values: list[float]) -> None:
        if OnTable.of(channel).turns_tool:
            on_table.begin_posture(channel)
        on_table.follow(channel)

    return follow


def refuse_one_shot(builder: Builder, plan: Plan) -> Step | None:
    """PC0001 for a one-shot code that would move the axes while a workpiece error has to turn the tool."""
    codes = [row for row in builder.codes if row.axis_words and row.order is Order.MOTION]
    if not codes or all(row.code in RETURNS for row in codes):
        return None
    words = plan.axis_words

    def check(channel: WordAddressChannel, _values: list[float]) -> None:
        if turned_tool.acts(channel) and turned_tool.must_turn(channel, words):
            raise turned_tool.not_yet()

    return declare(check, Idle(lambda channel: not turned_tool.acts(channel)))


# ---- the tool's direction under tip control ----------------------------------------------------------------


def _plan_posture(builder: Builder, plan: Plan) -> Step | None:
    """G43.4: rotary words tell how the tool stands on the work as it should lie; it stands so on the work as it lies.

    The positions of the rotary axes nearest to those words are gone to. Vectors of G43.5 are the work's by themselves.
    """
    words, motion = plan.axis_words, builder.mode["motion"]
    if builder.mode["length"] != "G43.4" or motion not in (*STRAIGHT, *ARCS):
        return None
    if (words or motion in ARCS) and builder.mode.codes.get("polar") == "G16":
        raise _not_yet(f"G16: {builder.mode[ERROR]}")
    if motion in ARCS and any(builder.has(letter) for letter in ("R", *path.CENTER_WORDS)):
        return path.plan_arc(builder, plan, ccw=motion == "G3", reached=reach_posed)
    if not words:
        return None
    if motion in ARCS:
        builder.control.plan_arc_without_center(builder, plan)  # refuses where that is no line
    kind, names_feed = STRAIGHT.get(motion, Kind.FEED), builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed if names_feed and kind == Kind.RAPID else _feed(channel, kind)
        goal = reach_posed(channel, words, values)
        channel.straight(kind, channel.coordinates.to_position(goal), feed, goal)

    return move


def reach_posed(channel: WordAddressChannel, words: tuple[AxisWord, ...], values: list[float]) -> list[float]:
    """The programmed end of a block, its rotary axes where they stand the tool on the work as it lies."""
    c, before = channel.coordinates, channel.coordinates.programmed
    goal = reach(channel, words, values)
    if turned_tool.must_turn(channel, words):
        beside = turned_tool.pose(channel, words, before, goal)
        if c.naming is not None:
            TipState.of(channel).beside = beside
            c.naming = tip.standing(channel)
            channel.context_changed()
    return goal


def wrap_turning(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A cycle with an axis of the table tells the scanner nothing; PC0001 for an arc or a thread that turns one."""
    turning, led = _turning(builder, plan), TipState.of(builder.channel).active is not None
    if step is not None and plan.axis_words and OnTable.of(builder.channel).turns_tool and not led:
        return _turned(builder, plan, step)
    if step is None or not turning or led:
        return step
    drills, motion = builder.mode["cycle"] != "G80", builder.mode["motion"]
    if motion in STRAIGHT and not drills:
        return step

    def move(channel: MillingChannel, values: list[float]) -> None:
        before = channel.coordinates.position
        step(channel, values)
        after = channel.coordinates.position
        if not drills and any(abs(after[axis] - before[axis]) > on_table.NOT_MOVED_DEG for axis in turning):
            raise _not_yet(f"{channel.mode[FIXTURE] or channel.mode[ERROR]}: {motion}")

    return move


def _turned(builder: Builder, plan: Plan, step: Step) -> Step:
    """A block while a workpiece error turns the tool: straight on the table where rotary axes turn in it."""
    motion, words = builder.mode["motion"], plan.axis_words
    drills, polar = builder.mode["cycle"] != "G80", builder.mode.codes.get("polar") == "G16"
    kind, names_feed = STRAIGHT.get(motion), builder.has("F")
    begins, corner = builder.mode["length"] in TIP_CODES, builder.corner()

    def move(channel: MillingChannel, values: list[float]) -> None:
        if drills or begins or not (turned_tool.acts(channel) and turned_tool.must_turn(channel, words)):
            step(channel, values)
            return
        if kind is None or corner is not None:
            raise turned_tool.not_yet()
        feed = channel.feed if names_feed and kind == Kind.RAPID else _feed(channel, kind)
        before = channel.coordinates.programmed
        goal = channel.control.polar_target(channel, plan, values) if polar else reach(channel, words, values)
        turned_tool.go(channel, (kind, feed), words, before, goal)

    return move
