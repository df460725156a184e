"""A run: what the axes do from one standstill to the next, as a function of time.

A run is made of planned pieces. Its law along the path is exact, and so are the averages: of the way over RAMP_S
(`law.py`), and of every axis's position over BLEND_S, twice (`averaging.py`). Where its pieces are JERKED, all of them
are: such a run has a law of limited jerk along a bent path, and needs no averages.
"""

from __future__ import annotations

from functools import cached_property
from math import sqrt

import numpy as np

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias, TypeVar
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord
from polycnc.motion.kernels.jerk import window_s
from polycnc.motion.kernels.speeds import ways_to_cap
from polycnc.motion.law import STEPS, Law, Phase
from polycnc.motion.sampling.tents import CURVE, LINE, under_tents

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from polycnc.motion.limits import AxisRapid

#: Of a piece whose cap on x rises: that cap, what it rises by in a mm, and the acceleration to it and from it.
RISING = PieceRecord.CAP2, PieceRecord.RISE, PieceRecord.PULL
_Kind = TypeVar("_Kind", bound=np.generic)
Numbers: TypeAlias = "NDArray[np.float64]"
#: Indices: of rows, axes, pieces.
Places: TypeAlias = "NDArray[np.int64]"
#: Position, velocity and acceleration, or what stands for them along the path.
Moved: TypeAlias = "tuple[Numbers, Numbers, Numbers]"


