"""The stage of the path in which the feed takes its course over a block (FLIN, FCUB, FPO).

A move becomes slices with constant feeds that take as long as the course. The spline of FCUB needs the blocks around
it, so a row of such blocks is held until another one comes.
"""

from __future__ import annotations

from math import hypot

from polycnc.channel.moves import knots
from polycnc.channel.moves.move_path import MovePath
from polycnc.channel.moves.path import EndOfBlock, Item, Move, PlacedEvent, Rank, Stage
from polycnc.control.sinumerik.feed import profiles
from polycnc.control.sinumerik.feed.profiles import Course, Profile
from polycnc.control.sinumerik.tables import CONSTANT, CUBIC
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Event
from polycnc.toolpath.kinds import Kind
from polycnc.toolpath.modes import FeedMode

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel

#: So many blocks of FCUB are held; then the first ones go, since what comes hardly bends the spline so far back.
MOST_BLOCKS, RELEASED = 64, 48
#: No slice lasts less, seconds.
_LEAST_S = 0.004
SHAPED = frozenset((Kind.SPLINE, *knots.DIVISIBLE))


@dataclass(frozen=True, slots=True)
class TellsFeed(Event):
    """What the running block says of its feed, in order with the moves; no stage behind sees it."""

    profile: Profile


@dataclass(slots=True)
class _Block:
    """A block that is held: what it says of its feed, and all that has come of it."""

    profile: Profile | None = None
    items: list[Item] = field(default_factory=list)
    lengths: list[float] = field(default_factory=list)

    @property
    def length(self) -> float:
        return sum(self.lengths)

    @property
    def course(self) -> Course | None:
        return None if self.profile is None else profiles.course_of(self.profile)


class ProfileStage(Stage):
    """Gives moves the course of their feed."""

    rank = Rank.FEED

    def __init__(self, channel: SinumerikChannel) -> None:
        self._channel = channel
        self._held: list[_Block] = []
        self._open = _Block()
        #: Slope over the way, and its end, of the course before those that are held.
        self._slope = 0.0

    @property
    def active(self) -> bool:
        """Whether blocks have a profile or some are held."""
        return bool(self._held or self._open.items) or self._channel.mode["feed_profile"] != CONSTANT

    def event(self, event: PlacedEvent) -> None:
        """Take what a block says of its feed; other events keep their place."""
        if isinstance(event.event, TellsFeed):
            self._open.profile = event.event.profile
        else:
            self._open.items.append(event)

    def move(self, move: Move) -> None:
        """Take a move of the open block."""
        self._open.items.append(move)
        if move.kind in SHAPED:
            self._open.lengths.append(self._length(move))

    def _length(self, move: Move) -> float:
        """Way of the tool; 0 where only other axes move."""
        if move.center is not None:
            return MovePath(move, self._channel.coordinates.geometry).length
        columns = [i for i in self._channel.coordinates.geometry if i >= 0]
        return hypot(*(move.end[i] - move.start[i] for i in columns))

    def block(self) -> None:
        """The open block is whole."""
        block, self._open = self._open, _Block()
        block.items.append(EndOfBlock())
        moves = bool(block.lengths)
        if self._held and not moves and not any(isinstance(item, Move) for item in block.items):
            self._held[-1].items += block.items
        elif moves and block.profile is not None and block.profile.kind == CUBIC and block.length > 0.0:
            self._held.append(block)
            if len(self._held) >= MOST_BLOCKS:
                self._release(RELEASED)
        else:
            self._close(block)

    def flush(self) -> None:
        """Nothing more comes that could bend the feed."""
        block, self._open = self._open, _Block(self._open.profile)
        self._close(block)
        self.after.flush()

    def _close(self, block: _Block) -> None:
        """A block ends the row of those that are held, and goes behind them."""
        if block.profile is not None and block.profile.kind == CUBIC and block.length > 0.0:
            self._held.append(block)
            self._release(len(self._held))
            return
        course = block.course
        if self._held:
            after = course.slope(0.0) / block.length if course is not None and block.length > 0.0 else 0.0
            self._release(len(self._held), after)
        if block.length > 0.0:
            self._slope = course.slope(1.0) / block.length if course is not None else 0.0
        self._write(block, course)

    def _release(self, count: int, after: float = 0.0) -> None:
        """Write the first of the held blocks, by the spline of all."""
        held = self._held
        told = [block.profile for block in held if block.profile is not None]
        feeds = [told[0].first, *(profile.end for profile in told)]
        courses = profiles.spline(feeds, [block.length for block in held], self._slope, after)
        for block, course in zip(held[:count], courses, strict=False):
            self._write(block, course)
        self._slope = courses[count - 1].slope(1.0) / held[count - 1].length
        self._held = held[count:]

    def _write(self, block: _Block, course: Course | None) -> None:
        if course is None or len(block.lengths) == 0:
            for item in block.items:
                self.pass_on(item)
            return
        total, lengths = block.length, iter(block.lengths)
        done = 0.0
        for item in block.items:
            if not isinstance(item, Move) or item.kind not in SHAPED:
                self.pass_on(item)
                continue
            length = next(lengths)
            share = length / total if total > 0.0 else 1.0 / len(block.lengths)
            if total > 0.0 and length == 0.0:
                self.after.move(item)  # other axes turn while the tool stands
                continue
            self._shape(item, course, done, min(done + share, 1.0), length)
            done += share

    def _shape(self, move: Move, course: Course, first: float, last: float, length: float) -> None:
        """Cut a move that makes a stretch of the block's way, and give the pieces their feeds."""
        width = last - first
        timed = self._channel.toolpath.contexts[move.context].feed_mode is FeedMode.INVERSE_TIME
        if not knots.is_divisible(move):
            feed = course.at(last) if last >= 1.0 else course.mean(first, last)
            move.feed = feed / width if timed else feed
            self.after.move(move)
            return
        mean = course.mean(first, last)
        seconds = width / mean if timed else length / mean
        ends = course.slices(most=max(int(seconds / _LEAST_S), 1))
        parts = [(end - first) / width for end in ends if first < end < last - 1e-12] + [1.0]
        move.feed = course.at(last)
        before = 0.0
        for piece, part in zip(knots.cut(self._channel, move, parts), parts, strict=True):
            a, b = first + width * before, first + width * part
            feed = course.mean(a, b) if b < 1.0 else course.at(1.0)
            piece.feed = feed / (b - a) if timed else feed
            self.after.move(piece)
            before = part
