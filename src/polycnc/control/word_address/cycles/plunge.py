"""The rows of a hole written at once.

Holes of one cycle have the same strokes, and a stroke along the drilling axis at rapid or at feed is a row in which
only that axis has another place. So the rows of a hole are worked out once, as columns, and the next hole brings only
where it lies. Whatever else may happen in a hole (a dwell, the spindle, a halt, a limit, a stage that looks at moves)
leaves it to the strokes, which are made one by one; dwells of one length the scanner knows too (`holes_as_data`).
"""

from __future__ import annotations

from array import array
from functools import lru_cache
from math import nan

from polycnc.channel.moves.travel import check_point
from polycnc.cycles.drilling.holes import Action
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import FARTHEST, NO_WAY
from polycnc.messages import AlarmError
from polycnc.toolpath import Kind
from polycnc.toolpath.table import CHUNK_ROWS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.cycles.drilling.holes import Cycle, Hole

#: Strokes of a hole that count as one block for the block limit.
STROKES_OF_A_BLOCK = 4
#: A hole with more strokes is made one by one.
MOST_STROKES = 1_000


class Plunge(NamedTuple):
    """The strokes of a hole as columns.

    Attributes:
        kinds: Kind of each row; `feeds` and `levels`, the place on the drilling axis, likewise.
        end: Place behind the last stroke.
        dwell: Seconds of each dwell among them, whose rows have them in place of a feed; 0 where there is none.
        blocks: How many blocks the hole counts beside its own.
    """

    kinds: array[int]
    feeds: array[float]
    levels: array[float]
    end: float
    blocks: int
    dwell: float = 0.0


def plunges(channel: Channel, axis: int, cycle: Cycle, hole: Hole) -> bool:
    """Write the rows of a hole below the tool; false, and nothing done, where its strokes are to be made one by one."""
    c = channel.coordinates
    if not c.direct or channel.path.head is not None or channel.single_block:
        return False
    position = c.position
    level = position[axis]
    plunge = plunge_of(cycle, hole, level, channel.feed)
    chunk = channel.toolpath.chunk
    if plunge is None or plunge.dwell or len(chunk) + len(plunge.levels) >= CHUNK_ROWS:
        return False
    if channel.blocks + plunge.blocks >= channel.block_limit or not _is_free(channel, axis, plunge.levels):
        return False
    channel.blocks += plunge.blocks
    channel.attention |= channel.blocks > channel.joined_below  # blocks behind it run with the limit in sight
    chunk.add_along(
        axis, plunge.levels, plunge.kinds, channel.level.program_number, channel.line,
        channel.context_number(), plunge.feeds, position,
    )  # fmt: skip
    c.pending[axis] = 0.0
    end = position[:]
    end[axis] = plunge.end
    c.arrive(end, end)
    return True


def _is_free(channel: Channel, axis: int, levels: array[float]) -> bool:
    """Whether nothing refuses a way along an axis between some places: then nothing refuses what lies between them."""
    c = channel.coordinates
    if channel.boundary is not None or c.transformation is not None or not levels:
        return False
    end = c.position[:]
    for end[axis] in (min(levels), max(levels)):
        if not -FARTHEST < sum(end) < FARTHEST:
            return False
        if channel.limits:
            try:
                check_point(channel, c.to_machine(end))
            except AlarmError:
                return False
    return True


def plunge_of(cycle: Cycle, hole: Hole, level: float, feed: float) -> Plunge | None:
    """The strokes of a cycle as columns; None where they are more than ways along the axis and dwells of one length.

    Args:
        cycle: What the tool does.
        hole: Its levels.
        level: Where the tool stands.
        feed: Feed in force.
    """
    # The levels as they are stored, too: zero and minus zero are equal, and two rows.
    stored = array("d", (hole.initial, hole.r, hole.bottom, hole.back, level)).tobytes()
    return _plunge(cycle, hole, level, feed, stored)


@lru_cache(maxsize=64)
def _plunge(cycle: Cycle, hole: Hole, level: float, feed: float, _bits: bytes) -> Plunge | None:
    kinds, feeds, levels = array("B"), array("d"), array("d")
    blocks, dwell = 0, 0.0
    for number, stroke in enumerate(cycle(hole)):
        blocks += number % STROKES_OF_A_BLOCK == STROKES_OF_A_BLOCK - 1
        if stroke.action is Action.DWELL:
            if stroke.value > 0.0:
                if dwell not in (0.0, stroke.value):
                    return None
                dwell = stroke.value
                kinds.append(Kind.DWELL)
                feeds.append(dwell)
                levels.append(level)
            continue
        at_feed = stroke.action is Action.FEED
        own_feed = feed * stroke.factor if at_feed else nan
        if not (at_feed and own_feed > 0.0) and stroke.action is not Action.RAPID:
            return None
        if stroke.overlaps is not None or number > MOST_STROKES:
            return None
        if not abs(stroke.value - level) <= NO_WAY:
            kinds.append(Kind.FEED if at_feed else Kind.RAPID)
            feeds.append(own_feed)
            levels.append(stroke.value)
        level = stroke.value
    return Plunge(kinds, feeds, levels, level, blocks, dwell)
