"""The stage that collects the control points of a B spline until it ends, and makes its curve out of them.

The curve begins at the first and ends at the last control point, and touches the control polygon there (job planning
4.2). It is cut into chords that stay within `TOLERANCE_MM` of it.
"""

from __future__ import annotations

from itertools import groupby
from operator import itemgetter

from polycnc.channel.moves.path import Rank, Stage
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.nurbs import nurbs_chords
from polycnc.geometry.tolerances import NO_WAY
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from polycnc.channel.moves.path import Move, PlacedEvent
    from polycnc.compensation.plane import Plane

TOLERANCE_MM = 0.001
#: A weight of zero takes a control point away; the curve's formula needs a number.
_LEAST_WEIGHT = 1e-6


class SplineStage(Stage):
    """Collects moves to control points: their parameters are weight, degree and knot distance.

    Args:
        plane: The plane in which the spline began.
        join: Makes one motion of the chords of a block.

    Attributes:
        plane: The plane in which the spline began; another one ends it.
        columns: Axes of the spline group; the others move evenly from point to point. None for all.
    """

    rank = Rank.SPLINE

    def __init__(self, plane: Plane, join: Callable[[list[Move]], object] = len) -> None:
        self.plane, self._join = plane, join
        self.columns: frozenset[int] | None = None
        self._held: list[Move] = []
        self._events: list[tuple[int, PlacedEvent]] = []

    @property
    def active(self) -> bool:
        """Whether control points are held."""
        return bool(self._held)

    def move(self, move: Move) -> None:
        """Hold a control point; any other move ends the spline."""
        if move.kind is Kind.SPLINE and move.parameters:
            self._held.append(move)
        else:
            self._finish()
            self.after.move(move)

    def event(self, event: PlacedEvent) -> None:
        """An event keeps its place behind the control point of its block."""
        if self._held:
            self._events.append((len(self._held), event))
        else:
            self.after.event(event)

    def flush(self) -> None:
        """The spline ends with the last control point that is known."""
        self._finish()
        self.after.flush()

    def _finish(self) -> None:
        held, events = self._held, self._events
        self._held, self._events = [], []
        if not held:
            return
        done, before = 0, held[0].start
        for place, points in groupby(self._curve(held), key=itemgetter(0)):
            while events and events[0][0] <= min(done, place):
                self.after.event(events.pop(0)[1])
            chords = []
            for _, point in points:
                if any(abs(a - b) > NO_WAY for a, b in zip(before, point, strict=True)):
                    chords.append(replace(held[place], start=before, end=point, parameters=()))
                before = point
            if chords:
                self._join(chords)
            for chord in chords:
                self.after.move(chord)
            done = place + 1
        for _, event in events:
            self.after.event(event)

    def _curve(self, held: list[Move]) -> Iterator[tuple[int, list[float]]]:
        """Points of the curve behind its first one, each with the block that it counts to."""
        points = [held[0].start, *(move.end for move in held)]
        degree = min(int(held[0].parameters[1]), len(held))
        spans = len(points) - degree
        inner = [0.0]
        for move in held[:spans]:
            inner.append(inner[-1] + move.parameters[2])
        knots = [0.0] * degree + inner + [inner[-1]] * degree
        weights = [1.0, *(max(move.parameters[0], _LEAST_WEIGHT) for move in held)]
        poles = [tuple(point) for point in points]
        chords = list(nurbs_chords(degree + 1, knots, poles, weights, TOLERANCE_MM))[1:]
        for k, chord in enumerate(chords, 1):
            share = k / len(chords) * len(held)
            place = min(int(share - 1e-9), len(held) - 1)
            point = list(chord) if k < len(chords) else held[-1].end
            if self.columns is not None:
                along = held[place]
                for i, (a, b) in enumerate(zip(along.start, along.end, strict=True)):
                    if i not in self.columns:
                        point[i] = a + (b - a) * (share - place)
            yield place, point
