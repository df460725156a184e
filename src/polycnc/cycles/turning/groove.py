"""A groove on a lathe with a parting tool (SINUMERIK CYCLE93, CYCLE930): walls at any angle, corners broken or rounded.

Points are (w, t): `w` runs from the edge at which the groove begins to the other one, `t` from the rim at that edge
down to the base. They are those of the tool's edge that lies nearer to where the groove begins. Each side of the groove
is drawn by itself, from its rim over the base, in points (u, t) whose `u` counts from its own edge.

On a slanted contour rim and base slope alike, walls lean from the way of the infeed, depth and width are told along the
axes. The tool's front does not slope: the edge on the side where the base lies higher draws the base, and on the lower
side the tool goes down as far as that edge lets it. What it cannot reach in the corner there stays.
"""

from __future__ import annotations

from functools import cached_property
from math import cos, hypot, radians, tan

from polycnc.cycles.count import parts
from polycnc.cycles.turning.contour import Piece, crossings, parallel, shifted, slopes, swapped
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.cycles.turning.contour import Contour
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: The tool goes so far off the wall that it has cut before it leaves the groove, mm.
OFF_WALL_MM = 1.0
_WHOLE = 1e-9
#: A corner that is broken by less is sharp.
BROKEN_MM = 1e-6
#: Edges that turn by less than this, radians, have no corner between them.
STRAIGHT_ON = 1e-9
#: A contour that slopes by less lies along its axis.
LEVEL = 1e-9
#: Steps that plunges leave on a slanted base are at most this share of the tool's width high.
STEP_OF_SLOPE = 0.25
#: Halvings of an edge until the place where the tool touches with both of its edges is exact.
_HALVINGS = 60


class GrooveStroke(NamedTuple):
    """A stroke; a dwell at the base has no point. An arc has a centre and turns as `ccw` says in (w, t)."""

    end: Point | None
    is_rapid: bool = False
    center: Point | None = None
    ccw: bool = False


DWELL = GrooveStroke(None)


class Corner(NamedTuple):
    """What becomes of a corner: an arc of a radius, a chamfer that leaves out `leg` of its edges, or of a length."""

    radius: float = 0.0
    leg: float = 0.0
    length: float = 0.0

    @property
    def is_sharp(self) -> bool:
        """Whether nothing becomes of it."""
        return max(self) <= BROKEN_MM


SHARP = Corner()


class Side(NamedTuple):
    """A side of a groove: how far its wall leans from upright, degrees, its corner at the rim and that at the base."""

    angle_deg: float = 0.0
    rim: Corner = SHARP
    base: Corner = SHARP

    @property
    def is_plain(self) -> bool:
        """Whether it is an upright wall between sharp corners."""
        return not self.angle_deg and self.rim.is_sharp and self.base.is_sharp


UPRIGHT = Side()


class GrooveError(ValueError):
    """The corners of a groove do not fit between its edges, or the tool does not between its walls."""


