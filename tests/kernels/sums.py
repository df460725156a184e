"""Small kernels for tests."""

from __future__ import annotations

from ctypes import Structure
from typing import Annotated, NamedTuple

from polycnc.kernels.layout import Floats, Ints32, Places, Text, place, record
from tests.kernels.halves import HALF


class Room(Places):
    """Places in an array."""

    FIRST = place()
    LAST = place()


@record
class Total(Structure):
    """What is carried on."""

    value: float
    count: int
    parts: Annotated[Floats, 2]


class Columns(NamedTuple):
    """Numbers, and how often each counts."""

    values: Floats
    times: Ints32


def add(columns: Columns, total: Total, extra: float) -> int:
    """Add products to a total; gives their number."""
    for i in range(len(columns.values)):
        weigh(columns, total, i)
    total.value += extra * HALF
    columns.values[0] = total.value
    total.count += 1
    return len(columns.values)


def weigh(columns: Columns, total: Total, i: int) -> None:
    """One product."""
    total.value += columns.values[i] * columns.times[i]
    total.parts[i] = columns.times[i]


def put(values: Floats, last: bool) -> None:
    """Mark a place."""
    values[Room.LAST if last else Room.FIRST] = 7.0


def go(position: Floats, way: Floats, times: int) -> int:
    """Move all axes; gives their number."""
    n = len(position)
    for i in range(n):
        position[i] += times * way[i] / n
    return n


def count(text: Text, sign: int, found: Floats) -> int:
    """How often a sign stands in a text; notes the last place."""
    times = 0
    for i in range(len(text)):
        if text[i] == sign:
            times += 1
            found[0] = i
    return times


def refuse(values: Floats) -> int:
    """Does what machine code cannot."""
    if values[0] < 0.0:
        raise ValueError
    return 1
