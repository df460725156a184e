"""What the interpreter has prepared and the main run has still to do, in order."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from polycnc.channel.intervention import NOTHING_BACK

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.intervention import TakesBack
    from polycnc.mainrun.geometry import Way
    from polycnc.toolpath import Context, Event


@dataclass(frozen=True, slots=True)
class Block:
    """A block begins.

    Attributes:
        program: Name of its program.
        line: Its line in that program's file.
        modal: Active code of every modal group behind it.
        takes_back: What it takes back of a manual intervention.
    """

    program: str
    line: int
    modal: Mapping[str, str]
    takes_back: TakesBack = NOTHING_BACK


@dataclass(frozen=True, slots=True)
class BlockEnd:
    """A block is over; single block operation halts here. `code` is its N word, or its line."""

    code: str


@dataclass(frozen=True, slots=True)
class Happening:
    """An event of the program. `stands` says whether the axes stand still for it."""

    event: Event
    context: Context
    stands: bool


@dataclass(frozen=True, slots=True)
class Standing:
    """The axes stand for a time. `why` is a share of `motion.Times` (`dwell_s`, `spindle_s` …)."""

    why: str
    seconds: float
    context: Context


@dataclass(slots=True, eq=False)
class Piece:
    """A piece of the path: a line, a chord, or 7.5° of an arc.

    Attributes:
        way: The row that it is a part of; `row` is its number.
        length: Of the piece, mm.
        first: Share of the row that lies before it; `share` is its own.
        kind: Kind of the row.
        context: What holds in it.
        program: Name of the program; `line` the line in its file.
        entry2: Largest squared speed at its start that its neighbours' geometry allows.
        cap2: Largest squared speed that the axes allow in it.
        asked: Speed that the program asks for, mm/s; infinite where it asks for none.
        rapid: Runs at rapid traverse.
        fixed: Bound to the spindle (thread, tap): no override, no feed hold, but for what follows.
        overridden: A tap on which the feed override acts all the same; `held` one that feed hold stops.
        faster: How much faster than programmed a tap comes out where no override acts on it.
        largest_override: The largest feed override of a tap.
        per_revolution: Its speed follows the spindle.
        left: Way from its end to the programmed end of a skip move that a signal cuts there, mm.
        is_coasting: What is run behind a skip signal.
        by_axis: A rapid on which every axis runs alone.
    """

    way: Way
    row: int
    length: float
    first: float
    share: float
    kind: int
    context: Context
    program: str
    line: int
    entry2: float
    cap2: float
    asked: float
    rapid: bool
    fixed: bool
    per_revolution: bool
    left: float
    by_axis: bool
    is_coasting: bool = False
    overridden: bool = False
    held: bool = False
    faster: float = 1.0
    largest_override: float = inf

    def at(self, share: float) -> list[float]:
        """Machine position after a share of the piece."""
        last = share >= 1.0 and self.first + self.share >= 1.0 - 1e-9
        return self.way.at(1.0 if last else self.first + self.share * share)


Item = Block | BlockEnd | Happening | Standing | Piece


@dataclass(slots=True)
class Rates:
    """What the operator has set of the speeds, 1 for 100 %.

    Attributes:
        feed: Feed override.
        rapid: Rapid override.
        spindle: Spindle override.
        dry_run: Speed of feed moves in dry run at 100 %, mm/s; 0 for off.
        hold: Feed hold: the axes come to rest.
        feed_cancelled: The feed override is switched off.
        gives_up: Reset or emergency stop: so they do in threads and taps.
    """

    feed: float = 1.0
    rapid: float = 1.0
    spindle: float = 1.0
    dry_run: float = 0.0
    hold: bool = False
    feed_cancelled: bool = False
    gives_up: bool = False

    def rapid_on(self, piece: Piece) -> float:
        """Rapid override that acts on a piece."""
        return self.rapid if piece.context.rapid_override else 1.0

    def cap2(self, piece: Piece) -> float:
        """Largest squared speed on a piece."""
        if self.gives_up:
            return 0.0
        if piece.fixed:
            overridden = piece.overridden and not self.feed_cancelled
            feed = min(self.feed, piece.largest_override) / piece.faster if overridden else 1.0
            if feed == 0.0 or (self.hold and piece.held):
                return 0.0
            return min(piece.cap2, piece.asked * piece.asked * feed * feed)
        if self.hold and piece.context.feed_hold:
            return 0.0
        if piece.by_axis:
            return self.rapid_on(piece) ** 2
        if piece.rapid:
            return piece.cap2 * self.rapid_on(piece) ** 2
        if self.dry_run:
            speed = self.dry_run * self.feed
            return min(piece.cap2, speed * speed)
        feed = self.feed if piece.context.feed_override else 1.0
        speed = piece.asked * feed if feed > 0.0 else 0.0
        if piece.per_revolution and piece.context.spindle_override:
            speed *= self.spindle
        return min(piece.cap2, speed * speed)
