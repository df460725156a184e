"""Pecking on the face and in grooves: G74 and G75 (0i-TF Plus II.4.2.5, 4.2.6, 6.4.5).

Coordinates: `a` is the direction of the pecks, `b` the direction in which columns follow each other.
"""

from __future__ import annotations

from math import copysign

from polycnc.cycles.turning.stroke import PlaneStroke, feed, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.geometry.arcs import Point


@dataclass(frozen=True, slots=True)
class Pecks:
    """Amounts of the cycle, mm of radius.

    Attributes:
        peck: Depth of a peck; 0 for the whole depth at once.
        back: Way back after a peck.
        step: Distance of columns; 0 for one column, or first and last one.
        relief: Way off the wall at the bottom, towards the column before; signed where there is one column.
    """

    peck: float
    back: float
    step: float = 0.0
    relief: float = 0.0


def peck_columns(start: Point, end: Point, pecks: Pecks) -> Iterator[PlaneStroke]:
    """Columns of pecks from the start to the far corner, and back to the start."""
    columns = list(_stops(start[1], end[1], pecks.step))
    across = copysign(1.0, end[1] - start[1])
    alone = abs(end[1] - start[1]) <= NO_WAY
    for number, column in enumerate(columns):
        if number:
            yield rapid(start[0], column)
        yield from _pecks(start[0], end[0], column, pecks)
        aside = column
        if pecks.relief:
            aside = column + pecks.relief if alone else column - across * pecks.relief
            yield rapid(end[0], aside)
        yield rapid(start[0], aside)
    yield rapid(*start)


def _pecks(top: float, bottom: float, column: float, pecks: Pecks) -> Iterator[PlaneStroke]:
    onwards = copysign(1.0, bottom - top)
    for depth in _stops(top, bottom, pecks.peck, first=False):
        yield feed(depth, column)
        if abs(depth - bottom) > NO_WAY:
            yield rapid(depth - onwards * pecks.back, column)


def _stops(begin: float, end: float, step: float, *, first: bool = True) -> Iterator[float]:
    """From the beginning to exactly the end in steps."""
    if first:
        yield begin
    if abs(end - begin) <= NO_WAY:
        return
    onwards = copysign(1.0, end - begin)
    number = 1
    while step > 0.0 and number * step < abs(end - begin) - NO_WAY:
        yield begin + onwards * number * step
        number += 1
    yield end
