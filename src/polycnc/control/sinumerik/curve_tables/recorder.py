"""What catches the moves of a curve table's definition, and makes segments of them (job planning 9.2.1).

Positions are taken as those of the axes, so frames of the definition count. Arcs and polynomials become polynomials of
degree five at most, which stay within a fraction of a micrometre of them; B splines come as chords.
"""

from __future__ import annotations

from itertools import groupby
from math import ceil, radians

from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import Recorder
from polycnc.control.sinumerik.couplings.links import without_couplings
from polycnc.control.sinumerik.curve_tables import splines
from polycnc.control.sinumerik.curve_tables.curve import Segment
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.polynomials import NODES, fitted, turns
from polycnc.geometry.tolerances import NO_WAY
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.channel.moves.path import Move
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Angle of an arc that one polynomial of degree five follows.
_PART_OF_ARC = radians(15.0)
#: Splines that go through their points.
THROUGH_POINTS = {"ASPLINE": True, "CSPLINE": False}


class _Piece(NamedTuple):
    """A segment, or (with the codes of a spline) the way from one of its points to the next."""

    segment: Segment
    spline: tuple[str, str, str] | None = None


class CurveRecorder(Recorder):
    """Keeps the curve of two axes.

    Args:
        channel: The channel whose blocks define it.
        leading: Column of the leading axis.
        following: Column of the following axis.
        number: Number of the table, for alarms.
        known: From positions of the definition to true ones.
    """

    def __init__(
        self,
        channel: SinumerikChannel,
        leading: int,
        following: int,
        number: int,
        known: Callable[[list[float]], list[float]],
    ) -> None:
        super().__init__()
        self._channel, self._columns, self._number = channel, (leading, following), number
        self._known = known
        self._start: tuple[float, float] | None = None
        self._pieces: list[_Piece] = []
        self._direction = 0.0
        self._bent: Callable[[float], list[float]] | None = None

    def bend(self, at: Callable[[float], list[float]]) -> None:
        """The next move is a curve: its position by a parameter from 0 to 1, as the program means it."""
        self._bent = at

    def move(self, move: Move) -> None:
        """Keep a move; the first one only leads to where the table begins."""
        bent, self._bent = self._bent, None
        if self._start is None:
            if any(move.start[column] != move.end[column] for column in self._columns):
                self._start = self._of_axes(move.end)
            return
        start, end = self._start, self._of_axes(move.end)
        if move.center is not None:
            self._add_arc(move)
        elif bent is not None:
            self._add_curve(bent, 0.0, 1.0)
        else:
            mode = self._channel.mode
            through = mode["motion"] in THROUGH_POINTS
            codes = (mode["motion"], mode["spline_start"], mode["spline_end"]) if through else None
            ways = [(a,) if abs(b - a) <= NO_WAY else (a, b - a) for a, b in zip(start, end, strict=True)]
            self._add(Segment(*ways), codes)
        self._start = end

    def _of_axes(self, position: list[float]) -> tuple[float, float]:
        machine = without_couplings(self._channel, self._known(position))
        leading, following = self._columns
        return machine[leading], machine[following]

    def _add_arc(self, move: Move) -> None:
        path = MovePath(move, self._channel.coordinates.geometry)
        count = max(ceil(abs(path.sweep) / _PART_OF_ARC), 1)
        for k in range(count):
            self._add_curve(path.at, k / count, (k + 1) / count)

    def _add_curve(self, at: Callable[[float], list[float]], first: float, last: float) -> None:
        points = [self._of_axes(at(first + (last - first) * node)) for node in NODES]
        leading, following = (fitted(values) for values in zip(*points, strict=True))
        self._add(Segment(leading, following))

    def _add(self, segment: Segment, spline: tuple[str, str, str] | None = None) -> None:
        """Keep a piece.

        Raises:
            AlarmError: 10943 where the leading axis turns round, 10949 where only the following axis moves.
        """
        begin, end = segment.ends
        way = end - begin
        if abs(way) <= NO_WAY and len(segment.leading) <= 2:
            if len(segment.following) == 1:
                return  # other axes move
            if not self._channel.memory.data.integer("$MC_CTAB_ENABLE_NO_LEADMOTION"):
                raise AlarmError("10949", number=self._number)
        elif turns(segment.leading) or way * self._direction < 0.0:
            raise AlarmError("10943", number=self._number)
        else:
            self._direction = way
        self._pieces.append(_Piece(segment, spline))

    def segments(self) -> tuple[Segment, ...]:
        """The definition is through: its segments.

        Raises:
            AlarmError: 10943 where a spline lets the leading axis turn round.
        """
        groups = [(codes, list(pieces)) for codes, pieces in groupby(self._pieces, lambda each: each.spline)]
        found: list[Segment] = []
        for k, (codes, pieces) in enumerate(groups):
            segments = [piece.segment for piece in pieces]
            if codes is not None:
                before = groups[k - 1][1][-1].segment if k else None
                behind = groups[k + 1][1][0].segment if k + 1 < len(groups) else None
                segments = list(_through_points(codes, segments, before, behind))
                if any(turns(segment.leading) for segment in segments):
                    raise AlarmError("10943", number=self._number)
            found += segments
        return tuple(found)


def _through_points(
    codes: tuple[str, str, str], pieces: list[Segment], before: Segment | None, behind: Segment | None
) -> Iterator[Segment]:
    """The pieces of a spline whose points are known."""
    code, begin, end = codes
    points = [(piece.leading[0], piece.following[0]) for piece in pieces]
    points.append((pieces[-1].ends[1], sum(pieces[-1].following)))
    bent = splines.curve(
        points,
        akima=THROUGH_POINTS[code],
        begin=begin[1:],
        end=end[1:],
        before=None if before is None else (before.leading[0], before.following[0]),
        behind=None if behind is None else (behind.ends[1], sum(behind.following)),
    )
    for leading, following in bent:
        yield Segment(leading, following)


def recorder_of(channel: SinumerikChannel) -> CurveRecorder | None:
    """What records a curve table now; None where no table is being defined."""
    return channel.path.find(CurveRecorder)
