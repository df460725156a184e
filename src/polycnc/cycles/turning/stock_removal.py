"""Stock removal along a turned contour: equal cuts, section by section (SINUMERIK CYCLE95, CYCLE952).

Coordinates are those of `contour`: `a` along the cuts, `b` in the direction of infeed. The highest point of the contour
is where the material begins, all in front of it is stock but where an outline of the blank says less. A contour that
goes down again behind a summit has a relief; it is cut after what lies in front of it, from the level at which the
summit closes it off.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from math import copysign, hypot

from polycnc.cycles.count import parts
from polycnc.cycles.turning.contour import Gap, Piece, climb, crossings, gaps, points, swapped
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

_HAIR = 1e-7
_WHOLE = 1e-6
#: So far off the contour a way begins that is looked at, for its first point lies on it, mm.
_ROOM = 1e-3
#: What is so near to a line lies on it; so deep is the material under the begin of a contour, mm.
_TOUCH, _DEEP = 1e-4, 1e4
#: Chords that a way is compared with miss their arc by no more than this, mm, or than this share of a large radius.
_CHORD_MM, _CHORD_SHARE = 1e-3, 2e-5


@dataclass(frozen=True, slots=True)
class Removal:
    """What stock removal is told; mm.

    Attributes:
        depth: Greatest depth of a cut.
        lift: Way off the work along both axes after a cut, and distance in front of it.
        towards: Direction of infeed, 1 or -1.
        follows: After a cut the tool follows the contour up to the cut before.
        at_edges: There is a cut at the level of every flat part of the contour, and equal ones between them.
        front: `a` at which the tool first meets the stock; None for the contour's begin.
        top: `b` at which it does; None for the contour's highest point.
    """

    depth: float
    lift: float
    towards: float
    follows: bool = True
    at_edges: bool = False
    front: float | None = None
    top: float | None = None


@dataclass(frozen=True, slots=True)
class Cut:
    """A stroke, what it belongs to, and whether it goes down into a relief."""

    stroke: PlaneStroke
    is_relief: bool = False
    is_straight: bool = False


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the contour that opens upwards: its deepest point, and the height at which it is closed off."""

    place: float
    bottom: float
    top: float


def sections(contour: Contour, towards: float, above: float | None = None) -> list[Section]:
    """The parts of the contour between its summits, in its direction; the first one is open to the front.

    A contour that goes down from where it begins has its first summit there. `above` is the `b` at which the first one
    is closed off, where that is not the contour's highest point.
    """
    heights = _heights(contour, towards)
    result: list[Section] = []
    top = _top(contour, towards, above)
    lowest, summit, rising = heights[0], heights[0][1], True
    for a, height in heights[1:]:
        if rising and height < summit - _HAIR:
            result.append(Section(*lowest, top))
            top, lowest, rising = summit, (a, height), False
        elif rising:
            summit = max(summit, height)
        elif height > lowest[1] + _HAIR:
            summit, rising = height, True
        elif height < lowest[1]:
            lowest = (a, height)
    return [*result, Section(*lowest, top)]


def _top(contour: Contour, towards: float, above: float | None) -> float:
    """The height at which the stock begins."""
    return max(height for _, height in _heights(contour, towards)) if above is None else -towards * above


def _heights(contour: Contour, towards: float) -> list[Point]:
    """(a, height) along the contour; heights count against the direction of infeed."""
    return [(a, -towards * b) for piece in contour for a, b in points(piece.edge)]


def _levels(section: Section, depth: float, edges: Iterable[float]) -> list[float]:
    """Heights of the cuts of a section: as few as the depth allows, all equally deep from one edge to the next."""
    within = sorted(
        {edge for edge in edges if section.bottom + _HAIR < edge < section.top - _HAIR}, reverse=True
    )
    result: list[float] = []
    for top, bottom in pairwise([section.top, *within, section.bottom]):
        total = top - bottom
        if total <= _HAIR:
            continue
        count = max(1, parts(total, depth, _WHOLE))
        result += [top - total * k / count for k in range(1, count)] + [bottom]
    return result


def _flats(contour: Contour, towards: float) -> Iterator[float]:
    """Heights of the parts of a contour that run along the cuts."""
    for piece in contour:
        edge = piece.edge
        if edge.center is None and abs(edge.end[1] - edge.start[1]) <= _HAIR < edge.length:
            yield -towards * edge.end[1]


