"""Through the pole of a polar plane: where the rotary axis stands there, and on which side of it the path goes on.

Just before the pole the rotary axis points where the path comes from, and there it stays: a place in the pole has that
direction, not the one in which a point without distance would lie. Moves are told on their way to the table, for
blocks may have been prepared before the path came there.
"""

from __future__ import annotations

from math import atan2, pi

from polycnc.channel.moves import knots
from polycnc.channel.moves.path import Rank, Stage
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeVar
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind
from polycnc.toolpath.row_path import arc_path, line_path
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.polar import CLOSEST_MM, PolarPlane
from polycnc.transformation.pole import POLE_MM, shares_at_pole
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import Move, Run
    from polycnc.toolpath.row_path import Path
    from polycnc.transformation.pole import Pole

Made = TypeVar("Made", bound=Any)

#: Kinds of moves that lead through the pole.
LED = frozenset((Kind.RAPID, Kind.FEED, Kind.SPLINE, *ARC_KINDS))
#: Where the direction of a way is looked at: behind this share of it, or so far off (mm) if it misses the pole.
SHARE, BESIDE_MM = 1e-6, 100.0 * POLE_MM
#: The other side must spare the rotary axis more than this, radians.
SPARED = 0.05


class PoleStage(Stage):
    """Tells moves on which side of the pole the linear axis is, and where the rotary axis stands in it.

    Args:
        channel: The channel.
    """

    rank = Rank.POLE
    keeps_ends = True
    takes_runs = True

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        #: Context and plane that were looked at last, the pole there, and the context with the side that holds.
        self._seen: tuple[int, PolarPlane | None, Pole | None, int] = (-1, None, None, -1)

    @property
    def plane(self) -> PolarPlane | None:
        """The polar plane that acts; None for none."""
        raise NotImplementedError

    @property
    def changes_sides(self) -> bool:
        """Whether the linear axis goes through the pole to its other side where that spares the rotary axis a turn."""
        return False

    def stand(self, side: float, pole_deg: float | None) -> None:
        """The linear axis is on a side of the pole, and the rotary axis in it at an angle; nothing moves."""
        raise NotImplementedError

    @property
    def active(self) -> bool:
        """Whether a polar plane acts."""
        return self.plane is not None

    def move(self, move: Move) -> None:
        """Pass a move on, in pieces from pole to pole."""
        pole, _ = self._look(move.context)
        if pole is None or move.kind not in LED:
            self._pass(move)
            return
        path, at_pole = self._way(pole, move)
        if not at_pole:
            self._pass(move)
            return
        edges = [0.0, *(share for share in at_pole if 0.0 < share < 1.0), 1.0]
        came: float | None = None
        for k, piece in enumerate(knots.cut(self._channel, move, edges[1:])):
            first, last = edges[k], edges[k + 1]
            if first in at_pole:
                self._leave(pole, path, (first, last), came)
            if last in at_pole:
                came = self._come(pole, path, (first, last), piece.context, ends=last == 1.0)
            self._pass(piece)

    def run(self, run: Run) -> int:
        """Take the moves in front of the first one that comes to the pole."""
        pole, context = self._look(run.context)
        run = run if context == run.context else replace(run, context=context)
        count = len(run.kinds) if pole is None else _clear(pole, run)
        return self.after.run(run.part(count)) if count else 0

    def _pass(self, move: Move) -> None:
        move.context = self._look(move.context)[1]
        self.after.move(move)

    # ---- at the pole

    def _look(self, context: int) -> tuple[Pole | None, int]:
        """The pole of a context, None for none, and the context with the side that holds."""
        plane = self.plane
        if self._seen[0] != context or self._seen[1] is not plane:
            made = self._channel.toolpath.contexts[context].transformation
            pole = None if made is None or plane is None else made.pole
            self._seen = (context, plane, pole, self._context(context))
        return self._seen[2], self._seen[3]

    def _way(self, pole: Pole, move: Move) -> tuple[Path, list[float]]:
        """The points of a move, and the shares of its way at which it is at the pole."""
        arc = None
        if move.center is not None:
            curve, ccw = (*move.center, *move.normal, move.turns), move.kind in CCW_KINDS
            arc = arc_path(move.start, move.end, curve, self._channel.coordinates.geometry, ccw=ccw)
        path = line_path(move.start, move.end) if arc is None else arc.at
        return path, shares_at_pole(pole, path, arc, move.start, move.end)

    def _leave(self, pole: Pole, path: Path, edges: tuple[float, float], came: float | None) -> None:
        """The path leaves the pole; `came`: the direction in which it was on its way there, if within this move."""
        ahead = _beside(pole, path, edges[0], edges[1])
        if ahead is None:
            return
        plane, own = self.plane, self._channel.coordinates.transformation
        assert plane is not None
        assert own is not None
        if came is None:
            beside = pole.axes_beside(own.to_machine(path(edges[0])), pole.side * plane.side * BESIDE_MM)
            came = _angle(pole, own.to_work(beside))
        turn = abs((_angle(pole, ahead) - came + pi) % (2.0 * pi) - pi)
        crosses = self.changes_sides and turn > 0.5 * pi + SPARED
        self.stand(-plane.side if crosses else plane.side, None)

    def _come(
        self, pole: Pole, path: Path, edges: tuple[float, float], context: int, *, ends: bool
    ) -> float | None:
        """The path comes to the pole, and `ends` there: the rotary axis stands as it does just before."""
        before = _beside(pole, path, edges[1], edges[0])
        if before is None:
            return None
        plane, made = self.plane, self._channel.toolpath.contexts[context].transformation
        assert plane is not None
        assert made is not None
        if ends:
            self.stand(plane.side, standing(made, plane.side, None).to_machine(before)[plane.rotary])
        return _angle(pole, before)

    def _context(self, number: int) -> int:
        """A context with the side that holds."""
        toolpath, plane = self._channel.toolpath, self.plane
        held = toolpath.contexts[number]
        if plane is None or held.transformation is None:
            return number
        made = standing(held.transformation, plane.side, plane.pole_deg)
        return (
            number
            if made == held.transformation
            else toolpath.context_number(replace(held, transformation=made))
        )


