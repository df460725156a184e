"""The stage of the path that leads cuts of short blocks beside their ends, so that their path is smoother.

A run are straight cuts, a block each and nothing else in it, under one context with a `Fairing`, none of them longer
than that says. Rows, and what displays tell of them, stay as they are programmed: how far an end is moved stands
in the row's curve parameters, for those who lead the axes. A run begins and ends where it is programmed.

In single block operation every block is to end where it is programmed, and nothing is held back.
"""

from __future__ import annotations

from array import array

from polycnc.channel.moves.path import Move, Rank, Run, Stage
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.compiled import fairing
from polycnc.toolpath.context import PROGRAMMED
from polycnc.toolpath.fairing import FADE, POINT, FairedRun
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE, Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import PlacedEvent
    from polycnc.toolpath.context import Context, Fairing

#: So many points are forgotten at once.
FORGOTTEN = 256
#: So many moves of a run are taken at once: room for its points grows with them.
AT_ONCE = 4096


class FairingStage(Stage):
    """Holds a run back as far as the ends around an end tell where it is led."""

    rank = Rank.FAIRING
    keeps_ends = True
    takes_runs = True

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self._of_block: Move | None = None
        self._mixed = -1  # the block that has had more than a cut, as the channel counts them
        self._rows: Run | None = None
        self._run = FairedRun()
        self._place, self._way, self._shift = array("d"), array("d"), array("d")
        self._fit, self._left = array("d"), array("d")
        self._free, self._least = array("d"), array("d")
        self._passed = 0  # points whose rows are passed on; the first is the start

    @property
    def active(self) -> bool:
        """Whether it holds something back."""
        return self._rows is not None or self._of_block is not None

    # ---- what comes ----------------------------------------------------------------------------------------

    def move(self, move: Move) -> None:
        """Keep the only cut of a block; anything else ends the run."""
        if self._of_block is None and self._mixed != self._channel.blocks and self._is_short_cut(move):
            self._of_block = move
            return
        self._end_block()
        self.after.move(move)

    def event(self, event: PlacedEvent) -> None:
        """A block with more than a cut is not of the run, and ends it."""
        self._end_block()
        self.after.event(event)

    def block(self) -> None:
        """The block has had nothing but its cut: it belongs to the run."""
        move, self._of_block, self._mixed = self._of_block, None, -1
        if move is not None:
            one = Run(
                array("B", (move.kind,)), array("I", (move.line,)), array("d", (move.feed,)),
                array("d", move.end), array("i", (NO_CURVE,)), move.start, move.program, move.context,
            )  # fmt: skip
            self._take(one)
        self.after.block()

    def run(self, run: Run) -> int:
        """Take many cuts at once."""
        context = self._channel.toolpath.contexts[run.context]
        if self._of_block is not None:
            return 0
        if _fairing(context) is None:
            self._end_run()
            return self.after.run(run)
        count = min(run.kinds.tobytes().find(Kind.RAPID) % (len(run.kinds) + 1), AT_ONCE)
        return self._take(run.part(count)) if count and not self._halts else 0

    def flush(self) -> None:
        """The run ends here."""
        self._end_block()
        self.after.flush()

    def _is_short_cut(self, move: Move) -> bool:
        """Whether a move may belong to a run, as far as it tells by itself."""
        context = self._channel.toolpath.contexts[move.context]
        is_line = move.kind is Kind.FEED and move.center is None and not move.parameters
        as_written = move.origin == PROGRAMMED and move.turning is None and not self._halts
        return is_line and as_written and _fairing(context) is not None

    @property
    def _halts(self) -> bool:
        """Whether every block is to end where it is programmed, because the operator halts there."""
        main_run = self._channel.main_run
        return self._channel.single_block if main_run is None else main_run.one_block

    # ---- the run -------------------------------------------------------------------------------------------

    def _end_block(self) -> None:
        """The running block has more than a cut; what it has begun with is passed on as it is."""
        self._end_run()
        move, self._of_block, self._mixed = self._of_block, None, self._channel.blocks
        if move is not None:
            self.after.move(move)

    def _take(self, cuts: Run) -> int:
        """Take cuts into the run, and pass on what is settled; gives how many."""
        toolpath, known = self._channel.toolpath, self._rows
        goes_on = known is not None and (known.program, known.context) == (cuts.program, cuts.context)
        if known is not None and not goes_on:
            self._end_run()
        context = toolpath.contexts[cuts.context]
        rule = _fairing(context)
        assert rule is not None
        if self._rows is None:
            self._begin(cuts, rule, context)
        taken = self._add(cuts, rule, context)
        self._pass_settled()
        if taken < len(cuts.kinds):  # this one is too long, or has no way
            self._end_run()
            taken += self._pass_run(cuts.part(1, taken))
        return taken

    def _begin(self, cuts: Run, rule: Fairing, context: Context) -> None:
        """A run begins where the first cut does."""
        self._run = FairedRun(points=1, reach=rule.reach, tolerance=rule.tolerance_mm)
        self._rows, self._passed = cuts.part(0), 1
        self._place[:] = array("d", _seen(cuts.start, self._channel.coordinates.geometry, context))
        for room, width in self._room():
            room[:] = array("d", bytes(8 * width))

    def _add(self, cuts: Run, rule: Fairing, context: Context) -> int:
        """Add cuts to the run, up to one that does not belong to it."""
        run, count, rows = self._run, len(cuts.kinds), self._rows
        assert rows is not None
        self._place.frombytes(bytes(8 * POINT * count))
        geometry = array("q", self._channel.coordinates.geometry)
        frame = array("d", [number for row in context.frame.m for number in row])
        taken = fairing().add_points(
            cuts.ends, len(cuts.start), geometry, frame, rule.longest_mm, run, self._place
        )
        del self._place[POINT * run.points :]
        for room, width in self._room():
            room.frombytes(bytes(8 * (width * run.points - len(room))))
        if taken:
            more = cuts.part(taken)
            self._rows = Run(
                rows.kinds + more.kinds, rows.lines + more.lines, rows.feeds + more.feeds, rows.ends + more.ends,
                rows.curves + more.curves, rows.start, rows.program, rows.context,
            )  # fmt: skip
        return taken

    def _room(self) -> tuple[tuple[array[float], int], ...]:
        """What is worked out for every point, and how many numbers that is."""
        return (
            (self._way, 1), (self._left, 1), (self._free, 1), (self._least, 1),
            (self._fit, POINT), (self._shift, POINT),
        )  # fmt: skip

    def _end_run(self) -> None:
        """No more cuts come: the last one ends as programmed."""
        if self._rows is not None:
            self._run.ended = 1
            self._pass_settled()
            self._rows = None

    def _pass_settled(self) -> None:
        """Pass on the rows whose ends are settled, and forget what no other end asks for."""
        rows, run = self._rows, self._run
        assert rows is not None
        settled = fairing().fair(
            run, self._place, self._way, self._fit, self._left, self._free, self._least, self._shift
        )
        count = settled - self._passed
        if count <= 0:
            return
        parameters, numbers = array("d", bytes(8 * CURVE_WIDTH * count)), array("i", bytes(4 * count))
        found = fairing().note_shifts(self._shift, self._passed, count, parameters, numbers)
        ready = rows.part(count)
        self._pass_run(
            Run(
                ready.kinds, ready.lines, ready.feeds, ready.ends, numbers, ready.start,
                ready.program, ready.context, parameters[: CURVE_WIDTH * found],
            )
        )  # fmt: skip
        self._rows, self._passed = rows.part(len(rows.kinds) - count, count), settled
        self._forget(settled - max(run.reach, 2 * FADE) - 1)

    def _forget(self, count: int) -> None:
        """Forget the points in front that no other end asks for, many at once."""
        if count < FORGOTTEN:
            return
        run = self._run
        del self._place[: POINT * count]
        for room, width in self._room():
            del room[: width * count]
        for name in ("points", "measured", "fitted", "widened", "lessened", "settled"):
            setattr(run, name, getattr(run, name) - count)
        run.before += count
        self._passed -= count

    def _pass_run(self, run: Run) -> int:
        """Pass cuts on; who executes them is told where each block ends."""
        main_run, count = self._channel.main_run, len(run.kinds)
        done = self.after.run(run) if main_run is None else 0
        for i in range(done, count):
            if main_run is not None:
                main_run.end_held_block()
            self.after.move(_move(run, i))
        return count


def _move(run: Run, i: int) -> Move:
    """A cut of a run."""
    axes, at = len(run.start), CURVE_WIDTH * run.curves[i]
    start = run.ends[(i - 1) * axes : i * axes].tolist() if i else run.start
    end = run.ends[i * axes : (i + 1) * axes].tolist()
    move = Move(Kind.FEED, start, end, run.feeds[i], run.program, run.lines[i], run.context)
    if run.parameters is not None and at >= 0:
        move.parameters = tuple(run.parameters[at : at + CURVE_WIDTH])
    return move


def _fairing(context: Context) -> Fairing | None:
    """What holds for cuts of a context; nothing where a transformation leads the axes, or a motion has several rows."""
    if context.transformation is not None or context.shown_by is not None or context.knot or context.chords:
        return None
    return context.fairing


def _seen(place: Sequence[float], geometry: Sequence[int], context: Context) -> tuple[float, float, float]:
    """Where X, Y and Z of a position are for the axes, but for the shift of the frame."""
    return context.frame.direct(*(place[axis] if axis >= 0 else 0.0 for axis in geometry))