def remove(contour: Contour, removal: Removal, outline: Contour | None = None) -> Iterator[Cut]:
    """All cuts of the contour, each from its infeed to the way back.

    Args:
        contour: What is left.
        removal: How it is cut.
        outline: Of the stock, in the direction of the contour: in front of it the tool goes at rapid, and cuts that
            would meet nothing are left out. Without one all up to the contour's highest point is stock.
    """
    work = _Work(contour, removal, outline)
    found = sections(contour, removal.towards, removal.top)
    for number, section in enumerate(found):
        summits = {
            later.top for later in found[number + 1 :] if _opens(contour, section, later, removal.towards)
        }
        yield from work.section(section, work.edges | summits, is_relief=number > 0)


class _Work:
    """The cuts of one call: where the tool stands, and how high the stock is.

    Attributes:
        at: Where the last cut ended, None before the first one.
        cut_at: Heights that cuts have been made at, and that of the stock before them.
        edges: Heights at which there is a cut in any case.
    """

    def __init__(self, contour: Contour, removal: Removal, outline: Contour | None) -> None:
        self.contour, self.removal, self.outline = contour, removal, outline
        self.begin = contour[0].edge.start[0]
        self.onwards = copysign(1.0, contour[-1].edge.end[0] - self.begin)
        self.foremost = self.begin if removal.front is None else removal.front
        self.at: Point | None = None
        self.cut_at = [_top(contour, removal.towards, removal.top)]
        self.edges = set(_flats(contour, removal.towards)) if removal.at_edges else set()

    def section(self, section: Section, edges: set[float], *, is_relief: bool) -> Iterator[Cut]:
        """The cuts of a section; behind a relief the tool rises past the steps on the flank in front of it."""
        towards, lift = self.removal.towards, self.removal.lift
        above = section.top
        # Over a relief the stock stands up to the last cut that passed over the summit in front of it.
        stock = min((height for height in self.cut_at if height >= above - _HAIR), default=above)
        for height in _levels(section, self.removal.depth, edges):
            place = self._place(section, height, is_flat=height == section.bottom or height in edges)
            if place is None:
                continue
            gap, entry, front = place
            level = -towards * height
            at = (entry, level, -towards * above, -towards * stock)
            cuts = list(_cut(self.contour, self.removal, gap, at, self.onwards, front=front))
            if front and self._is_near_stock(entry, level):
                # What was cut before lies under the way in: the last of it is no rapid.
                above_it = PlaneStroke(Kind.RAPID, (entry, level - towards * lift))
                cuts[:1] = [Cut(above_it), Cut(PlaneStroke(Kind.FEED, (entry, level)))]
            if self.at is not None and above == section.top:
                way = way_over(self.contour, self.at, cuts[0].stroke.end, towards=towards, lift=lift)
                yield from map(Cut, way)
            elif self.at is not None and front and self.at[0] != entry:
                yield Cut(PlaneStroke(Kind.RAPID, (entry, self.at[1])))
            yield from cuts
            self.at, above, stock = cuts[-1].stroke.end, height, height
            self.cut_at.append(height)
        if is_relief and self.at is not None and above < section.top:
            over = -towards * (section.top + lift)
            if towards * (self.at[1] - over) > _HAIR:
                self.at = (self.at[0], over)
                yield Cut(PlaneStroke(Kind.RAPID, self.at))

    def _is_near_stock(self, entry: float, level: float) -> bool:
        """Whether the outline of the stock reaches up to a level at a place, or nearly so."""
        if self.outline is None:
            return False
        at = [point[0] for piece in swapped(self.outline) for point in crossings(piece.edge, entry)]
        return any(self.removal.towards * (level - b) > -self.removal.lift + _WHOLE for b in at)

    def _place(self, section: Section, height: float, *, is_flat: bool) -> tuple[Gap, float, bool] | None:
        """The gap of a cut, where the tool goes down to it, and whether that is in front; None for no cut."""
        towards = self.removal.towards
        level = -towards * height
        # On the flat of a base the contour is not deeper than the cut: look a hair above it.
        gap = _gap_at(self.contour, level - towards * _HAIR if is_flat else level, towards, section.place)
        if gap is None and height == section.bottom:
            gap = _point_at(self.contour, section.place, level)
        if gap is None:
            return None
        front = abs(gap.start - self.begin) <= 2.0 * _HAIR
        met = self.foremost if self.outline is None else _met(self.outline, level, towards, self.foremost)
        is_point = gap.end == gap.start
        if met is None or (self.outline and not is_point and self.onwards * (gap.end - met) <= _HAIR):
            return None
        return gap, met - self.onwards * self.removal.lift if front else gap.start, front


