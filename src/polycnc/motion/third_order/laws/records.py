"""From a law along a bent path to records of pieces, and to the times of rows.

A record is a part of the path that lies in one phase of the law, one piece of the spline and one row: the place is a
cubic by the way, and the way a cubic by the time. Both kernels go along a law from where a `Walk` is, which they move
on: records come in batches, and the phases of a long run window by window.
"""

from __future__ import annotations

from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Floats, Ints, record
from polycnc.motion.kernels.columns import PIECE_BLOCKS, PLACES, Form, PieceRecord
from polycnc.motion.third_order.laws.courses import Phase
from polycnc.motion.third_order.laws.phases import gone, reached

#: Two places nearer than this are one, mm; a slower speed is rest, mm/s.
NEAR, STILL = 1e-9, 1e-9


class Track(NamedTuple):
    """A bent path of m pieces and n axes, as flat arrays, which may be longer.

    Attributes:
        way: At its knots, mm (m + 1).
        place: Positions there, (m + 1) · n.
        first: q' there.
        second: q'' there.
        cap2: Largest square of the speed on each piece (m).
    """

    way: Floats
    place: Floats
    first: Floats
    second: Floats
    cap2: Floats


class RowEnds(NamedTuple):
    """The rows of a path in order: the way at which each ends, mm, its number, and the slot where its time counts."""

    way: Floats
    row: Ints
    slot: Ints


@record
class Walk(Structure):
    """How far a kernel has come along a law. Each kernel has its own.

    Where the law goes on in other arrays, `phases` and `phase` are set anew for these; the rest stays.

    Attributes:
        axes: n.
        pieces: m of the path.
        phases: Of the law, up to before which to go.
        phase: The phase at hand.
        piece: The piece at hand.
        row: The row at hand, as an index of `RowEnds`.
        now: Seconds of the phase that are over.
        way: The way there, mm.
    """

    axes: int
    pieces: int
    phases: int
    phase: int
    piece: int
    row: int
    now: float
    way: float


def put_records(track: Track, phases: Floats, rows: RowEnds, walk: Walk, records: Floats) -> int:
    """Write the records of the next parts.

    Args:
        track: The path.
        phases: The law along it, or a part of it; `Phase`.
        rows: Its rows.
        walk: From where on; moved behind the last part.
        records: Room for at least one record.

    Returns:
        Number of records; none where the phases are over.
    """
    width, count = PieceRecord.VECTORS + PIECE_BLOCKS * walk.axes, 0
    while (count + 1) * width <= len(records) and step_on(phases, rows, walk):
        while walk.piece + 1 < walk.pieces and track.way[walk.piece + 1] <= walk.way + NEAR:
            walk.piece += 1
        is_last = walk.piece + 1 >= walk.pieces
        end = track.way[walk.piece + 1]
        until, way = end_of_part(phases, rows, walk, inf if is_last else end)
        if is_last and way > end - NEAR:
            way = end
        at = count * width
        put_motion(phases, walk, until, records, at)
        records[at + PieceRecord.LENGTH] = way - walk.way
        records[at + PieceRecord.CAP2] = track.cap2[walk.piece]
        records[at + PieceRecord.ROW] = rows.row[walk.row]
        records[at + PieceRecord.SLOT] = rows.slot[walk.row]
        put_point(track, walk.axes, walk.piece, walk.way, records, at, 0)
        put_point(track, walk.axes, walk.piece, way, records, at, 1)
        walk.now, walk.way = until, way
        count += 1
    return count


def add_times(
    phases: Floats, rows: RowEnds, walk: Walk, slots: Floats, times: Floats, first_row: int
) -> None:
    """Add up how long rows take; no records are needed for that.

    Args:
        phases: The law, or a part of it; `Phase`.
        rows: The rows of the path.
        walk: From where on; moved to the end of the phases. Its pieces do not count.
        slots: Seconds and length of every slot, in turn; those of the rows are added.
        times: Seconds and length of every row from `first_row` on, in turn; likewise.
        first_row: Number of the first row in `times`.
    """
    while step_on(phases, rows, walk):
        until, way = end_of_part(phases, rows, walk, inf)
        slot, row = 2 * rows.slot[walk.row], 2 * (rows.row[walk.row] - first_row)
        slots[slot] += until - walk.now
        slots[slot + 1] += way - walk.way
        times[row] += until - walk.now
        times[row + 1] += way - walk.way
        walk.now, walk.way = until, way


