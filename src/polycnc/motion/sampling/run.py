"""A run: what the axes do from one standstill to the next, as a function of time.

A run is made of planned pieces. Its time law along the path is exact, and so is the average of the way over RAMP_S; the
average of an axis's position over BLEND_S, twice, is a sum over moments (`averaging.py`).
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.motion.averaging import HALF, PARTS, TENT, area_after, average, tent_acceleration, way_after
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord
from polycnc.motion.kernels.jerk import window_s

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

Numbers: TypeAlias = "NDArray[np.float64]"
#: Position, velocity and acceleration, or what stands for them along the path.
Moved: TypeAlias = "tuple[Numbers, Numbers, Numbers]"


class TimeLaw:
    """Way along a path in time: phases of constant acceleration, one behind the other from time 0 and way 0.

    Args:
        seconds: Of each phase, (m,).
        speed: At the start of each, (m,).
        rate: Acceleration of each, (m,).
    """

    def __init__(self, seconds: Numbers, speed: Numbers, rate: Numbers) -> None:
        keep = seconds > 0.0
        speed, rate, seconds = speed[keep], rate[keep], seconds[keep]
        self._start: Numbers = np.concatenate([[0.0], np.cumsum(seconds)])
        ways = way_after(seconds, speed, rate)
        self._way: Numbers = np.concatenate([[0.0], np.cumsum(ways)])
        sums = area_after(seconds, self._way[:-1], speed, rate)
        self._sum: Numbers = np.concatenate([[0.0], np.cumsum(sums)])
        # At rest behind the last phase.
        self._speed: Numbers = np.append(speed, 0.0)
        self._rate: Numbers = np.append(rate, 0.0)

    @property
    def seconds(self) -> float:
        """Duration."""
        return float(self._start[-1])

    def at(self, time: Numbers) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Integral of the way, way, speed, acceleration at times; at rest outside of the run."""
        inside = time > 0.0
        time = np.maximum(time, 0.0)
        k = np.searchsorted(self._start, time, "right") - 1
        dt, speed, rate = time - self._start[k], self._speed[k], self._rate[k]
        place = self._way[k]
        way = place + way_after(dt, speed, rate)
        total = self._sum[k] + area_after(dt, place, speed, rate)
        return total, way, np.where(inside, speed + rate * dt, 0.0), np.where(inside, rate, 0.0)

    def when(self, way: float) -> float:
        """The time at which a way has been gone."""
        k = min(max(int(np.searchsorted(self._way, way, "right")) - 1, 0), len(self._speed) - 1)
        left, speed, rate = max(way - float(self._way[k]), 0.0), float(self._speed[k]), float(self._rate[k])
        fast = sqrt(max(speed * speed + 2.0 * rate * left, 0.0)) + speed
        return float(self._start[k]) + (2.0 * left / fast if fast > 0.0 else 0.0)

    def lag(self, speed: float) -> float:
        """Seconds that getting up to a speed from rest costs against having had it."""
        k = int(np.argmax(self._speed >= speed * (1.0 - 1e-9))) if speed > 0.0 else 0
        return float(self._start[k]) - float(self._way[k]) / speed if k else 0.0

    def averaged(self, time: Numbers, window: float) -> Moved:
        """Way, speed and acceleration, averaged over a window around each time."""
        if window == 0.0:
            return self.at(time)[1:]
        total, way, speed, _ = self.at(time - 0.5 * window)
        later, way_later, speed_later, _ = self.at(time + 0.5 * window)
        return (
            average(total, later, window),
            average(way, way_later, window),
            average(speed, speed_later, window),
        )