@dataclass(frozen=True)
class Groove:
    """A groove and how it is cut; mm.

    Attributes:
        width: Of the base, from wall to wall.
        depth: From rim to base.
        tool_width: Of the tool, not above what the flank allowances leave.
        base_allowance, flank_allowance: Left by roughing for a finishing cut.
        infeed: Greatest depth of one infeed; 0 for all at once.
        lift: Height above the rim between cuts, and way back between infeeds.
        sides: That at which the groove begins, and the other one.
        nose_radius: Of both edges of the tool.
        step: Greatest way between two plunges, as a share of the tool's width.
        alternates: Plunges go from the middle outwards; the first two are made in turn where there is an infeed.
        roughs: There are plunges; `finishes`: walls and base are finished, None where stock is left on them.
        slope: How much deeper rim and base lie for each mm of `w`.
    """

    width: float
    depth: float
    tool_width: float
    base_allowance: float = 0.0
    flank_allowance: float = 0.0
    infeed: float = 0.0
    lift: float = 1.0
    sides: tuple[Side, Side] = (UPRIGHT, UPRIGHT)
    nose_radius: float = 0.0
    step: float = 1.0
    alternates: bool = False
    roughs: bool = True
    finishes: bool | None = None
    slope: float = 0.0

    @cached_property
    def heights(self) -> tuple[float, float]:
        """Height of each wall, from its rim to its foot.

        Raises:
            GrooveError: A wall leans so much that it never comes to the base.
        """
        first, second = (
            1.0 - slope * tan(radians(side.angle_deg))
            for side, slope in zip(self.sides, (self.slope, -self.slope), strict=True)
        )
        if min(first, second) <= BROKEN_MM:
            raise GrooveError("slope")
        return self.depth / first, self.depth / second

    @cached_property
    def feet(self) -> tuple[float, float]:
        """From the edge of each side to the foot of its wall."""
        first, second = (
            height * tan(radians(side.angle_deg))
            for side, height in zip(self.sides, self.heights, strict=True)
        )
        return first, second

    @property
    def is_slanted(self) -> bool:
        """Whether it lies on a contour that slopes."""
        return abs(self.slope) > LEVEL

    def rim(self, w: float) -> float:
        """Where the rim lies highest over a tool at a place."""
        return min(self.slope * w, self.slope * (w + self.tool_width))

    @cached_property
    def over(self) -> float:
        """The level over the groove and the corners of its rims, at which the tool goes across."""
        starts = [contour[0].edge.start[1] for contour in self.contours] if not self.is_plain else []
        return min(0.0, self.slope * self.top, *starts) - self.lift

    @property
    def top(self) -> float:
        """Width at the rim."""
        return sum(self.feet) + self.width

    @cached_property
    def meeting(self) -> tuple[float, float]:
        """From the foot of each wall to where its edge stands when the other side goes on: at the middle of the base.

        Where the corner of a side takes more of the base than that, it is the end of that corner.

        Raises:
            GrooveError: The tool does not fit between the corners.
        """
        play = self.width - self.tool_width
        first, second = (max(_taken(side) - self.nose_radius, 0.0) for side in self.sides)
        if first + second > max(play, 0.0) + _WHOLE:
            raise GrooveError("corner")
        place = max(min(0.5 * play, play - second), first)
        return place, play - place

    @property
    def is_plain(self) -> bool:
        """Whether it is a rectangle."""
        return not self.is_slanted and all(side.is_plain for side in self.sides)

    @cached_property
    def contours(self) -> tuple[Contour, Contour]:
        """Each side in its own (u, t), from the highest point of its rim over the whole base.

        Raises:
            GrooveError: The corners do not fit.
        """
        return self._contour(0, self.slope, 0.0), self._contour(1, -self.slope, self.slope * self.top)

    def _contour(self, number: int, slope: float, t: float) -> Contour:
        """A side whose rim ends at `t`, with the slope of rim and base in its own direction."""
        side, foot = self.sides[number], (self.feet[number], t + self.heights[number])
        far = self.width + self.depth
        rim = offset.line((-far, t - far * slope), (0.0, t))
        wall = offset.line((0.0, t), foot)
        base = offset.line(foot, (foot[0] + self.width, foot[1] + self.width * slope))
        pieces = with_corner([Piece(rim)], Piece(wall), side.rim)
        return _from_summit(with_corner(pieces, Piece(base), side.base)[1:])

    def room(self, number: int, u: float) -> float:
        """How deep a side lets an edge of the tool go that stands at u; in front of the groove down to its rim."""
        u -= self.flank_allowance / cos(radians(self.sides[number].angle_deg))
        contour = self.contours[number]
        before, rim = contour[0].edge.start
        if u < before - NO_WAY:
            # A rim that rises towards the groove keeps the tool's front off up to its highest point.
            return rim + max(self.slope if number == 0 else -self.slope, 0.0) * (u - before)
        return _depth_at(contour, u)


def _from_summit(contour: Contour) -> Contour:
    """A side without what rises at its rim: the front of the tool lies over its highest point before it gets there."""
    pieces = slopes(contour)
    falls = (k for k, piece in enumerate(pieces) if piece.edge.end[1] > piece.edge.start[1] + NO_WAY)
    first = next(falls, 0)
    return pieces[first:] if first else contour


