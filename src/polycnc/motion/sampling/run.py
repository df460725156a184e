"""A run: what the axes do from one standstill to the next, as a function of time.

A run is made of planned pieces. Its law along the path is exact, and so are the averages: of the way over RAMP_S
(`law.py`), and of every axis's position over BLEND_S, twice (`averaging.py`). Where its pieces are JERKED, all of them
are: such a run has a law of limited jerk along a bent path, and needs no averages.
"""

from __future__ import annotations

from functools import cached_property
from math import sqrt
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.motion.averaging import tent_acceleration, under_tents
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord
from polycnc.motion.kernels.jerk import window_s
from polycnc.motion.law import STEPS, Law

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from polycnc.motion.limits import AxisRapid

Numbers: TypeAlias = "NDArray[np.float64]"
#: Position, velocity and acceleration, or what stands for them along the path.
Moved: TypeAlias = "tuple[Numbers, Numbers, Numbers]"


class Run:
    """Positions of all axes over a run.

    Args:
        pieces: Records of planned pieces, (m, width), from rest to rest.
        n: Number of axes.
        limits: For a rapid of each axis by itself: how each runs.
    """

    def __init__(self, pieces: Numbers, n: int, limits: Sequence[AxisRapid] = ()) -> None:
        self._ramp, self._blend, self._n = (
            float(pieces[0, PieceRecord.RAMP]),
            float(pieces[0, PieceRecord.BLEND]),
            n,
        )
        self.rows = pieces[:, PieceRecord.ROW].astype(np.int64)
        block = [
            pieces[:, PieceRecord.VECTORS + k * n : PieceRecord.VECTORS + (k + 1) * n]
            for k in range(PLACES + 2)
        ]
        self._start, self._end = block[PLACES], block[PLACES + 1]
        self._length = np.maximum(pieces[:, PieceRecord.LENGTH], 1e-300)
        self._ways: Numbers = np.concatenate([[0.0], np.cumsum(pieces[:, PieceRecord.LENGTH])])
        bent = np.isin(pieces[:, PieceRecord.FORM], (Form.BENT, Form.CURVED, Form.JERKED))[:, None]
        scale = (self._length / pieces[:, PieceRecord.MARGIN])[:, None]
        chord = self._end - self._start
        self._leave = np.where(bent, block[0] * scale, chord)
        self._arrive = np.where(bent, block[1] * scale, chord)
        self._alone: list[Law] = []
        self._bends: tuple[Numbers, Numbers] | None = None
        if pieces[0, PieceRecord.FORM] == Form.TIMED:
            ways = np.abs(chord[0]).tolist()
            self._alone = [_trapezoid(way, own.top, own.pull) for way, own in zip(ways, limits, strict=True)]
            self._ramps = [own.ramp for own in limits]
            ends = [law.seconds + own for law, own in zip(self._alone, self._ramps, strict=True)]
            self.law = self._alone[ends.index(max(ends))]
        elif pieces[0, PieceRecord.FORM] == Form.JERKED:
            self._bends = block[2] * scale * scale, block[3] * scale * scale
            columns = PieceRecord.TIME, PieceRecord.LENGTH, PieceRecord.PULL, PieceRecord.JERK
            seconds, ways, pulls, jerks = (pieces[:, column] for column in columns)
            self.law = Law.of(seconds, ways, np.sqrt(pieces[:, PieceRecord.SPEED2]), pulls, jerks)
        else:
            self.law = Law.of(*_phases(pieces))

    @property
    def seconds(self) -> float:
        """Duration, until the averages have come to rest."""
        return self.law.seconds + window_s(self._ramp, self._blend)

    @property
    def start(self) -> Numbers:
        """Position of the axes at the start, (n,)."""
        return self._start[0, :]

    @property
    def end(self) -> Numbers:
        """Position of the axes at the end, (n,)."""
        return self._end[-1, :]

    @property
    def main_axis(self) -> int:
        """The axis with the longest way: the one along which a lead counts."""
        return int(np.argmax(np.abs(self._end[-1, :] - self._start[0, :])))

    def enters(self, row: int) -> float:
        """When the axes come to the first piece of a row."""
        way = float(self._ways[np.searchsorted(self.rows, row)])
        return self.law.when(way) + 0.5 * self._ramp + self._blend

    def share_at(self, time: float) -> float:
        """The share of the way that is done at a time from the start of the run, by the axis that comes last."""
        return min(max(self.law.mean(time - self._blend, self._ramp) / self.law.end, 0.0), 1.0)

    def time_of(self, share: float) -> float:
        """When a share of the way is done; the averages count by their middle."""
        return self.law.when(share * self.law.end) + 0.5 * self._ramp + self._blend

    def lag(self, axis_speed: float) -> float:
        """Seconds by which the axes are behind one that has had its speed from the start of the run.

        Args:
            axis_speed: Speed of the main axis that is reached, mm/s.
        """
        axis = self.main_axis
        share = abs(float(self._end[0, axis]) - float(self._start[0, axis])) / float(self._length[0])
        return 0.5 * self._ramp + self._blend + self.law.lag(axis_speed / max(share, 1e-12))

    def piece_at(self, time: Numbers) -> NDArray[np.intp]:
        """Index of the piece at times from the start of the run."""
        return self._index(self.law.mean(time - self._blend, self._ramp))

    def at(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration of the axes at times from the start of the run, each (k, n)."""
        middle, blend = np.asarray(time) - self._blend, self._blend
        if blend == 0.0:
            return self._on_path(middle)
        position, velocity = under_tents(
            lambda moments: self._on_path(moments)[0], middle, blend, self._edges
        )
        first, here, last = (self._on_path(middle + late)[0] for late in (-blend, 0.0, blend))
        return position, velocity, tent_acceleration(first, here, last, blend)

    def on_path(self, time: Numbers) -> Numbers:
        """Positions on the path itself, before they are averaged, at times from the start of the run, (k, n)."""
        return self._on_path(np.asarray(time) - self._blend)[0]

    @cached_property
    def _edges(self) -> Numbers:
        """When the axes' averaged way begins to follow another rule, or comes to another piece."""
        low = np.array([self.law.when(way) for way in self._ways[1:-1].tolist()])
        high = low + self._ramp
        for _ in range(STEPS if self._ramp else 0):
            middle = 0.5 * (low + high)
            before = self.law.mean(middle, self._ramp) < self._ways[1:-1]
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        phases = self.law.edges(-1.0, self.law.seconds + self._ramp + 1.0, self._ramp)
        return np.unique(np.concatenate([np.array(phases), high]))

    def _index(self, way: Numbers) -> NDArray[np.intp]:
        return np.clip(np.searchsorted(self._ways, way, "right") - 1, 0, len(self._length) - 1)

    def _on_path(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration on the path itself."""
        if self._alone:
            return self._each_alone(time)
        way, speed, rate = (value[:, None] for value in _averaged(self.law, time, self._ramp))
        k = self._index(way[:, 0])
        f = np.clip((way - self._ways[k][:, None]) / self._length[k][:, None], 0.0, 1.0)
        start, chord, length = self._start[k], self._end[k] - self._start[k], self._length[k][:, None]
        # A cubic through both ends with their tangents (Hermite); on a line it is the line.
        leave, arrive = self._leave[k] - chord, self._arrive[k] - chord
        position = start + f * (chord + (1.0 - f) * ((1.0 - f) * leave - f * arrive))
        if self._bends is None:
            first = chord + (1.0 - f) * (1.0 - 3.0 * f) * leave + f * (3.0 * f - 2.0) * arrive
            second = (6.0 * f - 4.0) * leave + (6.0 * f - 2.0) * arrive
        else:  # of a short piece its ends would say little
            bend, change = self._bends[0][k], self._bends[1][k] - self._bends[0][k]
            first, second = self._leave[k] + f * (bend + 0.5 * f * change), bend + f * change
        return position, first * speed / length, second * (speed / length) ** 2 + first * rate / length

    def _each_alone(self, time: Numbers) -> Moved:
        """Every axis by its own law."""
        columns: list[Moved] = []
        for i, (law, ramp) in enumerate(zip(self._alone, self._ramps, strict=True)):
            start, end = float(self._start[0, i]), float(self._end[0, i])
            sense = 1.0 if end >= start else -1.0
            way, speed, rate = _averaged(law, time, ramp)
            columns.append((start + sense * way, sense * speed, sense * rate))
        position, velocity, acceleration = (np.stack(values, axis=1) for values in zip(*columns, strict=True))
        return position, velocity, acceleration


def _averaged(law: Law, time: Numbers, ramp: float) -> Moved:
    """Way, speed and acceleration along the path, averaged over the time `ramp` before each of these."""
    return law.mean(time, ramp), law.mean_speed(time, ramp), law.mean_pull(time, ramp)


def _phases(pieces: Numbers) -> Moved:
    """Three phases a piece, to its peak, along it and down: their seconds, ways and first speeds."""
    start2, peak2, end2 = (
        pieces[:, field] for field in (PieceRecord.SPEED2, PieceRecord.PEAK2, PieceRecord.END2)
    )
    length, rate = pieces[:, PieceRecord.LENGTH], pieces[:, PieceRecord.RATE]
    rate = np.where(rate > 0.0, rate, np.inf)
    up = np.minimum(0.5 * (peak2 - start2) / rate, length)
    down = np.minimum(0.5 * (peak2 - end2) / rate, length - up)
    ways = np.stack([up, length - up - down, down], axis=1).ravel()
    speeds = np.sqrt(np.stack([start2, peak2, peak2, end2], axis=1))
    sums = (speeds[:, :-1] + speeds[:, 1:]).ravel()
    return 2.0 * ways / np.where(sums > 0.0, sums, np.inf), ways, speeds[:, :-1].ravel()


def _trapezoid(way: float, top: float, pull: float) -> Law:
    """From rest to rest."""
    peak = min(top, sqrt(way * pull))
    up = 0.5 * peak * peak / pull
    ways, speeds = np.array([up, max(way - 2.0 * up, 0.0), up]), np.array([0.0, peak, peak])
    sums = np.array([peak, 2.0 * peak, peak])
    return Law.of(2.0 * ways / np.where(sums > 0.0, sums, np.inf), ways, speeds)
