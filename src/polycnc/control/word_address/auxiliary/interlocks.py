"""Blocks behind the interlocks of the machine's own controller (PLC): the words that it refuses in some states.

What it refuses is asked in `control/machine_words.py`.
"""

from __future__ import annotations

from polycnc.control.machine_words import (
    UNKNOWN_M,
    MachineSignals,
    asking,
    move_words,
    plc_of,
    refusal,
    refuse,
)
from polycnc.control.word_address.auxiliary.functions import notes
from polycnc.control.word_address.block.rules import Rule
from polycnc.deferred.functions import Deferred
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Note, declare, declared

if TYPE_CHECKING:
    from collections.abc import Iterable

    from polycnc.control.word_address.block.codes import MCode, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.plc import Plc


#: Codes that move the axes of their block once, without the decimal: reference points, skips, hole patterns, G53.
MOVING_CODES = frozenset({"G27", "G28", "G29", "G30", "G31", "G34", "G35", "G36", "G37", "G53"})


def guarded(row: MCode, plc: Plc) -> MCode:
    """A row of an M code behind the machine's interlocks."""
    word = f"M{row.code}"
    if not plc.knows(word):
        return row
    handler = row.handler

    def act(channel: WordAddressChannel, block: Words) -> None:
        refuse(channel, word)
        if handler is not None:
            handler(channel, block)

    does_no_more = handler is None or (not isinstance(handler, Deferred) and declared(handler) is notes)
    if does_no_more and not plc.matters(word):
        declare(act, notes)  # outputs change that refuse nothing
    return replace(row, handler=act)


def unlisted(row: MCode, plc: Plc) -> MCode:
    """A row of an M code that no list and no machine file has: an event, unless the machine checks."""
    if not plc.knows(UNKNOWN_M):
        return row

    def act(channel: WordAddressChannel, _block: Words) -> None:
        refuse(channel, UNKNOWN_M, f"M{row.code}")

    return replace(row, handler=act)


def guarded_word(builder: Builder, address: str, step: Step | None) -> Step | None:
    """The step of a word beside codes behind the interlock of S, T or B; T may call a program behind its block."""
    plc = plc_of(builder.channel)
    if address == "T" and plc.knows("T_CODE"):
        return asking(step, ("T_CODE",), plc)
    if step is None:
        return None
    if address.rstrip("0123456789") == "S":
        return _guarded_speed(step, builder, plc)
    return asking(step, ("B_CODE",), plc) if address == "B" else step


def _guarded_speed(step: Step, builder: Builder, plc: Plc) -> Step:
    """S behind its interlock; where the block starts the spindle too, the start is what is refused."""
    starts = [f"M{number}" for number in builder.m_codes if number in (3, 4)]
    act = asking(step, (*starts[-1:], "S_CODE"), plc)
    told = declared(step)
    if not isinstance(told, Note) or starts or act is step or plc.sets("S_CODE"):
        return act
    return declare(act, told._replace(condition=_lets_speeds_pass, step=step))


def _lets_speeds_pass(channel: WordAddressChannel) -> bool:
    """Whether the machine refuses no S now: its tool is clamped. Neither moves nor S itself change that."""
    signals = MachineSignals.of(channel).known
    return signals is None or refusal(channel, "S_CODE", signals) is None


def guarded_motion(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A move behind the interlocks of its axes, such as a clamped rotary axis."""
    if step is None:
        return None
    plc = plc_of(builder.channel)
    act = asking(step, move_words(builder.channel, (word.axis for word in plan.axis_words)), plc)
    told = declared(step)
    return (
        act if told is None or act is step else declare(act, told)
    )  # plain as long as nothing refuses moves


def note_reference_return(channel: WordAddressChannel, axes: Iterable[str]) -> None:
    """Axes have returned to a reference point: their position is known again."""
    signals = MachineSignals.of(channel).known
    if signals is not None:
        signals.update({f"NOT_REFERENCED_{axis}": 0.0 for axis in axes})


def note_tool_number(channel: WordAddressChannel) -> None:
    """The block of a tool change that is a macro names its tool as an argument: the machine has its number."""
    signals = MachineSignals.of(channel).known
    if signals is not None:
        plc_of(channel).latch("T_CODE", signals)


def ask_for_moves(builder: Builder, plan: Plan) -> Step | None:
    """In front of a code that moves its axes itself, as G28 does: the question whether they may move."""
    if not any(row.axis_words and row.code.partition(".")[0] in MOVING_CODES for row in builder.codes):
        return None
    plc = plc_of(builder.channel)
    words = plc.moves.intersection(move_words(builder.channel, (word.axis for word in plan.axis_words)))
    return asking(None, sorted(words), plc) if words else None


def _refuses_no_moves(channel: WordAddressChannel) -> bool:
    return not channel.memory.machine_refuses_moves


#: What the machine refuses to move.
MOVES_RULE = Rule(
    "moves that the machine refuses", rests=_refuses_no_moves, before=ask_for_moves, wrap=guarded_motion
)
