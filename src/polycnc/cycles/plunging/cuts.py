"""Plunges, cuts between walls, along them and along a whole contour (SINUMERIK CYCLE952).

Coordinates are those of `profile`. The tool's point stays on or above `floor`, in front of it is stock up to `stock`;
straight up from wherever it stands the way is open, for a profile has no overhang.
"""

from __future__ import annotations

from enum import Enum

from polycnc.cycles.count import parts
from polycnc.cycles.plunging.profile import SNUG_MM, Profile, level, stretches
from polycnc.cycles.turning.contour import Piece, slopes, turned_round
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point

_HAIR = 1e-6
_WHOLE = 1e-6
#: From place to place no farther than this there is room for one plunge alone, mm.
_NARROW = 2.0 * SNUG_MM


class Use(Enum):
    """What a stroke does: go past the work, plunge into it, cut along it, or follow the contour."""

    RAPID = 0
    PLUNGE = 1
    TURN = 2
    FOLLOW = 3


class Stroke(NamedTuple):
    """A stroke of the tool's point; an arc has a centre."""

    use: Use
    end: Point
    center: Point | None = None
    ccw: bool = True


@dataclass(frozen=True, slots=True)
class Work:
    """What is cut; mm.

    Attributes:
        floor: How deep the tool's point may go.
        stock: Where it meets the stock.
        lift: Distance off the stock, and way back between two infeeds.
        over: Height of the ways past the work.
    """

    floor: Profile
    stock: Profile
    lift: float
    over: float

    def stretches(self) -> list[tuple[float, float]]:
        """From where to where there is stock."""
        return stretches(self.stock, self.floor)


def plunge(work: Work, step: float, infeed: float) -> Iterator[Stroke]:
    """Plunges side by side, in every stretch from the middle outwards.

    Args:
        work: What is cut.
        step: Greatest way between two plunges, mm.
        infeed: Greatest depth of one infeed; 0 for all at once.
    """
    for low, high in work.stretches():
        count = 0 if high - low <= _NARROW else max(parts(high - low, step, _WHOLE), 1)
        places = [low + (high - low) * k / count if count else 0.5 * (low + high) for k in range(count + 1)]
        middle = count // 2
        for k in sorted(range(count + 1), key=lambda k: (abs(k - middle), -k)):
            yield from _plunge(work, places[k], infeed)


def _plunge(work: Work, place: float, infeed: float) -> Iterator[Stroke]:
    top, bottom = work.stock.height(place), work.floor.height(place)
    total = top - bottom
    if total <= _HAIR:
        return
    count = max(parts(total, infeed, _WHOLE), 1) if infeed > 0.0 else 1
    yield from _down(work, place, top)
    for k in range(1, count + 1):
        height = top - total * k / count
        yield Stroke(Use.PLUNGE, (place, height))
        if k < count:
            yield Stroke(Use.RAPID, (place, height + work.lift))
    yield Stroke(Use.RAPID, (place, work.over))


def _down(work: Work, place: float, height: float) -> Iterator[Stroke]:
    """Over a place, and down to the lift-off above a height."""
    yield Stroke(Use.RAPID, (place, work.over))
    if height + work.lift < work.over - _NARROW:
        yield Stroke(Use.RAPID, (place, height + work.lift))


def turn(work: Work, depth: float) -> Iterator[Stroke]:
    """Cuts between the walls, level by level, each entered by a plunge; every pocket is cut to its bottom at once."""
    for low, high in work.stretches():
        top, bottom = work.stock.highest(low, high), _lowest(work.floor, low, high)
        count = max(parts(top - bottom, depth, _WHOLE), 1)
        levels = [top - (top - bottom) * k / count for k in range(1, count)] + [bottom]
        yield from _clear(work, (low, high), top, levels)


def _lowest(floor: Profile, low: float, high: float) -> float:
    return min(
        point[1] for piece in slopes(floor.between(low, high)) for point in (piece.edge.start, piece.edge.end)
    )


def _clear(work: Work, stretch: tuple[float, float], top: float, levels: list[float]) -> Iterator[Stroke]:
    """A stretch down through levels; the tool comes from over the work and goes back there."""
    at: Point | None = None
    # Pockets that wait, each with the height above it and the number of its level; those within one come first.
    waiting = _pockets(work, stretch, top, levels, 0)
    while waiting:
        (low, high), above, number = waiting.pop()
        height = levels[number]
        to, last = (high, low) if at is not None and abs(at[0] - high) < abs(at[0] - low) else (low, high)
        if at is None:
            yield from _down(work, to, above)
        elif abs(at[0] - to) > NO_WAY or at[1] < above - NO_WAY:
            yield Stroke(Use.RAPID, (at[0], above + work.lift))
            yield Stroke(Use.RAPID, (to, above + work.lift))
        yield Stroke(Use.PLUNGE, (to, height))
        if high - low > _NARROW:
            yield Stroke(Use.TURN, (last, height))
        at = (last, height)
        if number + 1 < len(levels):
            waiting += _pockets(work, (low, high), height, levels, number + 1)
    if at is not None:
        yield Stroke(Use.RAPID, (at[0], work.over))


