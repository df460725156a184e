"""Through the pole of polar interpolation: the path rests there, and the rotary axis turns on the spot.

At the rotation centre the rotary axis has no direction: on a line through it, it turns by half a round in no time. A
row that begins at the pole, ends there or passes it is therefore run in legs, and between two of them the rotary axis
turns. Legs end and begin on a ring around the pole, too small to be seen: so every position of the path has its
direction, and a turn is a way along the ring.

A row on which a curve leads an axis through a kink is run in legs as well: the path rests at the kink, where the axis
would change its velocity at once.
"""

from __future__ import annotations

from array import array
from itertools import pairwise
from math import atan2, ceil, degrees, hypot, inf, pi, radians

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.frames import machine_of
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord, Rows, piece_width
from polycnc.toolpath.row_path import arc_path, line_path
from polycnc.transformation.pole import is_at, shares_at_pole

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.machine import Axis
    from polycnc.motion.pace import AxisLimits
    from polycnc.toolpath import Context
    from polycnc.toolpath.row_path import Path
    from polycnc.transformation.contract import Geometry, Transformation
    from polycnc.transformation.pole import Pole

#: Radius of the ring, mm: a path across it steps over it at rest, by less than an axis could move in a millisecond.
RING_MM = 1e-5
#: A following axis may step by what it can do within its limits in this time: no sample shows it.
KINK_S = 1e-3
#: Turns smaller than this (radians) count as none; a turn by half a round, but for this, is one forward.
NO_TURN, HALF = 1e-9, 1e-6
#: Degrees of a piece of a turn, and the part of the rotary axis's limits that cubics so long leave.
PIECE_DEG, PART = 2.0, 0.995


class Turn(NamedTuple):
    """The rotary axis turns at the pole, along the ring.

    Attributes:
        pole: The pole.
        start: Work coordinates at the start.
        angle: Of the start, radians; `way` is how far it turns.
    """

    pole: Pole
    start: list[float]
    angle: float
    way: float

    def at(self, share: float) -> list[float]:
        """Work coordinates after a share of the way."""
        return self.pole.beside(self.start, self.angle + share * self.way, RING_MM)


class Leg(NamedTuple):
    """A part of a row that begins or ends at the pole, in work coordinates.

    Attributes:
        start: Where it begins.
        end: Where it ends.
        path: Its points.
        length: Its way, mm; `part` is the share of the row's.
        rests: Whether it begins, and ends, at the pole.
        turn: What the rotary axis turns before it, if it does.
    """

    start: list[float]
    end: list[float]
    path: Path
    length: float
    part: float
    rests: tuple[bool, bool]
    turn: Turn | None


class PathLeg(NamedTuple):
    """A leg of a row through the pole, as the kernels take a row of its own.

    Attributes:
        turn: What the rotary axis turns before it, if it does.
        rows: Its columns; `feed` is a factor on that of the whole row.
        curves: Its curve parameters.
        end: Machine position of the path at its end.
    """

    turn: Turn | None
    rows: Rows
    curves: array[float]
    end: list[float]

    def at_feed(self, feed: float) -> Rows:
        """Its columns, where the whole row has this feed."""
        return self.rows._replace(feed=array("d", [feed * self.rows.feed[0]]))


def runs_in_legs(transformation: Transformation) -> bool:
    """Whether rows under a transformation may have to be run in legs."""
    from polycnc.transformation.couplings.kinks import has_kinks  # for paths under a transformation

    return transformation.pole is not None or has_kinks(transformation)


