"""A contour as heights over places, and what becomes of it for the point of a tool that has a nose and a width.

Points are (a, h): `a` runs along the cuts, `h` counts up, off the work; the tool comes from above and reaches from its
point towards larger `a`. At every place a profile has one height; where it jumps, a wall stands.
"""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property
from itertools import pairwise
from math import hypot, sqrt

from polycnc.cycles.count import checked
from polycnc.cycles.turning.contour import Piece, reversal, shifted, slopes, turned_round
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Places nearer to each other are one; what is so much higher is higher, mm.
_HAIR = 1e-7
#: Curves that are no longer are what rounding has left of a crossing: nobody cuts them, mm.
_SLIVER = 1e-5
#: So far apart may curves end that touch each other: arcs cross badly where they are nearly tangent, mm.
_GAP = 1e-4
#: A tool as wide as a groove goes into it: so much narrower it counts, mm.
SNUG_MM = 2e-5


@dataclass(frozen=True)
class Profile:
    """Heights over places.

    Attributes:
        curves: Lines and arcs towards larger `a`, one behind the other without gap in `a`; none is upright.
        posts: Single points: the ends of walls.
    """

    curves: tuple[Edge, ...]
    posts: tuple[Point, ...] = ()

    @property
    def begin(self) -> float:
        """The smallest place."""
        return self.curves[0].start[0]

    @property
    def end(self) -> float:
        """The largest place."""
        return self.curves[-1].end[0]

    @cached_property
    def _starts(self) -> list[float]:
        return [curve.start[0] for curve in self.curves]

    def height(self, a: float) -> float:
        """Height at a place; at a wall that of its foot, which the tool touches there."""
        number = bisect_right(self._starts, a) - 1
        near = [
            height_on(curve, min(max(a, curve.start[0]), curve.end[0]))
            for curve in self.curves[max(number - 1, 0) : number + 2]
            if curve.start[0] - _HAIR <= a <= curve.end[0] + _HAIR
        ]
        if not near:
            raise ValueError("beside the profile")
        return min(near)

    def highest(self, low: float, high: float) -> float:
        """The greatest height between two places, both within the profile."""
        tops = [
            max(height_on(curve, a) for a in _tops(curve, low, high))
            for curve in self.curves
            if curve.start[0] < high + _HAIR and curve.end[0] > low - _HAIR
        ]
        return max(tops)

    def between(self, low: float, high: float) -> Contour:
        """The profile from place to place, with its walls."""
        result: list[Piece] = []
        curves = cropped(self, low, high).curves
        for edge in [curve for curve in curves if curve.length > _SLIVER] or curves:
            if result and abs(result[-1].edge.end[1] - edge.start[1]) > _SLIVER:
                result.append(Piece(offset.line(result[-1].edge.end, edge.start)))
            result.append(Piece(edge))
        return result


def height_on(curve: Edge, a: float) -> float:
    """Height of a line or of half a circle at a place between its ends."""
    if curve.center is None:
        (a0, h0), (a1, h1) = curve.start, curve.end
        return h0 + (h1 - h0) * (a - a0) / (a1 - a0)
    radius = arcs.radius_of(curve.center, curve.end)
    rise = sqrt(max(radius * radius - (a - curve.center[0]) ** 2, 0.0))
    return curve.center[1] + (-rise if curve.ccw else rise)


def part(curve: Edge, low: float, high: float) -> Edge:
    """A curve from place to place."""
    start = curve.start if low <= curve.start[0] + NO_WAY else (low, height_on(curve, low))
    end = curve.end if high >= curve.end[0] - NO_WAY else (high, height_on(curve, high))
    if curve.center is None or hypot(end[0] - start[0], end[1] - start[1]) <= NO_WAY:
        return offset.line(start, end)
    return offset.arc(start, end, curve.center, curve.ccw)


def _tops(curve: Edge, low: float, high: float) -> list[float]:
    """Where the greatest height of a curve between two places may lie."""
    first, last = max(low, curve.start[0]), min(high, curve.end[0])
    if curve.center is None or curve.ccw or not first < curve.center[0] < last:
        return [first, last]
    return [first, last, curve.center[0]]


def upright(contour: Sequence[Piece], towards: float) -> Contour:
    """A contour of (a, b) in (a, h), towards larger `a`; `towards` is the direction of infeed, 1 or -1."""
    pieces = list(contour)
    if towards > 0.0:
        pieces = [Piece(_turned_over(piece.edge), piece.is_rapid) for piece in pieces]
    if pieces[-1].edge.end[0] < pieces[0].edge.start[0]:
        pieces = turned_round(pieces)
    return pieces


