"""A slot that is open at one end, milled in circles or in plunges (SINUMERIK CYCLE899).

Its own x runs along the slot from the middle of the open side, y across; the closed end is a half circle.
"""

from __future__ import annotations

from polycnc.cycles.count import parts
from polycnc.cycles.milling.stroke import Place, arc, cut, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point

_WHOLE = 1e-6


@dataclass(frozen=True, slots=True)
class OpenSlot:
    """The slot and how it is milled; mm.

    Attributes:
        place: Middle of the open side, and the direction of the slot.
        length, width: Of the slot.
        radius: Of the tool.
        step: Greatest advance along the slot.
        allowance: Left on its walls.
        clearance: How far the tool stands in front of the open side.
        ccw: It goes round to the left.
        feed: Of the cuts.
        safe, retract: Level of the safety plane and of the end.
    """

    place: Place
    length: float
    width: float
    radius: float
    step: float
    allowance: float
    clearance: float
    ccw: bool
    feed: float
    safe: float
    retract: float

    @property
    def reach(self) -> float:
        """How far the tool's centre goes off the middle line."""
        return 0.5 * self.width - self.radius - self.allowance

    @property
    def last(self) -> float:
        """Centre of the half circle at the closed end."""
        return self.length - self.allowance - self.radius - self.reach

    @property
    def before(self) -> float:
        """Where the tool stands in front of the slot."""
        return -self.radius - self.clearance

    def at(self, x: float, y: float) -> Point:
        """A point of the slot; y to the side on which a round begins."""
        return self.place(x, -y if self.ccw else y)


def circling(slot: OpenSlot, levels: Sequence[float]) -> Iterator[MillStroke]:
    """Trochoidal milling: full circles, each a step further into the slot."""
    reach = slot.reach
    first = min(slot.step - slot.radius - reach, slot.last)
    count = max(parts(slot.last - first, slot.step, _WHOLE), 0)
    for level in levels:
        yield rapid(slot.at(slot.before, reach))
        yield rapid(w=slot.safe)
        yield cut(slot.feed, w=level)
        for k in range(count + 1):
            x = first + ((slot.last - first) * k / count if count else 0.0)
            yield cut(slot.feed, slot.at(x, reach))
            if reach > NO_WAY:
                yield arc(slot.feed, slot.at(x, reach), slot.at(x, 0.0), slot.ccw)
        yield rapid(w=slot.safe)
    yield rapid(w=slot.retract)


def plunging(slot: OpenSlot, levels: Sequence[float]) -> Iterator[MillStroke]:
    """Plunge cutting: straight down beside each other, row by row into the slot, out again at rapid."""
    first = min(slot.step - slot.radius, slot.last)
    rows = max(parts(slot.last - first, slot.step, _WHOLE), 0)
    columns = max(parts(2.0 * slot.reach, slot.radius, _WHOLE), 1)
    deepest = levels[-1]
    for k in range(rows + 1):
        x = first + ((slot.last - first) * k / rows if rows else 0.0)
        for column in range(columns + 1 if slot.reach > NO_WAY else 1):
            y = slot.reach * (1.0 - 2.0 * column / columns)
            # At the closed end the tool keeps within the half circle.
            beyond = (slot.reach**2 - y * y) ** 0.5 if k == rows else 0.0
            yield rapid(slot.at(x + beyond, y))
            yield rapid(w=slot.safe)
            yield cut(slot.feed, w=deepest)
            yield rapid(w=slot.safe)
    yield rapid(w=slot.retract)


def walls(slot: OpenSlot, levels: Sequence[float], *, base: bool) -> Iterator[MillStroke]:
    """Finishing: along a wall, round the closed end, back along the other; `base`: before that at the last level."""
    for number, level in enumerate(levels):
        yield rapid(slot.at(slot.before, slot.reach))
        yield rapid(w=slot.safe)
        yield cut(slot.feed, w=level)
        if base and number == len(levels) - 1:
            yield from _base(slot)
        yield cut(slot.feed, slot.at(slot.last, slot.reach))
        if slot.reach > NO_WAY:
            yield arc(slot.feed, slot.at(slot.last, -slot.reach), slot.at(slot.last, 0.0), slot.ccw)
        yield cut(slot.feed, slot.at(slot.before, -slot.reach))
        yield rapid(w=slot.safe)
    yield rapid(w=slot.retract)


def _base(slot: OpenSlot) -> Iterator[MillStroke]:
    """Lines along the slot, from its middle outwards by less than the tool's diameter, ending in front of it."""
    count = parts(slot.reach, 1.6 * slot.radius, _WHOLE)
    yield cut(slot.feed, slot.at(slot.before, 0.0))
    for k in range(max(count, 1)):
        y = slot.reach * k / count if count else 0.0
        for side in (1.0, -1.0) if k else (1.0,):
            yield cut(slot.feed, slot.at(slot.before, side * y))
            yield cut(slot.feed, slot.at(slot.last + (slot.reach**2 - y * y) ** 0.5, side * y))
            yield cut(slot.feed, slot.at(slot.before, side * y))
    yield cut(slot.feed, slot.at(slot.before, slot.reach))
