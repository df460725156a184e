"""Rectangular and circular pockets: insertion, clearing from the inside to the outside, finishing.

Source: SINUMERIK milling cycles (POCKET1 to POCKET4). A circular pocket is a rectangular one whose corners leave no
straight sides.
"""

from __future__ import annotations

from enum import Enum
from math import radians, tan

from polycnc.cycles.count import parts
from polycnc.cycles.milling.stroke import Cavity, Place, arc, cut, rapid, ring, steps
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.milling.stroke import MillStroke


class Insertion(Enum):
    """How the tool goes into the material."""

    RAPID = 0
    FEED = 1
    HELIX = 2
    OSCILLATION = 3


@dataclass(frozen=True, slots=True)
class Pocket(Cavity):
    """A pocket and how it is milled; mm, feeds in the unit of the strokes.

    Attributes:
        place: Its middle and its long side.
        half_length, half_width: To the finished edge.
        corner: Corner radius of the finished edge.
        radius: Of the tool.
        reference, safe, retract: Levels of the blank's face, the safety plane and the end of the cycle.
        depth: Level of the finished base.
        infeed: Greatest step in depth, 0 for one step.
        width: Greatest step in the plane.
        allowance, base_allowance: Left for finishing at the edge and at the base.
        feed, depth_feed: In the plane and in depth.
        ccw: Sense in which the edge is followed.
        insertion: Way into the material.
        insertion_size: Radius of the helix, or angle of the oscillation in degrees.
        pitch: Depth of a turn of the helix.
        core_length, core_width, core_depth: What is already milled out of the middle, full sizes.
    """

    place: Place
    half_length: float
    half_width: float
    corner: float
    radius: float
    reference: float
    safe: float
    retract: float
    depth: float
    infeed: float
    width: float
    feed: float
    depth_feed: float
    ccw: bool
    allowance: float = 0.0
    base_allowance: float = 0.0
    insertion: Insertion = Insertion.FEED
    insertion_size: float = 0.0
    pitch: float = 0.0
    core_length: float = 0.0
    core_width: float = 0.0
    core_depth: float = 0.0

    def path(self, allowance: float) -> tuple[float, float, float]:
        """Half length, half width and corner radius of the tool's path along the edge."""
        off = self.radius + allowance
        return self.half_length - off, self.half_width - off, max(self.corner - off, 0.0)


def begin(pocket: Pocket) -> Iterator[MillStroke]:
    """Over the middle of the pocket, then to the safety plane."""
    yield rapid(pocket.place(0.0, 0.0))
    yield rapid(w=pocket.safe)


def rough(pocket: Pocket) -> Iterator[MillStroke]:
    """Clear the pocket level by level down to the allowances."""
    yield from begin(pocket)
    above = pocket.safe
    for below in steps(pocket.total - pocket.base_allowance, pocket.infeed):
        level = pocket.level(below)
        yield from insert(pocket, above, level)
        yield from clear(pocket, pocket.allowance, below)
        above = level
    yield rapid(w=pocket.retract)


def rough_on_helices(pocket: Pocket) -> Iterator[MillStroke]:
    """Clear a round pocket from its middle outwards, ring by ring: on a helix down to the allowances, once round.

    Behind each ring the tool leaves wall and base on a quarter circle. Pre-machined cores are not left out.
    """
    middle, reach = pocket.place(0.0, 0.0), pocket.path(pocket.allowance)[0]
    first = min(reach, pocket.radius)
    more = parts(reach - first, pocket.width, 1e-6) if reach - first > NO_WAY else 0
    depth, up = pocket.level(pocket.total - pocket.base_allowance), pocket.safe - pocket.reference
    yield rapid(pocket.place(first, 0.0))
    yield rapid(w=pocket.safe)
    for k in range(more + 1):
        size = first + (reach - first) * (k / more if more else 0.0)
        start = pocket.place(size, 0.0)
        if k:
            yield rapid(start)
        if size <= NO_WAY:
            yield cut(pocket.depth_feed, w=depth)
            continue
        way = depth - pocket.safe
        for part in steps(abs(way), pocket.infeed):
            yield arc(pocket.feed, start, middle, pocket.ccw, pocket.safe + way * part / abs(way))
        yield arc(pocket.feed, start, middle, pocket.ccw)
        off = size / 2.0
        end = pocket.place(size - off, off if pocket.ccw else -off)
        yield arc(pocket.feed, end, pocket.place(size - off, 0.0), pocket.ccw, depth + up)
        yield rapid(w=pocket.safe)
    yield rapid(w=pocket.retract)


def finish(pocket: Pocket) -> Iterator[MillStroke]:
    """Follow the finished edge in steps, then clear the base where it has an allowance."""
    yield from begin(pocket)
    half_length, half_width, corner = pocket.path(0.0)
    for below in steps(pocket.total, pocket.infeed):
        last = below == pocket.total
        yield cut(pocket.depth_feed, w=pocket.level(below))
        if last and pocket.base_allowance > NO_WAY:
            yield from clear(pocket, 0.0, below)
            continue
        yield from onto_edge(pocket, half_length)
        yield from ring(pocket.place, half_length, half_width, corner, pocket.ccw, pocket.feed)
        yield from off_edge(pocket, half_length)
    yield rapid(w=pocket.retract)


