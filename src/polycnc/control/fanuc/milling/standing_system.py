"""19696#5 WKP = 1: words of G43.4 name the tip in the work system, which does not turn with the table.

The end of a block is named as the table has turned at it; the tip goes straight on the table (FANUC 30i, A-79348E, page
20). So rows hold the tip on the table, as without WKP, and displays show it in the work system. What would take words
in another way is PC0001: arcs while the table stands elsewhere than at the start, one-shot codes with axis words, G92,
G16, chamfers, and a system that is mirrored, scaled or rotated.
"""

from __future__ import annotations

from dataclasses import replace
from math import nan
from typing import TYPE_CHECKING

from polycnc.control.fanuc.milling import leaning
from polycnc.control.fanuc.milling.five_axes import not_yet
from polycnc.control.fanuc.milling.parameters import FanucMillingParameters
from polycnc.control.word_address.block.rules import Rule
from polycnc.control.word_address.coordinates.on_table import OnTable
from polycnc.control.word_address.coordinates.tip import TipState
from polycnc.control.word_address.motion.path import target
from polycnc.control.word_address.transformations import tool_center_point
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.toolpath import Context
    from polycnc.transformation.couplings.coupled import Shown

#: Modal group: "work" while words name the tip in a system that does not turn.
SYSTEM = "tip_system"
STRAIGHT, ARCS = {"G0": Kind.RAPID, "G1": Kind.FEED}, ("G2", "G3")
#: Codes with axis words that name no place of the tip.
ALLOWED = frozenset(("G4", "G10", "G52", "G65", "G66", "G66.1"))


def start_following(channel: WordAddressChannel, words: Words) -> None:
    """G43.4, G43.5 H: words name the tip on the table, by 19696#5 WKP in the work system; PS5459 for G43.5 with that.

    PC0001 by WKP with axis words in the block, with G54.2 and with G54.4.
    """
    stands = FanucMillingParameters.naming(channel.setup.parameters).WKP
    if stands and channel.mode["length"] == "G43.5":
        raise words.fail("tip_direction", "G43.5")
    if stands and (OnTable.of(channel).acts or words.axes()):
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
    """A straight block: its words are the end in the work system, as the table has turned there."""
    motion, words = builder.mode["motion"], plan.axis_words
    if not words or builder.mode["length"] != "G43.4" or motion not in STRAIGHT:
        return None
    if builder.corner() is not None:
        raise not_yet(",C: 19696#5")
    kind, names_feed = STRAIGHT[motion], builder.has("F")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        c, seen = channel.coordinates, shown(channel)
        if not c.direct:
            raise not_yet("G51.1: 19696#5")
        feed = channel.feed if kind == Kind.FEED or names_feed else nan
        if kind == Kind.FEED and not feed > 0.0:
            raise channel.control.fail("no_feed")
        end = seen.to_machine(target(channel, words, values, seen.to_work(c.position)))
        c.pending = [0.0] * len(c.pending)
        c.owes = False
        channel.straight(kind, end, feed)

    return move


def _wrap(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """An arc is that of the work system while the table stands as it did when tip control began."""
    if step is None or builder.mode["motion"] not in ARCS or builder.mode["length"] != "G43.4":
        return step
    if any(builder.channel.axis_data[word.axis].rotary for word in plan.axis_words):
        raise not_yet(f"{builder.mode['motion']}: 19696#5")

    def move(channel: WordAddressChannel, values: list[float]) -> None:
        here = dict(zip(channel.axes, channel.coordinates.machine, strict=True))
        if channel.control.kinematics(channel).work_turn(here) != TipState.of(channel).begun:
            raise not_yet("G2: 19696#5")
        step(channel, values)

    return move


#: Words while they name the tip in a system that does not turn.
RULE = Rule(
    "tip in a system that stands", modes={SYSTEM: ("work",)}, check=_check_block, motion=_plan, wrap=_wrap
)
