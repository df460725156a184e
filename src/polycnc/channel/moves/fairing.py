"""The stage of the path that leads cuts of short blocks beside their ends, so that their path is smoother.

A run are straight cuts, a block each and nothing else in it, under one context with a `Fairing`, none of them longer
than that says. Rows, and what displays tell of them, stay as they are programmed: how far an end is moved stands
in the row's curve parameters, for those who lead the axes. A run begins and ends where it is programmed.

Limits of travel, working areas and forbidden zones are looked at in front of this stage, for the moves as they are
programmed. No end is moved beyond a limit that these keep to: walls bound how far it may go, and near a zone it stays.
Under a transformation ends are points of its path, such as the tip and its rotary axes; a cut stays as it is, at both
ends, where the axes behind it could come to a limit (`beside`).

In single block operation every block is to end where it is programmed, and nothing is held back.
"""

from __future__ import annotations

from array import array
from math import inf

from polycnc.channel.moves.path import Move, Rank, Run, Stage
from polycnc.channel.moves.travel import certainly_within, walls_of
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.compiled import fairing
from polycnc.toolpath.context import PROGRAMMED
from polycnc.toolpath.fairing import BOUNDS, FADE, PART, POINT, SPACE, TURNS, WIDEST, FairedRun, Points
from polycnc.toolpath.kinds import CURVE_WIDTH, NO_CURVE, Kind

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.moves.path import PlacedEvent
    from polycnc.channel.moves.travel import Wall
    from polycnc.geometry.frames import Matrix
    from polycnc.toolpath.context import Context, Fairing
    from polycnc.transformation.contract import Transformation

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
        self._arrays = {name: array("d") for name in Points._fields}
        self._points = Points(**self._arrays)
        self._columns = _columns(channel)
        self._terms: tuple[object, ...] = ()
        self._walls = array("d")
        #: The last transformation, and whether ends may be moved under it.
        self._made: tuple[Transformation | None, bool] = None, False
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
        if self._rule(context) is None:
            self._end_run()
            return self.after.run(run)
        if context.transformation is not None and (
            self._has_limits() or context.transformation.pole is not None
        ):
            return 0  # the axes behind every cut are looked at
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
        rule = self._rule(context)
        return is_line and as_written and rule is not None and not self._stays(move, context, rule)

    def _stays(self, move: Move, context: Context, rule: Fairing) -> bool:
        """Whether axes that a transformation leads could come to something forbidden, or turn by much near a pole."""
        if context.transformation is None:
            return False
        channel, made, turns = self._channel, context.transformation, dict(rule.turns)
        if made.pole is None and not self._has_limits():
            return False
        by = [PART * turns.get(column, 0.0) for column in range(len(channel.axes))]
        for column in made.geometry:
            if column >= 0:
                by[column] = PART * rule.tolerance_mm
        if certainly_within(channel, move, by, self._comes_near):
            return False
        from polycnc.channel.moves.beside import around, is_within  # where axes come near to something

        near = around(channel, move, made, by)
        if near is None or not self._has_limits():
            return near is None
        ways = near.chords() if self._watches() else []
        return not is_within(channel, near) or any(self._comes_near(*way) for way in ways)

    def _has_limits(self) -> bool:
        """Whether the axes could come to anything that is forbidden."""
        return bool(self._channel.limits) or self._watches()

    def _rule(self, context: Context) -> Fairing | None:
        """What holds for cuts of a context; nothing where a motion has several rows, or axes follow each other."""
        if context.fairing is None or context.shown_by is not None or context.knot or context.chords:
            return None
        made = context.transformation
        if made is not None and made is not self._made[0]:
            from polycnc.channel.moves.beside import is_led_evenly  # where a transformation acts

            self._made = made, is_led_evenly(made)
        return context.fairing if made is None or self._made[1] else None

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
        context = toolpath.contexts[cuts.context]
        rule, terms = self._rule(context), self._terms_of(context)
        assert rule is not None
        if known is not None and (
            (known.program, known.context) != (cuts.program, cuts.context) or self._terms != terms
        ):
            self._end_run()
        if self._rows is None:
            self._terms = terms
            self._begin(cuts, rule, context)
        taken = self._add(cuts, rule, context)
        self._pass_settled()
        if taken < len(cuts.kinds):  # this one is too long, or has no way
            self._end_run()
            taken += self._pass_run(cuts.part(1, taken))
        return taken

    def _terms_of(self, context: Context) -> tuple[object, ...]:
        """What holds for a run beside its context, such as limits: it ends where that changes."""
        channel, boundary = self._channel, self._channel.boundary
        return channel.limits, () if boundary is None else tuple(boundary.walls(channel, context))

    def _begin(self, cuts: Run, rule: Fairing, context: Context) -> None:
        """A run begins where the first cut does."""
        turns = dict(rule.turns)
        bounds = (rule.tolerance_mm, *(turns.get(column, 0.0) for column in self._columns[SPACE:]))
        self._run = FairedRun(points=1, reach=min(rule.reach, WIDEST), tolerance=bounds)
        self._run.turns = max((k for k in range(BOUNDS) if bounds[k] > 0.0), default=0)
        self._rows, self._passed = cuts.part(0), 1
        inward = context.frame.inverse().m
        walls = walls_of(self._channel, context) if context.transformation is None else []
        self._walls = array("d", [each for wall in walls for each in self._seen(wall, inward)])
        at = [cuts.start[column] if column >= 0 else 0.0 for column in self._columns]
        for room, width in self._room():
            room[:] = array("d", bytes(8 * width))
        self._points.place[:] = array("d", [*context.frame.direct(*at[:SPACE]), *at[SPACE:]])
        self._points.room[0] = inf

    def _seen(self, wall: Wall, inward: Matrix) -> list[float]:
        """A wall as points of the run are counted: X, Y and Z as the axes see them, but for the frame's shift."""
        counts = [wall.counts[column] if column >= 0 else 0.0 for column in self._columns]
        space = [sum(counts[k] * inward[k][j] for k in range(SPACE)) for j in range(SPACE)]
        return [*space, *counts[SPACE:], wall.bound]

    def _add(self, cuts: Run, rule: Fairing, context: Context) -> int:
        """Add cuts to the run, up to one that does not belong to it."""
        run, count, rows, points = self._run, len(cuts.kinds), self._rows, self._points
        assert rows is not None
        first = run.points
        self._arrays["place"].frombytes(bytes(8 * POINT * count))
        frame = array("d", [number for row in context.frame.m for number in row])
        taken = fairing().add_points(
            cuts.ends, len(cuts.start), array("q", self._columns), frame, rule.longest_mm, run, points.place
        )
        del points.place[POINT * run.points :]
        for room, width in self._room():
            room.frombytes(bytes(8 * (width * run.points - len(room))))
        points.room[first:] = array("d", (inf,)) * taken
        if taken:
            more = cuts.part(taken)
            self._keep_clear(more, first, context)
            self._rows = Run(
                rows.kinds + more.kinds, rows.lines + more.lines, rows.feeds + more.feeds, rows.ends + more.ends,
                rows.curves + more.curves, rows.start, rows.program, rows.context,
            )  # fmt: skip
        return taken

    def _keep_clear(self, cuts: Run, first: int, context: Context) -> None:
        """Ends of lines that come near something forbidden have no room: the first line ends at point `first`."""
        if not self._watches() or context.transformation is not None:
            return
        channel, room, distance = self._channel, self._points.room, PART * self._run.tolerance[0]
        axes, to_machine = len(cuts.start), channel.toolpath.to_machine
        start = to_machine(cuts.start, context, channel.coordinates.geometry)
        for i in range(len(cuts.kinds)):
            row = cuts.ends[i * axes : (i + 1) * axes].tolist()
            end = to_machine(row, context, channel.coordinates.geometry)
            if self._comes_near(start, end, distance):
                room[first + i - 1] = room[first + i] = 0.0
            start = end

    def _watches(self) -> bool:
        """Whether anything is forbidden beside walls."""
        return self._channel.boundary is not None

    def _comes_near(self, start: list[float], end: list[float], distance: float) -> bool:
        """Whether a way of machine positions comes nearer than a distance to what is forbidden beside walls."""
        boundary = self._channel.boundary
        return boundary is not None and boundary.comes_near(self._channel, start, end, distance)

    def _room(self) -> tuple[tuple[array[float], int], ...]:
        """What is noted of every point, and how many numbers that is."""
        widths = {"place": POINT, "fit": POINT, "shift": POINT, "left": BOUNDS}
        return tuple((room, widths.get(name, 1)) for name, room in self._arrays.items())

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
        settled = fairing().fair(run, self._points, self._walls)
        count = settled - self._passed
        if count <= 0:
            return
        parameters, numbers = array("d", bytes(8 * CURVE_WIDTH * count)), array("i", bytes(4 * count))
        found = fairing().note_shifts(run, self._points.shift, self._passed, count, parameters, numbers)
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


def _columns(channel: Channel) -> tuple[int, ...]:
    """Columns of X, Y and Z and of the first rotary axes, -1 for one that is missing."""
    turning = [column for column, axis in enumerate(channel.axis_data) if axis.rotary][:TURNS]
    return (*channel.coordinates.geometry, *turning, *(-1,) * (TURNS - len(turning)))
