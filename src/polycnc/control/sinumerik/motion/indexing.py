"""Coded positions of indexing axes: CAC, CIC, CDC, CACP, CACN.

A table of machine data holds the positions; numbers count from 0. Source: job planning 4.1, MD30500, MD10900 ff.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: The plain attribute that leads to a coded position.
WAYS = {"CAC": "AC", "CIC": "AC", "CDC": "DC", "CACP": "ACP", "CACN": "ACN"}


def position(channel: SinumerikChannel, column: int, modifier: str, value: float) -> float:
    """The position that a coded position names.

    Raises:
        AlarmError: 17500 for an axis without a position table, 17510 for a number that the table does not have.
    """
    table = _table(channel, column)
    if value != int(value):
        raise AlarmError("17510", axis=channel.axes[column])
    place = int(value)
    if modifier == "CIC":
        place += _nearest(channel, column, table)
        if channel.memory.axes[column].modulo:
            place %= len(table)
    if not 0 <= place < len(table):
        raise AlarmError("17510", axis=channel.axes[column])
    return table[place]


def _table(channel: SinumerikChannel, column: int) -> list[float]:
    memory = channel.memory
    number = memory.data.integer("$MA_INDEX_AX_ASSIGN_POS_TAB", channel.axes[column])
    if number not in (1, 2):
        raise AlarmError("17500", axis=channel.axes[column])
    length = memory.data.integer(f"$MN_INDEX_AX_LENGTH_POS_TAB_{number}")
    return [memory.data.number(f"$MN_INDEX_AX_POS_TAB_{number}", i) for i in range(length)]


def _nearest(channel: SinumerikChannel, column: int, table: list[float]) -> int:
    """The number of the position at which the axis stands."""
    now = channel.coordinates.position[column]
    if channel.memory.axes[column].modulo:
        now %= 360.0
    return min(range(len(table)), key=lambda i: abs(table[i] - now))
