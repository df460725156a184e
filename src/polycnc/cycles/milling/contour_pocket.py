"""Pockets and spigots of any contour: cleared in loops from the inside to the outside, edges and bases finished.

Source: SINUMERIK CYCLE63, CYCLE64 (contour pockets and spigots, predrilling). The loops lie at the cutter's radius and
the allowance off the walls, and at steps farther off. A step is at most the radius of the cutter: a place between two
loops is then within its reach from the outer one, in corners as well. From a loop to the next one outwards the cutter
goes straight towards the nearest wall, which never leaves what it may reach.
"""

from __future__ import annotations

from math import radians, tan

from polycnc.cycles.milling import region
from polycnc.cycles.milling.pockets import Insertion
from polycnc.cycles.milling.region import NEARER_MM, Loop, RegionError
from polycnc.cycles.milling.stroke import arc, cut, rapid, steps
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import arcs, distance, offset
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cycles.milling.stroke import MillStroke
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: More loops one inside another are taken for a mistake.
MOST_RINGS = 2_000
#: What a loop may miss its distance by and still be it, mm.
_ON_LOOP_MM = 1e-4
#: Parts of the radius by which the cutter is off the wall before it goes onto it.
_OFF_WALL = (1.0, 0.5, 0.25, 0.1)
#: Shortest loop that the cutter can go down along, mm.
_LEAST_RAMP_MM = 0.1


class InsertionError(ValueError):
    """Helix or oscillation find no room."""


class StartError(ValueError):
    """The cutter cannot go in where it is told to, or would have to go in elsewhere too."""


@dataclass(frozen=True, slots=True)
class ContourPocket:
    """Contours and how they are milled; mm, feeds in the unit of the strokes.

    Attributes:
        walls: As `region.walls` has them: for a spigot its own, else the pocket's and its islands'.
        blank: Outline of the blank round spigots, counter-clockwise; None for a pocket.
        radius: Of the cutter.
        step: Greatest step in the plane.
        keeps_sense: The walls lie on the right of the cutter; else on its left.
        feed, depth_feed: In the plane, on helices and slopes; straight down.
        reference, safe, retract: Levels of the blank's face, the safety plane and the end.
        clearance: Above what is milled, at which a rapid in depth ends.
        allowance: Left at the walls.
        insertion, helix, pitch, angle_deg: Way into the material.
        start: Where the cutter goes in; None for a place that is found.
    """

    walls: Sequence[Loop]
    blank: Loop | None
    radius: float
    step: float
    keeps_sense: bool
    feed: float
    depth_feed: float
    reference: float
    safe: float
    retract: float
    clearance: float
    allowance: float = 0.0
    insertion: Insertion = Insertion.FEED
    helix: float = 0.0
    pitch: float = 0.0
    angle_deg: float = 0.0
    start: Point | None = None

    @property
    def off(self) -> float:
        """How far the cutter's middle keeps off the walls."""
        return self.radius + self.allowance


@dataclass(slots=True)
class Ring:
    """A loop, how far off the walls it is, and the loops within that the cutter comes from."""

    loop: Loop
    away: float
    inner: list[Ring]


@dataclass(frozen=True, slots=True)
class Pass:
    """Once round a loop from its first edge on; `is_linked` where the cutter comes straight from the pass before.

    From where it ends it may have gone on along the loop again, to where the way to the next loop begins.
    """

    loop: Loop
    away: float
    is_linked: bool

    @property
    def start(self) -> Point:
        """Where it begins."""
        return self.loop[0].start

    @property
    def end(self) -> Point:
        """Where it ends."""
        return self.loop[-1].end


# ---- which loops


def areas(pocket: ContourPocket) -> list[list[Ring]]:
    """The outermost loops, with all that is in them, by the areas that the cutter can clear without leaving them.

    Raises:
        RegionError: The cutter goes in nowhere, or the contours cannot be followed.
    """
    step = min(pocket.step, pocket.radius)
    above: list[Ring] = []
    outermost: list[Ring] | None = None
    for k in range(MOST_RINGS):
        away = pocket.off + k * step
        rings = [Ring(loop, away, []) for loop in _loops(pocket, away)]
        if outermost is None:
            outermost = rings
        for ring in rings:
            if above:
                _outer_of(pocket, ring.loop[0].start, above, step).inner.append(ring)
        if not rings or (pocket.blank is not None and all(_is_clear(pocket, ring.loop) for ring in rings)):
            break
        above = rings
    else:
        raise RegionError("steps")
    if not outermost:
        raise RegionError("narrow")
    return _together(pocket, outermost)


