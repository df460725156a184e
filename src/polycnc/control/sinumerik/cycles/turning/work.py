"""The cuts of a turning cycle in its own coordinates, and the path of the nose along a contour."""

from __future__ import annotations

from math import copysign

from polycnc.control.sinumerik.tools import stages
from polycnc.cycles.count import parts
from polycnc.cycles.turning.contour import Contour, Piece, parallel, shifted, swapped, swapped_stroke
from polycnc.cycles.turning.outline import farthest
from polycnc.cycles.turning.stock_removal import is_clear, way_clear, way_over
from polycnc.cycles.turning.stroke import PlaneStroke
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import offset
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point
    from polycnc.geometry.offset import Edge

#: Ways off the work where the call gives none.
LIFT_MM = 1.0
#: A point looks away where it does by more than this, in units of the nose radius: frames may turn it.
_AWAY = 0.5
#: By so much a direction of 45 degrees may miss it and still not be steep.
_ROUNDING = 1e-9


class Work:
    """Which way the cuts of a call run: lengthwise (a is Z, b the radius) or across (a is the radius, b is Z).

    Attributes:
        moves: Of the cycle.
        across, towards: Kind of the cuts, and direction of infeed, 1 or -1.
        cuts: The ways that have been cut, of the tool's point.
    """

    def __init__(self, moves: Moves, *, across: bool, towards: float) -> None:
        self.moves = moves
        self.across = across
        self.towards = towards
        self.cuts: list[Edge] = []

    def contour(self, read_: Contour) -> Contour:
        """A contour of the plane in the coordinates of the cuts."""
        return swapped(read_) if self.across else read_

    def pair(self, along: float, radial: float) -> Point:
        """An amount along Z and one along X in the coordinates of the cuts."""
        return (radial, along) if self.across else (along, radial)

    def touching(self, level: float) -> float:
        """`b` of the tool's point where the nose touches a level from above."""
        radius = stages.radius(self.moves.channel)
        tip = self.pair(*stages.tip(self.moves.channel))
        return level - self.towards * radius + radius * tip[1]

    def front(self, edge: float, direction: float) -> float:
        """`a` of the tool's point where the nose touches a front, when it comes in a direction, 1 or -1."""
        radius = stages.radius(self.moves.channel)
        tip = self.pair(*stages.tip(self.moves.channel))
        return edge - direction * radius + radius * tip[0]

    def require_point(self, direction: float = 0.0) -> None:
        """61608 for a tool whose point looks away from the work: its nose would be reckoned with on the wrong side.

        Args:
            direction: In which the cuts run, 1 or -1; 0 for a tool that may be drawn along the contour.
        """
        tip = self.pair(*stages.tip(self.moves.channel))
        if stages.radius(self.moves.channel) > NO_WAY and (
            tip[1] * self.towards < -_AWAY or tip[0] * direction < -_AWAY
        ):
            raise AlarmError("61608")

    def tool_path(
        self,
        contour: Contour,
        allowance: float,
        *,
        roughs: bool = False,
        rounds_begin: bool = False,
        rounds_end: bool = False,
    ) -> Contour:
        """Where the tool's point runs: the nose lies on the contour, or an allowance off it.

        Roughing leaves stock in a rounding that is too narrow for both. `rounds_begin`: the nose comes round an open
        end from which the contour goes down, for it passes over that end; `rounds_end`: it comes over the end to which
        the contour rises.

        Raises:
            AlarmError: 61606 where the nose does not fit the contour.
        """
        channel = self.moves.channel
        radius = stages.radius(channel)
        first, second = stages.tip(channel)
        try:
            off = -self.towards * onwards(contour) * (radius + allowance)
            path = parallel(contour, off, leaves_fillets=roughs)
        except ValueError:
            raise AlarmError("61606") from None
        if rounds_begin:
            path = [*self._round_begin(contour[0].edge, path[0].edge.start, off, contour[-1].edge.end), *path]
        if rounds_end:
            path = [*path, *self._round_end(contour, path[-1].edge.end, off)]
        return shifted(path, *self.pair(radius * first, radius * second))

    def _round_begin(self, first: Edge, onto: Point, off: float, end: Point) -> Contour:
        """The nose's way round the open end of a contour that goes down from there; nothing else needs one."""
        begin = first.start
        is_open = self.towards * (begin[1] - end[1]) >= 0.0
        if not is_open or self.towards * first.departing[1] <= NO_WAY or abs(off) <= NO_WAY:
            return []
        above = (begin[0], begin[1] - self.towards * abs(off))
        return [Piece(offset.arc(above, onto, begin, off < 0.0))]

    def _round_end(self, contour: Contour, begin: Point, off: float) -> Contour:
        """The nose's way over the end of a contour that rises to there; nothing for a wall, or where it runs along."""
        (along, into), end = contour[-1].edge.arriving, contour[-1].edge.end
        rises, is_wall = self.towards * into < -NO_WAY, onwards(contour) * along <= NO_WAY
        if not rises or is_wall or abs(off) <= NO_WAY:
            return []
        above = (end[0], end[1] - self.towards * abs(off))
        return [Piece(offset.arc(begin, above, end, off < 0.0))]

    def clear(self, contour: Contour, end: Point, lift: float, *, stock: Contour | None = None) -> None:
        """Go past the contour before a rapid to a place, where that would touch it; 61606 where no way is clear.

        `stock` is what still lies on the contour: the way passes over it as well, where there is one that does.
        """
        start = self.pair(*self.moves.point)
        try:
            way = way_clear(contour, start, end, towards=self.towards, lift=lift)
        except ValueError:
            raise AlarmError("61606") from None
        if stock is not None:
            try:
                over = way_clear(stock, start, end, towards=self.towards, lift=lift)
            except ValueError:
                over = way_over(stock, start, end, towards=self.towards, lift=lift)
            if is_clear(contour, [start, *(stroke.end for stroke in over), end], self.towards):
                way = over
        for stroke in way:
            self.perform(stroke, 0.0)

    def require_clear(self, contour: Contour, end: Point) -> None:
        """61606 for a straight stroke through the contour: one that runs back on itself has no cuts that are clear."""
        if not is_clear(contour, [self.pair(*self.moves.point), end], self.towards):
            raise AlarmError("61606")

    def perform(self, stroke: PlaneStroke, feed: float) -> None:
        """Make a stroke, which is a block."""
        start = self.pair(*self.moves.point)
        if stroke.center is not None:
            self.cuts.append(offset.arc(start, stroke.end, stroke.center, stroke.kind is Kind.CCW))
        elif stroke.kind is not Kind.RAPID:
            self.cuts.append(offset.line(start, stroke.end))
        made = swapped_stroke(stroke) if self.across else stroke
        if made.kind is Kind.RAPID:
            self.moves.rapid(*made.end)
        elif made.center is None:
            self.moves.feed(feed, *made.end)
        else:
            self.moves.arc(feed, made.end, made.center, made.kind is Kind.CCW)
        self.moves.end_block()


