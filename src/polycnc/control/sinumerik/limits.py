"""Software limit switches and the working area: targets beyond them raise an alarm before anything moves.

Source: Fundamentals (G25, G26, WALIMON, WALIMOF), machine data 36100 and 36110, setting data 43400 to 43430.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.memory import Memory

SWITCH, WORKING_AREA = "10720", "10730"
_SLACK = 1e-6
#: Data that limits are made of.
DATA = frozenset(
    (
        "$SA_WORKAREA_PLUS_ENABLE",
        "$SA_WORKAREA_MINUS_ENABLE",
        "$SA_WORKAREA_LIMIT_PLUS",
        "$SA_WORKAREA_LIMIT_MINUS",
    )
)


class Limit(NamedTuple):
    """The range of an axis in machine coordinates, and the alarm for a target outside it."""

    column: int
    low: float
    high: float
    alarm: str


def refresh(channel: Channel) -> None:
    """Work out the limits that hold now; only those that setup or program gave a value."""
    memory: Memory = channel.memory
    data = memory.data
    limits = []
    for column, name in enumerate(channel.axes):
        minus, plus = (f"$MA_POS_LIMIT_{side}{_pair(channel, column, side)}" for side in ("MINUS", "PLUS"))
        low = data.number(minus, name) if data.is_set(minus, name) else -inf
        high = data.number(plus, name) if data.is_set(plus, name) else inf
        limits.append(Limit(column, low, high, SWITCH))
        if channel.mode["working_area"] == "WALIMON":
            below, above = (
                bool(data.number(f"$SA_WORKAREA_{side}_ENABLE", name)) for side in ("MINUS", "PLUS")
            )
            low = data.number("$SA_WORKAREA_LIMIT_MINUS", name) if below else -inf
            high = data.number("$SA_WORKAREA_LIMIT_PLUS", name) if above else inf
            limits.append(Limit(column, low, high, WORKING_AREA))
    memory.limits = tuple(limit for limit in limits if limit.low > -inf or limit.high < inf)


def _pair(channel: Channel, column: int, side: str) -> str:
    """Which of the two limit switches the PLC has chosen: nothing for the first, `2` for the second."""
    bit = {"MINUS": 2, "PLUS": 3}[side]
    return "2" if channel.setup.switches.plc.get(f"DB{31 + column}.DBX12.{bit}") else ""


def check(channel: Channel, end: list[float]) -> None:
    """Refuse a target beyond a limit: 10720 for a software limit switch, 10730 for the working area."""
    machine = channel.coordinates.to_machine(end)
    for limit in channel.memory.limits:
        value = machine[limit.column]
        if value < limit.low - _SLACK or value > limit.high + _SLACK:
            side = "-" if value < limit.low else "+"
            raise AlarmError(limit.alarm, axis=channel.axes[limit.column], side=side)