def _depth_at(contour: Contour, u: float) -> float:
    """The deepest `t` of a side at a place; that of its rim in front of it."""
    depth = contour[0].edge.start[1]
    for piece in contour:
        edge = piece.edge
        if edge.end[0] <= u + NO_WAY:
            depth = edge.end[1]
        elif edge.start[0] <= u:
            # The edge is crossed where its u is this one.
            return crossings(swapped([piece])[0].edge, u)[0][0]
    return depth


def _taken(side: Side) -> float:
    """What the corner at the base takes of the base."""
    turn = radians(90.0 - side.angle_deg)
    return max(side.base.radius * tan(0.5 * turn), side.base.leg, 0.5 * side.base.length / cos(0.5 * turn))


def with_corner(before: list[Piece], piece: Piece, corner: Corner) -> list[Piece]:
    """A contour that goes on with a piece, the corner between broken or rounded; `GrooveError` if that does not fit."""
    a, b = before[-1].edge, piece.edge
    if corner.is_sharp or abs(offset.turn(a, b)) <= STRAIGHT_ON:
        return [*before, piece]
    if corner.radius:
        cuts = offset.rounded(a, b, corner.radius)
    else:
        cuts = offset.chamfered(a, b, corner.leg or offset.leg_of_chamfer(a, b, corner.length))
    if cuts is None:
        raise GrooveError("corner")
    if cuts.center is None:
        broken = offset.line(cuts.leaving, cuts.entering)
    else:
        broken = offset.arc(cuts.leaving, cuts.entering, cuts.center, offset.turn(a, b) > 0.0)
    pieces = [offset.line(a.start, cuts.leaving), broken, offset.line(cuts.entering, b.end)]
    return [*before[:-1], *(Piece(edge) for edge in pieces if edge.length > NO_WAY)]


def strokes(groove: Groove) -> Iterator[GrooveStroke]:
    """Plunges side by side, each in equal infeeds, then both sides with half of the base each where stock is left.

    Raises:
        GrooveError: The corners do not fit, or the tool's nose does not into those of the base.
    """
    finishes = groove.finishes
    if finishes is None:
        finishes = not groove.is_plain or groove.base_allowance > 0.0 or groove.flank_allowance > 0.0
    if groove.is_slanted:
        _halves(groove)  # a tool that is too wide for the slope is found before it cuts
    if groove.roughs:
        yield from _rough(groove)
    if finishes:
        yield from _finish(groove)


def _rough(groove: Groove) -> Iterator[GrooveStroke]:
    """Plunges over the base from its first wall on, then down the walls where these lean by more than the tool."""
    leans = [
        groove.flank_allowance / cos(radians(side.angle_deg)) if side.angle_deg else groove.flank_allowance
        for side in groove.sides
    ]
    first = groove.feet[0] + leans[0]
    way = groove.width - sum(leans) - groove.tool_width
    apart = groove.tool_width * groove.step
    if groove.is_slanted:
        apart = min(apart, groove.tool_width * STEP_OF_SLOPE / abs(groove.slope))
    steps = max(parts(way, apart, _WHOLE), 0)
    places = [first + (way * column / steps if steps > 0 else 0.0) for column in range(steps + 1)]
    if groove.alternates:
        yield from _outwards(groove, places)
    else:
        for column, w in enumerate(places):
            yield from _plunge(groove, w, min(OFF_WALL_MM, way / steps) if column else 0.0)
    for number, (foot, start, sense) in enumerate(
        ((groove.feet[0], first, -1.0), (groove.feet[1], first + max(way, 0.0), 1.0))
    ):
        count = parts(foot, apart, _WHOLE)
        for k in range(1, count):
            yield from _plunge(groove, start + sense * foot * k / count, 0.0, number)


def _outwards(groove: Groove, places: list[float]) -> Iterator[GrooveStroke]:
    """Plunges from the middle one outwards, on both sides in turn; the first two go down together."""
    middle = (len(places) - 1) // 2
    order = sorted(range(len(places)), key=lambda k: (abs(k - middle), -k))
    together = order[:2] if groove.infeed > 0.0 else []
    yield from _in_turn(groove, [places[k] for k in together])
    for k in order[len(together) :]:
        yield from _plunge(groove, places[k], 0.0, at_once=bool(together))


