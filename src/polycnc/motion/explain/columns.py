"""Which limit held for many pieces at once: what `account` finds piece by piece, by arrays.

Most pieces of long programs are lines and curves of cuts that no corner parameter bounds. All others are left to the
account: pieces under a transformation, of a law of limited jerk, rapids of each axis by itself.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.motion.explain.causes import EVEN, SAME, Cause, Part, asked_speed
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord
from polycnc.motion.time_constants import Use
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import ARC_KINDS, RAPID_KINDS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from polycnc.motion.planner import Planner
    from polycnc.toolpath import Context, Toolpath
    from polycnc.toolpath.table import Chunk

#: Rows in which nothing moves.
_STANDING = frozenset((Kind.EVENT, Kind.DWELL))


class RowNotes(NamedTuple):
    """What the program asks for in rows, (n,) each.

    Attributes:
        asked: Path speed, mm/s; infinite for as fast as it goes.
        rapid: Whether it is a rapid.
        behind_s: Seconds of a time constant behind the interpolation; infinite where all rest behind a row is that.
        known: Whether nothing else must be known of the row.
    """

    asked: NDArray[np.float64]
    rapid: NDArray[np.bool_]
    behind_s: NDArray[np.float64]
    known: NDArray[np.bool_]

    def with_more(self, more: RowNotes) -> RowNotes:
        """These rows and further ones behind them."""
        return RowNotes(
            np.concatenate([self.asked, more.asked]),
            np.concatenate([self.rapid, more.rapid]),
            np.concatenate([self.behind_s, more.behind_s]),
            np.concatenate([self.known, more.known]),
        )

    def without(self, first: int) -> RowNotes:
        """These rows without so many of the first."""
        return RowNotes(
            self.asked[first:].copy(),
            self.rapid[first:].copy(),
            self.behind_s[first:].copy(),
            self.known[first:].copy(),
        )


class Columns:
    """Rows and pieces of a toolpath, many at once.

    Args:
        toolpath: The toolpath.
        planner: Plans it.
        tops: Highest velocity of every column in cuts, and in rapids.
    """

    def __init__(
        self, toolpath: Toolpath, planner: Planner, tops: tuple[Sequence[float], Sequence[float]]
    ) -> None:
        self._toolpath, self._planner = toolpath, planner
        self._tops, self._n = np.array(tops), len(toolpath.axes)
        limits = planner.cut_limits
        self._joins = min(limits.step) < inf
        self._bends = min(*limits.arc, limits.path.arc_pull) < inf
        self._first = 0
        self._notes = RowNotes(np.zeros(0), np.zeros(0, bool), np.zeros(0), np.zeros(0, bool))

    def take(self, chunk: Chunk) -> list[int]:
        """Note what a chunk's rows ask for; gives the rows of which more must be known."""
        rows = chunk.numpy()
        keys, own = np.unique(rows.context.astype(np.int64) * 16 + rows.kind, return_inverse=True)
        notes = RowNotes(
            np.zeros(len(chunk)), np.zeros(len(chunk), bool), np.zeros(len(chunk)), np.zeros(len(chunk), bool)
        )
        for number, key in enumerate(keys.tolist()):
            kind, context = key % 16, self._toolpath.contexts[key // 16]
            if kind in _STANDING or not self._knows(kind, context):
                continue
            at = np.flatnonzero(own == number)
            notes.asked[at] = self._asked(kind, context, rows.feed[at])
            notes.rapid[at] = kind == Kind.RAPID
            notes.behind_s[at] = self._behind_s(kind, context)
            notes.known[at] = True
        end = self._first + len(self._notes.known)
        if end != chunk.first:  # chunks in front of it were short
            self._first = chunk.first
            self._notes = notes
        else:
            self._notes = self._notes.with_more(notes)
        left = ~notes.known & ~np.isin(rows.kind, tuple(_STANDING))
        return np.flatnonzero(left).tolist()

    def _knows(self, kind: int, context: Context) -> bool:
        """Whether a kind of rows under a context is simple."""
        is_ahead = kind not in RAPID_KINDS and self._planner.is_ahead(context)
        turns = context.degree_mm != 1.0 and self._planner.rotary_weight(context) == 0.0
        return not (
            context.transformation is not None
            or kind in (Kind.RAPID, Kind.REF, Kind.THREAD, Kind.TAP)
            or turns
            or (is_ahead and (self._joins or (self._bends and kind in ARC_KINDS)))
        )

    def _asked(self, kind: int, context: Context, feed: NDArray[np.float64]) -> NDArray[np.float64]:
        one = asked_speed(kind, 1.0, context, self._planner)
        if one in (0.0, inf):
            return np.full(len(feed), one)
        speeds: NDArray[np.float64] = np.where(feed * one > 0.0, feed * one, inf)
        return speeds

    def _behind_s(self, kind: int, context: Context) -> float:
        if self._planner.use_of(kind, context) is Use.AFTER:
            return inf
        return self._planner.behind_s(context) if self._planner.is_ahead(context) else 0.0

    def forget(self, before: int) -> None:
        """No piece comes of a row before this one."""
        if (done := before - self._first) > 0:
            self._notes = self._notes.without(done)
            self._first = before

    def known(self, pieces: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which pieces, (m, width), are simple."""
        rows = pieces[:, PieceRecord.ROW].astype(np.int64) - self._first
        form, there = pieces[:, PieceRecord.FORM], (rows >= 0) & (rows < len(self._notes.known))
        simple = there & np.isin(form, (Form.STRAIGHT, Form.BENT, Form.CURVED))
        simple[simple] = self._notes.known[rows[simple]]
        return simple

    def parts(self, pieces: NDArray[np.float64]) -> dict[Cause, Part]:
        """What held on simple pieces, (m, width)."""
        rows = pieces[:, PieceRecord.ROW].astype(np.int64) - self._first
        pause = pieces[:, PieceRecord.PAUSE]
        pause = pause - np.minimum(pieces[:, PieceRecord.EARLY], pause)
        behind = np.minimum(pause, self._notes.behind_s[rows])
        up, down, even = _phases(pieces)
        seconds, length = pieces[:, PieceRecord.TIME], pieces[:, PieceRecord.LENGTH]
        level, speed = length - up - down, np.sqrt(pieces[:, PieceRecord.PEAK2]) * (1.0 + SAME)
        asked = self._notes.asked[rows]
        by_feed = (asked < inf) & (speed >= asked)
        tops = self._tops[self._notes.rapid[rows].astype(np.int64)]
        by_axes = ~by_feed & (speed[:, None] * self._shares(pieces) >= tops).any(axis=1)
        held = {Cause.FEED: by_feed, Cause.AXES: by_axes, Cause.CORNERS: ~(by_feed | by_axes)}
        parts = {cause: _sum(even[on], level[on]) for cause, on in held.items()}
        parts[Cause.ACCELERATION] = _sum(np.maximum(seconds - even, 0.0), up + down)
        parts[Cause.TIME_CONSTANT] = _sum(behind, np.zeros(0))
        parts[Cause.JERK] = _sum(pause - behind, np.zeros(0))
        return parts

    def _shares(self, pieces: NDArray[np.float64]) -> NDArray[np.float64]:
        """The greatest way of every axis by the way of the path, (m, n)."""
        n, at = self._n, PieceRecord.VECTORS
        length = pieces[:, PieceRecord.LENGTH][:, None]
        first, last = (pieces[:, at + k * n : at + (k + 1) * n] for k in (PLACES, PLACES + 1))
        shares: NDArray[np.float64] = np.abs(last - first) / np.where(length > 0.0, length, inf)
        bent = np.flatnonzero(pieces[:, PieceRecord.FORM] != Form.STRAIGHT)
        if len(bent):
            ways = np.abs(pieces[bent, at : at + 2 * n]).reshape(-1, 2, n).max(axis=1)
            shares[bent] = np.maximum(shares[bent], ways)
        return shares


def _phases(
    pieces: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Way up to the highest speed, way down, and seconds at it."""
    start2, peak2, end2, rate, length, seconds = (
        pieces[:, column]
        for column in (
            PieceRecord.SPEED2, PieceRecord.PEAK2, PieceRecord.END2, PieceRecord.RATE, PieceRecord.LENGTH,
            PieceRecord.TIME,
        )
    )  # fmt: skip
    # Along a curve the speed that it allows changes from piece to piece.
    steady = np.minimum(start2, end2) >= (1.0 - EVEN) * peak2
    changes = (rate > 0.0) & ~((pieces[:, PieceRecord.FORM] == Form.CURVED) & steady)
    pull = np.where(changes, rate, inf)
    up = np.minimum(0.5 * (peak2 - start2) / pull, length)
    down = np.minimum(0.5 * (peak2 - end2) / pull, length - up)
    level = length - up - down
    fast = np.sqrt(np.where(peak2 > 0.0, peak2, inf))
    even = np.where(level == length, seconds, level / fast)
    return up, down, np.minimum(even, seconds)


def _sum(seconds: NDArray[np.float64], way: NDArray[np.float64]) -> Part:
    return Part(float(seconds.sum()), float(way.sum()))
