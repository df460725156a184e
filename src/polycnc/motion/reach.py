"""How fast a row gets along its way, where its axes share their acceleration between two things.

An axis that leads a curved path needs a part of its acceleration, `|q''|·x`, for the bend of its way (x is the square
of the speed), and has the rest for changes of speed, `|q'|·x'/2`. So what it has left depends on the speed, and the
speed on what was left before: from place to place x becomes as large as the axes allow, from both ends towards the
middle. That gives every share of the row its own speed and its own part of the acceleration.

Which part is for the bend is found there, not chosen: little where the row begins at rest, all of it where it is
fastest. Where a row may be entered at speed, or left, it is not known how fast, and `AT_JOINT` is the most all along.
"""

from __future__ import annotations

from itertools import pairwise
from math import cos, inf, pi, sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.demand import PATH_STEP
from polycnc.motion.kernels.columns import PIECES_PER_TURN
from polycnc.motion.kernels.demands import NOTHING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.motion.demand import Way

#: Shares of a row: as many as a row has room for, but for those of its ends.
PARTS = 28
#: Part of the largest x that a row has where it may be entered or left at speed.
AT_JOINT = 0.6
#: Part of the largest x that no share has, so that something of the acceleration is left to come along it.
LEAST_LEFT = 0.01
#: The turn of a piece of an arc at most, radians.
PIECE = 2.0 * pi / PIECES_PER_TURN


class Place(NamedTuple):
    """What the axes allow at a place of a row.

    Attributes:
        top2: Largest x by their velocities.
        along: What the columns can accelerate along the path, mm/s².
        asks: Of each axis, parts of its acceleration: for each unit of x, and for `along`.
    """

    top2: float
    along: float
    asks: list[tuple[float, float]]


def looked_at(way: Way) -> list[Place]:
    """Look at a row under a transformation, from share to share."""
    return [_place(way, k / PARTS) for k in range(PARTS + 1)]


def _place(way: Way, share: float) -> Place:
    step = PATH_STEP / way.length
    middle = min(max(share, step), 1.0 - step)
    nearby = [way.path(middle + k * step) for k in (-1, 0, 1)]
    before, here, after = (way.made.to_machine(point) for point in nearby)
    direction = [(b - a) / (2.0 * PATH_STEP) for a, b in zip(nearby[0], nearby[2], strict=True)]
    along = min((limit / abs(u) for limit, u in zip(way.pulls, direction, strict=True) if u), default=0.0)
    top2, asks = inf, []
    for i, axis in way.axes:
        came, goes = here[i] - before[i], after[i] - here[i]
        if way.turning[i]:  # the shorter way round
            came, goes = ((turn + 180.0) % 360.0 - 180.0 for turn in (came, goes))
        first, second = abs(came + goes) / (2.0 * PATH_STEP), abs(goes - came) / PATH_STEP**2
        if axis.velocity and first > 0.0:
            top2 = min(top2, (axis.velocity / first) ** 2)
        if axis.acceleration:
            asks.append((second / axis.acceleration, first * along / axis.acceleration))
    return Place(top2, along, asks)


def shares_of(
    places: Sequence[Place], length: float, angle: float, *, stops: bool
) -> list[tuple[float, float, float]]:
    """End, speed and `ease` of shares of equal length between places.

    Args:
        places: At equal distances, the first at the start of the row and the last at its end.
        length: Of the row, mm.
        angle: By how much the path turns, radians.
        stops: Whether it begins and ends at rest.
    """
    count, most = len(places) - 1, 1.0 - LEAST_LEFT if stops else AT_JOINT
    parts = [between(a, b, angle / count) for a, b in pairwise(places)]
    forth = _reached(parts, length / count, most, stops)
    back = _reached(parts[::-1], length / count, most, stops)[::-1]
    shares = []
    for k, part in enumerate(parts):
        x = max(min(forth[k], back[k]), NOTHING)
        shares.append(((k + 1) / count, sqrt(x), ease_at(part, x)))
    return shares


def between(a: Place, b: Place, angle: float) -> Place:
    """The least that is allowed between two places, along which the path turns by an angle, radians.

    At its ends the cubic of a piece bends more than its arc, by `d²/12` of that for a turn d.
    """
    nearer, turn = cos(0.5 * angle), min(angle, PIECE)
    bent = nearer / (1.0 + turn * turn / 12.0)
    asks = [(max(p[0], q[0]) / bent, max(p[1], q[1]) / nearer) for p, q in zip(a.asks, b.asks, strict=True)]
    return Place(min(a.top2, b.top2) * nearer * nearer, min(a.along, b.along), asks)


def largest2(place: Place) -> float:
    """Largest x at which every axis keeps its velocity and can hold the speed."""
    most = max((bend for bend, _ in place.asks), default=0.0)
    return min(place.top2, 1.0 / most if most > NOTHING else inf)


def ease_at(place: Place, x: float) -> float:
    """Part of what the columns can accelerate along the path that is left at an x."""
    left = [(1.0 - bend * x) / pull for bend, pull in place.asks if pull > NOTHING]
    return max(min(1.0, *left), 0.0) if left else 1.0


def _reached(parts: Sequence[Place], step: float, most: float, from_rest: bool) -> list[float]:
    """Largest x of each part that is reached from the first one's start with what is left at that x."""
    x, found = 0.0 if from_rest else most * largest2(parts[0]), []
    for part in parts:
        reach = x + 2.0 * step * part.along
        for bend, pull in part.asks:
            if pull > NOTHING:
                gain = 2.0 * step * part.along / pull
                reach = min(reach, (x + gain) / (1.0 + gain * bend))
        x = min(max(reach, x), most * largest2(part))
        found.append(x)
    return found