class Run:
    """Positions of all axes over a run.

    Args:
        pieces: Records of planned pieces, (m, width), from rest to rest.
        n: Number of axes.
        limits: For a rapid of each axis by itself: velocity and acceleration of every axis.
    """

    def __init__(self, pieces: Numbers, n: int, limits: Sequence[tuple[float, float]] = ()) -> None:
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
        bent = np.isin(pieces[:, PieceRecord.FORM], (Form.BENT, Form.CURVED))[:, None]
        scale = (self._length / pieces[:, PieceRecord.MARGIN])[:, None]
        chord = self._end - self._start
        self._leave = np.where(bent, block[0] * scale, chord)
        self._arrive = np.where(bent, block[1] * scale, chord)
        self._alone: list[TimeLaw] = []
        if pieces[0, PieceRecord.FORM] == Form.TIMED:
            self._alone = [_trapezoid(abs(way), *limit) for way, limit in zip(chord[0], limits, strict=True)]
            self.law = max(self._alone, key=lambda law: law.seconds)
        else:
            self.law = TimeLaw(*_phases(pieces))

    @property
    def seconds(self) -> float:
        """Duration, until the averages have come to rest."""
        return self.law.seconds + window_s(self._ramp, self._blend)

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
        way = self.law.averaged(time - 0.5 * self._ramp - self._blend, self._ramp)[0]
        return self._index(way)

    def at(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration of the axes at times from the start of the run, each (k, n)."""
        time = np.asarray(time) - 0.5 * self._ramp - self._blend
        blend = self._blend
        if blend == 0.0:
            return self._on_path(time)
        steps = blend / PARTS
        places = np.stack([self._on_path(time + k * steps)[0] for k in range(-PARTS, PARTS + 1)])
        before, after = (np.tensordot(HALF, places[k : k + PARTS + 1], 1) for k in (0, PARTS))
        position = np.tensordot(TENT, places, 1)
        acceleration = tent_acceleration(places[0, ...], places[PARTS, ...], places[-1, ...], blend)
        return position, average(before, after, blend), acceleration

    def on_path(self, time: Numbers) -> Numbers:
        """Positions on the path itself, before they are averaged, at times from the start of the run, (k, n)."""
        return self._on_path(np.asarray(time) - 0.5 * self._ramp - self._blend)[0]

    def _index(self, way: Numbers) -> NDArray[np.intp]:
        return np.clip(np.searchsorted(self._ways, way, "right") - 1, 0, len(self._length) - 1)

    def _on_path(self, time: Numbers) -> Moved:
        """Position, velocity and acceleration on the path itself."""
        if self._alone:
            return self._each_alone(time)
        way, speed, rate = (value[:, None] for value in self.law.averaged(time, self._ramp))
        k = self._index(way[:, 0])
        f = np.clip((way - self._ways[k][:, None]) / self._length[k][:, None], 0.0, 1.0)
        start, chord, length = self._start[k], self._end[k] - self._start[k], self._length[k][:, None]
        # A cubic through both ends with their tangents (Hermite); on a line it is the line.
        leave, arrive = self._leave[k] - chord, self._arrive[k] - chord
        position = start + f * (chord + (1.0 - f) * ((1.0 - f) * leave - f * arrive))
        first = chord + (1.0 - f) * (1.0 - 3.0 * f) * leave + f * (3.0 * f - 2.0) * arrive
        second = (6.0 * f - 4.0) * leave + (6.0 * f - 2.0) * arrive
        return position, first * speed / length, second * (speed / length) ** 2 + first * rate / length

    def _each_alone(self, time: Numbers) -> Moved:
        """Every axis by its own time law."""
        columns: list[Moved] = []
        for i, law in enumerate(self._alone):
            start, end = float(self._start[0, i]), float(self._end[0, i])
            sense = 1.0 if end >= start else -1.0
            way, speed, rate = law.averaged(time, self._ramp)
            columns.append((start + sense * way, sense * speed, sense * rate))
        position, velocity, acceleration = (np.stack(values, axis=1) for values in zip(*columns, strict=True))
        return position, velocity, acceleration


def _phases(pieces: Numbers) -> Moved:
    """Three phases a piece: to its peak, along it, and down."""
    start, peak, end = (
        np.sqrt(pieces[:, field]) for field in (PieceRecord.SPEED2, PieceRecord.PEAK2, PieceRecord.END2)
    )
    rate = np.where(pieces[:, PieceRecord.RATE] > 0.0, pieces[:, PieceRecord.RATE], 1.0)
    up, down = (peak - start) / rate, (peak - end) / rate
    level = pieces[:, PieceRecord.LENGTH] - 0.5 * (up * (start + peak) + down * (end + peak))
    level = np.maximum(level, 0.0) / np.where(peak > 0.0, peak, 1.0)
    seconds = np.stack([up, level, down], axis=1).ravel()
    speed = np.stack([start, peak, peak], axis=1).ravel()
    rates = np.stack([rate, np.zeros_like(rate), -rate], axis=1).ravel()
    return np.where(seconds > 0.0, seconds, 0.0), speed, rates


def _trapezoid(way: float, top: float, pull: float) -> TimeLaw:
    """From rest to rest."""
    peak = min(top, sqrt(way * pull))
    ramp = peak / pull
    level = (way - peak * ramp) / peak if peak > 0.0 else 0.0
    return TimeLaw(
        np.array([ramp, max(level, 0.0), ramp]), np.array([0.0, peak, peak]), np.array([pull, 0.0, -pull])
    )
