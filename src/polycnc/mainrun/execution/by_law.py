"""Runs with limited jerk whose path is bent by its way: a law leads along all their rows."""

from __future__ import annotations

from math import dist, inf, sqrt

from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun.motion.law_motion import LawMotion
from polycnc.mainrun.motion.law_run import NEAR_MM, LawRun
from polycnc.mainrun.preparation.items import Move
from polycnc.mainrun.preparation.law_rows import LawRows
from polycnc.motion.third_order.laying.room import axes_of

if TYPE_CHECKING:
    from polycnc.mainrun.execution.clock import Clock
    from polycnc.mainrun.motion.law_run import State
    from polycnc.mainrun.preparation.items import ChannelRates, Piece
    from polycnc.mainrun.preparation.law_rows import RowOfRun
    from polycnc.mainrun.preparation.preprocessing import Preprocessing

#: So many stretches are handed on together; the way to rest counts so often as what must be known ahead, and as what a
#: law that is found anew leads over: it is found again when half of that is left.
ENOUGH, AHEAD = 64, 3.0
#: So far ahead is known what an override may ask for at any moment, at most.
OVERRIDE = 1.2


class RestBefore(Protocol):
    """Gives the number of the first row ahead before which the axes shall rest; inf for none."""

    def __call__(self, *, gated: bool, first: float = -inf) -> float:
        """By what the operator has set, and, if `gated`, for a function that runs; from the row `first` on."""


