"""Planning as the toolpath grows: chunks come in, speeds and times come out, in bounded memory.

Rows are laid out as pieces in a buffer. When it is full, a look-ahead that ends in a stop at its last joint
shows up to where nothing behind the buffer can matter any more; so far the pieces are final, timed and
dropped, and the rest moves to the front. The buffer is looked at only when it is full, however the rows are
cut into chunks, and has at least twice the room of what the last look left: the result does not depend on the
chunks, and the cost stays in proportion to the rows.
"""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.compiled import kernels, plain
from polycnc.motion.kernels.columns import PLACES, Form, PieceRecord, Rows, new_state, piece_width
from polycnc.motion.limits import ContextTables, averages, axis_rapids, is_bent_by_way
from polycnc.motion.pace import taps_as_overridden
from polycnc.motion.settings import DEFAULT, Settings
from polycnc.motion.standing.beside import Awaits, Beside
from polycnc.motion.standing.positioning import PositionedAxes, places_of, rests_of
from polycnc.motion.standing.waits import Waits, least_seconds
from polycnc.motion.standing.zero_mark import lag_s
from polycnc.motion.time_constants import Use, use_of, uses_of
from polycnc.motion.times import Plan, Times, ToolTimes
from polycnc.motion.transformed import RealAxes
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from polycnc.machine import Machine
    from polycnc.motion.kernels.columns import Limits, State
    from polycnc.motion.limits import AxisRapid
    from polycnc.motion.pole import PathLeg, Turn
    from polycnc.motion.standing.beside import Begins, Step
    from polycnc.motion.standing.waits import Parallel
    from polycnc.motion.third_order.laying.leading import LawRuns
    from polycnc.toolpath import Context, Toolpath
    from polycnc.toolpath.table import Chunk

    Enters = Mapping[int, Sequence[float]]
    _TakesRows = Callable[[Rows, int, array[float], int, array[float], Limits, State, bool], None]

#: Pieces that the buffer takes at first, and pieces that it takes before it is looked at: twice as many each time that
#: it has been looked at so often, for memory costs a short path more than looking; but no more than the last number.
FIRST_ROOM, FULL_ROOM, LOOKS, MOST_ROOM = 256, 2048, 8, 4096