def standing(made: Made, side: float, pole_deg: float | None, turns_deg: float = 0.0) -> Made:
    """A transformation whose polar plane is on a side, its rotary axis so many turns on; any other one as it is."""
    if isinstance(made, Seated):
        return replace(made, inner=standing(made.inner, side, pole_deg, turns_deg))
    if isinstance(made, Chain):
        first, *others = made.links
        return replace(made, links=(standing(first, side, pole_deg, turns_deg), *others))
    if not isinstance(made, PolarPlane):
        return made
    return replace(made, side=side, pole_deg=pole_deg, start_deg=made.start_deg + turns_deg)


def _beside(pole: Pole, path: Path, here: float, other: float) -> list[float] | None:
    """A point of a way next to one of its ends, which is the pole; None where it never leaves that."""
    share = SHARE
    if pole.distance(path(here)) > CLOSEST_MM:
        share = min(0.5, BESIDE_MM / max(pole.distance(path(other)), BESIDE_MM))
    point = path(here + share * (other - here))
    return None if pole.distance(path(0.5 * (here + other))) <= POLE_MM else point


def _angle(pole: Pole, point: Sequence[float]) -> float:
    x, y = pole.away(point)
    return atan2(y, x)


def _clear(pole: Pole, run: Run) -> int:
    """How many moves of a run keep off the pole, from the first one on."""
    import numpy as np

    width, place = len(run.start), np.array(pole.place)
    ends = np.frombuffer(run.ends).reshape(-1, width)
    points = np.vstack([np.array(run.start), ends])[:, list(pole.columns)] - place
    start, way = points[:-1], np.diff(points, axis=0)
    square = (way * way).sum(axis=1)
    share = np.clip(-(start * way).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    nearest = np.hypot(*(start + share[:, None] * way).T)
    near = np.flatnonzero(nearest <= 2.0 * POLE_MM)
    return int(near[0]) if len(near) else len(run.kinds)