def legs_of(
    pole: Pole,
    start: list[float],
    end: list[float],
    curve: Sequence[float],
    geometry: Geometry,
    *,
    ccw: bool,
) -> list[Leg]:
    """Legs of a line (`curve` is empty) or an arc; none where it keeps away from the pole.

    Args:
        pole: The pole.
        start: Work coordinates of the start; on the ring where the row before has ended at the pole.
        end: Those of the end.
        curve: Centre, normal and further turns of an arc.
        geometry: Columns of X, Y and Z.
        ccw: Sense of the arc.
    """
    first, last = (pole.beside(point, 0.0, 0.0) if is_at(pole, point) else point for point in (start, end))
    arc = arc_path(first, last, curve, geometry, ccw=ccw) if len(curve) else None
    path = arc.at if arc is not None else line_path(first, last)
    places = shares_at_pole(pole, path, arc, first, last)
    if not places:
        return []
    if arc is None and is_at(pole, start) and is_at(pole, end):
        still = pole.beside(end, _angle(pole, start), RING_MM)
        way = hypot(*(b - a for a, b in zip(start, still, strict=True)))
        return [Leg(start, still, line_path(start, still), way, 1.0, (True, True), None)]
    legs: list[Leg] = []
    at, edges = start, [*([] if 0.0 in places else [0.0]), *places, *([] if 1.0 in places else [1.0])]
    for span in pairwise(edges):
        leg = _leg(pole, path, span, places, curve, geometry, ccw=ccw)
        turn = _turn(pole, at, leg.start) if leg.rests[0] else None
        legs.append(leg._replace(turn=turn))
        at = leg.end
    return legs


def slope_steps(axes: Sequence[Axis | None], *, soft: bool) -> Callable[[int, int], float]:
    """The step of a slope with which a following axis keeps its limits at any speed of the leading one (columns)."""

    def most(following: int, leading: int) -> float:
        own, other = axes[following], axes[leading]
        if own is None or other is None:
            return 0.0
        step = KINK_S * (own.jerk * KINK_S if soft and own.jerk else own.acceleration or inf)
        return 0.5 * step / max(other.rapid, other.max_feed)

    return most


def kink_legs(
    transformation: Transformation,
    steps: Callable[[int, int], float],
    start: list[float],
    end: list[float],
    curve: Sequence[float],
    *,
    ccw: bool,
) -> list[Leg]:
    """Legs of a row from kink to kink of the curves that lead axes: there the path rests.

    None where it has no kink, and where a leg would be a full circle or more. `steps` is that of `slope_steps`.
    """
    from polycnc.transformation.couplings.kinks import kinks

    geometry = transformation.geometry
    arc = arc_path(start, end, curve, geometry, ccw=ccw) if len(curve) else None
    path = arc.at if arc is not None else line_path(start, end)
    knots = kinks(transformation, path, steps)
    if not knots:
        return []
    edges, legs = [0.0, *(f for f in knots if f < 1.0), 1.0], list[Leg]()
    for low, high in pairwise(edges):
        if arc is not None and (high - low) * arc.angle >= 2.0 * pi - NO_TURN:
            return []
        first, last = path(low), end if high == 1.0 else path(high)
        inner, length = line_path(first, last), hypot(*(b - a for a, b in zip(first, last, strict=True)))
        if arc is not None:
            part = arc_path(first, last, [*curve[:6], 0.0], geometry, ccw=ccw)
            inner, length = part.at, part.length
        legs.append(Leg(first, last, inner, length, high - low, (False, False), None))
    return legs


def _leg(
    pole: Pole,
    path: Path,
    edges: tuple[float, float],
    places: Sequence[float],
    curve: Sequence[float],
    geometry: Geometry,
    *,
    ccw: bool,
) -> Leg:
    """From one edge of a row to the next, the pole at one of them or at both."""
    rests = (edges[0] in places, edges[1] in places)
    start, end = (
        pole.beside(path(f), 0.0, 0.0) if rest else path(f) for f, rest in zip(edges, rests, strict=True)
    )
    if len(curve):
        arc = arc_path(start, end, [*curve[:6], 0.0], geometry, ccw=ccw)
        whole, way, length = arc.at, arc.planar, arc.length
    else:
        whole, way = line_path(start, end), max(pole.distance(start), pole.distance(end))
        length = hypot(*(b - a for a, b in zip(start, end, strict=True)))
    short = min(RING_MM / way, 0.25)
    low, high = (short if rests[0] else 0.0), (1.0 - short if rests[1] else 1.0)

    def inner(f: float) -> list[float]:
        return whole(low + f * (high - low))

    return Leg(inner(0.0), inner(1.0), inner, length * (high - low), edges[1] - edges[0], rests, None)