def step_on(phases: Floats, rows: RowEnds, walk: Walk) -> bool:
    """Go on to the phase and the row of the part at hand; false where the phases are over."""
    while walk.phase < walk.phases and walk.now >= phases[walk.phase * Phase.SIZE + Phase.TIME]:
        walk.phase, walk.now = walk.phase + 1, 0.0
    while walk.row + 1 < len(rows.way) and rows.way[walk.row] <= walk.way + NEAR:
        walk.row += 1
    return walk.phase < walk.phases


def end_of_part(phases: Floats, rows: RowEnds, walk: Walk, limit: float) -> tuple[float, float]:
    """Where a part ends that goes no further than to a way: seconds from the start of its phase, and the way."""
    at = walk.phase * Phase.SIZE
    time = phases[at + Phase.TIME]
    if walk.phase + 1 < walk.phases:
        end = phases[at + Phase.SIZE + Phase.WAY]
    else:
        end = phases[at + Phase.WAY] + gone(phases, at, time)
    if walk.row + 1 < len(rows.way):
        limit = min(limit, rows.way[walk.row])
    if limit > end - NEAR:
        return time, end
    return reached(phases, at, walk.now, limit), limit


def put_motion(phases: Floats, walk: Walk, until: float, records: Floats, at: int) -> None:
    """Write how a part is run: of the phase at hand the time up to `until`."""
    phase, seconds = walk.phase * Phase.SIZE, until - walk.now
    jerk = phases[phase + Phase.JERK]
    pull = phases[phase + Phase.PULL] + walk.now * jerk
    speed = speed_after(phases, phase, walk.now)
    end = speed_after(phases, phase, until)
    if until >= phases[phase + Phase.TIME] and walk.phase + 1 < walk.phases:
        end = phases[phase + Phase.SIZE + Phase.SPEED]
    peak = max(speed, end)
    if jerk < 0.0 < pull < -jerk * seconds:
        peak = max(peak, speed - 0.5 * pull * pull / jerk)
    for field in range(PieceRecord.VECTORS):
        records[at + field] = 0.0
    records[at + PieceRecord.FORM], records[at + PieceRecord.MARGIN] = Form.JERKED, 1.0
    records[at + PieceRecord.TIME] = seconds
    records[at + PieceRecord.PULL], records[at + PieceRecord.JERK] = pull, jerk
    records[at + PieceRecord.ENTRY2] = records[at + PieceRecord.REACH2] = speed * speed
    records[at + PieceRecord.SPEED2], records[at + PieceRecord.END2] = speed * speed, end * end
    records[at + PieceRecord.PEAK2] = peak * peak
    records[at + PieceRecord.HOLD2] = records[at + PieceRecord.HOLD_PULL] = inf
    records[at + PieceRecord.PATH_PULL] = inf


def speed_after(phases: Floats, at: int, time: float) -> float:
    """The speed in a phase after some time."""
    speed = phases[at + Phase.SPEED] + time * (phases[at + Phase.PULL] + 0.5 * time * phases[at + Phase.JERK])
    return speed if speed > STILL else 0.0


def put_point(track: Track, n: int, p: int, way: float, records: Floats, at: int, end: int) -> None:
    """Write q', q'' and place of piece p at a way: as those of the start of a part (0) or of its end (1)."""
    length, to = track.way[p + 1] - track.way[p], at + PieceRecord.VECTORS + end * n
    knot = p + 1 if way == track.way[p + 1] else p
    t = way - track.way[knot]
    for i in range(n):
        q, third = knot * n + i, (track.second[p * n + n + i] - track.second[p * n + i]) / length
        first, second = track.first[q], track.second[q]
        records[to + i] = first + t * (second + 0.5 * t * third)
        records[to + 2 * n + i] = second + t * third
        records[to + PLACES * n + i] = track.place[q] + t * (first + t * (0.5 * second + t * third / 6.0))