_Pocket = tuple[tuple[float, float], float, int]


def _pockets(
    work: Work, stretch: tuple[float, float], above: float, levels: list[float], number: int
) -> list[_Pocket]:
    """Where a stretch is open at a level, the last one first."""
    return [(gap, above, number) for gap in reversed(_gaps(work.floor, *stretch, levels[number]))]


def _gaps(floor: Profile, low: float, high: float, height: float) -> list[tuple[float, float]]:
    """Where the floor lies below a height, or just reaches it as a flat."""
    return stretches(level(height + 2.0 * _HAIR, low, high), floor)


def follow(work: Work) -> Iterator[Stroke]:
    """Down all walls, each from its rim: those of a valley meet in the middle of its base."""
    for low, high in work.stretches():
        for way in ways_down(_walled(work, low, high)):
            start = way[0].edge.start
            # Between plunges stock may still stand on a summit.
            yield from _down(work, start[0], max(start[1], work.stock.height(start[0])))
            yield Stroke(Use.FOLLOW, start)
            for piece in way:
                edge = piece.edge
                yield Stroke(Use.FOLLOW, edge.end, edge.center, edge.ccw)
            yield Stroke(Use.RAPID, (way[-1].edge.end[0], work.over))


def follow_on(work: Work, direction: float, front: float) -> Iterator[Stroke]:
    """Along the floor in one direction, 1 or -1, wherever there is stock; past the work from place to place.

    Where the stock begins, at `front`, the tool comes along the floor, elsewhere from above.
    """
    found = work.stretches()
    for low, high in found if direction > 0.0 else reversed(found):
        way = _walled(work, low, high)
        if direction < 0.0:
            way = turned_round(way)
        begin = way[0].edge.start[0]
        if abs(begin - front) <= _NARROW:
            if abs(way[0].edge.end[0] - begin) <= _HAIR:
                way = way[1:]
            before = (front - direction * work.lift, way[0].edge.start[1])
            yield Stroke(Use.RAPID, (before[0], work.over))
            yield Stroke(Use.RAPID, before)
        else:
            yield from _down(work, begin, max(way[0].edge.start[1], work.stock.height(begin)))
        yield Stroke(Use.FOLLOW, way[0].edge.start)
        for piece in way:
            edge = piece.edge
            yield Stroke(Use.FOLLOW, edge.end, edge.center, edge.ccw)
        yield Stroke(Use.RAPID, (way[-1].edge.end[0], work.over))


def _walled(work: Work, low: float, high: float) -> Contour:
    """The floor of a stretch, with the walls between which it lies up to the stock."""
    floor = work.floor.between(low, high)
    first, last = floor[0].edge.start, floor[-1].edge.end
    rims = [(a, max(h, work.stock.height(a))) for a, h in (first, last)]
    begin, end = offset.line(rims[0], first), offset.line(last, rims[1])
    walls = [[Piece(edge)] if edge.length > _NARROW else [] for edge in (begin, end)]
    return [*walls[0], *floor, *walls[1]]


def ways_down(contour: Contour) -> list[Contour]:
    """A contour as ways that never rise; in every valley one comes from each side."""
    result: list[Contour] = []
    down: Contour = []
    up: Contour = []
    for piece in slopes(contour):
        rise = piece.edge.end[1] - piece.edge.start[1]
        if up and rise < -NO_WAY:
            result += _valley(down, up)
            down, up = [], []
        if up or rise > NO_WAY:
            up.append(piece)
        else:
            down.append(piece)
    return result + _valley(down, up)


def _valley(down: Contour, up: Contour) -> list[Contour]:
    """The two ways into a valley; a base between them is parted in its middle."""
    if down and up:
        base = down[-1].edge
        if base.center is None and abs(base.end[1] - base.start[1]) <= NO_WAY:
            middle = (0.5 * (base.start[0] + base.end[0]), base.start[1])
            down = [*down[:-1], Piece(offset.line(base.start, middle))]
            up = [Piece(offset.line(middle, base.end)), *up]
    return [way for way in (down, turned_round(up)) if way]