def onto_edge(pocket: Pocket, half_length: float) -> Iterator[MillStroke]:
    """A half circle from the inside onto the middle of the right side."""
    reach = _approach(pocket, half_length)
    yield cut(pocket.feed, pocket.place(half_length - 2.0 * reach, 0.0))
    if reach > NO_WAY:
        end, middle = pocket.place(half_length, 0.0), pocket.place(half_length - reach, 0.0)
        yield arc(pocket.feed, end, middle, pocket.ccw)


def off_edge(pocket: Pocket, half_length: float) -> Iterator[MillStroke]:
    """A half circle from the middle of the right side to the inside, and to the middle of the pocket."""
    reach = _approach(pocket, half_length)
    if reach > NO_WAY:
        end, middle = pocket.place(half_length - 2.0 * reach, 0.0), pocket.place(half_length - reach, 0.0)
        yield arc(pocket.feed, end, middle, pocket.ccw)
    yield cut(pocket.feed, pocket.place(0.0, 0.0))


def _approach(pocket: Pocket, half_length: float) -> float:
    """Radius of the half circle on which the edge is approached: it stays inside the pocket."""
    return min(half_length, pocket.path(0.0)[1]) / 2.0


def insert(pocket: Pocket, above: float, level: float) -> Iterator[MillStroke]:
    """Into the material in the middle of the pocket."""
    match pocket.insertion:
        case Insertion.RAPID:
            yield rapid(w=level)
        case Insertion.FEED:
            yield cut(pocket.depth_feed, w=level)
        case Insertion.HELIX:
            yield from _helix(pocket, above, level)
        case Insertion.OSCILLATION:
            yield from _oscillate(pocket, above, level)


def _helix(pocket: Pocket, above: float, level: float) -> Iterator[MillStroke]:
    """Turns about the middle, each the pitch deeper, and one at the bottom."""
    start, middle = pocket.place(pocket.insertion_size, 0.0), pocket.place(0.0, 0.0)
    yield cut(pocket.feed, start)
    down = -1.0 if level < above else 1.0
    for part in steps(abs(level - above), pocket.pitch):
        yield arc(pocket.feed, start, middle, pocket.ccw, above + down * part)
    yield arc(pocket.feed, start, middle, pocket.ccw)
    yield cut(pocket.feed, middle)


def _oscillate(pocket: Pocket, above: float, level: float) -> Iterator[MillStroke]:
    """To and fro along the long side, down by the angle, and back to the middle."""
    half_length, half_width, _ = pocket.path(pocket.allowance)
    reach = max(half_length - half_width, half_length / 2.0)
    slope = tan(radians(pocket.insertion_size))
    down = -1.0 if level < above else 1.0
    strokes = max(1, parts(abs(level - above), 2.0 * reach * slope))
    yield cut(pocket.feed, pocket.place(-reach, 0.0))
    for k in range(1, strokes + 1):
        side = reach if k % 2 else -reach
        yield cut(pocket.feed, pocket.place(side, 0.0), above + down * abs(level - above) * k / strokes)
    yield cut(pocket.feed, pocket.place(reach if strokes % 2 == 0 else -reach, 0.0))
    yield cut(pocket.feed, pocket.place(0.0, 0.0))


def clear(pocket: Pocket, allowance: float, below: float) -> Iterator[MillStroke]:
    """Rings outwards, evenly spaced, the last one along the edge; then back to the middle."""
    half_length, half_width, corner = pocket.path(allowance)
    shorter = min(half_length, half_width)
    core = _core(pocket, below)
    count = max(1, parts(shorter, pocket.width, 1e-6)) if shorter > NO_WAY else 0
    if half_length - half_width > NO_WAY and not core:
        yield cut(pocket.feed, pocket.place(half_width - half_length, 0.0))
        yield cut(pocket.feed, pocket.place(half_length - half_width, 0.0))
    for k in range(1, count + 1):
        off = shorter * (1.0 - k / count)
        a, b = half_length - off, half_width - off
        if core and k < count and a + pocket.radius <= core[0] and b + pocket.radius <= core[1]:
            continue
        rounding = min(max(corner - off, 0.0), a, b)
        yield cut(pocket.feed, pocket.place(a, 0.0))
        yield from ring(pocket.place, a, b, rounding, pocket.ccw, pocket.feed)
    yield cut(pocket.feed, pocket.place(0.0, 0.0))


def _core(pocket: Pocket, below: float) -> tuple[float, float] | None:
    """Half sizes of what is already milled out at a depth; None for nothing."""
    if pocket.core_length <= 0.0 or below > pocket.core_depth + NO_WAY:
        return None
    return pocket.core_length / 2.0, (pocket.core_width or pocket.core_length) / 2.0


def fits(pocket: Pocket) -> bool:
    """Whether the tool goes into the pocket at all."""
    half_length, half_width, _ = pocket.path(pocket.allowance)
    return min(half_length, half_width) >= -NO_WAY