def _turned_over(edge: Edge) -> Edge:
    start, end = (edge.start[0], -edge.start[1]), (edge.end[0], -edge.end[1])
    if edge.center is None:
        return offset.line(start, end)
    return offset.arc(start, end, (edge.center[0], -edge.center[1]), not edge.ccw)


def profile(contour: Sequence[Piece], top: float, *, open_at: float = 0.0) -> Profile:
    """Heights of a contour of (a, h), with walls at both ends up to a height.

    Args:
        contour: Towards larger `a`.
        top: Of the walls.
        open_at: 1 or -1 where there is no wall at the larger or smaller end.

    Raises:
        ValueError: It runs back along `a`, or nowhere.
    """
    if reversal(contour, 0, 1.0) > _HAIR:
        raise ValueError("overhang")
    # Points that arcs turn at are ends of curves: each is one half of a circle, above or below.
    edges = [piece.edge for piece in slopes(contour)]
    curves = [edge for edge in edges if edge.end[0] - edge.start[0] > _HAIR]
    if not curves:
        raise ValueError("no way")
    ends = ((contour[0].edge.start, -1.0), (contour[-1].edge.end, 1.0))
    tops = [(a, h if side == open_at else max(h, top)) for (a, h), side in ends]
    walls = [point for edge in edges if edge not in curves for point in (edge.start, edge.end)]
    return Profile(envelope(curves), (*tops, *walls))


def envelope(curves: Iterable[Edge]) -> tuple[Edge, ...]:
    """The highest of several curves at every place, all towards larger `a` and none upright.

    Raises:
        ValueError: There is a gap between them.
    """
    found = _bridged(curve for curve in curves if curve.end[0] - curve.start[0] > _HAIR)
    places = {a for curve in found for a in (curve.start[0], curve.end[0])}
    for number, first in enumerate(found):
        for second in found[number + 1 :]:
            if second.start[0] >= first.end[0]:
                break
            places.update(a for a, _ in _meetings(first, second))
    result: list[tuple[Edge, float, float]] = []
    for low, high in pairwise(_apart(sorted(places))):
        middle = 0.5 * (low + high)
        over = [curve for curve in found if curve.start[0] <= middle <= curve.end[0]]
        if not over:
            raise ValueError("gap")
        best = max(over, key=lambda curve: height_on(curve, middle))
        if result and result[-1][0] is best:
            result[-1] = (best, result[-1][1], high)
        else:
            result.append((best, low, high))
    return tuple(part(curve, low, high) for curve, low, high in result)


def _bridged(curves: Iterable[Edge]) -> list[Edge]:
    """Curves by where they begin, with a line over every gap that is no wider than rounding makes one."""
    result: list[Edge] = []
    reached: Edge | None = None
    for curve in sorted(curves, key=lambda curve: curve.start[0]):
        if reached is not None and _HAIR < curve.start[0] - reached.end[0] <= _GAP:
            result.append(offset.line(reached.end, curve.start))
        if reached is None or curve.end[0] > reached.end[0]:
            reached = curve
        result.append(curve)
    return result


def _meetings(first: Edge, second: Edge) -> list[Point]:
    """Where two curves may cross: points of the whole lines and circles between which both lie."""
    low, high = max(first.start[0], second.start[0]), min(first.end[0], second.end[0])
    return [point for point in offset.crossings(first, second, 0.0, 0.0) if low < point[0] < high]


def _apart(places: list[float]) -> list[float]:
    """Places in order without those that are hardly farther than the one before; the last one stays."""
    result: list[float] = []
    for place in places:
        if not result or place - result[-1] > _HAIR:
            result.append(place)
    return result


def _corners(profile: Profile) -> list[Point]:
    """Ends and turning points of the curves, and the posts."""
    points = [*profile.posts]
    for curve in profile.curves:
        points += [(a, height_on(curve, a)) for a in _tops(curve, curve.start[0], curve.end[0])]
    return points


def swept(profile: Profile, width: float) -> Profile:
    """The greatest height from every place to one that lies `width` farther."""
    if width <= NO_WAY:
        return profile
    curves = [*profile.curves, *(curve.moved((-width, 0.0)) for curve in profile.curves)]
    curves += [offset.line((a - width, h), (a, h)) for a, h in _corners(profile)]
    return Profile(envelope(curves))


