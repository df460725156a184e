"""Where cycle time goes: which limit held, over which share of the time and of the path.

A `TimeAccount` listens to a planner. A piece of the path is passed in three phases: up to its highest speed, along it,
and down. What bounds the highest speed is found by comparing it with what the program asks for and with what the axes
can do; what is lower is what corners, curves and their jerk allow, there or nearby (`kernels/hold.py`).

A part of a bent path under one constant jerk is passed in one phase, which counts as a whole. Below feed and axes it is
told apart what uses more of some axis's acceleration or jerk: the change of the speed, or the curve.
"""

from __future__ import annotations

from array import array
from math import hypot, inf, sqrt
from typing import TYPE_CHECKING

from polycnc.deferred.modules import is_installed
from polycnc.motion.explain.causes import EVEN, SAME, Cause, Part, asked_speed, is_uneven
from polycnc.motion.kernels.columns import PLACES, UNEVEN_FORMS, Form, PieceRecord, piece_width
from polycnc.motion.time_constants import Use
from polycnc.toolpath import Kind
from polycnc.toolpath.kinds import ARC_KINDS, CURVE_WIDTH, RAPID_KINDS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.motion.explain.columns import Columns
    from polycnc.motion.planner import Planner
    from polycnc.toolpath import Context, Toolpath
    from polycnc.toolpath.table import Chunk

#: Real axes under a transformation are looked at in differences, as the planner looks at them: these differ by less.
REAL = 1.0 + 1e-3
#: Part by which the speed of a law of limited jerk stays below that which bounds it; change of the speed along a bent
#: path, in parts of acceleration or jerk of an axis, that counts as none.
BELOW, STEADY = 0.01, 0.05
#: Part by which a squared speed may be off that of a joint.
EVEN_JOINT = 1e-5
#: Rows from which on they are worth to be looked at as columns.
MANY = 4096
#: Part of the way of a row that turns which a tip that stands may seem to go.
STANDS = 1e-6


class _Joint:
    """Where two pieces of cuts that are planned ahead meet, and what is held at its speed around it.

    Args:
        steps: Highest step of the velocity of every column, by parameters.
    """

    def __init__(self, steps: Sequence[float]) -> None:
        self._steps = steps
        self._end: list[float] | None = None
        self._top2 = inf
        self._noted, self._noted2 = Part(0.0, 0.0), 0.0
        self._is_new = False

    def rest(self) -> None:
        """The axes come to rest."""
        self._end, self._top2, self._noted = None, inf, Part(0.0, 0.0)

    def pass_(self, first: list[float], last: list[float], *, is_ahead: bool, rests: bool) -> None:
        """A piece with these directions at its ends comes next."""
        if rests or not is_ahead:
            self.rest()
        self._is_new = False
        if self._end is not None:
            turns = (abs(b - a) for a, b in zip(self._end, first, strict=True))
            tops = [step / turn for step, turn in zip(self._steps, turns, strict=True) if turn > SAME]
            if tops:
                self._top2, self._is_new = min(tops) ** 2, True
        self._end = last if is_ahead else None

    def bounds(self, peak2: float) -> bool:
        """Whether a squared speed is what the parameters allow at the last joint."""
        return abs(peak2 - self._top2) <= EVEN_JOINT * peak2

    def before(self) -> Part:
        """What was noted before the joint, where its speed is that of the joint."""
        found = self._noted if self._is_new and self.bounds(self._noted2) else Part(0.0, 0.0)
        if self._is_new:
            self._noted = Part(0.0, 0.0)
        return found

    def note(self, part: Part, peak2: float) -> None:
        """A piece that is slow for a corner, perhaps for the one behind it."""
        same = self._noted2 == peak2
        self._noted = Part(self._noted.seconds + part.seconds, self._noted.way + part.way) if same else part
        self._noted2 = peak2


def _normal(chunk: Chunk, row: int, context: Context) -> tuple[float, ...]:
    """The axis of a row's arc, machine coordinates; empty of other rows."""
    if chunk.kind[row] not in ARC_KINDS or chunk.curve[row] < 0:
        return ()
    at = chunk.curve[row] * CURVE_WIDTH + 3
    axis = chunk.curves[at : at + 3]
    size = hypot(*axis) or 1.0
    return tuple(sum(m * a for m, a in zip(line, axis, strict=True)) / size for line in context.frame.m)


