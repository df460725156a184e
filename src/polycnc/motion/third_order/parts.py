"""A part of a programmed path, bent: flat arrays, without numpy."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.third_order.bends.bending import NO_ROOM, NOT_WITHIN
from polycnc.motion.third_order.bends.controls import Spline
from polycnc.motion.third_order.bends.keeping import VECTORS, Kept
from polycnc.motion.third_order.bends.knots import Samples
from polycnc.motion.third_order.bends.pieces import Pieces
from polycnc.motion.third_order.bends.seams import BESIDES, KNOWN, SIDE, first_piece, pieces_behind
from polycnc.motion.third_order.bends.stretches import Stretches
from polycnc.motion.third_order.bends.turning import Turning
from polycnc.motion.third_order.compiled import kernels

if TYPE_CHECKING:
    from polycnc.kernels.layout import Floats, Ints

#: Room for knots: a stretch has so many at first, and the path so many besides; fourfold where that is too little.
PER_STRETCH, OTHERS = 3, 64
#: How much more room there is than is asked for, so that it seldom grows.
SPARE = 1.25


class Seam(NamedTuple):
    """A place at which a path is bent in parts: its way, and the distance of the knots around it."""

    way: float
    apart: float


class Part(NamedTuple):
    """A cubic spline of m pieces by the way, from a seam or a rest to the next: what `BentPath` has, flat.

    Attributes:
        way: At the knots, mm, m + 1 numbers from 0 on.
        place: Positions of the n axes there, (m + 1)·n.
        first: q' there.
        second: q'' there.
        cap2: Largest square of the speed on each piece, m.
        corner2: That by parameters for corners near it, and by what the program leaves the rows near it, m.
        ease: The part of acceleration and jerk that may be used there, m.
        row: Number of the row of each piece, m; of several the first.
        rows: Numbers of the rows that end in the part, r.
        row_way: The ways at which they do, r.
    """

    way: Floats
    place: Floats
    first: Floats
    second: Floats
    cap2: Floats
    corner2: Floats
    ease: Floats
    row: Ints
    rows: Ints
    row_way: Floats


def cut_out(path: Stretches, first: int, end: int, origin: float) -> Stretches:
    """The stretches from one to before another; their ways are counted from `origin`."""
    cut = part_of(path, first, end)
    if origin != 0.0:
        kernels().shift_ways(path.way, first, end - first + 1, origin, cut.way, 0)
    return cut


def part_of(path: Stretches, first: int, end: int) -> Stretches:
    """The stretches from one to before another; their ways go on."""
    n, own = len(path.rotary), slice(first, end)
    vectors = slice(first * n, end * n)
    return Stretches(
        path.way[first : end + 1],
        path.place[first * n : (end + 1) * n],
        path.leave[vectors],
        path.arrive[vectors],
        path.form[own],
        path.tolerance[own],
        path.turn_tolerance[own],
        path.cap2[own],
        path.step2[own],
        path.spread2[own],
        path.left2[own],
        path.ease[own],
        path.row[own],
        path.rotary,
        path.top,
    )


def known_from(path: Stretches, seam: Seam) -> int:
    """The first stretch that a part which begins at a seam must know."""
    return max(bisect_right(path.way, seam.way - KNOWN * seam.apart) - 1 - BESIDES, 0)


def known_to(path: Stretches, seam: Seam) -> int:
    """The stretch behind the last one that a part which ends at a seam must know."""
    return min(bisect_left(path.way, seam.way + KNOWN * seam.apart) + BESIDES, len(path.form))


class Room:
    """Room in which parts are bent, one behind the other; it grows with the largest of them.

    Attributes:
        smooth: `bend_path` says what these are for.
        turning: Likewise.
        samples: Likewise.
        spline: Likewise.
        pieces: Likewise.
        before: Likewise.
        rows: Rows that end in a part.
        ways: Where they do.
    """

    def __init__(self) -> None:
        self._stretches = self._knots = self._axes = 0

    def for_stretches(self, count: int, n: int) -> None:
        """Make room for so many stretches of n axes, and as many knots as they have at first."""
        if count > self._stretches:
            self._stretches = count = int(SPARE * count)
            self.smooth, self.turning = whole(count + 1), turning_for(count)
            self.rows, self.ways = whole(count), numbers(count)
        self.for_knots(PER_STRETCH * count + OTHERS, n)

    def for_knots(self, count: int, n: int) -> None:
        """Make room for so many knots of n axes."""
        if count > self._knots or n > self._axes:
            self._knots, self._axes = count, n
            self.samples = Samples(numbers(count), numbers(count), *(whole(count) for _ in range(3)))
            self.spline, self.before = spline_for(count, n), numbers(count * (Kept.SIZE + VECTORS * n))
            self.pieces = Pieces(numbers(count), numbers(count), numbers(count), whole(count))

    def widen(self) -> None:
        """The knots need more."""
        self.for_knots(4 * self._knots, self._axes)


def bend_between(path: Stretches, head: Seam | None, tail: Seam | None, room: Room | None = None) -> Part:
    """Bend a path between two seams, or from rest, or to rest.

    Args:
        path: The path, no further than it must be known beyond the seams; from rest it begins there. Tangents of
            lines that are chords of a curve may be set.
        head: The seam at which it begins; none from rest.
        tail: The seam at which it ends; none to rest.
        room: Of parts that are bent one behind the other.

    Raises:
        ValueError: The tolerance is not kept: it is too small for the numbers of the path. Or the seams overlap.
    """
    if head is not None and tail is not None and tail.way - head.way <= SIDE * (head.apart + tail.apart):
        msg = f"a seam at {tail.way} mm lies too near to that at {head.way} mm"
        raise ValueError(msg)
    if head is None and tail is None and path.way[0] == 0.0:
        return bent_part(path, array("d", (0.0, 0.0, 0.0, 0.0)), room or Room())
    first = 0 if head is None else known_from(path, head)
    end = len(path.form) if tail is None else known_to(path, tail)
    origin = path.way[0] if head is None else head.way
    seams = array("d", (0.0, 0.0, 0.0, 0.0))
    if head is not None:
        seams[0:2] = array("d", (0.0, head.apart))
    if tail is not None:
        seams[2:4] = array("d", (tail.way - origin, tail.apart))
    return bent_part(cut_out(path, first, end, origin), seams, room or Room())


def bent_part(path: Stretches, seams: array[float], room: Room) -> Part:
    """Bend a path between its `Seams`; its tangents are set, its ways count from the start of the part.

    Raises:
        ValueError: The tolerance is not kept.
    """
    n, told = len(path.rotary), whole(4)
    room.for_stretches(len(path.form), n)
    while True:
        spline, pieces = room.spline, room.pieces
        found = kernels().bend_path(
            path, seams, room.smooth, room.turning, room.samples, spline, pieces,
            room.before, room.rows, room.ways, told,
        )  # fmt: skip
        if found != NO_ROOM:
            break
        room.widen()
    if found == NOT_WITHIN:
        msg = f"rows {path.row[0]} to {path.row[-1]} cannot be bent within their tolerance"
        raise ValueError(msg)
    low, high = first_piece(seams), found - pieces_behind(seams)
    of_knots = slice(low * n, (high + 1) * n)
    ended = told[3]
    return Part(
        spline.way[low : high + 1],
        spline.place[of_knots],
        spline.first[of_knots],
        spline.second[of_knots],
        pieces.cap2[low:high],
        pieces.corner2[low:high],
        pieces.ease[low:high],
        pieces.row[low:high],
        room.rows[:ended],
        room.ways[:ended],
    )


def turning_for(count: int) -> Turning:
    """Room for the turning of so many stretches."""
    before, behind, area = (numbers(count + 1) for _ in range(3))
    return Turning(before, behind, area, *(numbers(count) for _ in range(3)))


def spline_for(room: int, n: int) -> Spline:
    """Room for a spline of so many knots."""
    way, apart, moved = (numbers(more) for more in (room, room, room + 3))
    vectors = (numbers((room + 3) * n) for _ in range(4))
    return Spline(way, apart, moved, whole(room), whole(room), whole(room), *vectors)


def numbers(count: int) -> array[float]:
    """Room for so many numbers."""
    return array("d", (0.0,)) * count


def whole(count: int) -> array[int]:
    """Room for so many whole numbers."""
    return array("q", (0,)) * count