def onwards(contour: Contour) -> float:
    """The direction of a contour along the cuts; 61605 where it has none."""
    if abs(contour[-1].edge.end[0] - contour[0].edge.start[0]) <= NO_WAY:
        raise AlarmError("61605")
    return copysign(1.0, contour[-1].edge.end[0] - contour[0].edge.start[0])


def in_steps(work: Work, stroke: PlaneStroke, feed: float, step: float, dwell: float) -> None:
    """A cut that stands still after every step of it, so that the chip breaks.

    Args:
        work: The cuts.
        stroke: A straight one, along them.
        feed: Of it.
        step: Way from stop to stop, mm.
        dwell: Seconds above 0, revolutions below.
    """
    begin = work.pair(*work.moves.point)[0]
    way = stroke.end[0] - begin
    for part in steps_of(abs(way), step):
        work.perform(replace(stroke, end=(begin + copysign(part, way), stroke.end[1])), feed)
        if part < abs(way):
            work.moves.dwell(dwell)
            work.moves.end_block()


def steps_of(total: float, step: float) -> list[float]:
    """Ends of equal steps along a way, the last one shorter."""
    count = max(0, parts(total, step, 1e-9) - 1)
    return [step * k for k in range(1, count + 1)] + [total]


def finish(
    work: Work, path: Contour, onwards_: float, feed: float, lift: float, stock: Contour | None
) -> None:
    """Along a path of the tool once, from beside its begin to beside its end; `stock` is what roughing has left."""
    start, end = path[0].edge.start, path[-1].edge.end
    before = _beside(start, path[0].edge.departing, onwards_, work.towards, lift)
    if _is_closed(path, work.towards):
        before = (start[0], farthest(path, 1, -work.towards) - work.towards * lift)
    after = _beside(end, path[-1].edge.arriving, onwards_, work.towards, lift)
    work.clear(path, before, lift, stock=stock)
    for stroke in (
        PlaneStroke(Kind.RAPID, before),
        PlaneStroke(Kind.FEED, start),
        *(piece.stroke() for piece in path),
        PlaneStroke(Kind.FEED, after),
    ):
        # A rapid in the contour cuts as well: the cycle has feeds of its own.
        work.perform(stroke if stroke.end == before else _at_feed(stroke), feed)


def _is_closed(path: Contour, towards: float) -> bool:
    """Whether a path begins at its closed end, below a summit: behind it stock stands as high as that."""
    begin, end = path[0].edge.start[1], path[-1].edge.end[1]
    return towards * (begin - end) < -NO_WAY and towards * (begin - farthest(path, 1, -towards)) > NO_WAY


def _beside(point: Point, direction: Point, onwards_: float, towards: float, lift: float) -> Point:
    """A place off an end of the contour: square to the cuts where it is steep there, for the nose is beside a wall."""
    steep = direction[1] * towards > direction[0] * onwards_ + _ROUNDING
    return (point[0] - (0.0 if steep else onwards_ * lift), point[1] - towards * lift)


def _at_feed(stroke: PlaneStroke) -> PlaneStroke:
    return replace(stroke, kind=Kind.FEED) if stroke.kind is Kind.RAPID else stroke
