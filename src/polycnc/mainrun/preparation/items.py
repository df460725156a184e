"""What the interpreter has prepared and the main run has still to do, in order."""

from __future__ import annotations

from math import inf

from polycnc.channel.interpolator import Influence
from polycnc.channel.intervention import NOTHING_BACK
from polycnc.deferred.records import dataclass, replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar, TypeAlias
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.intervention import TakesBack
    from polycnc.mainrun.motion.geometry import Cubic, Segment
    from polycnc.mainrun.preparation.layout import PreparedRow
    from polycnc.motion.kernels.columns import Limits
    from polycnc.toolpath import Context, Event
    from polycnc.toolpath.motion_settings import DryRun

#: Programs with a line of each.
Places: TypeAlias = tuple[tuple[str, int], ...]


@dataclass(frozen=True, slots=True)
class Block:
    """A block begins.

    Attributes:
        program: Name of its program.
        line: Its line in that program's file.
        modal: Active code of every modal group behind it.
        takes_back: What it takes back of a manual intervention.
        is_silent: It does nothing on the machine, but for beginning and ending synchronised actions.
        callers: Program and line of the blocks that have called its program, from the main program on.
        is_part: It runs as a part of the block that has called it: the shape of a turning cycle.
    """

    program: str
    line: int
    modal: Mapping[str, str]
    takes_back: TakesBack = NOTHING_BACK
    is_silent: bool = False
    callers: Places = ()
    is_part: bool = False

    @property
    def levels(self) -> Places:
        """Where it stands, from the main program on."""
        here = (self.program, self.line)
        return self.callers if self.callers[-1:] == (here,) else (*self.callers, here)

    def followed_by(self, program: str, line: int, modal: Mapping[str, str]) -> Block:
        """A block of which rows come alone: of the same program, or of one of those that have called it."""
        at = next((i for i, (name, _) in enumerate(self.levels) if name == program), 0)
        return Block(program, line, modal, callers=self.levels[:at])


@dataclass(frozen=True, slots=True)
class BlockEnd:
    """A block is over; single block operation halts here.

    Attributes:
        code: Its N word, or its line.
        context: What holds behind it, where it has changed what its last row has; else None.
    """

    code: str
    context: Context | None = None


@dataclass(frozen=True, slots=True)
class Happening:
    """An event of the program. `stands` says whether the axes stand still for it."""

    event: Event
    context: Context
    stands: bool


@dataclass(frozen=True, slots=True)
class Standing:
    """The axes stand for a time. `why` is a share of `motion.Times` (`dwell_s`, `spindle_s` …).

    Attributes:
        is_asked_again: What it waits for may have gone by when somebody has held the program meanwhile.
    """

    is_asked_again: ClassVar[bool] = False
    why: str
    seconds: float
    context: Context

    def wait_s(self, _time: float) -> float:
        """Seconds that they stand from a time on."""
        return self.seconds


@dataclass(slots=True, eq=False)
class Row:
    """What a row of the path and its pieces share.

    Attributes:
        way: Where it leads; `row` is its number, with a fraction for a leg through the pole (`motion/pole.py`).
        kind: Kind of the row.
        context: What holds in it.
        program: Name of the program; `line` the line in its file.
        rapid: Runs at rapid traverse.
        fixed: Bound to the spindle (thread, tap): no override, no feed hold, but for what follows.
        per_revolution: Its speed follows the spindle.
        left: Way from its end to the programmed end of a skip move that a signal cuts there, mm.
        by_axis: A rapid on which every axis runs alone.
        overridden: A tap on which the feed override acts all the same; `held` one that feed hold stops.
        faster: How much faster than programmed a tap comes out where no override acts on it.
        largest_override: The largest feed override of a tap.
        limits: The machine in it, as the planner's kernels take it: those by which its pieces are laid and planned.
    """

    way: Segment
    row: float
    kind: int
    context: Context
    program: str
    line: int
    rapid: bool
    fixed: bool
    per_revolution: bool
    left: float
    by_axis: bool
    overridden: bool
    held: bool
    faster: float
    largest_override: float
    limits: Limits


