"""The stage that holds a smooth approach back until the contour's first move tells its direction.

See `smooth_approach` for what an approach is made of.
"""

from __future__ import annotations

from math import isnan

from polycnc.channel.moves import origins
from polycnc.channel.moves.path import Move, Rank, Stage
from polycnc.control.sinumerik.tables import RETRACTIONS
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.context import SHORTENED

if TYPE_CHECKING:
    from polycnc.compensation.plane import Plane
    from polycnc.geometry.arcs import Point

#: DISCL in mm, and whether it is a height (AC) or counts from the machining plane.
Clearance: TypeAlias = tuple[float, bool] | None
LINES, QUARTERS = ("G147", "G148"), ("G247", "G248")


@dataclass(frozen=True, slots=True)
class Shape:
    """The touching line or arc.

    Attributes:
        code: Function of the block.
        size: DISR and what the tool radius adds to it, mm.
        side: 1 if it lies left of the direction of travel, -1 right; 0 while its other end has to tell (G143).
        in_plane: G341.
        gain: What the tool radius adds to an arc on the left, mm.
    """

    code: str
    size: float
    side: int
    in_plane: bool
    gain: float = 0.0

    def sided(self, side: int) -> Shape:
        """The same on a side of the contour."""
        return replace(self, size=self.size + self.gain * side, side=side, gain=0.0)

    def towards(self, point: Point, touch: Point, travel: Point) -> Shape:
        """The same on the side of the contour on which a point lies, where no code says which (G143)."""
        if self.side:
            return self
        away = travel[0] * (point[1] - touch[1]) - travel[1] * (point[0] - touch[0])
        return self.sided(1 if away >= 0.0 else -1)

    def far_end(self, touch: Point, direction: Point) -> Point:
        """The end that does not touch the contour; `direction` leads away from it along the contour's tangent."""
        u, v = direction
        # Of an approach the direction is turned round, so the side of travel changes with it.
        turned = self.side if self.code in RETRACTIONS else -self.side
        across = (-v * turned * self.size, u * turned * self.size)
        along = (u * self.size, v * self.size)
        if self.code in LINES:
            across = (0.0, 0.0)
        elif self.code not in QUARTERS:
            across, along = (2.0 * across[0], 2.0 * across[1]), (0.0, 0.0)
        return touch[0] + along[0] + across[0], touch[1] + along[1] + across[1]

    def center(self, touch: Point, direction: Point) -> Point | None:
        """Centre of the arc; None for a line."""
        if self.code in LINES:
            return None
        turned = self.side if self.code in RETRACTIONS else -self.side
        return touch[0] - direction[1] * turned * self.size, touch[1] + direction[0] * turned * self.size

    @property
    def origin(self) -> int:
        """What kind of intermediate block it is."""
        if self.code in LINES:
            return origins.APPROACH_LINE
        return origins.APPROACH_QUARTER if self.code in QUARTERS else origins.APPROACH_HALF

    @property
    def ccw(self) -> bool:
        """Sense of the arc: it turns to the side on which it lies."""
        return self.side > 0


@dataclass(slots=True)
class Approach:
    """An approach that waits for the first move of the contour.

    Attributes:
        place: Kind and feed of the way to P2, with the place of the block in the program.
        start: P0.
        touch: P4; None while the next move has to tell it.
        clearance: DISCL and whether it is absolute, None for none.
        deep: Height of P4 where the block tells it; NaN where the next move does.
        feed: Of P3 to P4.
        infeed: Of P2 to P3; NaN for that of the way to P2.
    """

    shape: Shape
    place: Move
    start: list[float]
    touch: list[float] | None
    clearance: Clearance
    deep: float
    feed: float
    infeed: float


class SmoothApproach(Stage):
    """The stage that holds an approach back."""

    rank = Rank.APPROACH

    def __init__(self, plane: Plane) -> None:
        self.plane = plane
        self.waiting: Approach | None = None

    @property
    def active(self) -> bool:
        """Whether an approach waits."""
        return self.waiting is not None

    def move(self, move: Move) -> None:
        """Take the next move: it tells P4 if that is open, else the direction of the contour."""
        waiting = self.waiting
        if waiting is None or not self.plane.moves(move):
            self.after.move(move)
        elif waiting.touch is None:
            third = self.plane.columns[self.plane.w]
            if third >= 0 and not isnan(waiting.deep) and abs(move.end[third] - waiting.deep) > NO_WAY:
                raise AlarmError("10745", line=waiting.place.line)
            waiting.touch = move.end
        else:
            self.waiting = None
            edge = self.plane.edge(move)
            for part in self._parts(waiting, waiting.touch, edge.departing if edge else (0.0, 0.0)):
                self.after.move(part)
            self.after.move(move)

    def flush(self) -> None:
        """No contour follows: alarm 10740."""
        if self.waiting is not None:
            line, self.waiting = self.waiting.place.line, None
            raise AlarmError("10740", line=line)
        self.after.flush()

    def _parts(self, waiting: Approach, touch: list[float], direction: Point) -> list[Move]:
        """The moves P0 to P4."""
        plane, shape, place = self.plane, waiting.shape, waiting.place
        third = plane.columns[plane.w]
        away = (-direction[0], -direction[1])
        shape = shape.towards(plane.point(waiting.start), plane.point(touch), direction)
        far = shape.far_end(plane.point(touch), away)
        above = plane.at(waiting.start, far)
        points = [(above, place.kind, place.feed)]
        if third >= 0:
            height = height_of(waiting.clearance, waiting.start[third], touch[third])
            points.append((with_value(above, third, height), place.kind, place.feed))
            if shape.in_plane:
                kind, feed = (
                    (place.kind, place.feed) if isnan(waiting.infeed) else (Kind.FEED, waiting.infeed)
                )
                points.append((with_value(above, third, touch[third]), kind, feed))
        parts = []
        now = waiting.start
        for end, kind, feed in points:
            if end != now:
                parts.append(_placed(place, kind, now, end, feed))
            now = end
        last = _placed(place, Kind.FEED, now, touch, waiting.feed)
        center = shape.center(plane.point(touch), away)
        if center is not None:
            last.kind = plane.arc_kind(shape.ccw, now, touch)
            last.center, last.normal = plane.lift(center, now), plane.normal
        for part in parts:
            part.origin = SHORTENED
        last.origin = shape.origin
        return [*parts, last]


def height_of(clearance: Clearance, far: float, plane: float) -> float:
    """Height of P2 for DISCL; alarm 10741 if it does not lie between the start and the machining plane."""
    if clearance is None:
        return plane
    value, is_absolute = clearance
    height = value if is_absolute else plane + (value if far >= plane else -value)
    if not min(far, plane) - NO_WAY <= height <= max(far, plane) + NO_WAY:
        raise AlarmError("10741")
    return height


def _placed(place: Move, kind: Kind, start: list[float], end: list[float], feed: float) -> Move:
    return Move(kind, start, end, feed, place.program, place.line, place.context)


def with_value(point: list[float], column: int, value: float) -> list[float]:
    """A point with one coordinate replaced."""
    changed = point.copy()
    changed[column] = value
    return changed
