"""What a larger cutter has left of a contour pocket, or round spigots (SINUMERIK CYCLE63, residual material).

A larger cutter clears all that it reaches with its middle `reference` and the allowance off the walls. The smaller one
cuts nothing where its own circle lies in one of the larger cutter's. Of its loops what remains is milled, from the
inside outwards; each way begins and ends where the circle has become clear, so that the cutter goes down into what is
milled already. A loop that is nowhere clear is an area that the larger cutter has not come to: there it goes in as at
roughing.
"""

from __future__ import annotations

from math import ceil

from polycnc.cycles.milling import contour_pocket, region
from polycnc.cycles.milling.contour_pocket import ContourPocket, Pass
from polycnc.cycles.milling.stroke import cut, rapid
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.region import Loop
    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Material no thicker than this is none, mm.
_THIN_MM = 2e-3
#: Along a loop it is looked at so many places of a radius, and where material begins is found to this, mm.
_PLACES, _EXACT_MM = 6.0, 1e-5


@dataclass(frozen=True, slots=True)
class Cleared:
    """Where the cutter cuts nothing.

    Attributes:
        walls: Of the pocket.
        loops: Of the larger cutter's middle nearest to the walls.
        off: How far these are off the walls.
        play: By how much the larger cutter's radius is larger.
    """

    walls: Sequence[Loop]
    loops: Sequence[Loop]
    off: float
    play: float

    def is_clear(self, point: Point) -> bool:
        """Whether the cutter stands in what the larger one has cleared."""
        if not self.loops:
            return False
        if region.clearance(self.walls, point) >= self.off:
            return True
        return region.clearance(self.loops, point) <= self.play + _THIN_MM


def rough(pocket: ContourPocket, levels: Sequence[float], reference: float) -> Iterator[MillStroke]:
    """Mill what a cutter of the radius `reference` has left.

    Args:
        pocket: What is milled.
        levels: From the top on.
        reference: Radius of the larger cutter, mm.

    Raises:
        RegionError, InsertionError: As roughing.
    """
    off = reference + pocket.allowance
    cleared = Cleared(pocket.walls, region.loops_at(pocket.walls, off), off, reference - pocket.radius)
    ways: list[Loop] = []
    for area in contour_pocket.areas(pocket):
        whole: list[Pass] = []
        before: Pass | None = None
        for done in contour_pocket.passes(pocket, area):
            parts = _left(cleared, done.loop, pocket.radius)
            if parts is None:
                follows = done.is_linked and bool(whole) and whole[-1] is before
                done = replace(done, is_linked=follows)
                whole.append(done)
            else:
                ways += parts
            before = done
        yield from contour_pocket.mill_passes(pocket, whole, levels)
    yield from _mill(pocket, ways, levels)
    yield rapid(w=pocket.retract)


def _mill(pocket: ContourPocket, ways: Sequence[Loop], levels: Sequence[float]) -> Iterator[MillStroke]:
    """Along ways that begin and end in what is milled already, level by level."""
    above = pocket.reference
    for number, level in enumerate(levels):
        up = 1.0 if pocket.safe > level else -1.0
        for way in ways:
            yield rapid(w=pocket.retract)
            yield rapid(way[0].start)
            yield rapid(w=pocket.safe if number == 0 else above + up * pocket.clearance)
            yield cut(pocket.depth_feed, w=level)
            for edge in way:
                yield contour_pocket.stroke_of(pocket, edge)
        above = level


class _Part(NamedTuple):
    """A part of an edge, from one share of its length to another."""

    edge: Edge
    first: float
    last: float

    def at(self, share: float) -> Point:
        return _point(self.edge, share)


def _point(edge: Edge, share: float) -> Point:
    if edge.center is not None:
        return arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, share)
    return tuple(a + share * (b - a) for a, b in zip(edge.start, edge.end, strict=True))  # type: ignore[return-value]


def _left(cleared: Cleared, loop: Loop, radius: float) -> list[Loop] | None:
    """The parts of a loop along which there is material, from clear place to clear place; None for all of it."""
    parts = [part for edge in loop for part in _parts(edge, radius / _PLACES)]
    clear = [cleared.is_clear(part.at(part.first)) for part in parts]
    if not any(clear):
        return None
    begin = clear.index(True)
    parts, clear = parts[begin:] + parts[:begin], clear[begin:] + clear[:begin]
    ways: list[Loop] = []
    way: list[_Part] = []
    for part, first, last in zip(parts, clear, [*clear[1:], True], strict=True):
        if first and last:
            continue
        if first:
            part = part._replace(first=_edge_of_clear(cleared, part, part.first, part.last))
        if last:
            part = part._replace(last=_edge_of_clear(cleared, part, part.last, part.first))
        way.append(part)
        if last:
            ways.append(_joined(way))
            way = []
    return ways


def _parts(edge: Edge, most: float) -> list[_Part]:
    count = max(1, ceil(edge.length / most))
    return [_Part(edge, k / count, (k + 1) / count) for k in range(count)]


def _edge_of_clear(cleared: Cleared, part: _Part, clear: float, other: float) -> float:
    """The share of an edge, on the clear side, up to which it is clear."""
    while abs(other - clear) * part.edge.length > _EXACT_MM:
        middle = 0.5 * (clear + other)
        if cleared.is_clear(part.at(middle)):
            clear = middle
        else:
            other = middle
    return clear


def _joined(way: Sequence[_Part]) -> Loop:
    """The edges of parts that follow each other."""
    joined: list[_Part] = []
    for part in way:
        if joined and joined[-1].edge is part.edge:
            joined[-1] = joined[-1]._replace(last=part.last)
        else:
            joined.append(part)
    return [region.piece_of(each.edge, each.at(each.first), each.at(each.last)) for each in joined]