class TimeAccount:
    """Counts why a toolpath takes its time, while it is planned.

    Args:
        toolpath: The toolpath.
        planner: Plans it; who listens to its pieces goes on listening.
        tops: Highest velocity of every column in cuts, and in rapids.
    """

    def __init__(
        self, toolpath: Toolpath, planner: Planner, tops: tuple[Sequence[float], Sequence[float]]
    ) -> None:
        self._toolpath, self._planner, self._tops = toolpath, planner, tops
        self._n = len(toolpath.axes)
        self._asked: dict[int, tuple[float, bool]] = {}
        self._after: set[int] = set()
        self._behind: dict[int, float] = {}
        self._ahead: dict[int, tuple[float, ...]] = {}
        self._degrees: dict[int, float] = {}
        self._limits = planner.cut_limits
        self._joint = _Joint(self._limits.step)
        self._contexts: dict[int, Context] = {}
        self._seconds = dict.fromkeys(Cause, 0.0)
        self._ways = dict.fromkeys(Cause, 0.0)
        self._columns: Columns | None = None
        self._next = planner.on_pieces
        planner.on_pieces = self._pieces

    @property
    def parts(self) -> dict[Cause, Part]:
        """Seconds and way by cause: together the time and the way of the motion."""
        return {cause: Part(self._seconds[cause], self._ways[cause]) for cause in Cause}

    @property
    def hidden_s(self) -> Mapping[str, float]:
        """Seconds of spindle ramps and of a magazine that turns beside motion, by the field of `Times`."""
        return self._planner.hidden_s

    def take(self, chunk: Chunk) -> None:
        """Note what the program asks for in a chunk's rows; comes before the planner takes the chunk."""
        if len(chunk) >= MANY and self._columns is None and is_installed("numpy"):
            from polycnc.motion.explain.columns import Columns

            self._columns = Columns(self._toolpath, self._planner, self._tops)
        for row in range(len(chunk)) if self._columns is None else self._columns.take(chunk):
            if chunk.kind[row] not in (Kind.EVENT, Kind.DWELL):
                self._note(chunk, row)

    def _note(self, chunk: Chunk, row: int) -> None:
        """Note what the program asks for in a row."""
        kind, number = chunk.kind[row], chunk.first + row
        context = self._toolpath.contexts[chunk.context[row]]
        self._asked[number] = self._asked_speed(chunk, row, context), kind == Kind.RAPID
        if self._planner.use_of(kind, context) is Use.AFTER:
            self._after.add(number)
        if kind not in RAPID_KINDS and self._planner.is_ahead(context):
            self._ahead[number] = _normal(chunk, row, context)
            self._behind[number] = self._planner.behind_s(context)
        if kind == Kind.RAPID or context.transformation is not None:
            self._contexts[number] = context
        if context.degree_mm != 1.0 and self._planner.rotary_weight(context) == 0.0:
            self._degrees[number] = context.degree_mm

    def _asked_speed(self, chunk: Chunk, row: int, context: Context) -> float:
        """Path speed that the program asks for, mm/s; 0 where that changes along the row, or F counts a part of it."""
        kind = chunk.kind[row]
        if kind in (Kind.THREAD, Kind.TAP) and chunk.curve[row] >= 0 and not is_uneven(kind, context):
            return chunk.curves[chunk.curve[row] * CURVE_WIDTH] * self._planner.rpm(context, 0.0) / 60.0
        return asked_speed(kind, chunk.feed[row], context, self._planner)

    def _pieces(self, records: array[float], count: int) -> None:
        width = piece_width(self._n)
        for piece in range(count) if self._columns is None else self._without_simple(records, count):
            self._piece(records, piece * width)
        done = int(records[(count - 1) * width + PieceRecord.ROW])
        for rows in (self._asked, self._contexts, self._ahead, self._behind, self._degrees):
            for row in [row for row in rows if row < done]:
                del rows[row]
        self._after = {row for row in self._after if row >= done}
        if self._columns is not None:
            self._columns.forget(done)
        if self._next is not None:
            self._next(records, count)

    def _without_simple(self, records: array[float], count: int) -> list[int]:
        """Count the simple pieces, and give the others."""
        import numpy as np

        assert self._columns is not None
        width = piece_width(self._n)
        pieces = np.frombuffer(records, count=count * width).reshape(count, width)
        simple = self._columns.known(pieces)
        for cause, part in self._columns.parts(pieces[simple]).items():
            self._count(cause, *part)
        return np.flatnonzero(~simple).tolist()

    def _piece(self, records: array[float], at: int) -> None:
        """Share the seconds and the way of a piece out."""
        pause = records[at + PieceRecord.PAUSE] - min(
            records[at + PieceRecord.EARLY], records[at + PieceRecord.PAUSE]
        )
        row = int(records[at + PieceRecord.ROW])
        behind = pause if row in self._after else min(pause, self._behind.get(row, 0.0))
        self._count(Cause.TIME_CONSTANT, behind, 0.0)
        self._count(Cause.JERK, pause - behind, 0.0)
        seconds, length = records[at + PieceRecord.TIME], records[at + PieceRecord.LENGTH]
        if records[at + PieceRecord.FORM] == Form.TIMED:
            self._joint.rest()
            level = min(self._level_of_rapid(records, at), seconds)
            share = level / seconds if seconds > 0.0 else 0.0
            self._count(Cause.AXES, level, share * length)
            self._count(Cause.ACCELERATION, seconds - level, (1.0 - share) * length)
            return
        if records[at + PieceRecord.FORM] == Form.JERKED:
            self._joint.rest()
            self._count(self._cause_under_jerk(records, at), seconds, length)
            return
        start2, peak2, end2, rate = (
            records[at + field]
            for field in (PieceRecord.SPEED2, PieceRecord.PEAK2, PieceRecord.END2, PieceRecord.RATE)
        )
        up = down = 0.0
        curved = records[at + PieceRecord.FORM] in UNEVEN_FORMS
        # Along a curve the speed that it allows changes from piece to piece.
        if rate > 0.0 and not (curved and min(start2, end2) >= (1.0 - EVEN) * peak2):
            up = min(0.5 * (peak2 - start2) / rate, length)
            down = min(0.5 * (peak2 - end2) / rate, length - up)
        level = length - up - down
        even = seconds if level == length else level / sqrt(peak2) if peak2 > 0.0 else 0.0
        cause, even = self._bound(records, at, peak2), min(even, seconds)
        self._joint.pass_(*self._directions(records, at), is_ahead=row in self._ahead, rests=start2 == 0.0)
        before = self._joint.before()
        for known, sign in ((Cause.CORNERS, -1.0), (Cause.CORNER_STEP, 1.0)):
            self._count(known, sign * before.seconds, sign * before.way)
        if cause is Cause.CORNERS and self._joint.bounds(peak2):
            cause = Cause.CORNER_STEP
        self._joint.note(Part(even, level) if cause is Cause.CORNERS else Part(0.0, 0.0), peak2)
        self._count(cause, even, level)
        self._count(Cause.ACCELERATION, max(seconds - even, 0.0), up + down)

    def _count(self, cause: Cause, seconds: float, way: float) -> None:
        self._seconds[cause] += seconds
        self._ways[cause] += way

    def _bound(self, records: array[float], at: int, peak2: float) -> Cause:
        """What bounds the highest speed of a piece."""
        asked = self._asked_of(records, at)
        speed = sqrt(peak2) * (1.0 + SAME)
        if asked < inf and speed >= asked:
            return Cause.FEED
        if self._is_at_top(records, at, peak2):
            return Cause.AXES
        return Cause.ARC_PULL if speed >= self._top_of_arc(records, at) else Cause.CORNERS

    def _asked_of(self, records: array[float], at: int) -> float:
        """The speed that the program asks for on a piece: of turns alone in degrees."""
        row = int(records[at + PieceRecord.ROW])
        asked, _ = self._asked.get(row, (0.0, False))
        return asked / self._degrees[row] if row in self._degrees and self._turns(records, at) else asked

    def _is_at_top(self, records: array[float], at: int, peak2: float) -> bool:
        """Whether an axis can go no faster."""
        _, rapid = self._asked.get(int(records[at + PieceRecord.ROW]), (0.0, False))
        speed, shares = sqrt(peak2) * (1.0 + SAME), self._shares(records, at)
        return any(speed * share >= top for share, top in zip(shares, self._tops[rapid], strict=True))

    def _cause_under_jerk(self, records: array[float], at: int) -> Cause:
        """What bounds a part of a bent path."""
        asked = self._asked_of(records, at)
        peak2 = records[at + PieceRecord.PEAK2] / (1.0 - BELOW) ** 2
        if asked > 0.0:
            cause = self._bound(records, at, peak2)
        elif self._is_at_top(records, at, peak2):
            cause = Cause.AXES
        else:  # what is asked for shows in the piece alone
            cause = Cause.FEED if peak2 >= records[at + PieceRecord.CAP2] else Cause.CORNERS
        if cause is not Cause.CORNERS:
            return cause
        along, across = self._used(records, at)
        return Cause.ACCELERATION if along > max(across, STEADY) else Cause.CORNERS

    def _used(self, records: array[float], at: int) -> tuple[float, float]:
        """Largest part of the acceleration or jerk of an axis that the change of the speed needs, and the curve.

        In the middle of a part of a bent path, by its time.
        """
        n, time, length = self._n, 0.5 * records[at + PieceRecord.TIME], records[at + PieceRecord.LENGTH]
        speed, jerk = sqrt(records[at + PieceRecord.SPEED2]), records[at + PieceRecord.JERK]
        pull = records[at + PieceRecord.PULL] + time * jerk
        speed += time * (pull - 0.5 * time * jerk)
        along = across = 0.0
        for i in range(n):
            first, last, bend, end = records[
                at + PieceRecord.VECTORS + i : at + PieceRecord.VECTORS + 4 * n : n
            ]
            turn, third = 0.5 * (first + last), (end - bend) / length
            bend = 0.5 * (bend + end)
            most, jolt = self._limits.acceleration[i], self._limits.jerk[i]
            along = max(along, abs(turn * pull) / most, abs(turn * jerk) / jolt)
            curve = speed * (3.0 * bend * pull + third * speed * speed)
            across = max(across, abs(bend) * speed * speed / most, abs(curve) / jolt)
        return along, across

    def _turns(self, records: array[float], at: int) -> bool:
        """Whether nothing but rotary axes moves on a piece."""
        ways = zip(*self._directions(records, at), self._limits.rotary, strict=False)
        return all(rotary or max(abs(first), abs(last)) < STANDS for first, last, rotary in ways)

    def _top_of_arc(self, records: array[float], at: int) -> float:
        """Speed that parameters allow on a piece of an arc that is planned ahead; infinite on others."""
        normal, n = self._ahead.get(int(records[at + PieceRecord.ROW]), ()), self._n
        columns = [(j, i) for j, i in enumerate(self._limits.geometry) if i >= 0]
        here = at + PieceRecord.VECTORS + 2 * n
        bend = hypot(*(records[here + i] for _, i in columns)) / records[at + PieceRecord.MARGIN]
        if not normal or bend == 0.0:
            return inf
        shares = ((i, sqrt(max(1.0 - normal[j] ** 2, 0.0))) for j, i in columns)
        pulls = (self._limits.arc[i] / share for i, share in shares if share > SAME)
        path = self._limits.path
        return max(sqrt(min(path.arc_pull, *pulls) / bend), path.arc_least)

    def _directions(self, records: array[float], at: int) -> tuple[list[float], list[float]]:
        """Derivatives of the columns by the path at the start and at the end of a piece."""
        n, here, length = self._n, at + PieceRecord.VECTORS, records[at + PieceRecord.LENGTH]
        if records[at + PieceRecord.FORM] == Form.STRAIGHT:
            place = here + PLACES * n
            way = [(records[place + n + i] - records[place + i]) / (length or 1.0) for i in range(n)]
            return way, way
        margin = records[at + PieceRecord.MARGIN]
        first, last = (
            [number / margin for number in records[here + k * n : here + (k + 1) * n]] for k in (0, 1)
        )
        return first, last

    def _shares(self, records: array[float], at: int) -> list[float]:
        """The greatest way of every axis by the way of the path, on a piece."""
        form, n = records[at + PieceRecord.FORM], self._n
        here, length = at + PieceRecord.VECTORS, records[at + PieceRecord.LENGTH]
        first, last = (records[here + (PLACES + end) * n : here + (PLACES + end + 1) * n] for end in (0, 1))
        mean = [abs(b - a) / length if length > 0.0 else 0.0 for a, b in zip(first, last, strict=True)]
        ways = [records[here : here + n], records[here + n : here + 2 * n]]
        context = self._contexts.get(int(records[at + PieceRecord.ROW]))
        if context is not None and context.transformation is not None and form != Form.LED and length > 0.0:
            if form == Form.STRAIGHT:
                ways = [array("d", ((b - a) / length for a, b in zip(first, last, strict=True)))] * 2
            rates = self._planner.real_axes.rates
            ends = zip((first, last), ways, strict=True)
            both = [rates(place, direction, context) for place, direction in ends]
            return [REAL * max(abs(a), abs(b)) for a, b in zip(*both, strict=True)]
        if form == Form.STRAIGHT:
            return mean
        return [max(share, abs(a), abs(b)) for share, a, b in zip(mean, *ways, strict=True)]

    def _level_of_rapid(self, records: array[float], at: int) -> float:
        """Seconds for which the slowest axis of a rapid, on which every axis runs alone, has its highest speed."""
        here, n = at + PieceRecord.VECTORS + PLACES * self._n, self._n
        ways = [abs(records[here + n + i] - records[here + i]) for i in range(n)]
        context = self._contexts[int(records[at + PieceRecord.ROW])]
        runs = self._planner.rapids(ways, context)
        times = [
            (
                way / own.top + own.top / own.pull + own.ramp if way else 0.0,
                way / own.top - own.top / own.pull,
            )
            for way, own in zip(ways, runs, strict=True)
        ]
        return max(max(times)[1], 0.0)