def _together(pocket: ContourPocket, rings: list[Ring]) -> list[list[Ring]]:
    """Loops round islands with the smallest loop round an area that they lie in."""
    sense = 1.0 if pocket.keeps_sense else -1.0
    sizes = [sense * region.area(ring.loop) for ring in rings]
    found: dict[int, list[Ring]] = {k: [ring] for k, ring in enumerate(rings) if sizes[k] > 0.0}
    outer = sorted(found, key=lambda k: sizes[k])
    for k, ring in enumerate(rings):
        if k not in found:
            round_it = (j for j in outer if region.contains(rings[j].loop, ring.loop[0].start))
            found.setdefault(next(round_it, -1), []).append(ring)
    return list(found.values())


def _loops(pocket: ContourPocket, away: float) -> list[Loop]:
    """Loops at a distance in the sense of milling."""
    found = region.loops_at(pocket.walls, away)
    return found if pocket.keeps_sense else [region.reversed_loop(loop) for loop in found]


def _is_clear(pocket: ContourPocket, loop: Loop) -> bool:
    """Whether the cutter cuts nothing of the blank along a loop."""
    blank = pocket.blank
    assert blank is not None
    if region.contains(blank, loop[0].start):
        return False
    return all(region.room_along([blank], edge) >= pocket.radius + pocket.clearance for edge in loop)


def _outer_of(pocket: ContourPocket, point: Point, rings: Sequence[Ring], step: float) -> Ring:
    """The loop that is met on the way from a point to its nearest wall."""
    place = _outwards(pocket, point, step)
    ring = min(rings, key=lambda ring: region.clearance([ring.loop], place))
    if region.clearance([ring.loop], place) > _ON_LOOP_MM:
        raise RegionError("no way out")
    return ring


def _outwards(pocket: ContourPocket, point: Point, way: float) -> Point:
    """A point by so much nearer to its nearest wall."""
    wall = region.nearest(pocket.walls, point)
    part = way / arcs.radius_of(wall, point)
    return point[0] + part * (wall[0] - point[0]), point[1] + part * (wall[1] - point[1])


# ---- in which order


def passes(pocket: ContourPocket, area: Sequence[Ring]) -> list[Pass]:
    """All loops of an area from the innermost ones on."""
    done: list[Pass] = []
    for ring in area:
        _clear(pocket, ring, done)
    return done


def _clear(pocket: ContourPocket, ring: Ring, done: list[Pass]) -> None:
    for inner in ring.inner:
        _clear(pocket, inner, done)
    if ring.inner:
        done[-1], place = _way_out(pocket, done[-1], ring)
        done.append(Pass(_begun_at(ring.loop, place), ring.away, is_linked=True))
        return
    if done:
        at = done[-1].end
        place = region.nearest([ring.loop], at)
        if _reaches(pocket, at, place):
            done.append(Pass(_begun_at(ring.loop, place), ring.away, is_linked=True))
            return
    done.append(Pass(_start_of(pocket, ring.loop), ring.away, is_linked=False))


def _way_out(pocket: ContourPocket, last: Pass, ring: Ring) -> tuple[Pass, Point]:
    """The pass, gone on to where the straight way outwards meets a loop, and where it does.

    Raises:
        RegionError: It does nowhere.
    """
    for k, edge in enumerate(last.loop):
        place = _outwards(pocket, edge.start, last.away - ring.away)
        on_loop = region.clearance([ring.loop], place) <= _ON_LOOP_MM
        if on_loop and _reaches(pocket, edge.start, place):
            return Pass([*last.loop, *last.loop[:k]], last.away, last.is_linked), place
    raise RegionError("no way out")


def _reaches(pocket: ContourPocket, start: Point, end: Point) -> bool:
    """Whether the cutter may go straight from one point to another."""
    way = offset.line(start, end)
    return way.length <= NO_WAY or region.room_along(pocket.walls, way) >= pocket.off - 10.0 * NEARER_MM