class ByLaw:
    """Leads runs of a channel by their law.

    Args:
        preprocessing: What is prepared.
        rates: What the operator has set.
        clock: The time.
        rest_before: Before which row the axes shall rest.
    """

    def __init__(
        self, preprocessing: Preprocessing, rates: ChannelRates, clock: Clock, rest_before: RestBefore
    ) -> None:
        self._preprocessing, self._rates, self._clock = preprocessing, rates, clock
        self._rest_before, self._one_block = rest_before, False
        self._run: LawRun | None = None
        self._rows = LawRows(preprocessing.axes, rates)
        self._set: tuple[object, ...] = ()
        self._row: RowOfRun
        self._fed = -inf
        self._parted = -inf  # the row in execution is a run of its own because of single block
        self._first_rest = -inf  # before rows in front of this one the axes cannot rest any more

    def drop(self) -> None:
        """The axes are led by something else."""
        self._run = None

    def motion(self, move: Move, *, at_rest: bool, held: bool, one_block: bool) -> LawMotion | None:
        """The motion along a row, which leaves the queue; None where no law leads.

        Args:
            move: The row in front.
            at_rest: The axes stand.
            held: They shall rest at once.
            one_block: No more than a block is prepared.
        """
        self._one_block = one_block
        if at_rest and (self._run is None or self._rows.find(move.row) is None):
            self._run = self._begin(move)
        run = self._run
        if run is None:
            return None
        row, time = self._rows.find(move.row), self._clock.time
        assert row is not None
        run.forget(row.begin, time)
        self._rows.forget(row)
        self._row = row
        self._know(run)
        motion = LawMotion(self._preprocessing.queue.pop_row(), run, row.begin, row.end)
        self.revise(held=held)
        if not held:
            self._lead_farther(run)
        motion.follow()
        return motion

    def take_over(self, piece: Piece, state: State | None) -> LawMotion | None:
        """Single block is off again, and the row in execution goes on into the next one: the motion along it.

        Args:
            piece: The row, which is a run of its own, from rest to rest.
            state: How the axes move along it.

        Returns:
            None where the row is such a run for itself, or where the next one is too near to go on into it.
        """
        if state is None or piece.row != self._parted:
            return None
        self._one_block, self._parted = False, -inf
        queue, rows, time = self._preprocessing.queue, self._rows, self._clock.time
        self._preprocessing.reopen()
        queue.join_rows()
        self._feed_two(rows)
        row = self._rows.find(piece.row)
        if row is not None and not rows.is_one_line and row.move.prepared is not None:
            run = LawRun(axes_of(row.move.prepared.limits), time, rows.cap2)
            run.take_up(time, state)
            self._row = row
            self._know(run)
            goes_on = dist(run.place(state.way), piece.at(state.way / piece.length)) < NEAR_MM
            if goes_on and run.lead_to(time, self._stop_way(run), self._far(run)):
                self._run, self._set = run, self._asked(held=False)
                return LawMotion(queue.front_row, run, row.begin, row.end)
        queue.join_rows(rests=True)
        self._run = None
        return None

    def revise(self, *, held: bool) -> None:
        """What bounds the speed may have changed: find the law anew where it has."""
        run, now = self._run, self._asked(held=held)
        if run is None or now == self._set:
            return
        if run.brake(self._clock.time) if held else self._lead_on(run):
            self._set = now

    def go_on(self, *, held: bool) -> None:
        """The axes rest within a row: if nobody asks for that any more, they go on."""
        if self._run is not None and not held:
            self._lead_on(self._run)

    def _lead_farther(self, run: LawRun) -> None:
        """Let the law lead as far ahead as it must, and on from a rest that nobody asks for any more."""
        if run.end_time <= self._clock.time or (run.is_planned and self._rows.bars):
            self._lead_on(run)
        elif run.is_short and run.end_way < self._row.end + self._ahead(run):
            run.lead_farther(self._clock.time, self._stop_way(run), self._far(run))

    def _lead_on(self, run: LawRun) -> bool:
        """Find the law anew; false where it stays as it is."""
        time, stop, far = self._clock.time, self._stop_way(run), self._far(run)
        if run.lead_to(time, stop, far):
            return True
        if not run.brake(time):
            return False
        if stop < run.end_way:  # too near: the axes rest before the first block for which they can
            self._first_rest = self._rows.number_from(run.end_way)
            stop = self._stop_way(run)
        run.lead_to(time, stop, far)
        return True

    def _stop_way(self, run: LawRun) -> float:
        """Where the axes shall rest, as far as that is known."""
        return min(self._asked_stop(), self._rows.barred_from(run.law.at(self._clock.time), self._far(run)))

    def _asked_stop(self) -> float:
        """Where the row begins before which the axes shall rest, if it is known."""
        number = self._rest_before(gated=True, first=self._first_rest)
        if number == inf:
            self._first_rest = -inf
        stop = self._rows.find(number)
        return inf if stop is None else stop.begin

    def _asked(self, *, held: bool) -> tuple[object, ...]:
        """What a law is found for."""
        return held, self._asked_stop(), *self._asked_speeds()

    def _asked_speeds(self) -> tuple[object, ...]:
        operator, rates = self._rates.operator, self._rates
        speeds = operator.feed, operator.rapid, operator.spindle, operator.dry_run, operator.feed_cancelled
        return (*speeds, rates.feed, rates.influence)

    # ---- what is known -------------------------------------------------------------------------------------

    def _begin(self, move: Move) -> LawRun | None:
        """The run that begins with a row, from rest; None where it is no more than that, or where none begins."""
        rows = self._rows = LawRows(self._preprocessing.axes, self._rates)
        self._fed = -inf
        if not rows.add(move, self._preprocessing.contexts):
            return None
        self._fed = move.row
        self._feed_two(rows)
        if rows.is_one_line:
            asked = self._one_block or self._rest_before(gated=False) < inf
            self._parted = move.row if asked else -inf
            self._preprocessing.revised |= self._preprocessing.queue.lay_alone(self._rates)
        if not rows.rows or rows.is_one_line:
            return None
        assert move.prepared is not None
        self._set = False, inf, *self._asked_speeds()
        return LawRun(axes_of(move.prepared.limits), self._clock.time, rows.cap2)

    def _feed_two(self, rows: LawRows) -> None:
        """Let the run go on along a second row, if there is one."""
        closed = False
        while not closed and len(rows.rows) < 2:
            closed = self._feed() or (len(rows.rows) < 2 and not self._fill_on())

    def _fill_on(self) -> bool:
        return self._preprocessing.fill_on(one_block=self._one_block)

    def _feed(self) -> bool:
        """Let the run go on along the rows that are prepared; true where it is over with them.

        It ends where the axes shall rest by what the operator has set; for a function they rest without an end, since
        it may be done in time.
        """
        new: list[Move] = []
        for item in reversed(self._preprocessing.items):
            if isinstance(item, Move):
                if item.row <= self._fed:
                    break
                new.append(item)
        stop = self._rest_before(gated=False) if new else inf
        for item in reversed(new):
            if item.row >= stop or not self._rows.add(item, self._preprocessing.contexts):
                return True
            self._fed = item.row
        return False

    def _know(self, run: LawRun) -> None:
        """Let so much of the run be known that the axes could still rest behind the row, whatever is asked for."""
        goal = self._row.end + self._ahead(run, OVERRIDE * self._row.move.asked(0.5)) + NEAR_MM
        while not run.is_closed and run.known_way <= goal:
            closed = self._feed()
            if not closed and self._rows.waits < ENOUGH:
                closed = not self._fill_on()
            if closed or self._rows.waits >= ENOUGH:
                run.take(self._rows.take(closed=closed), closed=closed)

    def _ahead(self, run: LawRun, faster: float = 0.0) -> float:
        """How far behind the row a law must lead, for the speed that is asked for, or a faster one that may be."""
        row, rows = self._row, self._rows
        asked = max(sqrt(rows.cap2(row.begin, row.end, asked=True)), min(sqrt(row.top2), faster))
        return AHEAD * run.way_to_rest(max(min(asked, run.fastest), run.law.speed(self._clock.time)))

    def _far(self, run: LawRun) -> float:
        """How far a law that is found anew leads."""
        return self._row.end + 2.0 * self._ahead(run) + NEAR_MM
