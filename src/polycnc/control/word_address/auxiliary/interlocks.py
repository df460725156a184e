"""Interlocks of the machine's own controller (PLC) while a program is calculated: words that it refuses in some states.

The rows are data (`plc.toml` of the control, read by `machine/plc.py`). Here only what a program itself brings about is
known, and what the setup says of the machine: where the axes stand, and what earlier M codes have done. On the main
run's clock the same rows are asked with the live signals, and this module stands aside.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from polycnc.control.tool_change import stands_at_reference, z_stands_at_change_point
from polycnc.control.word_address.block.rules import Rule
from polycnc.language.bulk import Note, declare, declared
from polycnc.messages import AlarmError
from polycnc.toolpath.events import InterlockQuery

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from polycnc.control.word_address.block.codes import MCode, Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.block.words import Words
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.plc import Plc, PlcAlarm

#: What the rules call an M code that is in no list.
UNKNOWN_M = "UNKNOWN_M"
#: Brakes of rotary axes.
BRAKES = ("FOURTH_AXIS_CLAMPED", "FIFTH_AXIS_CLAMPED")


def _z_is_referenced(channel: WordAddressChannel) -> bool:
    z = channel.coordinates.geometry[2]
    return z < 0 or stands_at_reference(channel, z)


#: Signals that follow from the state of the program.
STATES: Mapping[str, Callable[[WordAddressChannel], bool]] = {
    "Z_AT_REFERENCE": _z_is_referenced,
    "Z_AT_CHANGE_POINT": z_stands_at_change_point,
    "AUTO": lambda channel: channel.setup.switches.mode.lower() != "mdi",
    "MDI": lambda channel: channel.setup.switches.mode.lower() == "mdi",
}


def refuse(channel: WordAddressChannel, word: str, address: str = "") -> None:
    """Raise the machine's alarm if it refuses a word now; else let its rules answer to the word.

    Args:
        channel: The channel.
        word: A word of the rules.
        address: How the program writes it, where that differs.
    """
    plc: Plc = channel.control.plc
    signals: dict[str, float] | None = channel.memory.machine_signals
    if signals is None:
        if word.startswith("MOVE_") or word == UNKNOWN_M:
            channel.event(InterlockQuery(word))  # asked when the axes are there
        return

    row = _refusal(channel, word, signals)
    if row is not None and row.stops:
        channel.mark = channel.toolpath.mark()  # what the block has done before stays: the machine stops here
        raise AlarmError(row.code, address=address or word.removesuffix("_CODE"))
    plc.latch(word, signals)


def _refusal(channel: WordAddressChannel, word: str, signals: dict[str, float]) -> PlcAlarm | None:
    """The row that refuses a word in the state of the program and of the machine."""

    def value(name: str) -> float:
        state = STATES.get(name)
        return float(state(channel)) if state is not None else signals.get(name, 0.0)

    plc: Plc = channel.control.plc
    return plc.refusal(word, value)


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

    return replace(row, handler=act)


def unlisted(row: MCode, plc: Plc) -> MCode:
    """A row of an M code that no list and no machine file has: an event, unless the machine checks."""
    if not plc.knows(UNKNOWN_M):
        return row

    def act(channel: WordAddressChannel, _block: Words) -> None:
        refuse(channel, UNKNOWN_M, f"M{row.code}")

    return replace(row, handler=act)


def nothing(_channel: WordAddressChannel, _values: list[float]) -> None:
    """A word that only the machine's rules answer to."""


def guarded_step(step: Step, words: Iterable[str], plc: Plc) -> Step:
    """A step behind the interlocks of some words, asked in their order."""
    mine = [word for word in words if plc.knows(word)]

    def act(channel: WordAddressChannel, values: list[float]) -> None:
        for word in mine:
            refuse(channel, word)
        step(channel, values)

    return act if mine else step


def guarded_speed(step: Step, builder: Builder) -> Step:
    """S behind its interlock; where the block starts the spindle too, the start is what is refused."""
    control: Any = builder.control
    plc: Plc = control.plc
    starts = [f"M{number}" for number in builder.m_codes if number in (3, 4)]
    act = guarded_step(step, (*starts[-1:], "S_CODE"), plc)
    told = declared(step)
    if not isinstance(told, Note) or starts or act is step:
        return act
    return declare(act, told._replace(condition=_lets_speeds_pass, step=step))


def _lets_speeds_pass(channel: WordAddressChannel) -> bool:
    """Whether the machine refuses no S now: its tool is clamped. Neither moves nor S itself change that."""
    signals: dict[str, float] | None = channel.memory.machine_signals
    return signals is None or _refusal(channel, "S_CODE", signals) is None


def guarded_motion(builder: Builder, plan: Plan, step: Step | None) -> Step | None:
    """A move behind the interlocks of its axes: a clamped rotary axis."""
    if step is None:
        return None
    control: Any = builder.control
    rotary = [data.name for data in builder.channel.axis_data if data.rotary]
    moved = [builder.channel.axes[word.axis] for word in plan.axis_words]
    words = [f"MOVE_{axis}" for axis in moved if axis in rotary]
    fifth = ["MOVE_FIFTH_AXIS"] if any(axis in rotary[1:2] for axis in moved) else []
    told = declared(step)
    act = guarded_step(step, (*words, *fifth), control.plc)
    return act if told is None else declare(act, told)  # plain as long as no brake is on


def holds_an_axis(channel: WordAddressChannel) -> bool:
    """Whether a brake is on, so that moves have to be asked for."""
    signals: dict[str, float] = getattr(channel.memory, "machine_signals", None) or {}
    return any(signals.get(brake) for brake in BRAKES)


def note_reference_return(channel: WordAddressChannel, axes: Iterable[str]) -> None:
    """Axes have returned to a reference point: their position is known again."""
    if channel.memory.machine_signals is not None:
        channel.memory.machine_signals.update({f"NOT_REFERENCED_{axis}": 0.0 for axis in axes})


def note_tool_number(channel: WordAddressChannel) -> None:
    """The block of a tool change that is a macro names its tool as an argument: the machine has its number."""
    plc: Plc = channel.control.plc
    if channel.memory.machine_signals is not None:
        plc.latch("T_CODE", channel.memory.machine_signals)


#: A rotary axis does not move against its brake.
BRAKE_RULE = Rule("brakes of rotary axes", rotary=True, wrap=guarded_motion)