def _opens(contour: Contour, section: Section, later: Section, towards: float) -> bool:
    """Whether a cut of a section at the height of a later one's summit passes over that one.

    Without such a cut the stock over a relief would stand higher than its summit.
    """
    if not section.bottom + _HAIR < later.top < section.top - _HAIR:
        return False
    gap = _gap_at(contour, -towards * (later.top + _HAIR), towards, section.place)
    return gap is not None and min(gap.start, gap.end) <= later.place <= max(gap.start, gap.end)


def _met(outline: Contour, level: float, towards: float, foremost: float) -> float | None:
    """Where a cut at a level first meets the stock below an outline; None where all of it lies deeper."""
    begin = outline[0].edge.start[0]
    for gap in gaps(outline, level - towards * _HAIR, towards):
        if abs(gap.start - begin) > 2.0 * _HAIR:
            break
        return None if gap.piece >= len(outline) else gap.end
    return foremost


def way_over(contour: Contour, start: Point, end: Point, *, towards: float, lift: float) -> list[PlaneStroke]:
    """The rapids before the last one on a way past the contour: axis by axis, out of the work first.

    Out to the clearance over what lies between, or to the higher end, then across; the rapid to the end itself is the
    caller's.
    """
    low, high = sorted((start[0], end[0]))
    between = [height for a, height in _heights(contour, towards) if low < a < high]
    if not between:
        return []
    level = -towards * max(max(between) + lift, -towards * start[1], -towards * end[1])
    corners = [(start[0], level), (end[0], level)]
    places = [place for before, place in pairwise([start, *corners]) if place != before]
    return [PlaneStroke(Kind.RAPID, place) for place in places if place != end]


def way_clear(
    contour: Contour, start: Point, end: Point, *, towards: float, lift: float
) -> list[PlaneStroke]:
    """As `way_over` where a straight rapid would touch the contour; nothing where it passes clear of it.

    Under an overhang the way out of the work is closed: the tool goes along first.

    Raises:
        ValueError: No way is clear.
    """
    low, high = sorted((start[0], end[0]))
    touches = False
    for a, b in _samples(contour):
        if low < a < high:
            on_way = start[1] + (end[1] - start[1]) * (a - start[0]) / (end[0] - start[0])
            touches = touches or towards * (on_way - b) > -_HAIR
    if not touches and is_clear(contour, [start, end], towards):
        return []
    over = way_over(contour, start, end, towards=towards, lift=lift)
    along = [PlaneStroke(Kind.RAPID, (end[0], start[1]))]
    for way in (over, along):
        if is_clear(contour, [start, *(stroke.end for stroke in way), end], towards):
            return way
    raise ValueError("no way out")


def blank(contour: Contour, towards: float, above: float | None = None) -> Contour:
    """The outline of the material before roughing, from end to end of the contour.

    It reaches up to the contour's highest point, or where the tool meets it at a `b` above.
    """
    (begin, low), end = contour[0].edge.start, contour[-1].edge.end[0]
    top = -towards * _top(contour, towards, above)
    corners = [(begin, low), (begin, top), (end, top)]
    return [Piece(offset.line(p, q)) for p, q in pairwise(corners)]


def _samples(contour: Contour) -> Iterator[Point]:
    """Corners of the contour, and points of its arcs."""
    for piece in contour:
        yield from _chords(piece.edge)


@lru_cache(maxsize=4096)
def _chords(edge: Edge) -> tuple[Point, ...]:
    """The ends of a line, or points of an arc whose chords are near to it; every cut asks for the same ones."""
    if edge.center is None:
        return (edge.start, edge.end)
    radius = arcs.radius_of(edge.center, edge.end)
    count = arcs.parts_for_chord_error(radius, edge.sweep, max(_CHORD_MM, _CHORD_SHARE * radius))
    return (edge.start, *arcs.split(edge.start, edge.end, edge.center, edge.ccw, count))