def _in_turn(groove: Groove, places: list[float]) -> Iterator[GrooveStroke]:
    """Two plunges in turn, each two infeeds deeper than the other has come; one alone goes down by one at a time.

    Between them the tool rises by an infeed and the safety distance: there both are open.
    """
    if not places:
        return
    last = places[0]
    bottoms = [_base(groove, w) for w in places]
    rim = min(map(groove.rim, places))
    below, depth, level = [rim] * len(places), rim, groove.over
    number = 0
    while any(bottom - done > NO_WAY for done, bottom in zip(below, bottoms, strict=True)):
        if bottoms[number] - below[number] > NO_WAY:
            depth += groove.infeed
            below[number] = min(depth, bottoms[number])
            yield GrooveStroke((places[number], level), is_rapid=True)
            yield GrooveStroke((places[number], below[number]))
            level = max(below[number] - groove.infeed, rim) - groove.lift
            yield GrooveStroke((places[number], level), is_rapid=True)
            last = places[number]
        number = (number + 1) % len(places)
    yield GrooveStroke((last, groove.over), is_rapid=True)


def _plunge(
    groove: Groove, w: float, off: float, number: int | None = None, *, at_once: bool = False
) -> Iterator[GrooveStroke]:
    """In and out at a place; `off` the wall at the base before the way out, `number` of the side that bounds it."""
    base, rim = _base(groove, w), groove.rim(w)
    if base - rim <= NO_WAY:
        return
    off = off if _base(groove, w - off) >= base else 0.0
    infeeds = max(parts(base - rim, groove.infeed, _WHOLE), 1) if groove.infeed > 0.0 and not at_once else 1
    yield GrooveStroke((w, groove.over), is_rapid=True)
    for k in range(1, infeeds + 1):
        t = rim + (base - rim) * k / infeeds
        yield GrooveStroke((w, t))
        if k < infeeds:
            yield GrooveStroke((w, t - groove.lift), is_rapid=True)
    if number is None:
        yield DWELL
    if off:
        yield GrooveStroke((w - off, base))
    yield GrooveStroke((w - off, groove.over), is_rapid=True)


def _base(groove: Groove, w: float) -> float:
    """How deep roughing goes at a place: to the base, or to where the walls let both edges of the tool."""
    base = groove.depth + groove.rim(w) - groove.base_allowance * hypot(1.0, groove.slope)
    if groove.is_plain:
        return base
    return min(base, groove.room(0, w), groove.room(1, groove.top - w - groove.tool_width))


def _finish(groove: Groove) -> Iterator[GrooveStroke]:
    """Each side from its rim to the middle of the base, by the edge of the tool that lies on its side."""
    if groove.is_plain:
        yield from _finish_plain(groove)
        return
    for number, path in enumerate(_halves(groove)):
        start, end = path[0].edge.start, path[-1].edge.end
        yield GrooveStroke(_place(groove, number, (start[0], groove.over)), is_rapid=True)
        yield GrooveStroke(_place(groove, number, start))
        for piece in path:
            edge = piece.edge
            center = None if edge.center is None else _place(groove, number, edge.center)
            yield GrooveStroke(_place(groove, number, edge.end), center=center, ccw=edge.ccw is (number == 0))
        yield GrooveStroke(_place(groove, number, (end[0], groove.over)), is_rapid=True)


def _finish_plain(groove: Groove) -> Iterator[GrooveStroke]:
    last = groove.width - groove.tool_width
    for wall in (0.0, last):
        yield GrooveStroke((wall, -groove.lift), is_rapid=True)
        yield GrooveStroke((wall, groove.depth))
        yield GrooveStroke((0.5 * last, groove.depth))
        yield GrooveStroke((0.5 * last, -groove.lift), is_rapid=True)


