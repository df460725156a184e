"""19696#5 WKP = 1: words of G43.4 name the tip in the work system, which does not turn with the table.

The end of a block is named as the table has turned at it; the tip goes straight on the table (FANUC 30i, A-79348E, page
20). So rows hold the tip on the table, as without WKP, and displays show it in the work system. Arcs are those on the
table; it may turn their plane in itself only. What would take words in another way is PC0001: one-shot codes with axis
words, G92, G16, chamfers, and a system that is mirrored, scaled or rotated.
"""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.control.fanuc.milling import leaning
from polycnc.control.fanuc.milling.five_axes import not_yet
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates import on_table
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.motion.arcs import emit_arc, write_with_rest
from polycnc.control.word_address.transformations import tool_center_point
from polycnc.deferred.records import replace
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, cross, dot
from polycnc.machine.kinematics import unit
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import AxisWord, Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.toolpath import Context
    from polycnc.transformation.couplings.coupled import Shown

#: Modal group: "work" while words name the tip in a system that does not turn.
SYSTEM = "tip_system"
STRAIGHT, ARCS = {"G0": Kind.RAPID, "G1": Kind.FEED}, ("G2", "G3")
#: An axis that turns by less (degrees) stands; directions whose sine is smaller are the same.
NO_TURN_DEG, ALONG = 1e-6, 1e-6
#: Codes with axis words that name no place of the tip.
ALLOWED = frozenset(("G4", "G10", "G52", "G65", "G66", "G66.1"))


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: words name the tip on the table, by 19696#5 WKP in the work system; PS5459 for G43.5 with that.

    Where the table turns, directions begin behind the block of G43.5 (PS5421, as in the control's list of alarms).
    PC0001 by WKP with an arc in the block and with G54.4.
    """
    directed = channel.mode["length"] == "G43.5" and any(letter in words for letter in "IJK")
    if directed and channel.control.kinematics(channel).work:
        raise words.fail("tip_company", "G43.5")
    stands = FanucMillingParameters.naming(channel.setup.parameters).WKP
    if stands and channel.mode["length"] == "G43.5":
        raise words.fail("tip_direction", "G43.5")
    curved = bool(words.axes()) and channel.mode["motion"] not in STRAIGHT
    if stands and (OnTable.of(channel).error or curved):
        raise not_yet("G43.4: 19696#5")
    tool_center_point.start_following(channel, words)
    leaning.begin(channel, words)
    channel.mode = channel.mode.with_code(SYSTEM, "work" if stands else "")
    channel.context_changed()


def end_following(channel: WordAddressChannel) -> None:
    """G49 or another length code: the axes are named themselves again; nothing moves."""
    tool_center_point.end_following(channel)
    leaning.end(channel)
    channel.mode = channel.mode.with_code(SYSTEM, "")


def shown(channel: WordAddressChannel) -> Shown:
    """From the tip in the work system to its places on the table, and back."""
    from polycnc.transformation.couplings.coupled import Shown

    state = TipState.of(channel)
    if state.active is None or state.seated is None:
        raise ValueError("tip control does not lead")
    bare = replace(state.active, kinematics=replace(state.active.kinematics, work=()))
    return Shown(state.seated, bare)


def place(channel: WordAddressChannel, position: list[float]) -> list[float]:
    """A position of the path as words name it."""
    return shown(channel).to_work(position) if _acts(channel) else position


def _acts(channel: WordAddressChannel) -> bool:
    return channel.mode.codes.get(SYSTEM) == "work" and TipState.of(channel).is_leading(channel)


def displayed(channel: WordAddressChannel, context: Context) -> Context:
    """A context while words name the tip in the work system: displays show it there."""
    return replace(context, shown_by=shown(channel)) if _acts(channel) else context


def _check_block(builder: Builder) -> None:
    if builder.mode["length"] != "G43.4":
        return
    for row in builder.codes:
        other = row.group == "motion" and row.code not in (*STRAIGHT, *ARCS)
        if other or row.code == "G92" or (row.axis_words and row.code not in ALLOWED):
            raise not_yet(f"{row.code}: 19696#5")
    if builder.mode["polar"] == "G16":
        raise not_yet("G16: 19696#5")


def _plan(builder: Builder, plan: Plan) -> Step | None:
    """A block names its end in the work system, as the table has turned there."""
    motion = builder.mode["motion"]
    if builder.mode["length"] != "G43.4" or motion not in (*STRAIGHT, *ARCS):
        return None
    told = path.read_center(builder) if motion in ARCS else None
    if told is not None:
        _refuse_corner(builder)
        return _arc(builder, plan, told)
    if not plan.axis_words:
        return None
    _refuse_corner(builder)
    if motion in ARCS:
        builder.control.plan_arc_without_center(builder, plan)  # refuses where that is no line
    return _straight(builder, plan)


def _refuse_corner(builder: Builder) -> None:
    if builder.corner() is not None:
        raise not_yet(",C: 19696#5")


def _straight(builder: Builder, plan: Plan) -> Step:
    words, kind, names_feed = (
        plan.axis_words,
        STRAIGHT.get(builder.mode["motion"], Kind.FEED),
        builder.has("F"),
    )

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed if kind == Kind.FEED or names_feed else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        channel.straight(kind, _end(channel, words, values), feed)

    return move


def _end(channel: WordAddressChannel, words: tuple[AxisWord, ...], values: list[float]) -> list[float]:
    """The end of a block on the table."""
    c, seen = channel.coordinates, shown(channel)
    if not c.direct:
        raise not_yet("G51.1: 19696#5")
    end = seen.to_machine(path.target(channel, words, values, seen.to_work(c.position)))
    c.pending = [0.0] * len(c.pending)
    c.owes = False
    return end


def _arc(builder: Builder, plan: Plan, told: path.CenterWords) -> Step:
    """An arc on the table: its centre counts from its start, as the table has turned there (B-63944EN/02, page 669)."""
    words, plane, ccw = plan.axis_words, PLANES[builder.mode["plane"]], builder.mode["motion"] == "G3"
    u, v, w = plane

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        if not channel.feed > 0.0:
            raise channel.control.fail("no_feed")
        c, seen = channel.coordinates, shown(channel)
        begin, named = c.position[:], told.tell(values)
        center = seen.to_work(begin)
        end = _end(channel, words, values)
        if not _turns_in_plane(channel, w, begin, end):
            raise channel.control.fail("tip_company", address=builder.mode["motion"])
        columns = c.geometry[u], c.geometry[v]
        if not isinstance(named, float):
            for column, way in zip(columns, named, strict=True):
                center[column] += way
            center = seen.to_machine(center)
            named = center[columns[0]] - begin[columns[0]], center[columns[1]] - begin[columns[1]]
        first, last = ((point[columns[0]], point[columns[1]]) for point in (begin, end))
        found, beside = path.find_center(channel, first, last, named, ccw)
        if found is None:
            channel.straight(Kind.FEED, end, channel.feed)
        elif beside:
            write_with_rest(channel, end, found, plane, ccw=ccw, feed=channel.feed, programmed=end)
        else:
            emit_arc(channel, end, found, plane, ccw=ccw, feed=channel.feed)

    return move


def _plan_start(builder: Builder, plan: Plan) -> Step | None:
    """The block in which tip control begins: the axes go straight to where its words are (B-63944EN/02, page 656)."""
    motion, words = builder.mode["motion"], plan.axis_words
    begins = motion in STRAIGHT and builder.before["length"] not in tool_center_point.TIP_CODES
    if not words or not begins or any(builder.has(letter) for letter in "IJK"):
        return None
    if builder.mode["polar"] == "G16" or builder.corner() is not None:
        return None
    kind, names_feed = STRAIGHT[motion], builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        feed = channel.feed if kind == Kind.FEED or names_feed else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        c, led = channel.coordinates, channel.coordinates.transformation
        machine = c.to_machine(c.to_position(path.reach(channel, words, values)))
        channel.flush()
        c.transform(None)
        with channel.under(replace(channel.context, shown_by=led)):
            channel.straight(kind, c.from_machine(machine), feed)
            channel.flush()
        c.transform(led)
        standing = channel.control.kinematics(channel).axes
        on_table.begin_posture(channel, told=any(channel.axes[word.axis] in standing for word in words))
        channel.context_changed()

    return move


def _refuse_standing_arc(builder: Builder, plan: Plan) -> Step | None:
    """PS5421 for a block of G02 or G03 that turns rotary axes alone: the tip stands (A-79348E, page 14)."""
    motion, words = builder.mode["motion"], plan.axis_words
    tip = builder.mode["length"] in tool_center_point.TIP_CODES
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


#: Words while they name the tip in a system that does not turn.
RULE = Rule("tip in a system that stands", modes={SYSTEM: ("work",)}, check=_check_block, motion=_plan)
#: Arcs of the tip.
ARC_RULE = Rule(
    "arcs under tip control",
    modes={"length": tool_center_point.TIP_CODES},
    motion=_refuse_standing_arc,
)
#: Straight blocks in which tip control begins.
START_RULE = Rule("block in which tip control begins", codes=tool_center_point.TIP_CODES, motion=_plan_start)