class Planner:
    """Plans a toolpath chunk by chunk. `take` fits `Toolpath(on_full=...)`.

    Args:
        toolpath: The toolpath whose chunks will come; its contexts are read as they are added.
        machine: Limits of axes and spindles, times of tool changes and auxiliary functions.
        channel: Number of the channel that makes the toolpath.
        start: Machine position of every column before the first row; all zero where it is left out.
        tool: Number or name of the tool in the spindle before the first row; 0 for none.
        settings: How the control leads the axes.
        keep_rows: Keep seconds and length of every row (16 bytes each).
        on_pieces: Called with the buffer and the number of its pieces that have become final, before they are
            dropped.
        feed_profile: Called with each chunk; gives the feed of every row, in the unit of the row, in place of the
            programmed ones: an override, or a profile block by block. Threads and taps keep their lead.
        compiled: Use compiled kernels where they are there.

    Attributes:
        on_pieces: See above; can be set as long as nothing is planned.
        on_rows: Called with rows as they are laid out, from one on, with their curve parameters and number, contexts,
            limits, the state before them, and whether they are accelerated after the interpolation.
        on_wait: Called when a row must wait, with row number, share (a field of `Times`), context number and seconds;
            before its pieces become final, but for what runs beside motion and outlasts it.
        is_turning: Pieces that become final are of a turn at the pole.
    """

    def __init__(
        self,
        toolpath: Toolpath,
        machine: Machine,
        *,
        channel: int = 1,
        start: Sequence[float] = (),
        tool: int | str = 0,
        settings: Settings = DEFAULT,
        keep_rows: bool = True,
        on_pieces: Callable[[array[float], int], None] | None = None,
        feed_profile: Callable[[Chunk], array[float]] | None = None,
        compiled: bool = True,
    ) -> None:
        self._axes = len(toolpath.axes)
        self._width = piece_width(self._axes)
        self._machine = machine
        self._toolpath = toolpath
        self._settings = settings
        self._keep_rows = keep_rows
        self.on_pieces = on_pieces
        self.on_wait: Callable[[int, str, int, float], None] | None = None
        self.on_rows: _TakesRows | None = None
        self._laid = 0
        self._feed_profile = feed_profile
        self._kernels = kernels() if compiled else plain()
        self._state = new_state(self._axes, start)
        self._real = RealAxes(machine, channel, toolpath.axes, settings, start)
        self._limits = self._real.limits(None)
        self._pieces = array("d", bytes(8 * self._width * FIRST_ROOM))
        self._room, self._looks = FULL_ROOM, 0
        self._uses, self._use = uses_of(machine, channel, settings), Use.CUT
        self._tables = ContextTables(self._uses.after_s)
        self._slots = array("d")
        self._stations: dict[tuple[object, ...], int] = {}
        self._waited: dict[int, dict[str, float]] = {}
        self._rows = array("d")
        self._row_waits: dict[int, float] = {}
        self._first_row = self._next_row = 0
        self._waits = Waits(machine, toolpath, tool, self._wait)
        self._waits.rapid_stops, self._waits.spindle_wait = settings.rapid_stops, settings.spindle_wait
        self._waits.step, self._beside = self._step, Beside(self._lag_of, self._settle_parallel)
        self._waits.positioned = PositionedAxes(machine, channel, toolpath.axes, settings)
        self._final_row = 0  # rows before it are planned
        self.is_turning = False
        self._rests: set[int] = set()
        self._come_to_rest: dict[int, float] = {}  # by row of a function: averages that it outlasts
        self._outlasted = -1, 0.0  # the last row that has waited for a function beside a block, seconds
        self._runs: LawRuns | None = None  # until a context asks for it
        self._rapid_context: Context | None = None  # whose rapids were looked at last
        self._rapids_are_soft = False
        self._compiled = compiled

    @property
    def unlaid(self) -> int:
        """Rows of the chunk at hand that are not laid out yet; another thread may ask."""
        laid = self._laid if self._runs is None else max(self._laid, self._runs.reached)
        return max(self._next_row - laid, 0)

    @property
    def facing(self) -> int:
        """The column of X, -1 for none."""
        return self._limits.geometry[0]

    @property
    def real_axes(self) -> RealAxes:
        """What the machine's axes do under a transformation."""
        return self._real

    @property
    def position(self) -> list[float]:
        """Machine position behind the last row laid out; before the first, that of the start."""
        return list(self._state.position)

    def rpm(self, context: Context, radius_mm: float) -> float:
        """Spindle speed of a context at a turning radius."""
        return self._waits.rpm(context, radius_mm)

    def spindle_pull(self, context: Context) -> float:
        """Acceleration of the spindle of a context, rpm a second; 0 for at once."""
        spindle = self._waits.spindle(context)
        return spindle.acceleration_rpm_s if spindle is not None else 0.0

    def runs_up_beside(self, context: Context) -> bool:
        """Whether the spindle of a context goes to another speed beside the axes, and no block waits for that."""
        spindle = self._waits.spindle(context)
        return spindle is not None and not self._waits.stands_for_speed(spindle)

    def stops_for_change(self, context: Context) -> bool:
        """Whether the spindle of a context comes to rest for a change of the tool."""
        return self._waits.stops_for_change(self._waits.spindle(context))

    @property
    def top_speeds(self) -> tuple[Sequence[float], Sequence[float]]:
        """Highest velocity of every column in cuts, and in rapids."""
        return self._limits.top_feed, self._limits.top_rapid

    @property
    def settings(self) -> Settings:
        """How the control leads the axes."""
        return self._settings

    def rapids(self, ways: Sequence[float], context: Context) -> list[AxisRapid]:
        """How each axis runs a rapid by itself: none does under a transformation."""
        if context is not self._rapid_context:
            self._rapid_context = context
            self._rapids_are_soft = averages(context, self._machine, self._settings)[0] > 0.0
        limits = self._real.limits(None, self._use_of_rapids)
        return axis_rapids(ways, context, limits, soft=self._rapids_are_soft)

    def rapids_of(self, piece: Sequence[float], context: Context) -> list[AxisRapid]:
        """How each axis runs a planned piece by itself; empty where they go together."""
        if piece[PieceRecord.FORM] != Form.TIMED:
            return []
        at, n = PieceRecord.VECTORS + PLACES * self._axes, self._axes
        return self.rapids([piece[at + n + i] - piece[at + i] for i in range(n)], context)

    def use_of(self, kind: int, context: Context) -> Use:
        """What a row of a kind runs by."""
        return use_of(kind, context, self._uses)

    @property
    def _use_of_rapids(self) -> Use:
        return Use.RAPID if self._uses.rapid else Use.CUT

    def take(self, chunk: Chunk) -> bool:
        """Plan a chunk; true, for it is no longer needed."""
        if len(chunk) == 0:
            return True
        self._add_contexts()
        self._state.run.unseen = 1.0 if self.on_pieces is None else 0.0
        self._next_row = chunk.first + len(chunk)
        self._waits.take(chunk, self.facing)
        stops = self._waits.stops(chunk)
        feed = chunk.feed if self._feed_profile is None else self._feed_profile(chunk)
        bounds = self._real.bounds(chunk, self._toolpath.contexts)
        feed = bounds.paced(feed)
        curves = taps_as_overridden(chunk) if self._settings.taps_overridden else chunk.curves
        whole = Rows(chunk.kind, chunk.context, feed, chunk.end, chunk.curve, stops, *bounds.shares)
        switches = self._switches(chunk) if self._uses.differ else {}
        places = places_of(self._toolpath, chunk)
        rests = {number - chunk.first for number in self._rests} | rests_of(self._toolpath, chunk) | {*places}
        self._rests.clear()
        beside = {entry.last + 1 - chunk.first for entry in self._waits.parallel if entry.last >= chunk.first}
        row = 0
        for edge in (*sorted({*bounds.enters, *bounds.legs, *switches, *rests, *beside}), len(chunk)):
            self._lay(whole._replace(kind=chunk.kind[:edge]), row, curves, chunk.first)
            row = edge
            outlasting = self._outlasting(chunk, edge, whole, bounds.enters) if edge in beside else []
            if outlasting or edge in rests:
                self._rest()
                self._state.run.overlap = self._state.run.rapid_overlap = 0.0
            for column, place in places.get(edge, {}).items():
                self._state.position[column] = place
            if edge in bounds.placed:
                self._state.position[:] = array("d", bounds.placed[edge])
            for entry in outlasting:
                self._come_to_rest[entry.row] = self._averages(entry)
            if edge in switches:
                self._switch(switches[edge], self._toolpath.contexts[chunk.context[edge]])
            if edge in bounds.enters:
                context = self._toolpath.contexts[chunk.context[edge]]
                self._enter(context, bounds.enters[edge], chunk.first + edge)
            if edge in bounds.legs:
                self._through_pole(bounds.legs[edge], chunk, edge, feed[edge])
                row = edge + 1
        self._laid = self._next_row
        return True

    def _outlasting(self, chunk: Chunk, edge: int, rows: Rows, enters: Enters) -> list[Parallel]:
        """The functions that outlast the motion of the block in front of a row: the axes rest at its end."""
        entries = [entry for entry in self._waits.parallel if entry.last + 1 == chunk.first + edge]
        return [entry for entry in entries if self._least_seconds(entry, chunk, rows, enters) < entry.seconds]

    def _least_seconds(self, entry: Parallel, chunk: Chunk, rows: Rows, enters: Enters) -> float:
        """The least time of the block of a function."""
        seconds, first = None, chunk.first
        if self._runs is not None:
            from polycnc.motion.third_order.laying.least import ChunkRows

            told = self._toolpath.contexts, self._tables, self._real, self._uses
            block = ChunkRows(rows, chunk.curves, first, enters, *told)
            seconds = block.least_seconds(entry.row + 1 - first, entry.last - first, self._axes)
        if seconds is not None:
            return seconds
        piece, end = self._piece_of(entry.row), self._state.run.pieces
        return least_seconds(self._pieces, piece, end, self._width)

    def _averages(self, entry: Parallel) -> float:
        """Seconds in which the averages of a run come to rest beside a function whose block does not begin the run.

        The seconds of the row that begins it hold them.
        """
        first, pieces = self._piece_of(entry.row), self._state.run.pieces
        if (
            entry not in self._waits.parallel or first == pieces
        ):  # a law has led it, and it is planned; or no motion
            return 0.0
        for piece in reversed(range(pieces)):
            at = piece * self._width
            pause = self._pieces[at + PieceRecord.PAUSE]
            if pause > 0.0 or self._pieces[at + PieceRecord.ENTRY2] == 0.0:  # here its run begins
                return pause if piece < first else 0.0
        return 0.0

    def _lag_of(self, row: int) -> float | None:
        """Seconds by which the axes of a thread are behind its spindle, up to speed; None before the row is planned."""
        if row >= self._final_row:
            return None
        at = self._piece_of(row) * self._width
        laid = at < self._state.run.pieces * self._width and self._pieces[at + PieceRecord.ROW] == row
        return lag_s(self._pieces, at) if laid else 0.0

    def _piece_of(self, row: int) -> int:
        """The first piece in the buffer that belongs to a row or to one behind it."""
        piece = self._state.run.pieces
        while piece and self._pieces[(piece - 1) * self._width + PieceRecord.ROW] >= row:
            piece -= 1
        return piece

    def _step(self, step: Step) -> None:
        """Something begins beside the axes, or a row waits for it."""
        self._beside.note(step)
        if isinstance(step, Awaits) and step.rests:
            self._rests.add(step.row)

    def tell_begins(self, tell: Callable[[Begins], None]) -> None:
        """Have somebody told of what begins beside the axes, before pieces of rows behind it become final."""
        self._beside.on_begin = tell

    @property
    def hidden_s(self) -> Mapping[str, float]:
        """Seconds of spindle ramps and of the magazine that nothing waits for, by the field of `Times`."""
        return self._beside.hidden_s

    def _seconds(self, first: int, last: int) -> float:
        """Seconds of the rows from one to before another one."""
        return sum(self._rows[2 * (first - self._first_row) : 2 * (last - self._first_row) : 2])

    def _switches(self, chunk: Chunk) -> dict[int, Use]:
        """The rows from which on another use holds."""
        use, found = self._use, {}
        for row, (kind, number) in enumerate(zip(chunk.kind, chunk.context, strict=True)):
            if (
                kind < Kind.DWELL
                and (own := use_of(kind, self._toolpath.contexts[number], self._uses)) != use
            ):
                use = found[row] = own
        return found

    def _switch(self, use: Use, context: Context) -> None:
        """Before a row that another use holds for the axes rest."""
        self._rest()
        self._use, self._limits = use, self._real.limits(context, use)

    def _lay(self, rows: Rows, row: int, curves: array[float], number: int) -> None:
        """Lay rows out from one on."""
        contexts = self._tables.of(self._use)
        self._tell(rows, row, curves, number)
        if self._runs is not None:
            self._lay_runs(self._runs, rows, row, curves, number, contexts)
            return
        while row < len(rows.kind):
            row = self._kernels.lay(
                rows, row, curves, number, contexts, self._limits, self._pieces, self._state
            )
            self._laid = number + row
            if row < len(rows.kind):
                self._make_room()

    def _tell(self, rows: Rows, row: int, curves: array[float], number: int) -> None:
        """Rows from one on will be laid out."""
        if self.on_rows is not None:
            runs, contexts, after = self._runs, self._tables.of(self._use), self._use is Use.AFTER
            state = self._state if runs is None or not runs.is_open else runs.room.lead
            self.on_rows(rows, row, curves, number, contexts, self._limits, state, after)

    def _lay_runs(
        self, runs: LawRuns, rows: Rows, row: int, curves: array[float], number: int, contexts: array[float]
    ) -> None:
        """Lay rows out: runs that a law leads as windows, all others as pieces."""
        from polycnc.motion.third_order.laying.rows import DONE, NO_PIECE

        while row < len(rows.kind):
            row, why = runs.lay(rows, row, curves, number, contexts, self._limits, self._pieces, self._state)
            self._laid = number + row
            self._take_windows(runs)
            if why == NO_PIECE:
                self._make_room()
            elif why != DONE:
                self._end_run(runs)

    def _rest(self) -> None:
        """The axes come to rest behind the last row."""
        if self._runs is not None and self._runs.is_open:
            self._end_run(self._runs)
        self._kernels.settle(self._pieces, self._axes, self._limits, self._state)
        self._state.run.stop = 1.0

    def _end_run(self, runs: LawRuns) -> None:
        """The run that is laid is over, and the axes rest."""
        if runs.is_row:
            rows, curves, number = runs.row
            contexts = self._tables.of(self._use)
            self._state.run.stop = 1.0
            while not self._kernels.lay(
                rows, 0, curves, number, contexts, self._limits, self._pieces, self._state
            ):
                self._make_room()
        else:
            runs.end(self._limits)
            self._take_windows(runs)
            lead = runs.room.lead
            self._state.position[:] = lead.position
            self._state.run.without_feed += lead.run.without_feed
            self._state.run.standing_spindle += lead.run.standing_spindle
        self._state.run.stop = 1.0

    def _take_windows(self, runs: LawRuns) -> None:
        """Count the time of windows that are settled, and hand their pieces on."""
        while runs.windows:
            window = runs.windows.popleft()
            if self._state.run.pieces > 0:
                self._kernels.settle(self._pieces, self._axes, self._limits, self._state)
            self._look_ahead(window.rows.row[0])
            window.add_times(self._slots, self._rows, self._first_row)
            self._beside.settle(window.rows.row[-1], self._seconds, self._wait)
            self._settle_parallel(window.planned_rows)
            while self.on_pieces is not None and (count := window.put_records(self._pieces)):
                self.on_pieces(self._pieces, count)
            self._pieces[PieceRecord.SPEED2] = 0.0
            self._forget_rows(window.planned_rows)

    def _through_pole(self, legs: Sequence[PathLeg], chunk: Chunk, row: int, feed: float) -> None:
        """Lay the legs of a row, at rest before each of them; between two of them the rotary axis turns."""
        number, first = chunk.first + row, chunk.context[row]
        for leg in legs:
            rows = leg.at_feed(feed)
            if leg.turn is not None:
                self._tell(rows, 0, leg.curves, number)
                self._turn(leg.turn, first, chunk.kind[row], number)
            self._lay(rows, 0, leg.curves, number)
            self._state.run.stop = 1.0

    def _turn(self, turn: Turn, context: int, kind: int, number: int) -> None:
        """The rotary axis turns at rest. Its degrees are no way that the feed counts."""
        rapid = kind == Kind.RAPID
        slot = 2 * context + (0 if rapid else 1)
        records = self._real.turn(turn, self._toolpath.contexts[context], kind, number, slot)
        self._rest()
        self._look_ahead(number)
        while len(self._pieces) < len(records):
            self._pieces.frombytes(bytes(8 * len(self._pieces)))
        count = len(records) // self._width
        self._pieces[: len(records)] = records
        self._state.run.pieces, self._state.run.stop = count, 1.0
        way, row_way = 2 * slot + 1, 2 * (number - self._first_row) + 1
        before, self.is_turning = (self._slots[way], self._rows[row_way]), True
        self._look_ahead(number)
        (self._slots[way], self._rows[row_way]), self.is_turning = before, False
        last = (count - 1) * self._width + PieceRecord.VECTORS + (PLACES + 1) * self._axes
        self._state.position[:] = records[last : last + self._axes]

    def _enter(self, context: Context, position: list[float], row: int) -> None:
        """Before a row a transformation begins or ends: at rest the path goes on from where the real axes are."""
        self._rest()
        self._look_ahead(row)
        self._limits = self._real.limits(context, self._use)
        self._state.position[:] = array("d", position)

    def finish(self) -> Plan:
        """Plan what the toolpath still holds, to a stop behind the last row, and give the result."""
        for chunk in self._toolpath.chunks:
            if chunk.first >= self._next_row:
                self.take(chunk)
        self._waits.settle(self._next_row)
        self._rest()
        self._look_ahead(self._next_row)
        self._final_row = self._next_row
        self._beside.settle(self._next_row, self._seconds, self._wait)
        self._settle_parallel(self._next_row)
        return self._plan()

    # ---- the buffer of pieces ------------------------------------------------------------------------------

    def _make_room(self) -> None:
        room = len(self._pieces) // self._width
        if room >= self._room:
            before = self._state.run.pieces
            self._look_ahead()
            self._looks += 1
            is_enough = self._looks % LOOKS or room >= MOST_ROOM
            if is_enough and self._state.run.pieces < before and 2 * self._state.run.pieces <= room:
                return
            self._room = 2 * room
        self._pieces *= 2  # whatever is in the new half: a piece is written before it is read

    def _look_ahead(self, end: int | None = None) -> None:
        """Find the speeds of all pieces that nothing still to come can change, and drop those pieces.

        Of all pieces if the axes come to rest before the row `end`.

        The last pieces wait for the rows behind them, for a spline bends there, and a bound on the speed may
        reach back; the joint before them is taken as a stop.
        """
        count, width = self._state.run.pieces, self._width
        self._final_row = self._final_row if end is None else end
        self._reach(min(max(self._laid, end or 0) + 1, self._next_row))
        last = self._kernels.settled(self._pieces, self._axes, self._state) if end is None else count
        if last <= 0:
            return
        final = self._kernels.backward(self._pieces, last, self._axes, self._limits)
        if end is not None:
            final = count
        if final <= 0:
            return  # so far everything hangs on what is still to come
        pieces, rest = self._pieces, array("d", self._pieces[final * width : count * width])
        end2 = rest[PieceRecord.REACH2] if rest else 0.0
        self._kernels.forward(
            pieces,
            final,
            self._axes,
            self._limits,
            end2,
            self._slots,
            self._rows,
            self._first_row,
        )
        last_row = int(pieces[(final - 1) * width + PieceRecord.ROW]) if end is None else end
        self._final_row = last_row + 1 if end is None else end
        self._beside.settle(last_row, self._seconds, self._wait)
        planned_rows = int(rest[PieceRecord.ROW]) if end is None else end
        self._settle_parallel(planned_rows)
        if self.on_pieces is not None:
            self.on_pieces(pieces, final)
        end2 = pieces[(final - 1) * width + PieceRecord.END2]
        pieces[: len(rest)] = rest
        pieces[PieceRecord.SPEED2] = end2
        self._state.run.pieces = count - final
        self._forget_rows(planned_rows)

    def _reach(self, row: int) -> None:
        """Have room for seconds and length of all rows before one."""
        missing = 2 * (row - self._first_row) - len(self._rows)
        if missing > 0:
            self._rows.frombytes(bytes(8 * missing))

    def _forget_rows(self, planned_rows: int) -> None:
        """All rows before one are planned: where rows are not kept, they are forgotten."""
        if not self._keep_rows:
            self._final_row = planned_rows
            self._beside.settle(planned_rows, self._seconds, self._wait)
            needed = min([planned_rows, *(entry.row for entry in self._waits.parallel)])
            forgotten = 2 * (needed - self._first_row)
            if 2 * forgotten >= len(self._rows):  # those behind them move up
                del self._rows[:forgotten]
                self._first_row = needed

    # ---- rows and totals -----------------------------------------------------------------------------------

    def _add_contexts(self) -> None:
        for context in self._toolpath.contexts[len(self._slots) // 4 :]:
            smoothing = self._tables.smoothing(context, self._machine, self._settings)
            station = self._stations.setdefault((*_station(context), smoothing), len(self._stations))
            spindle = self._waits.spindle(context)
            self._tables.add(context, self._axes, spindle, station, self._settings, smoothing)
            self._slots.extend((0.0, 0.0, 0.0, 0.0))
            if self._runs is None and smoothing[0] > 0.0 and is_bent_by_way(context, self._settings):
                from polycnc.motion.third_order.laying.leading import LawRuns

                self._runs = LawRuns(self._axes, compiled=self._compiled)

    def _wait(self, row: int, share: str, context: int, seconds: float) -> None:
        """A row waits: called before its motion is planned. What comes behind the last row counts for it."""
        if self.on_wait is not None:
            self.on_wait(row, share, context, seconds)
        row = min(row, self._next_row - 1)
        self._reach(row + 1)
        self._rows[2 * (row - self._first_row)] += seconds
        if self._keep_rows and share != "dwell_s":  # a dwell is what its row is for
            self._row_waits[row] = self._row_waits.get(row, 0.0) + seconds
        shares = self._waited.setdefault(context, {})
        shares[share] = shares.get(share, 0.0) + seconds

    def _settle_parallel(self, planned_rows: int) -> None:
        """Let what follows on planned blocks wait for the auxiliary functions that run beside them and take longer."""
        open_yet = []
        for entry in self._waits.parallel:
            behind = entry.last + 1
            if behind > planned_rows:
                open_yet.append(entry)
                continue
            before = self._outlasted[1] if self._outlasted[0] == behind else 0.0
            counted = before if behind >= self._next_row > entry.row + 1 else 0.0  # for the last row
            # What its own row waits for comes in front of it.
            motion = self._seconds(entry.row + 1, behind) - counted + self._come_to_rest.get(entry.row, 0.0)
            left = entry.seconds - motion - before
            if left > 0.0:
                self._outlasted = behind, left + before
                self._wait(behind, "auxiliary_s", entry.context, left)
                self._beside.stand(behind, left)
        self._waits.parallel[:] = open_yet
        if not open_yet:
            self._come_to_rest.clear()

    def _plan(self) -> Plan:
        total, tools = Times(), dict[tuple[int, str], ToolTimes]()
        for number, context in enumerate(self._toolpath.contexts[: len(self._slots) // 4]):
            rapid_s, rapid_mm, cutting_s, cutting_mm = self._slots[4 * number : 4 * number + 4]
            times = Times(cutting_s=cutting_s, rapid_s=rapid_s, cutting_mm=cutting_mm, rapid_mm=rapid_mm)
            for share, seconds in self._waited.get(number, {}).items():
                setattr(times, share, getattr(times, share) + seconds)
            key = (context.tool, context.tool_name)
            tools.setdefault(key, ToolTimes(*key)).times += times
            total += times
        used = tuple(tool for tool in tools.values() if tool.tool or tool.name or tool.times.total_s > 0.0)
        without_feed, without_spindle = self._state.run.without_feed, self._state.run.standing_spindle
        rows = self._rows[::2], self._rows[1::2], self._row_waits
        return Plan(total, used, *rows, without_feed, without_spindle)


def _station(context: Context) -> tuple[object, ...]:
    """What the axes stand still for when it changes between two moves."""
    spindle = (context.spindle, context.spindle_rpm, context.spindle_direction, context.surface_speed)
    return (context.tool, context.tool_name, *spindle)
