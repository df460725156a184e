"""19696#5 WKP = 1: words of G43.4 name the tip in the work system, which does not turn with the table.

The end of a block is named as the table has turned at it; the tip goes straight on the table (FANUC 30i, A-79348E, page
20). So rows hold the tip on the table, as without WKP, and displays show it in the work system (`Coordinates.naming`).
Arcs, chamfers and roundings are those on the table; it may turn their plane in itself only.
"""

from __future__ import annotations

from math import nan

from polycnc.control.fanuc.milling import leaning
from polycnc.control.fanuc.milling.five_axes import not_yet
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.coordinates import on_table
from polycnc.control.word_address.coordinates.tip import TIP_CODES, TipState
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.arcs import mirrors_plane, scales, write_with_rest
from polycnc.control.word_address.tools import length
from polycnc.control.word_address.transformations import tool_center_point, workpiece
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, cross, dot
from polycnc.machine.kinematics import unit
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.geometry.arcs import Point

#: Modal group: "work" while words name the tip in a system that does not turn.
SYSTEM = "tip_system"
STRAIGHT, ARCS = {"G0": Kind.RAPID, "G1": Kind.FEED}, ("G2", "G3")
#: An axis that turns by less (degrees) stands; directions whose sine is smaller are the same.
NO_TURN_DEG, ALONG = 1e-6, 1e-6
#: Codes whose ways are not told in that system: polycnc executes them without it alone.
NOT_STANDING = frozenset(("G6.2", "G31", "G37", "G45", "G46", "G47", "G48", "G60"))


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: words name the tip on the table, by 19696#5 WKP in the work system; PS5459 for G43.5 with that.

    Where the table turns, directions begin behind the block of G43.5 (PS5421, as in the control's list of alarms).
    """
    directed = channel.mode["length"] == "G43.5" and any(letter in words for letter in "IJK")
    if directed and channel.control.kinematics(channel).work:
        raise words.fail("tip_company", "G43.5")
    stands = FanucMillingParameters.naming(channel.setup.parameters).WKP
    if stands and channel.mode["length"] == "G43.5":
        raise words.fail("tip_direction", "G43.5")
    state = TipState.of(channel)
    state.stands, state.beside = stands, ()
    tool_center_point.start_following(channel, words)
    leaning.begin(channel, words)
    channel.mode = channel.mode.with_code(SYSTEM, "work" if stands else "")
    channel.context_changed()


def end_following(channel: WordAddressChannel) -> None:
    """G49 or another length code: the axes are named themselves again; nothing moves."""
    TipState.of(channel).stands = False
    tool_center_point.end_following(channel)
    leaning.end(channel)
    channel.mode = channel.mode.with_code(SYSTEM, "")


def compensate_length(channel: WordAddressChannel, words: Words) -> None:
    """G43, G44 H: the length offset of Z; it ends tool centre point control."""
    end_following(channel)
    length.compensate_length(channel, words)


def cancel_length(channel: WordAddressChannel, words: Words) -> None:
    """G49: neither length nor tool centre point control."""
    end_following(channel)
    length.cancel_length(channel, words)


def check_lengths(builder: Builder) -> None:
    """PS5421 for G43.4 within G43.5 and the other way round, PS5452 for tip control within G43, G44 and so on.

    General knowledge of FANUC 30i (its lists of these alarms).
    """
    before, after = builder.before["length"], builder.mode["length"]
    led = [code in TIP_CODES for code in (before, after)]
    if all(led) and before != after:
        raise builder.control.fail("tip_company", address=after)
    if any(led) and not all(led) and "G49" not in (before, after):
        raise builder.control.fail("five_axis_mode", address=after)


def check_block(builder: Builder) -> None:
    """Refuse codes whose ways are not told in that system."""
    if builder.mode["length"] != "G43.4":
        return
    for row in builder.codes:
        if row.code in NOT_STANDING:
            raise not_yet(f"{row.code}: 19696#5")


def plan_arc(builder: Builder, plan: Plan) -> Step | None:
    """An arc ends in the work system, as the table has turned there."""
    if builder.mode["length"] != "G43.4" or builder.mode["motion"] not in ARCS:
        return None
    told = path.read_center(builder)
    return None if told is None else _arc(builder, plan, told)


def _arc(builder: Builder, plan: Plan, told: path.CenterWords) -> Step:
    """An arc on the table: its centre counts from its start, as the table has turned there (B-63944EN/02, page 669)."""
    motion, plane = builder.mode["motion"], PLANES[builder.mode["plane"]]
    polar, corner = builder.mode.codes.get("polar") == "G16", builder.corner()
    reached = workpiece.reach_posed if builder.mode[workpiece.ERROR] else path.reach
    if polar and builder.mode[workpiece.ERROR]:
        raise not_yet("G54.4 G16: 19696#5")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        if not channel.feed > 0.0:
            raise channel.control.fail("no_feed")
        c, named, begin = channel.coordinates, told.tell(values), _told(channel, channel.coordinates.position)
        columns = [c.geometry[axis] for axis in plane[:2]]
        middle = _middle(channel, columns, named)
        if polar:
            goal = channel.control.polar_target(channel, plan, values)
        else:
            goal = reached(channel, plan.axis_words, values)
        end, ccw = c.to_position(goal), (motion == "G3") != mirrors_plane(c.programming, plane)
        if not _turns_in_plane(channel, plane[2], begin, _told(channel, end)):
            raise channel.control.fail("tip_company", address=motion)
        first, last = ((point[columns[0]], point[columns[1]]) for point in (c.position, end))
        if isinstance(named, float):
            named *= max(scales(c.programming, plane))
        else:
            named = middle[columns[0]] - first[0], middle[columns[1]] - first[1]
        found, _ = path.find_center(channel, first, last, named, ccw)
        if corner is not None:
            corner(channel, values)
        if found is None:
            channel.straight(Kind.FEED, end, channel.feed, goal)
        else:
            write_with_rest(channel, end, found, plane, ccw=ccw, feed=channel.feed, programmed=goal)

    return move


def _middle(channel: WordAddressChannel, columns: list[int], named: float | Point) -> list[float]:
    """The centre on the table, by its way from the start; the start where a radius tells the arc."""
    c = channel.coordinates
    middle = c.programmed[:]
    if not isinstance(named, float):
        for column, way in zip(columns, named, strict=True):
            middle[column] += way
    return c.to_position(middle)


def _told(channel: WordAddressChannel, position: list[float]) -> list[float]:
    """A position of the path with rotary axes as words tell them, on a work that lies elsewhere too."""
    beside = TipState.of(channel).beside
    return [value + way for value, way in zip(position, beside, strict=True)] if beside else position


def keep_plane(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """PS5421 for a chamfer or a rounding in a plane that the table turns out of itself."""
    if step is None or builder.mode["length"] != "G43.4" or builder.corner() is None:
        return step
    motion, w = builder.mode["motion"], PLANES[builder.mode["plane"]][2]

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        begin = _told(channel, channel.coordinates.position)
        step(channel, values)
        if not _turns_in_plane(channel, w, begin, _told(channel, channel.coordinates.position)):
            raise channel.control.fail("tip_company", address=motion)

    return move


def plan_start(builder: Builder, plan: Plan) -> Step | None:
    """The block in which tip control begins: the axes go straight to where its words are (B-63944EN/02, page 656)."""
    motion, words = builder.mode["motion"], plan.axis_words
    if motion not in STRAIGHT or builder.before["length"] in TIP_CODES:
        return None
    if builder.mode["length"] == "G43.5":
        directed = tool_center_point.plan_with_direction(
            builder, plan, leaning.leaned if builder.has("Q") else None, _straight_by_axes
        )
        if directed is not None:
            return directed
    if not words or builder.mode["polar"] == "G16" or builder.corner() is not None:
        return None
    kind, names_feed = STRAIGHT[motion], builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed if kind == Kind.FEED or names_feed else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        programmed = path.reach(channel, words, values)
        _straight_by_axes(channel, kind, channel.coordinates.to_position(programmed), feed, programmed)
        standing = channel.control.kinematics(channel).axes
        on_table.begin_posture(channel, told=any(channel.axes[word.axis] in standing for word in words))

    return move


def _straight_by_axes(
    channel: WordAddressChannel, kind: Kind, end: list[float], feed: float, _programmed: list[float]
) -> None:
    """Straight in the axes to where tip control will have the tip; displays show this already."""
    from polycnc.transformation.couplings.coupled import Shown

    c = channel.coordinates
    led, naming, machine = c.transformation, c.naming, c.to_machine(end)
    channel.flush()
    c.transform(None)
    shown = naming.bare if isinstance(naming, Shown) else led
    with channel.under(replace(channel.context, shown_by=shown)):
        channel.straight(kind, c.from_machine(machine), feed)
        channel.flush()
    c.transform(led, naming=naming)
    channel.context_changed()


def refuse_standing_arc(builder: Builder, plan: Plan) -> Step | None:
    """PS5421 for a block of G02 or G03 that turns rotary axes alone: the tip stands (A-79348E, page 14)."""
    motion, words = builder.mode["motion"], plan.axis_words
    tip = builder.mode["length"] in TIP_CODES
    if (
        tip
        and words
        and motion in ARCS
        and not any(builder.has(letter) for letter in ("R", *path.CENTER_WORDS))
    ):
        rotary = [builder.channel.axis_data[word.axis].rotary for word in words]
        if all(rotary):
            raise builder.control.fail("tip_company", address=motion)
    return None


def _turns_in_plane(channel: WordAddressChannel, w: int, begin: list[float], end: list[float]) -> bool:
    """Whether the table turns the plane that is square on an axis (0 to 2) in itself, during the block and before it.

    Axes that are square on the plane may turn, others stand as they did when tip control began.
    """
    normal, kinematics, started = (
        axis_vector(w),
        channel.control.kinematics(channel),
        TipState.of(channel).begun,
    )
    offsets = channel.coordinates.offsets
    angles, ends = (
        {name: value + zero for name, value, zero in zip(channel.axes, point, offsets, strict=True)}
        for point in (begin, end)
    )
    for number, joint in enumerate(kinematics.work):
        if abs(ends[joint.axis] - angles[joint.axis]) > NO_TURN_DEG:
            outer = replace(kinematics, work=kinematics.work[:number]).work_turn(angles)
            x, y, z = cross(outer.direct(*unit(joint.direction)), normal)
            if x * x + y * y + z * z > ALONG * ALONG:
                return False
    turned = (kinematics.work_turn(angles) @ started.inverse()).direct(*normal)
    return dot(turned, normal) > 1.0 - ALONG * ALONG
