"""The kernel that bends a path: its parts in turn, until it keeps to the tolerance."""

from __future__ import annotations

from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.controls import Spline, lay_controls, shape
from polycnc.motion.third_order.bends.keeping import VECTORS, Kept, forget, keep, take_over
from polycnc.motion.third_order.bends.knots import Samples, even_out, place_knots, take_samples
from polycnc.motion.third_order.bends.levelling import level
from polycnc.motion.third_order.bends.pieces import Pieces, bound_pieces, cut_pieces, end_rows, take_left
from polycnc.motion.third_order.bends.seams import first_piece, pieces_behind
from polycnc.motion.third_order.bends.stretches import Stretches, curve_lines
from polycnc.motion.third_order.bends.turning import Turning, measure, sum_turning
from polycnc.motion.third_order.bends.within import weigh_excess

#: Times that knots are placed anew because the tolerance was exceeded somewhere; the first of them with levelling.
ROUNDS, LEVELLED = 16, 6
#: What the kernel gives where there is no room, and where the tolerance is not kept.
NO_ROOM, NOT_WITHIN = -1, -2


def bend_path(
    path: Stretches,
    seams: Floats,
    smooth: Ints,
    turning: Turning,
    samples: Samples,
    spline: Spline,
    pieces: Pieces,
    before: Floats,
    rows: Ints,
    ways: Floats,
    told: Ints,
) -> int:
    """Bend a path within its tolerance.

    Args:
        path: It; the tangents of lines that are chords of a curve are set.
        seams: `Seams`; the path reaches beyond them, and what lies there of the spline is of no use.
        smooth: Room for a number for each end of a stretch.
        turning: Room.
        samples: Room.
        spline: Room, filled in.
        pieces: Likewise.
        before: Room for what a round leaves to the next (`keeping.py`).
        rows: Room for a number for each stretch: the rows that end between the seams.
        ways: The same: where they do.
        told: Set to rounds, places that exceeded the tolerance at first, samples, rows that end.

    Returns:
        Number of pieces of the spline, or NO_ROOM or NOT_WITHIN.
    """
    n = len(path.rotary)
    curve_lines(path, n, smooth)
    measure(path, n, smooth, turning)
    kept, width = 0, Kept.SIZE + VECTORS * n
    for number in range(ROUNDS):
        sum_turning(path, turning)
        count = take_samples(path, turning, seams, samples)
        if count < 0:
            return NO_ROOM
        even_out(samples, count)
        made = place_knots(samples, count, seams, spline) - 1
        if made < 0 or (made + 3) * n > len(spline.control) or (made + 1) * width > len(before):
            return NO_ROOM
        lay_spline(path, n, spline, made, number, before, kept)
        found = weigh_excess(path, n, spline, made, seams, turning, number)
        told[0], told[2] = number, count
        if number == 0:
            told[1] = found
        if found == 0:
            first, last = first_piece(seams), made - pieces_behind(seams)
            told[3] = end_rows(path, spline.way[first], spline.way[last], rows, ways)
            return put_pieces(path, n, spline, made, first, last, pieces)
        keep(spline, n, made, before)
        kept = made
    return NOT_WITHIN


def lay_spline(
    path: Stretches, n: int, spline: Spline, made: int, number: int, before: Floats, kept: int
) -> None:
    """Find the spline of so many pieces; the round before has kept `kept` ones."""
    if number == 0:
        forget(spline, made)
    else:
        take_over(spline, n, made, before, kept)
    lay_controls(path, n, spline, made)
    shape(spline, n, made)
    if number < LEVELLED:
        level(path, n, spline, made)


def put_pieces(
    path: Stretches, n: int, spline: Spline, made: int, first: int, last: int, pieces: Pieces
) -> int:
    """Cut the pieces of a spline from one to before another, and bound all; their number, NO_ROOM without room."""
    take_left(path, spline, made, pieces)
    made = cut_pieces(path, n, spline, made, first, last, pieces)
    if made < 0:
        return NO_ROOM
    bound_pieces(path, n, spline, made, pieces)
    return made