def _sides(contour: Contour) -> Iterator[tuple[Point, Point, float]]:
    """Lines and chords of the contour, and how near to them a way touches and does not cross them."""
    for piece in contour:
        edge, touch = piece.edge, _TOUCH
        if edge.center is not None:
            touch += max(_CHORD_MM, _CHORD_SHARE * arcs.radius_of(edge.center, edge.end))
        for a, b in pairwise(_chords(edge)):
            yield a, b, touch


def is_clear(contour: Contour, way: list[Point], towards: float) -> bool:
    """Whether a way from corner to corner, (a, b) in mm, crosses nowhere the contour or the front under its begin."""
    sides = list(_sides(contour))
    begin, first = contour[0].edge.start, contour[0].edge.departing[0]
    if first * (contour[-1].edge.end[0] - begin[0]) >= 0.0:  # else it hangs over
        sides.append(((begin[0], begin[1] + towards * _DEEP), begin, _TOUCH))
    return not any(_cross(p, q, a, b, touch) for p, q in pairwise(way) for a, b, touch in sides)


def _cross(p: Point, q: Point, a: Point, b: Point, touch: float) -> bool:
    """Whether two lines cross between their ends; the first one may end by `touch` behind the second one."""
    return _are_apart(p, q, a, b, _TOUCH) and _are_apart(a, b, p, q, touch)


def _are_apart(p: Point, q: Point, a: Point, b: Point, touch: float) -> bool:
    """Whether two points lie on both sides of the line from p to q, by more than a distance."""
    u, v = q[0] - p[0], q[1] - p[1]
    on = touch * hypot(u, v)
    first, second = u * (a[1] - p[1]) - v * (a[0] - p[0]), u * (b[1] - p[1]) - v * (b[0] - p[0])
    return min(first, second) < -on and max(first, second) > on


def _gap_at(contour: Contour, level: float, towards: float, place: float) -> Gap | None:
    """The gap of a level over a place; None where it is only a point."""
    for gap in gaps(contour, level, towards):
        low, high = sorted((gap.start, gap.end))
        if low - 2.0 * _HAIR <= place <= high + 2.0 * _HAIR and high - low > 10.0 * _HAIR:
            return gap
    return None


def _point_at(contour: Contour, place: float, level: float) -> Gap | None:
    """A section that ends in a point, as one that begins with a chamfer does: the tool goes there and follows it up."""
    for number, piece in enumerate(contour):
        a, b = piece.edge.start
        if abs(a - place) <= _HAIR and abs(b - level) <= _HAIR:
            return Gap(place, place, number)
    return None


def _cut(
    contour: Contour,
    removal: Removal,
    gap: Gap,
    at: tuple[float, float, float, float],
    onwards: float,
    *,
    front: bool,
) -> Iterator[Cut]:
    """One cut; `at` is where it begins, its level, the level of the cut before, and the top of the stock."""
    entry, level, former, stock = at
    towards, lift = removal.towards, removal.lift
    if front:
        yield Cut(PlaneStroke(Kind.RAPID, (entry, level)))
    else:
        yield Cut(PlaneStroke(Kind.RAPID, (entry, stock - towards * lift)))
        yield Cut(PlaneStroke(Kind.FEED, (entry, level)), is_relief=True)
    yield Cut(PlaneStroke(Kind.FEED, (gap.end, level)), is_straight=True)
    last = (gap.end, level)
    if removal.follows:
        for piece in climb(contour, gap, level, former, towards):
            yield Cut(piece.stroke())
            last = piece.edge.end
    if not front:
        last = (last[0], former)
    # A relief has a flank behind the tool: straight up. In front of the open section nothing stands.
    off = (last[0] - onwards * lift if front else last[0], last[1] - towards * lift)
    if front and not is_clear(contour, [(last[0] - onwards * _ROOM, last[1]), off], towards):
        off = (off[0], last[1])  # Under an overhang there is no way but along the cut.
    yield Cut(PlaneStroke(Kind.FEED, off))
    yield Cut(PlaneStroke(Kind.RAPID, (entry, off[1])))