@dataclass(slots=True, eq=False)
class Move(Row):
    """A row that is laid out; its pieces are made when their turn comes.

    Attributes:
        asks: Speed that the program asks for up to a share of the way, mm/s; infinite where it asks for none.
        total: Length of its pieces, mm, and `done` the share of those that have been taken.
        prepared: What it has been made from; None for one that begins elsewhere than its program has led the axes.
        grows: A thread whose lead changes: its pieces say what the program asks for.
    """

    asks: tuple[tuple[float, float], ...]
    total: float
    prepared: PreparedRow | None = None
    done: float = 0.0
    grows: bool = False

    def asked(self, share: float) -> float:
        """Speed that the program asks for at a share of the way."""
        if len(self.asks) == 1:
            return self.asks[0][1]
        return next((speed for end, speed in self.asks if share <= end), self.asks[-1][1])


@dataclass(slots=True, eq=False)
class Piece(Row):
    """A piece of the path: a line, a chord of a spline, or 7.5° of an arc.

    Attributes:
        length: Of the piece, mm.
        first: Share of the row that lies before it; `share` is its own.
        cap2: Largest squared speed that the axes allow in it.
        asked: Speed that the program asks for, mm/s; infinite where it asks for none.
        is_coasting: What is run behind a skip signal.
        curve: Where it leads, if it is a chord of a spline or a part of a corner that is rounded.
        rise: By which factor `cap2`, then that at its start, is larger at its end.
    """

    length: float
    first: float
    share: float
    cap2: float
    asked: float
    is_coasting: bool = False
    curve: Cubic | None = None
    rise: float = 1.0

    def at(self, share: float) -> list[float]:
        """Machine position after a share of the piece."""
        if self.curve is not None:
            return self.curve.at(share)
        last = share >= 1.0 and self.first + self.share >= 1.0 - 1e-9
        return self.way.at(1.0 if last else self.first + self.share * share)


#: No action changes the speeds.
UNINFLUENCED = Influence()
Item = Block | BlockEnd | Happening | Standing | Move


@dataclass(slots=True)
class Rates:
    """What the operator has set of the speeds, 1 for 100 %.

    Attributes:
        feed: Feed override.
        rapid: Rapid override.
        spindle: Spindle override.
        dry_run: What a dry run does; None while none is on.
        rapid_held: A feed override of 0 % holds rapids too.
        hold: Feed hold: the axes come to rest.
        feed_cancelled: The feed override is switched off.
        gives_up: Reset or emergency stop: so they do in threads and taps.
        drives_off: Emergency stop, or the power goes off.
    """

    feed: float = 1.0
    rapid: float = 1.0
    spindle: float = 1.0
    dry_run: DryRun | None = None
    rapid_held: bool = False
    hold: bool = False
    feed_cancelled: bool = False
    gives_up: bool = False
    drives_off: bool = False

    def rapid_on(self, move: Row) -> float:
        """Rapid override that acts on a move."""
        if self.rapid_held and self.feed == 0.0 and move.context.feed_override:
            return 0.0
        return self.rapid if move.context.rapid_override else 1.0

    def axis_speed(self, move: Row, top: float, own: Influence = UNINFLUENCED) -> float:
        """Speed of an axis that runs a rapid alone and could go as fast as `top`."""
        if self.gives_up or (self.hold and move.context.feed_hold):
            return 0.0
        return min(top * self.rapid_on(move), self._dry_rapid) * own.factor

    @property
    def _dry_rapid(self) -> float:
        """Largest speed of a rapid in dry run."""
        dry = self.dry_run
        return dry.speed * self.feed if dry is not None and dry.rapids else inf

    def cap2(self, move: Row, cap2: float, asked: float, own: Influence = UNINFLUENCED) -> float:
        """Largest squared speed on a piece of a move, where the axes allow `cap2` and the program asks for `asked`.

        `own` is what the actions of its channel make of it; threads and taps know nothing of that.
        """
        context = move.context
        if self.gives_up:
            return 0.0
        dry = self.dry_run
        if move.fixed:
            asked = dry.speed_for(asked) if dry is not None and dry.with_spindle else asked
            overridden = move.overridden and not self.feed_cancelled
            feed = min(self.feed, move.largest_override) / move.faster if overridden else 1.0
            if move.kind == Kind.THREAD and (dry is None or not dry.with_spindle):
                feed *= context.spindle_factor(self.spindle)
            if feed == 0.0 or (self.hold and move.held):
                return 0.0
            return min(cap2, asked * asked * feed * feed)
        if self.hold and context.feed_hold:
            return 0.0
        if move.by_axis:
            return self.axis_speed(move, 1.0, own) ** 2
        if move.rapid:
            return min(cap2 * self.rapid_on(move) ** 2, self._dry_rapid**2) * min(own.factor, 1.0) ** 2
        if dry is not None and (context.feed_override or move.kind != Kind.SKIP):  # FANUC 6200#7 SKF
            speed = dry.speed_for(asked) * self.feed * own.factor
            return min(cap2, speed * speed)
        feed = (self.feed if context.feed_override else 1.0) * own.factor
        speed = max(asked * feed + own.addend, 0.0) if feed > 0.0 else 0.0
        if move.per_revolution:
            speed *= context.spindle_factor(self.spindle)
        return min(cap2, speed * speed)