def _halves(groove: Groove) -> tuple[Contour, Contour]:
    """Where the edge on each side goes along it, up to where both meet on the base."""
    paths = _edge_path(groove, 0), _edge_path(groove, 1)
    if not groove.is_slanted:
        first, second = (
            _until(path, (foot + meeting, groove.depth))
            for path, foot, meeting in zip(paths, groove.feet, groove.meeting, strict=True)
        )
        return first, second
    high = 0 if groove.slope > 0.0 else 1
    upper, lower = paths[high], _until_both_touch(groove, paths[1 - high], paths[high])
    touched = _across(groove, lower[-1].edge.end)
    base = upper[-1].edge
    if base.center is None and touched[0] > base.start[0] + NO_WAY:
        # Both sides go on to the middle of the base, which the upper edge draws.
        part = 0.5 * (touched[0] - base.start[0]) / (base.end[0] - base.start[0])
        met = tuple(p + part * (q - p) for p, q in zip(base.start, base.end, strict=True))
        lower.append(Piece(offset.line(_across(groove, touched), _across(groove, (met[0], met[1])))))
        touched = (met[0], met[1])
    upper = _until(upper, touched)
    return (upper, lower) if high == 0 else (lower, upper)


def _until(path: Contour, point: Point) -> Contour:
    """A side's path, which never rises, up to one of its points."""
    result: Contour = []
    u, t = point
    for piece in path:
        edge = piece.edge
        if edge.end[0] <= u + NO_WAY and edge.end[1] <= t + NO_WAY:
            result.append(piece)
            continue
        is_upright = edge.end[0] - edge.start[0] <= NO_WAY
        if is_upright and t > edge.start[1] + NO_WAY:
            result.append(Piece(_led_to(edge, (edge.start[0], t))))
        elif not is_upright and u > edge.start[0] + NO_WAY:
            result.append(Piece(_led_to(edge, crossings(swapped([piece])[0].edge, u)[0][::-1])))
        break
    return result


def _led_to(edge: Edge, end: Point) -> Edge:
    """The part of an edge from its start."""
    return (
        offset.line(edge.start, end)
        if edge.center is None
        else offset.arc(edge.start, end, edge.center, edge.ccw)
    )


def _until_both_touch(groove: Groove, lower: Contour, upper: Contour) -> Contour:
    """The path of the edge on the lower side, down to where the other edge touches the upper one's.

    Raises:
        GrooveError: That is above the rim, for the tool is too wide for the slope.
    """
    if _cuts(groove, lower[0].edge.start, upper):
        raise GrooveError("slope")
    result: Contour = []
    for piece in lower:
        edge = piece.edge
        if not _cuts(groove, edge.end, upper):
            result.append(piece)
            continue
        clear, cutting = 0.0, 1.0
        for _ in range(_HALVINGS):
            part = 0.5 * (clear + cutting)
            clear, cutting = (clear, part) if _cuts(groove, _along(edge, part), upper) else (part, cutting)
        led = _led_to(edge, _along(edge, clear))
        return [*result, Piece(led)] if led.length > NO_WAY or not result else result
    return result


def _along(edge: Edge, part: float) -> Point:
    """A point of an edge, by its part of the way."""
    if edge.center is not None:
        return arcs.point_on_arc(edge.start, edge.end, edge.center, edge.ccw, part)
    (u0, t0), (u1, t1) = edge.start, edge.end
    return u0 + part * (u1 - u0), t0 + part * (t1 - t0)


def _cuts(groove: Groove, point: Point, upper: Contour) -> bool:
    """Whether the edge on the upper side lies below its path when the other one is at a point of the lower side."""
    u, t = _across(groove, point)
    return t > _depth_at(upper, u) + NO_WAY


def _across(groove: Groove, point: Point) -> Point:
    """The other edge of the tool, in the other side's own coordinates."""
    return groove.top - point[0] - groove.tool_width, point[1]


def _edge_path(groove: Groove, number: int) -> Contour:
    """Where the edge on a side would go along it and on over the base: its nose lies on the contour."""
    radius = groove.nose_radius
    try:
        path = parallel(groove.contours[number], -radius)
    except ValueError:
        raise GrooveError("nose") from None
    return shifted(path, -radius, radius)


def _place(groove: Groove, number: int, point: Point) -> Point:
    """A point of the edge on a side, as one of the edge that lies nearer to where the groove begins."""
    u, t = point
    return (u, t) if number == 0 else (groove.top - u - groove.tool_width, t)
