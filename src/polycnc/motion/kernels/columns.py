"""What the kernels share: the numbers of kinds and fields, and the columns that they read and write."""

from __future__ import annotations

from collections.abc import MutableSequence
from typing import NamedTuple

Floats = MutableSequence[float]
Ints = MutableSequence[int]

# Numbers of the row kinds (`toolpath.Kind`), as plain integers that a compiler can fold.
RAPID, CW, CCW, HELIX_CW, HELIX_CCW, SPLINE, THREAD, TAP, REF, DWELL, EVENT = 0, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12
CURVE_WIDTH = 8

# Fields of one context in the flat table of contexts; `OFFSETS` and the numbers behind it are one for each axis.
PER_REVOLUTION, INVERSE_TIME, RPM, SURFACE_MM_S, RPM_LIMIT, SPINDLE_REV_S2 = 0, 1, 2, 3, 4, 5
EXACT_STOP, TOLERANCE, ROTARY_WEIGHT, STATION, HAS_FRAME, MIRROR, FRAME, OFFSETS = 6, 7, 8, 9, 10, 11, 12, 24

# What is carried from row to row (`State.now`) and from piece to piece.
STOP, EXIT2, ROW_LENGTH, METRIC, AT_STATION, SMOOTH = 0, 1, 2, 3, 4, 5
# Counters (`State.count`).
PIECES, WITHOUT_FEED = 0, 1

STRAIGHT, CURVED, TIMED = 0, 1, 2

#: Pieces of a full turn. Over 7.5° an axis exceeds what holds at both ends by at most the margins below.
PIECES_PER_TURN = 48
#: Pieces of a straight cut under constant surface speed, where the speed follows the radius.
FACING_PIECES = 16
#: Cosine of the angle between two spline chords from which on it counts as a corner.
SMOOTH_COS = 0.7
#: Two ends of an arc nearer than this (mm) make it a full circle.
SAME_POINT_MM = 1e-7


class Rows(NamedTuple):
    """Columns of a chunk, as the table has them; `stops` says per event whether the axes stand still for it."""

    kind: Ints
    context: Ints
    feed: Floats
    end: Floats
    curve: Ints
    curves: Floats
    stops: Ints


class Limits(NamedTuple):
    """The machine, one number an axis: mm or degrees, s. `jump` is the velocity step allowed at a corner.

    `geometry` holds the axis numbers of X, Y, Z, -1 for a missing one; `rules` whether every axis runs a rapid alone at
    its own speed, and whether the axes stop between rapid and cutting.
    """

    rapid: Floats
    max_feed: Floats
    acceleration: Floats
    jump: Floats
    rotary: Ints
    geometry: Ints
    rules: Ints


class Pieces(NamedTuple):
    """Pieces, one number each, `vectors` four times `axes`: q' at start and end, q'' at start and end.

    `cap2` bounds x inside the piece, `entry2` at its start. `reach2` (one more than pieces) is what `backward` finds,
    `speed2` (likewise) the x that `forward` chooses, `time` the seconds. `pull` is the acceleration on a straight piece, the
    seconds of a timed one.
    """

    length: Floats
    cap2: Floats
    pull: Floats
    entry2: Floats
    reach2: Floats
    speed2: Floats
    time: Floats
    form: Ints
    row: Ints
    slot: Ints
    vectors: Floats


class State(NamedTuple):
    """What is carried from row to row, and room to work in; one number an axis unless said otherwise.

    `position` in machine coordinates, `tangent` q' at the end of the last piece; `now` and `count` by the constants above.
    `target`, `delta`, `unit`, `bend` belong to the row at hand; `basis` (9) and `turn` (4) to its arc.
    """

    position: Floats
    tangent: Floats
    target: Floats
    delta: Floats
    unit: Floats
    bend: Floats
    basis: Floats
    turn: Floats
    now: Floats
    count: Ints
