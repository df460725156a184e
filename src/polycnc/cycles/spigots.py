"""Rectangular and circular spigots (SINUMERIK CYCLE76, CYCLE77): on a half circle in, once round, out, per level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from polycnc.cycles.mill_stroke import Place, arc, cut, rapid, ring

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.mill_stroke import MillStroke


@dataclass(frozen=True, slots=True)
class Spigot:
    """A spigot and how it is milled; mm.

    Attributes:
        place: Its middle and its length.
        half_length, half_width, corner: Of the finished spigot.
        blank: Half the length of the blank.
        radius: Of the tool, with the allowance that is left.
        clearance: Distance from the blank at which the tool goes down.
        ccw: Sense in which the spigot is followed.
        feed, depth_feed: In the plane and in depth.
        safe, retract: Level of the safety plane and of the end.
    """

    place: Place
    half_length: float
    half_width: float
    corner: float
    blank: float
    radius: float
    clearance: float
    ccw: bool
    feed: float
    depth_feed: float
    safe: float
    retract: float

    @property
    def reach(self) -> float:
        """Radius of the half circles: the tool goes down beside the blank."""
        side = self.half_length + self.radius
        beside = max(self.blank, self.half_length) + self.clearance + self.radius
        return max(0.5 * (beside - side), 0.5 * self.radius)


def mill(spigot: Spigot, levels: Sequence[float]) -> Iterator[MillStroke]:
    """All levels, from positioning beside the blank to the retraction plane."""
    off, reach = spigot.radius, spigot.reach
    side = spigot.half_length + off
    begin, middle = spigot.place(side + 2.0 * reach, 0.0), spigot.place(side + reach, 0.0)
    yield rapid(begin)
    yield rapid(w=spigot.safe)
    for level in levels:
        yield cut(spigot.depth_feed, w=level)
        yield arc(spigot.feed, spigot.place(side, 0.0), middle, not spigot.ccw)
        yield from ring(
            spigot.place, side, spigot.half_width + off, spigot.corner + off, spigot.ccw, spigot.feed
        )
        yield arc(spigot.feed, begin, middle, not spigot.ccw)
    yield rapid(w=spigot.retract)
