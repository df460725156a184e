"""Through the centre of turning under TRANSMIT: where the rotary axis stands there, and on which side the path goes on.

With MD24911 or MD24951 = 0 the infeed axis may go through the centre to its other side while the rotary axis stands.
So it does wherever that spares the rotary axis a turn: straight on, and at corners of less than 90 degrees; at sharper
ones it comes back on its own side. With 1 or 2 it keeps its side, and the rotary axis turns in the centre (6.8.1).

Moves are told their side on their way to the table, for blocks may have been prepared before the path came there.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan2, pi
from typing import TYPE_CHECKING, Any, TypeVar

from polycnc.channel.moves import knots
from polycnc.channel.moves.path import Rank, Stage
from polycnc.control.sinumerik.couplings import links
from polycnc.control.sinumerik.transformations.seat import Transformations
from polycnc.toolpath.kinds import ARC_KINDS, CCW_KINDS, Kind
from polycnc.toolpath.row_path import arc_path, line_path
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.polar import CLOSEST_MM, PolarPlane
from polycnc.transformation.pole import POLE_MM, shares_at_pole
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.moves.path import Move, Run
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.toolpath.row_path import Path
    from polycnc.transformation.pole import Pole

    Inner = TypeVar("Inner", bound=Any)

#: Kinds of moves that lead through the centre.
LED = frozenset((Kind.RAPID, Kind.FEED, Kind.SPLINE, *ARC_KINDS))
#: Where the direction of a way is looked at: behind this share of it, or so far off (mm) if it misses the centre.
SHARE, BESIDE_MM = 1e-6, 100.0 * POLE_MM
#: The other side must spare the rotary axis more than this, radians.
SPARED = 0.05


class PoleSides(Stage):
    """Tells moves on which side of the centre the infeed axis is, and where the rotary axis stands in it.

    Args:
        channel: The channel.
    """

    rank = Rank.POLE
    keeps_ends = True
    takes_runs = True

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel

    @property
    def active(self) -> bool:
        """Whether a transformation with a centre of turning acts."""
        return plane_of(self._channel) is not None

    def move(self, move: Move) -> None:
        """Pass a move on, in pieces from centre to centre."""
        pole = self._pole(move.context)
        if pole is None or move.kind not in LED:
            self._pass(move)
            return
        path, at_pole = self._way(pole, move)
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
        """Take the moves in front of the first one that comes to the centre."""
        pole, run = self._pole(run.context), replace(run, context=self._context(run.context))
        count = len(run.kinds) if pole is None else _clear(pole, run)
        return self.after.run(run.part(count)) if count else 0

    def _pass(self, move: Move) -> None:
        move.context = self._context(move.context)
        self.after.move(move)

    # ---- in the centre

    def _pole(self, context: int) -> Pole | None:
        made = self._channel.toolpath.contexts[context].transformation
        return made.pole if isinstance(made, Seated) else None

    def _way(self, pole: Pole, move: Move) -> tuple[Path, list[float]]:
        """The points of a move, and the shares of its way at which it is in the centre."""
        arc = None
        if move.center is not None:
            curve, ccw = (*move.center, *move.normal, move.turns), move.kind in CCW_KINDS
            arc = arc_path(move.start, move.end, curve, self._channel.coordinates.geometry, ccw=ccw)
        path = line_path(move.start, move.end) if arc is None else arc.at
        return path, shares_at_pole(pole, path, arc, move.start, move.end)

    def _leave(self, pole: Pole, path: Path, edges: tuple[float, float], came: float | None) -> None:
        """The path leaves the centre; `came`: the direction in which it was on its way there, if within this move."""
        ahead = _beside(pole, path, edges[0], edges[1])
        if ahead is None:
            return
        plane, own = plane_of(self._channel), Transformations.of(self._channel).seated
        assert plane is not None
        assert own is not None
        if came is None:
            beside = pole.axes_beside(own.to_machine(path(edges[0])), pole.side * plane.side * BESIDE_MM)
            came = _angle(pole, own.to_work(beside))
        turn = abs((_angle(pole, ahead) - came + pi) % (2.0 * pi) - pi)
        free = Transformations.of(self._channel).build
        crosses = free is not None and free.changes_sides and turn > 0.5 * pi + SPARED
        stand(self._channel, -plane.side if crosses else plane.side, None)

    def _come(
        self, pole: Pole, path: Path, edges: tuple[float, float], context: int, *, ends: bool
    ) -> float | None:
        """The path comes to the centre, and `ends` there: the rotary axis stands as it does just before."""
        before = _beside(pole, path, edges[1], edges[0])
        if before is None:
            return None
        plane, made = plane_of(self._channel), self._channel.toolpath.contexts[context].transformation
        assert plane is not None
        assert isinstance(made, Seated)
        if ends:
            stands = replace(made, inner=_standing(made.inner, plane.side, None)).to_machine(before)
            stand(self._channel, plane.side, stands[plane.rotary])
        return _angle(pole, before)

    def _context(self, number: int) -> int:
        """A context with the side that holds."""
        toolpath, plane = self._channel.toolpath, plane_of(self._channel)
        held = toolpath.contexts[number]
        if plane is None or not isinstance(held.transformation, Seated):
            return number
        inner = _standing(held.transformation.inner, plane.side, plane.pole_deg)
        if inner == held.transformation.inner:
            return number
        return toolpath.context_number(
            replace(held, transformation=replace(held.transformation, inner=inner))
        )


def plane_of(channel: SinumerikChannel) -> PolarPlane | None:
    """The polar plane of the transformation that acts; None for none."""
    build = Transformations.of(channel).build
    inner = build.inner if build is not None else None
    first = inner.links[0] if isinstance(inner, Chain) else inner
    return first if isinstance(first, PolarPlane) else None


def stand(channel: SinumerikChannel, side: float, pole_deg: float | None) -> None:
    """The infeed axis is on a side of the centre, and the rotary axis in it at an angle; nothing moves."""
    state, coordinates = Transformations.of(channel), channel.coordinates
    build, seated = state.build, state.seated
    assert build is not None
    assert seated is not None
    inner = _standing(build.inner, side, pole_deg)
    if inner == build.inner:
        return
    state.build = replace(build, inner=inner)
    state.seated = replace(seated, inner=_standing(seated.inner, side, pole_deg))
    links.take_seat(channel, state.seated)
    if coordinates.transformation is seated:
        coordinates.transformation = state.seated
    channel.context_changed()


def _standing(inner: Inner, side: float, pole_deg: float | None) -> Inner:
    """A transformation whose polar plane is on a side; any other one as it is."""
    if isinstance(inner, Chain):
        first, *others = inner.links
        return replace(inner, links=(_standing(first, side, pole_deg), *others))
    return replace(inner, side=side, pole_deg=pole_deg) if isinstance(inner, PolarPlane) else inner


def _beside(pole: Pole, path: Path, here: float, other: float) -> list[float] | None:
    """A point of a way next to one of its ends, which is the centre; None where it never leaves that."""
    share = SHARE
    if pole.distance(path(here)) > CLOSEST_MM:
        share = min(0.5, BESIDE_MM / max(pole.distance(path(other)), BESIDE_MM))
    point = path(here + share * (other - here))
    return None if pole.distance(path(0.5 * (here + other))) <= POLE_MM else point


def _angle(pole: Pole, point: Sequence[float]) -> float:
    x, y = pole.away(point)
    return atan2(y, x)


def _clear(pole: Pole, run: Run) -> int:
    """How many moves of a run keep off the centre, from the first one on."""
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
