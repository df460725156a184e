"""Rows of the code tables.

A control's G table is a tuple of `GCode` rows: the table says which group a code belongs to, which addresses it takes
and which handler acts. Groups have the field's names (`motion`, `plane`, `distance` …); a control's own group numbers
stand in its tables only where a program can see them (#4001).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import IntEnum

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.toolpath import Context

#: Acts when its block runs.
Handler = Callable[["Channel", "Words"], None]
#: A step of a plan: what a block of one shape does, given its values.
Step = Callable[["Channel", list[float]], Any]
#: Looks at the shape of a block once and gives its step; for codes whose speed matters.
Planner = Callable[["Builder"], "Step | None"]
#: The same for motion codes, which also need the plan that is being made.
MotionPlanner = Callable[["Builder", "Plan"], "Step | None"]
#: What a feature changes in a context.
ContextStep = Callable[["Channel", "Context"], "Context"]
#: Gives an M code of a block another row than its table does, or None.
MRow = Callable[["Builder", int], "MCode | None"]


class Order(IntEnum):
    """Where in its block a code acts; the order in which the controls work a block off."""

    FEED_MODE = 0
    SETTING = 1
    COMPENSATION = 2
    LENGTH = 3
    MOTION = 4
    CALL = 5


@dataclass(frozen=True, slots=True)
class GCode:
    """A row of a G table.

    Attributes:
        code: As written, without leading zeros.
        group: Name of the modal group; empty for a one-shot code.
        handler: What the code does; None if being active in its group is all.
        planner: Instead of a handler: plans the block's motion.
        takes: Addresses beside the axis words that a block with this code may hold; `,R` as `,R`, blank-separated.
        reals: Addresses of whole numbers that this code reads as lengths, angles or factors.
        gives_way: Addresses of `takes` that belong to another code of the block where one takes them.
        axis_words: The code takes the axis words of its block, so that the active motion code does not.
        order: When in the block it acts.
        ends: Another modal group that goes back to its power-on code (a motion code ends a drilling cycle).
        idle_in_cycle: Has no effect in a block while a drilling cycle is active.
        only_changes: Acts only where another code of its group was in force.
        not_yet: Known to the control, not executed by polycnc.
        open: The words of its block that nothing else takes go to the machine with it.
        addresses: The addresses of `takes`.
    """

    code: str
    group: str = ""
    handler: Handler | None = None
    planner: MotionPlanner | None = None
    takes: str = ""
    reals: str = ""
    gives_way: str = ""
    axis_words: bool = False
    order: Order = Order.SETTING
    ends: str = ""
    idle_in_cycle: bool = False
    only_changes: bool = False
    not_yet: bool = False
    open: bool = False
    addresses: tuple[str, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "addresses", tuple(self.takes.split()))


@dataclass(frozen=True, slots=True)
class MCode:
    """A row of an M table.

    Attributes:
        code: Number.
        after: Acts after the motion of its block instead of with it.
        handler: What it does beside being recorded; it gets the words of the block.
        takes: Addresses that belong to it.
        silent: The code is not sent to the machine (M98, M99).
        open: The words of its block that nothing else takes go to the machine with it.
        turns: Its handler lets a spindle turn or stand.
    """

    code: int
    after: bool = False
    handler: Handler | None = None
    takes: str = ""
    silent: bool = False
    open: bool = False
    turns: bool = False


#: What machining centres of every family choose at power-on, by modal group; each family adds and replaces.
MILLING_POWER_ON = {
    "motion": "G0",
    "plane": "G17",
    "distance": "G90",
    "stroke": "G23",
    "feed": "G94",
    "unit": "G21",
    "compensation": "G40",
    "length": "G49",
    "cycle": "G80",
    "return": "G98",
    "scaling": "G50",
    "macro": "G67",
    "surface_speed": "G97",
    "wcs": "G54",
    "path": "G64",
    "rotation": "G69",
    "polar": "G15",
    "mirror": "G50.1",
}


def not_yet(*codes: str) -> tuple[GCode, ...]:
    """Rows of codes that the control knows and polycnc does not execute yet."""
    return tuple(GCode(code, not_yet=True) for code in codes)


def table(*rows: GCode | tuple[GCode, ...]) -> dict[str, GCode]:
    """A G table by code; a later row replaces an earlier one of the same code."""
    flat = [row for item in rows for row in (item if isinstance(item, tuple) else (item,))]
    return {row.code: row for row in flat}


def with_aliases(rows: Mapping[str, GCode], aliases: Mapping[str, str]) -> dict[str, GCode]:
    """A G table in which codes can also be written another way: alias to the code that it stands for."""
    return {**rows, **{alias: rows[code] for alias, code in aliases.items()}}


def m_table(*rows: MCode) -> dict[int, MCode]:
    """An M table by number."""
    return {row.code: row for row in rows}