class ChannelRates:
    """The speeds of one channel: what the operator has set, and what its actions make of them.

    Args:
        operator: What the operator has set, for all channels.

    Attributes:
        influence: What the actions have last made of it.
        stops: The axes brake on the path, whatever else is set; the rest of the block is dropped then.
    """

    def __init__(self, operator: Rates) -> None:
        self.operator = operator
        self._kept: Rates | None = None
        self._is_inside = False
        self.influence = UNINFLUENCED
        self.stops = False

    @property
    def hold(self) -> bool:
        """Feed hold."""
        return self.operator.hold and not self.finishing

    @property
    def finishing(self) -> bool:
        """Whether strokes are under way that a hold and a reset let come to their end; without power nothing does."""
        return self._is_inside and not self.operator.drives_off

    def enter(self, context: Context) -> bool:
        """Execution comes under a context; true where a section of delayed stops ends with that.

        Such a section keeps the overrides that hold where it begins.
        """
        self._is_inside = context.finishes and (self._is_inside or not self.operator.gives_up)
        if context.stop_delay:
            self._kept = self._kept or replace(self.operator)
            return False
        ended, self._kept = self._kept is not None, None
        return ended

    def _of(self, move: Row) -> Rates:
        """What the operator has set, as far as it concerns a move."""
        if self.finishing and move.context.finishes and self.operator.gives_up:
            return replace(self.operator, gives_up=False)
        kept = self._kept
        return self.operator if kept is None or not move.context.stop_delay or self.gives_up else kept

    @property
    def feed(self) -> float:
        """Feed override."""
        return (self._kept or self.operator).feed * self.influence.factor

    @property
    def spindle(self) -> float:
        """Spindle override."""
        return self.operator.spindle

    @property
    def dry_run(self) -> DryRun | None:
        """What a dry run does; None while none is on."""
        return self.operator.dry_run

    @property
    def gives_up(self) -> bool:
        """Reset or emergency stop."""
        return self.operator.gives_up and not self.finishing

    def cap2(self, move: Row, cap2: float, asked: float) -> float:
        """Largest squared speed on a piece of a move, where the axes allow `cap2` and the program asks for `asked`."""
        return 0.0 if self.stops else self._of(move).cap2(move, cap2, asked, self._own(move))

    def moves(self, piece: Piece) -> bool:
        """Whether neither a hold nor an override of 0 keeps the axes from moving along a piece."""
        return self.cap2(piece, piece.cap2, piece.asked) > 0.0

    def axis_speed(self, move: Row, top: float) -> float:
        """Speed of an axis that runs a rapid alone and could go as fast as `top`."""
        return 0.0 if self.stops else self._of(move).axis_speed(move, top, self._own(move))

    def _own(self, move: Row) -> Influence:
        """What actions make of a move: the least override of the axes that it moves counts too."""
        own = self.influence
        if not own.of_axes:
            return own
        start, end = move.way.start, move.way.end
        least = min(
            (share for column, share in own.of_axes.items() if start[column] != end[column]), default=1.0
        )
        return Influence(own.factor * least, own.addend * least)
