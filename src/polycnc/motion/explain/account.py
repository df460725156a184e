"""Where cycle time goes: which limit held, over which share of the time and of the path.

A `TimeAccount` listens to a planner: it notes what bounds the rows that the planner lays out, and shares the pieces out
that become final. Kernels do both (`kernels/pieces.py`).
"""

from __future__ import annotations

from array import array
from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.explain.causes import Cause, Part
from polycnc.motion.explain.compiled import kernels
from polycnc.motion.explain.kernels.held import PACES, STEADY, Held, Ledger, Limit, Note, Tables
from polycnc.motion.kernels.columns import PLACES, ContextRecord, PieceRecord, new_state, piece_width
from polycnc.motion.pace import own_columns

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from polycnc.motion.kernels.columns import Limits, Rows, State
    from polycnc.motion.planner import Planner
    from polycnc.toolpath import Context, Toolpath
    from polycnc.toolpath.context import Pace

#: Real axes under a transformation are looked at in few places of a piece: in the fastest one by so much less.
REAL = 1.05
#: Notes are moved to the front when so many of them are over.
MANY = 16_384


class TimeAccount:
    """Counts why a toolpath takes its time, while it is planned.

    Args:
        toolpath: The toolpath.
        planner: Plans it; who listens to its pieces goes on listening.
        compiled: Use compiled kernels where they are there.
    """

    def __init__(self, toolpath: Toolpath, planner: Planner, *, compiled: bool = True) -> None:
        self._toolpath, self._planner = toolpath, planner
        self._n = len(toolpath.axes)
        self._kernels = kernels(compiled=compiled)
        self._state = new_state(self._n)
        self._ledger = Ledger()
        self._notes, self._first = array("d"), 0
        self._limits = array("d")
        self._numbers: dict[int, tuple[int, Limits]] = {}
        self._paces, self._paced = array("d"), 0
        self._contexts = array("d")
        self._parts = array("d", bytes(16 * Held.SIZE * (self._n + 1)))
        self._real = array("d")
        self._next = planner.on_pieces
        planner.on_rows, planner.on_pieces = self._rows, self._pieces

    @property
    def parts(self) -> dict[Cause, Part]:
        """Seconds and way by cause: together the time and the way of the motion."""
        return {cause: _total(parts.values()) for cause, parts in self.by_axis.items()}

    @property
    def by_axis(self) -> dict[Cause, dict[str, Part]]:
        """The same by the axis that it was; an empty name where it was none of them."""
        names = ("", *self._toolpath.axes)
        found = {
            cause: {name: self._part(number, i) for i, name in enumerate(names)}
            for number, cause in enumerate(Cause)
        }
        rest = found[Cause.STANDSTILL]  # behind the last piece the axes stand
        last = Part(self._ledger.pending_s, self._ledger.pending_mm)
        rest[""] = _total((rest[""], last))
        return found

    def _part(self, number: int, i: int) -> Part:
        at = 2 * (number * (self._n + 1) + i)
        return Part(self._parts[at], self._parts[at + 1])

    @property
    def hidden_s(self) -> Mapping[str, float]:
        """Seconds of spindle ramps and of a magazine that turns beside motion, by the field of `Times`."""
        return self._planner.hidden_s

    def _rows(
        self,
        rows: Rows,
        first: int,
        curves: array[float],
        number: int,
        contexts: array[float],
        limits: Limits,
        state: State,
        after: bool,
    ) -> None:
        """The planner lays rows out, from row `first` on."""
        self._add_paces()
        self._contexts = contexts
        self._state.position[:] = state.position
        self._state.run.stop = max(self._state.run.stop, state.run.stop)
        if not self._notes:
            self._first = number + first
        missing = (number + len(rows.kind) - self._first) * Note.SIZE - len(self._notes)
        self._notes.frombytes(bytes(8 * max(missing, 0)))
        self._kernels.note_rows(
            rows, first, curves, number, contexts, limits, self._state, self._number_of(limits), int(after),
            self._notes, self._first,
        )  # fmt: skip

    def _number_of(self, limits: Limits) -> int:
        """The number of limits in the table of `Limit` blocks."""
        known = self._numbers.get(id(limits))
        if known is None:
            known = self._numbers[id(limits)] = len(self._numbers), limits  # which keeps its id
            caps = self._planner.settings.feed_caps
            capped = (
                caps.get(name, inf) <= top
                for name, top in zip(self._toolpath.axes, limits.top_feed, strict=True)
            )
            blocks = {
                Limit.TOP_RAPID: limits.top_rapid, Limit.TOP_FEED: limits.top_feed,
                Limit.PULL: limits.acceleration, Limit.JERK: limits.jerk, Limit.ROTARY: limits.rotary,
                Limit.CAPPED: capped,
            }  # fmt: skip
            for block in sorted(blocks):
                self._limits.extend(blocks[block])
        return known[0]

    def _add_paces(self) -> None:
        """Take in what new contexts say of their axes."""
        if self._paced == len(self._toolpath.contexts):
            return
        rapid, feed = self._planner.top_speeds[1], self._planner.top_speeds[0]
        for context in self._toolpath.contexts[self._paced :]:
            self._paced += 1
            pace = context.pace
            bound = None if context.transformation is None else own_columns(context.transformation)
            blocks = [
                *_caps(pace, self._n, feed, bound, rapid=False),
                *_caps(pace, self._n, rapid, bound, rapid=True),
            ]
            self._paces.extend((context.transformation is not None, min(blocks) < inf, *blocks))

    def _pieces(self, records: array[float], count: int) -> None:
        """Pieces of the planner are final."""
        if len(self._real) < 3 * count:
            self._real = array("d", bytes(24 * count))
        tables = Tables(self._notes, self._contexts, self._limits, self._paces)
        # A turn at the pole goes from rest to rest, by degrees that are no way of the path.
        ways = self._stand() if self._planner.is_turning else None
        found = self._kernels.share_out(
            records, count, self._n, tables, self._first, self._ledger, self._parts, self._real
        )
        for k in range(found):
            self._look_at_real_axes(records, *self._real[3 * k : 3 * k + 3])
        if ways is not None:
            self._parts[1::2], self._ledger.pending_mm = ways, 0.0
        done = int(records[(count - 1) * piece_width(self._n) + PieceRecord.ROW]) - self._first
        if done >= MANY:
            del self._notes[: done * Note.SIZE]
            self._first += done
        if self._next is not None:
            self._next(records, count)

    def _stand(self) -> array[float]:
        """The axes rest behind the pieces so far: what they have braked for; the ways of all parts."""
        ledger, at = self._ledger, 2 * Held.STANDSTILL * (self._n + 1)
        self._parts[at] += ledger.pending_s
        self._parts[at + 1] += ledger.pending_mm
        ledger.pending_s = ledger.pending_mm = 0.0
        return self._parts[1::2]

    def _look_at_real_axes(self, records: array[float], piece: float, seconds: float, way: float) -> None:
        """Count what a transformation bounds: a velocity of a real axis, or an acceleration."""
        n, at = self._n, int(piece) * piece_width(self._n)
        row = int(records[at + PieceRecord.ROW]) - self._first
        number = int(self._notes[row * Note.SIZE + Note.RECORD]) // (ContextRecord.OFFSETS + n)
        context = self._toolpath.contexts[number]
        cause, axis = self._bound_of_real_axes(records, at, context)
        for held, i, sign in ((Held.REAL, -1, -1.0), (cause, axis, 1.0)):
            place = 2 * (held * (n + 1) + i + 1)
            self._parts[place] += sign * seconds
            self._parts[place + 1] += sign * way

    def _bound_of_real_axes(self, records: array[float], at: int, context: Context) -> tuple[int, int]:
        """The number of the cause, and the axis."""
        n, here = self._n, at + PieceRecord.VECTORS
        length, slot = records[at + PieceRecord.LENGTH], int(records[at + PieceRecord.SLOT])
        first, last = (records[here + (PLACES + end) * n : here + (PLACES + end + 1) * n] for end in (0, 1))
        mean = [(b - a) / length for a, b in zip(first, last, strict=True)]
        peak2, real = records[at + PieceRecord.PEAK2], self._planner.real_axes
        tops, pulls = (
            list(own) for own in (self._planner.top_speeds[slot % 2 == 0], real.limits(None).acceleration)
        )
        for i, own in real.axis_limits(context, rapid=slot % 2 == 0):
            tops[i], pulls[i] = min(tops[i], own.velocity or inf), own.acceleration or inf
        middle = [0.5 * (a + b) for a, b in zip(first, last, strict=True)]
        rates = [real.rates(place, mean, context) for place in (first, middle, last)]
        fastest = [
            REAL * peak2**0.5 * max(map(abs, own)) / top for *own, top in zip(*rates, tops, strict=True)
        ]
        if max(fastest) >= 1.0:
            return Held.AXES, fastest.index(max(fastest))
        if context.pace is not None and context.pace.following < inf:
            return Held.FOLLOWING, -1
        used = [abs(c - a) / pull for a, _, c, pull in zip(*rates, pulls, strict=True)]
        is_bent = max(used) * peak2 > STEADY * length
        return (Held.CURVATURE, used.index(max(used))) if is_bent else (Held.CORNERS, -1)


def _total(parts: Iterable[Part]) -> Part:
    seconds, ways = zip(*parts, strict=True)
    return Part(sum(seconds), sum(ways))


def _caps(
    pace: Pace | None, n: int, tops: Sequence[float], bound: frozenset[int] | None, *, rapid: bool
) -> list[float]:
    """PACES blocks of highest velocities of the columns (`motion/pace.py`).

    `bound` are the columns for which limits of single axes are; None for all.
    """
    if pace is None:
        return [inf] * (PACES * n)
    faster, none = pace.rapid if rapid else 1.0, (inf,) * n
    named = [inf if rapid else top for top in pace.top or none]
    lowered = [factor * faster * top for factor, top in zip(pace.velocity or none, tops, strict=True)]
    reach, left = [faster * top for top in pace.reach or none], list(pace.left or none)
    if bound is not None:
        lowered, reach = ([top if i in bound else inf for i, top in enumerate(of)] for of in (lowered, reach))
        left = list(none)
    return [*map(min, named, lowered), *reach, *left]