def _start_of(pocket: ContourPocket, loop: Loop) -> Loop:
    """A loop that begins where the cutter goes in: beside the blank if it can, else at its longest edge."""
    if pocket.blank is not None:
        blank = pocket.blank
        outside = [k for k, edge in enumerate(loop) if not region.contains(blank, edge.start)]
        if outside:
            best = max(outside, key=lambda k: region.clearance([blank], loop[k].start))
            return loop[best:] + loop[:best]
    longest = max(range(len(loop)), key=lambda k: loop[k].length)
    return loop[longest:] + loop[:longest]


def _begun_at(loop: Loop, place: Point) -> Loop:
    """The loop from a point on it, round and back to it."""
    number = min(range(len(loop)), key=lambda k: distance.of_point(place, loop[k]))
    edge = loop[number]
    after = loop[number + 1 :] + loop[:number]
    if arcs.radius_of(place, edge.start) <= _ON_LOOP_MM:
        return [edge, *after]
    if arcs.radius_of(place, edge.end) <= _ON_LOOP_MM:
        return [*after, edge]
    place = distance.nearest_point(place, edge)
    return [region.piece_of(edge, place, edge.end), *after, region.piece_of(edge, edge.start, place)]


def entries(pocket: ContourPocket) -> list[Point]:
    """Where the cutter goes into the material, area by area."""
    return [
        done.start
        for area in areas(pocket)
        for done in passes(pocket, area)
        if not done.is_linked and not _is_beside(pocket, done.start)
    ]


def _is_beside(pocket: ContourPocket, point: Point) -> bool:
    """Whether the cutter stands beside the blank at a point."""
    blank = pocket.blank
    if blank is None or region.contains(blank, point):
        return False
    return region.clearance([blank], point) >= pocket.radius


# ---- strokes


def rough(pocket: ContourPocket, levels: Sequence[float]) -> Iterator[MillStroke]:
    """Clear all areas level by level; with the base as the one level that is its finishing.

    Raises:
        RegionError: As `areas`.
        InsertionError: The helix does not fit, or there is no way to oscillate along.
        StartError: The cutter does not come to its first pass from where it is to go in, or goes in at several places.
    """
    ways = [passes(pocket, area) for area in areas(pocket)]
    if pocket.start is not None:
        _check_start(pocket, [done for around in ways for done in around if not done.is_linked])
    for around in ways:
        yield from mill_passes(pocket, around, levels)
    yield rapid(w=pocket.retract)


def mill_passes(
    pocket: ContourPocket, around: Sequence[Pass], levels: Sequence[float]
) -> Iterator[MillStroke]:
    """The passes of an area, level by level.

    Raises:
        InsertionError: As `rough`.
    """
    above = pocket.reference
    for number, level in enumerate(levels):
        for done in around:
            if not done.is_linked:
                yield rapid(w=pocket.retract)
                yield from _enter(pocket, done, above, level, is_first=number == 0)
            else:
                yield cut(pocket.feed, done.start)
            for edge in done.loop:
                yield stroke_of(pocket, edge)
        above = level


def _check_start(pocket: ContourPocket, entered: Sequence[Pass]) -> None:
    start = pocket.start
    assert start is not None
    if (
        len(entered) > 1
        or region.clearance(pocket.walls, start) < pocket.off - NEARER_MM
        or not _reaches(pocket, start, entered[0].start)
    ):
        raise StartError


def stroke_of(pocket: ContourPocket, edge: Edge, w: float | None = None) -> MillStroke:
    """The stroke along an edge, down to a level with `w`."""
    if edge.center is None:
        return cut(pocket.feed, edge.end, w)
    return arc(pocket.feed, edge.end, edge.center, edge.ccw, w)


def _enter(
    pocket: ContourPocket, done: Pass, above: float, level: float, *, is_first: bool
) -> Iterator[MillStroke]:
    """Over the start of a pass, near to what is milled already, and into the material.

    Args:
        pocket: What is milled.
        done: The pass.
        above: Level that is milled already.
        level: Level of the pass.
        is_first: Nothing is milled yet.
    """
    up = 1.0 if pocket.safe > level else -1.0
    near = pocket.safe if is_first else above + up * pocket.clearance
    insertion = Insertion.FEED if _is_beside(pocket, done.start) else pocket.insertion
    if insertion is Insertion.HELIX:
        middle = _room_for_helix(pocket, done)
        begin = (middle[0] + pocket.helix, middle[1])
        yield rapid(begin)
        yield rapid(w=near)
        yield cut(pocket.feed, w=above)
        for part in steps(abs(level - above), pocket.pitch):
            yield arc(pocket.feed, begin, middle, pocket.keeps_sense, above - up * part)
        yield arc(pocket.feed, begin, middle, pocket.keeps_sense)
        yield cut(pocket.feed, middle)
        yield cut(pocket.feed, done.start)
        return
    yield rapid(pocket.start or done.start)
    yield rapid(w=near)
    if insertion is Insertion.OSCILLATION:
        yield cut(pocket.feed, w=above)
        yield from _ramp(pocket, done.loop, above, level)
        return
    yield cut(pocket.depth_feed, w=level)
    if pocket.start is not None:
        yield cut(pocket.feed, done.start)


