"""Interlocks of the machine's own controller (PLC): M codes and S words that it refuses in some states.

A control states a table of `Interlock` rows. Only what a program itself brings about is looked at: where the axes
stand, and what earlier M codes have done.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.codes import MCode, Step
    from polycnc.control.word_address.words import Words

#: How close to its change point an axis must stand, mm.
WINDOW_MM = 0.01


@dataclass(frozen=True, slots=True)
class Interlock:
    """A row: these words are refused with this alarm while a state holds."""

    words: frozenset[str]
    holds: Callable[[Channel], bool]
    alarm: str


def words(*names: str) -> frozenset[str]:
    """The words of an interlock: `M6`, `S`."""
    return frozenset(names)


def away_from_tool_change(channel: Channel) -> bool:
    """Z stands neither at its first nor at its second reference point."""
    c = channel.coordinates
    z = c.geometry[2]
    if z < 0:
        return False
    at = c.machine[z]
    return all(abs(at - channel.control.reference_point(channel, z, number)) > WINDOW_MM for number in (1, 2))


def tool_unclamped(channel: Channel) -> bool:
    """M11 has released the tool."""
    return bool(channel.memory.tool_unclamped)


def not_in_mdi(channel: Channel) -> bool:
    """The program does not run in MDI mode."""
    return channel.setup.switches.mode.lower() != "mdi"


def guarded(row: MCode, interlocks: tuple[Interlock, ...]) -> MCode:
    """A row of an M code behind its interlocks."""
    name = f"M{row.code}"
    mine = [interlock for interlock in interlocks if name in interlock.words]
    if not mine:
        return row
    handler = row.handler

    def act(channel: Channel, block: Words) -> None:
        _refuse(channel, mine, name)
        if handler is not None:
            handler(channel, block)

    return replace(row, handler=act)


def guarded_speed(step: Step, interlocks: tuple[Interlock, ...]) -> Step:
    """The step of an S word behind its interlocks."""
    mine = [interlock for interlock in interlocks if "S" in interlock.words]

    def act(channel: Channel, values: list[float]) -> None:
        _refuse(channel, mine, "S")
        step(channel, values)

    return act if mine else step


def _refuse(channel: Channel, interlocks: list[Interlock], word: str) -> None:
    for interlock in interlocks:
        if interlock.holds(channel):
            raise AlarmError(interlock.alarm, address=word)


def clamp_tool(channel: Channel, _words: Words) -> None:
    """M10."""
    channel.memory.tool_unclamped = False


def unclamp_tool(channel: Channel, _words: Words) -> None:
    """M11."""
    channel.memory.tool_unclamped = True