def _angle(pole: Pole, point: Sequence[float]) -> float:
    x, y = pole.away(point)
    return atan2(y, x)


def _turn(pole: Pole, start: list[float], end: Sequence[float]) -> Turn | None:
    """From one point of the ring to another, the shorter way; None where they are one."""
    angle = _angle(pole, start)
    way = (_angle(pole, end) - angle + pi) % (2.0 * pi) - pi
    if way < HALF - pi:
        way += 2.0 * pi
    return Turn(pole, start, angle, way) if abs(way) > NO_TURN else None


def turn_records(
    turn: Turn,
    axis: AxisLimits,
    context: Context,
    geometry: Geometry,
    *,
    soft: bool,
    row: float,
    slot: int,
) -> array[float]:
    """The planner's pieces of a turn, from rest to rest. Their length counts degrees of the rotary axis.

    Args:
        turn: The turn.
        axis: What the rotary axis may do.
        context: What holds in the row.
        geometry: Columns of X, Y and Z.
        soft: The jerk is limited.
        row: Number of the row.
        slot: Where the row's time counts.
    """
    n, way = len(turn.start), abs(degrees(turn.way))
    width, count = piece_width(n), ceil(way / PIECE_DEG)
    top, pull = PART * axis.velocity or 1e9, PART * axis.acceleration or 1e9
    jerk, ramp = PART * axis.jerk, 0.0
    if soft and jerk > 0.0:
        from polycnc.motion.kernels.alone import best_ramp

        ramp = best_ramp(way, top, pull, jerk)
        pull = min(pull, 0.5 * jerk * ramp)
    records = array("d", bytes(8 * width * count))
    for k in range(count):
        at = k * width
        own = (
            (PieceRecord.FORM, Form.BENT),
            (PieceRecord.ROW, row),
            (PieceRecord.SLOT, slot),
            (PieceRecord.LENGTH, way / count),
            (PieceRecord.CAP2, top * top),
            (PieceRecord.PULL, pull),
        )
        held = (
            (PieceRecord.HOLD2, inf),
            (PieceRecord.HOLD_PULL, inf),
            (PieceRecord.PATH_PULL, inf),
            (PieceRecord.MARGIN, 1.0),
            (PieceRecord.RAMP, ramp),
        )
        for field, value in (*own, *held):
            records[at + field] = value
        records[at + PieceRecord.ENTRY2] = top * top if k else 0.0
        for end in range(2):
            share, here = (k + end) / count, at + PieceRecord.VECTORS + end * n
            records[here + PLACES * n : here + PLACES * n + n] = array(
                "d", machine_of(turn.at(share), context, geometry)
            )
            tangent, bend = _along_ring(turn, share, context, geometry)
            records[here : here + n] = array("d", tangent)
            records[here + 2 * n : here + 3 * n] = array("d", bend)
    records[PieceRecord.PAUSE] = ramp
    return records


def _along_ring(
    turn: Turn, share: float, context: Context, geometry: Geometry
) -> tuple[list[float], list[float]]:
    """First and second derivative of the machine position by degrees turned."""
    angle, per_degree = turn.angle + share * turn.way, radians(1.0 if turn.way > 0.0 else -1.0)
    centre = turn.pole.beside(turn.start, 0.0, 0.0)
    middle = machine_of(centre, context, geometry)

    def moved(angle: float, size: float) -> list[float]:
        ahead = machine_of(turn.pole.beside(turn.start, angle, RING_MM), context, geometry)
        return [size * (a - b) for a, b in zip(ahead, middle, strict=True)]

    return moved(angle + 0.5 * pi, per_degree), moved(angle + pi, per_degree * per_degree)