def _ramp(pocket: ContourPocket, loop: Loop, above: float, level: float) -> Iterator[MillStroke]:
    """To and fro along the first edge of a loop, down by the angle, and back to its start."""
    edge = loop[0]
    slope = tan(radians(pocket.angle_deg))
    if edge.length < _LEAST_RAMP_MM:
        raise InsertionError("oscillation")
    # There and back is one turn, so that it ends where it began.
    turns = steps(abs(level - above), 2.0 * edge.length * slope)
    down = 1.0 if level > above else -1.0
    at = 0.0
    back = region.reversed_loop([edge])[0]
    for part in turns:
        yield stroke_of(pocket, edge, above + down * 0.5 * (at + part))
        yield stroke_of(pocket, back, above + down * part)
        at = part


def _room_for_helix(pocket: ContourPocket, done: Pass) -> Point:
    """The middle of a helix that the cutter can leave straight to the start of a pass.

    Raises:
        InsertionError: There is none.
    """
    room = pocket.off + pocket.helix - NEARER_MM
    start = done.start
    corners = [edge.start for edge in done.loop]
    mean = (sum(p[0] for p in corners) / len(corners), sum(p[1] for p in corners) / len(corners))
    wall = region.nearest(pocket.walls, start)
    away = arcs.radius_of(wall, start)
    inwards = (start[0] - wall[0]) / away, (start[1] - wall[1]) / away
    beyond = [
        (start[0] + k * pocket.helix * inwards[0], start[1] + k * pocket.helix * inwards[1])
        for k in (0.0, 0.5, 1.0)
    ]
    for middle in (*beyond, mean) if pocket.start is None else (pocket.start,):
        if region.clearance(pocket.walls, middle) < room:
            continue
        if _reaches(pocket, middle, start):
            return middle
    raise InsertionError("helix")


# ---- edges


def finish_edges(pocket: ContourPocket, levels: Sequence[float]) -> Iterator[MillStroke]:
    """Once along every wall at each level, straight onto it and off again.

    Args:
        pocket: With no allowance; `step` is what roughing has left.
        levels: From the top on.

    Raises:
        RegionError: As `areas`.
    """
    found = _loops(pocket, pocket.off)
    if not found:
        raise RegionError("narrow")
    for loop in found:
        begun = _start_of(pocket, loop)
        first = begun[0]
        middle = region.middle_of(first)
        begun = _begun_at(begun, middle)
        beside = _beside_wall(pocket, begun[0].start)
        yield rapid(w=pocket.retract)
        yield rapid(beside)
        yield rapid(w=pocket.safe)
        for level in levels:
            yield cut(pocket.depth_feed, w=level)
            yield cut(pocket.feed, begun[0].start)
            for edge in begun:
                yield stroke_of(pocket, edge)
            yield cut(pocket.feed, beside)
    yield rapid(w=pocket.retract)


def rising_to(pocket: ContourPocket, strokes: Sequence[MillStroke], level: float) -> list[MillStroke]:
    """The same strokes, but between two insertions the cutter rises to a level instead of the retraction plane."""
    up = rapid(w=pocket.retract)
    inner = [rapid(w=level) if stroke == up else stroke for stroke in strokes[1:-1]]
    return [*strokes[:1], *inner, *strokes[-1:]]


def _beside_wall(pocket: ContourPocket, point: Point) -> Point:
    """A place off the wall from which the cutter can go straight onto it; the point itself where it has no room."""
    wall = region.nearest(pocket.walls, point)
    away = arcs.radius_of(wall, point)
    for part in _OFF_WALL:
        way = part * max(pocket.radius, pocket.step)
        place = (
            point[0] + way * (point[0] - wall[0]) / away,
            point[1] + way * (point[1] - wall[1]) / away,
        )
        if _reaches(pocket, point, place):
            return place
    return point