class Run:
    """Positions of all axes over a run, which may go on behind the pieces that are known so far.

    Args:
        pieces: Records of planned pieces, (m, width), from rest on; to rest where no more follow.
        n: Number of axes.
        limits: For a rapid of each axis by itself: how each runs.

    Attributes:
        rows: The row of every piece that is kept, (m,).
    """

    def __init__(self, pieces: Numbers, n: int, limits: Sequence[AxisRapid] = ()) -> None:
        self._ramp, self._blend, self._n = (
            float(pieces[0, PieceRecord.RAMP]),
            float(pieces[0, PieceRecord.BLEND]),
            n,
        )
        self._form = int(pieces[0, PieceRecord.FORM])
        self.rows = np.zeros(0, np.int64)
        self._start, self._end, self._leave, self._arrive = (np.zeros((0, n)) for _ in range(4))
        self._bends = (np.zeros((0, n)),) * 2 if self._form == Form.JERKED else None
        self._length, self._ways, self._is_bent = np.zeros(0), np.zeros(1), False
        self.law = Law()
        self._alone: list[Law] = []
        self.go_on(pieces)
        if self._form == Form.TIMED:
            ways = np.abs(self._end[0] - self._start[0]).tolist()
            self._alone = [_trapezoid(way, own.top, own.pull) for way, own in zip(ways, limits, strict=True)]
            self._ramps = [own.ramp for own in limits]
            ends = [law.end_time + own for law, own in zip(self._alone, self._ramps, strict=True)]
            self.law = self._alone[ends.index(max(ends))]

    def go_on(self, pieces: Numbers) -> None:
        """More pieces follow, (m, width)."""
        n = self._n
        block = [
            pieces[:, PieceRecord.VECTORS + k * n : PieceRecord.VECTORS + (k + 1) * n]
            for k in range(PLACES + 2)
        ]
        start, end = block[PLACES], block[PLACES + 1]
        length = np.maximum(pieces[:, PieceRecord.LENGTH], 1e-300)
        forms = pieces[:, PieceRecord.FORM]
        bent = ((forms == Form.BENT) | (forms == Form.CURVED) | (forms == Form.JERKED))[:, None]
        scale = (length / pieces[:, PieceRecord.MARGIN])[:, None]
        chord = leave = arrive = end - start
        if bent.any():
            self._is_bent = True
            leave, arrive = (np.where(bent, side * scale, chord) for side in block[:2])
        self.rows = _joined(self.rows, pieces[:, PieceRecord.ROW].astype(np.int64))
        ways = np.cumsum(_joined(self._ways[-1:], pieces[:, PieceRecord.LENGTH]))
        self._ways = _joined(self._ways[:-1], ways)
        self._length = _joined(self._length, length)
        self._start, self._end = _joined(self._start, start), _joined(self._end, end)
        self._leave, self._arrive = _joined(self._leave, leave), _joined(self._arrive, arrive)
        self.__dict__.pop("_edges", None)
        if self._bends is not None:
            bends = zip(self._bends, (block[2], block[3]), strict=True)
            first, last = (np.concatenate([known, more * scale * scale]) for known, more in bends)
            self._bends = first, last
            columns = PieceRecord.TIME, PieceRecord.LENGTH, PieceRecord.PULL, PieceRecord.JERK
            seconds, ways, pulls, jerks = (pieces[:, column] for column in columns)
            self.law.extend(seconds, ways, np.sqrt(pieces[:, PieceRecord.SPEED2]), pulls, jerks)
        elif self._form != Form.TIMED:
            self.law.extend(*_phases(pieces))

    def forget(self, before: float) -> None:
        """Nobody asks for a time before this one: what the averages do not reach from there on is dropped."""
        before -= self._ramp + 2.0 * self._blend
        if before <= 0.0:  # averages reach to where it still rests
            return
        kept = min(int(self._index(np.array([self.law.at(before)]))[0]), len(self.rows) - 1)
        self.law.forget(before)
        self.rows, self._length, self._ways = self.rows[kept:], self._length[kept:], self._ways[kept:]
        self._start, self._end = self._start[kept:], self._end[kept:]
        self._leave, self._arrive = self._leave[kept:], self._arrive[kept:]
        if self._bends is not None:
            self._bends = self._bends[0][kept:], self._bends[1][kept:]
        self.__dict__.pop("_edges", None)

    @property
    def can_go_on(self) -> bool:
        """Whether more pieces may follow: none does behind a rapid of each axis by itself."""
        return self._form != Form.TIMED

    @property
    def known_s(self) -> float:
        """Up to when the motion is known, whatever follows."""
        return self.law.end_time

    @property
    def seconds(self) -> float:
        """Duration, until the averages have come to rest."""
        return self.law.end_time + window_s(self._ramp, self._blend)

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

    def enters(self, rows: Places) -> Numbers:
        """When the axes come to the first piece of rows, (k,)."""
        return self.law.when_at(self._ways[np.searchsorted(self.rows, rows)]) + 0.5 * self._ramp + self._blend

    def share_at(self, time: float) -> float:
        """The share of the way that is done at a time from the start of the run, by the axis that comes last."""
        return min(max(self.law.mean(time - self._blend, self._ramp) / self.law.end, 0.0), 1.0)

    def time_of(self, share: float) -> float:
        """When a share of the way is done; the averages count by their middle."""
        return self.law.when(share * self.law.end) + 0.5 * self._ramp + self._blend

    def piece_at(self, time: Numbers) -> Places:
        """Index of the piece at times from the start of the run."""
        if len(self.rows) == 1:
            return np.zeros(len(time), np.int64)
        return self._index(self.law.mean(time - self._blend, self._ramp))

    def at(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration of the axes at times from the start of the run, each (k, n)."""
        middle, blend = np.asarray(time) - self._blend, self._blend
        if blend == 0.0:
            return self._on_path(middle)
        degree = CURVE if self._is_bent else LINE
        return under_tents(self._place, middle, blend, self._edges, degree)

    def on_path(self, time: Numbers) -> Numbers:
        """Positions on the path itself, before they are averaged, at times from the start of the run, (k, n)."""
        return self._place(np.asarray(time) - self._blend)

    @cached_property
    def _edges(self) -> Numbers:
        """When the axes' averaged way begins to follow another rule, or comes to another piece."""
        low = self.law.when_at(self._ways[1:-1])
        high = low + self._ramp
        for _ in range(STEPS if self._ramp else 0):
            middle = 0.5 * (low + high)
            before = self.law.mean(middle, self._ramp) < self._ways[1:-1]
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        laws = zip(self._alone, self._ramps, strict=True) if self._alone else ((self.law, self._ramp),)
        phases = [law.edges(-1.0, law.end_time + ramp + 1.0, ramp) for law, ramp in laws]
        return np.unique(np.concatenate([*phases, high]))

    def _index(self, way: Numbers) -> Places:
        return np.clip(np.searchsorted(self._ways, way, "right") - 1, 0, len(self._length) - 1)

    def _on_path(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration on the path itself."""
        if self._alone:
            return self._each_alone(time)
        way, speed, rate = self.law.motion(time, self._ramp)
        speed, rate = speed[:, None], rate[:, None]
        k, f, chord, leave, arrive, position = self._by_way(way)
        length = self._length[k][:, None]
        if self._bends is None:
            first = chord + (1.0 - f) * (1.0 - 3.0 * f) * leave + f * (3.0 * f - 2.0) * arrive
            second = (6.0 * f - 4.0) * leave + (6.0 * f - 2.0) * arrive
        else:  # of a short piece its ends would say little
            bend, change = self._bends[0][k], self._bends[1][k] - self._bends[0][k]
            first, second = self._leave[k] + f * (bend + 0.5 * f * change), bend + f * change
        return position, first * speed / length, second * (speed / length) ** 2 + first * rate / length

    def _place(self, time: Numbers) -> Numbers:
        """Positions on the path itself."""
        return self._each_alone(time)[0] if self._alone else self._by_way(self.law.mean(time, self._ramp))[-1]

    def _by_way(self, way: Numbers) -> tuple[Places, Numbers, Numbers, Numbers, Numbers, Numbers]:
        """The piece at ways, its part that is done, its chord and by what its tangents differ, and the position.

        A cubic through both ends with their tangents (Hermite); on a line it is the line.
        """
        k = self._index(way)
        f = np.clip((way - self._ways[k]) / self._length[k], 0.0, 1.0)[:, None]
        start, chord = self._start[k], self._end[k] - self._start[k]
        if not self._is_bent:
            still = np.zeros((1, self._n))
            return k, f, chord, still, still, start + f * chord
        leave, arrive = self._leave[k] - chord, self._arrive[k] - chord
        position = start + f * (chord + (1.0 - f) * ((1.0 - f) * leave - f * arrive))
        return k, f, chord, leave, arrive, position

    def _each_alone(self, time: Numbers) -> Moved:
        """Every axis by its own law."""
        position = np.repeat(self._start[:1], len(time), axis=0)
        velocity, acceleration = np.zeros_like(position), np.zeros_like(position)
        for i, (law, ramp) in enumerate(zip(self._alone, self._ramps, strict=True)):
            start, end = float(self._start[0, i]), float(self._end[0, i])
            if start != end:
                sense = 1.0 if end >= start else -1.0
                way, speed, rate = law.motion(time, ramp)
                position[:, i], velocity[:, i] = start + sense * way, sense * speed
                acceleration[:, i] = sense * rate
        return position, velocity, acceleration


def _joined(known: NDArray[_Kind], more: NDArray[_Kind]) -> NDArray[_Kind]:
    """What is known, and more behind it: most runs have but one part."""
    return np.concatenate([known, more]) if len(known) else more


def _phases(pieces: Numbers) -> Moved:
    """Three phases a piece, to its peak, along it and down: their seconds, ways and first speeds."""
    start2, peak2, end2 = (
        pieces[:, field] for field in (PieceRecord.SPEED2, PieceRecord.PEAK2, PieceRecord.END2)
    )
    length, rate = pieces[:, PieceRecord.LENGTH], pieces[:, PieceRecord.RATE]
    rate = np.where(rate > 0.0, rate, np.inf)
    up = np.minimum(0.5 * (peak2 - start2) / rate, length)
    down = np.minimum(0.5 * (peak2 - end2) / rate, length - up)
    squares = np.stack([start2, peak2, peak2, end2], axis=1)
    for k in np.flatnonzero(pieces[:, PieceRecord.RISE]).tolist():
        cap2, rise, pull = (float(pieces[k, at]) for at in RISING)
        ends = float(start2[k]), float(end2[k])
        up[k], down[k] = ways_to_cap(*ends, cap2, rise, pull, float(length[k]))
        squares[k, 1:3] = ends[0] + 2.0 * pull * up[k], ends[1] + 2.0 * pull * down[k]
    ways = np.stack([up, length - up - down, down], axis=1).ravel()
    speeds = np.sqrt(squares)
    sums = (speeds[:, :-1] + speeds[:, 1:]).ravel()
    return 2.0 * ways / np.where(sums > 0.0, sums, np.inf), ways, speeds[:, :-1].ravel()


def _trapezoid(way: float, top: float, pull: float) -> Law:
    """From rest to rest."""
    peak, law = min(top, sqrt(way * pull)), Law()
    if peak > 0.0:
        up = 0.5 * peak * peak / pull
        at_peak = max(way - 2.0 * up, 0.0)
        parts = (
            (2.0 * up / peak, up, 0.0),
            (2.0 * at_peak / (2.0 * peak), at_peak, peak),
            (2.0 * up / peak, up, peak),
        )
        phases = [
            Phase(seconds, part, speed, 2.0 * (part - speed * seconds) / (seconds * seconds))
            for seconds, part, speed in parts
            if seconds > 0.0
        ]
        law.run(0.0, 0.0, phases)
    return law