def widened(profile: Profile, along: float, up: float) -> Profile:
    """The profile with stock on both sides of its walls and above."""
    return swept(moved(profile, along, up), 2.0 * along)


def moved(profile: Profile, along: float, up: float) -> Profile:
    """The profile elsewhere."""
    curves = tuple(piece.edge for piece in shifted([Piece(curve) for curve in profile.curves], along, up))
    return Profile(curves, tuple((a + along, h + up) for a, h in profile.posts))


def dilated(profile: Profile, radius: float) -> Profile:
    """Heights of the middle of a circle that lies on the profile."""
    if radius <= NO_WAY:
        return profile
    curves: list[Edge] = []
    for curve in profile.curves:
        if curve.center is None:
            curves.append(curve.moved(offset.square(curve.departing, radius)))
            continue
        before = arcs.radius_of(curve.center, curve.end)
        after = before - radius if curve.ccw else before + radius
        if after > _HAIR:
            start, end = (_scaled(curve.center, point, after / before) for point in (curve.start, curve.end))
            curves.append(offset.arc(start, end, curve.center, curve.ccw))
    for a, h in _corners(profile):
        curves.append(offset.arc((a - radius, h), (a, h + radius), (a, h), False))
        curves.append(offset.arc((a, h + radius), (a + radius, h), (a, h), False))
    return Profile(envelope(curves))


def _scaled(center: Point, point: Point, factor: float) -> Point:
    return tuple(c + factor * (p - c) for c, p in zip(center, point, strict=True))  # type: ignore[return-value]


def of_tool(profile: Profile, radius: float, width: float) -> Profile:
    """How deep the point of a tool may go: one with two noses of a radius, so wide from the point on.

    Raises:
        ValueError: The noses are wider than the tool.
    """
    flat = width - 2.0 * radius
    if flat < -_HAIR:
        raise ValueError("nose")
    return moved(swept(dilated(profile, radius), max(flat - SNUG_MM, 0.0)), -radius, -radius)


def cropped(profile: Profile, low: float, high: float) -> Profile:
    """What of a profile lies between two places; it may have no curve."""
    curves = (
        part(curve, max(low, curve.start[0]), min(high, curve.end[0]))
        for curve in profile.curves
        if curve.start[0] < high - _HAIR and curve.end[0] > low + _HAIR
    )
    return Profile(tuple(curves))


def stretches(above: Profile, below: Profile) -> list[tuple[float, float]]:
    """From where to where one profile lies above another."""
    low, high = max(above.begin, below.begin), min(above.end, below.end)
    places = {low, high}
    for first in above.curves:
        for second in below.curves:
            if first.start[0] < second.end[0] and second.start[0] < first.end[0]:
                places.update(a for a, _ in _meetings(first, second))
    for profile in (above, below):
        places.update(a for curve in profile.curves for a in (curve.start[0], curve.end[0]) if low < a < high)
    result: list[tuple[float, float]] = []
    for start, end in pairwise(_apart(sorted(places))):
        middle = 0.5 * (start + end)
        if above.height(middle) - below.height(middle) <= _HAIR:
            continue
        if result and start - result[-1][1] <= _HAIR:
            result[-1] = (result[-1][0], end)
        else:
            result.append((start, end))
    return result


def level(height: float, low: float, high: float) -> Profile:
    """The same height from place to place."""
    return Profile((offset.line((low, height), (high, height)),))


def layers(floor: Profile, stock: Profile, step: float) -> list[Profile]:
    """Floors at multiples of a distance off one, square to it, as far as there is stock; that one is the last."""
    result = [floor]
    while stretches(stock, found := dilated(floor, step * len(result))):
        result.append(found)
        checked(len(result))
    return result[::-1]


def shifted_layers(floor: Profile, stock: Profile, way: Point) -> list[Profile]:
    """As `layers`, each moved by a way along both axes from the one below it; none goes below the floor."""
    result = [floor]
    wall = floor.highest(floor.begin, floor.end)
    while True:
        along, up = way[0] * len(result), way[1] * len(result)
        beside = [floor.begin, floor.begin + along] if along > 0.0 else [floor.end + along, floor.end]
        walls = level(max(wall, stock.highest(stock.begin, stock.end)), *beside).curves if along else ()
        found = Profile(envelope([*floor.curves, *moved(floor, along, up).curves, *walls]))
        if not stretches(stock, found):
            return result[::-1]
        result.append(found)
        checked(len(result))
