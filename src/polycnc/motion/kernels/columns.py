"""What the kernels share: the numbers of kinds and fields in the flat arrays that they read and write.

Everything is a flat array of floats, so that a kernel takes few arguments and the same source runs on
`array.array` and on NumPy views. `n` is the number of axes.
"""

from __future__ import annotations

from typing import NamedTuple

from polycnc.kernels.layout import Bytes, Floats, Ints32, Words32

# Numbers of the row kinds (`toolpath.Kind`), as plain integers that a compiler can fold.
RAPID, CW, CCW, HELIX_CW, HELIX_CCW, SPLINE, THREAD, TAP, REF, SKIP, DWELL, EVENT = (
    0,
    2,
    3,
    4,
    5,
    6,
    7,
    8,
    9,
    10,
    11,
    12,
)
CURVE_WIDTH = 8
#: Numbers kept of a row under a transformation: its shares, and of `ease` what holds at corners at its two ends.
SHARES, AT_START, AT_END = 32, 30, 31


class Rows(NamedTuple):
    """Columns of a chunk as the table has them; `stops` says of each event whether the axes stand for it.

    Under a transformation every row has SHARES shares: `share` says where each of them ends (0 to 1 of the row's way; a
    first one that ends at 1 is alone), `top` bounds the path speed, and `ease` says by which factor the acceleration
    along the path must shrink for the real axes to keep their limits; at AT_START and AT_END stand the factors for the
    columns' limits at corners (`motion/transformed.py`). All empty where none acts.
    """

    kind: Bytes
    context: Words32
    feed: Floats
    end: Floats
    curve: Ints32
    stops: Bytes
    share: Floats
    top: Floats
    ease: Floats


# `limits`: blocks of n numbers (mm or degrees, s), then what is there once.
TOP_RAPID, TOP_FEED, ACCELERATION, JUMP, ROTARY, JERK, LIMIT_BLOCKS = 0, 1, 2, 3, 4, 5, 6
#: Behind the blocks: the columns of X, Y, Z (-1 for a missing one); whether the axes stop between rapid and
#: cutting; highest speed of a cut along the path; highest step of an axis's velocity at a corner of two cuts.
GEOMETRY, RAPID_STOPS, PATH_FEED, CORNER_SPEED, LIMIT_TAIL = 0, 3, 4, 5, 6

# `contexts`: one record a context. RAMP_S is the time over which the speed along the path is averaged (0: the
# jerk has no limit), BLEND_S that over which the axes' positions are, twice; DRIVE_SPEED and DRIVE_REDUCTION
# are those of the settings (1 and 0 without DRIVE). RAPID_SPEED bounds rapids along the path (0: nothing does).
# Behind OFFSETS stand n numbers.
PER_REVOLUTION, INVERSE_TIME, RPM, SURFACE_MM_S, RPM_LIMIT, SPINDLE_REV_S2 = 0, 1, 2, 3, 4, 5
EXACT_STOP, TOLERANCE, ROTARY_WEIGHT, STATION, HAS_FRAME, MIRROR = 6, 7, 8, 9, 10, 11
RAPID_BY_AXIS, RAMP_S, BLEND_S, DRIVE_SPEED, DRIVE_REDUCTION, RAPID_SPEED = 12, 13, 14, 15, 16, 17
#: How a stroke of a drilling cycle meets the next one (`toolpath.context`).
OVERLAP, OVERLAPS = 18, 2
#: Acceleration after interpolation: seconds by which the axes are behind at speed, and the speed from which on it acts.
LAG_S, LAG_FROM = 19, 20
#: Factor on the highest rapid of every axis.
RAPID_SHARE = 21
#: How far before and behind a corner its rounding reaches at most, mm (infinite: the tolerance alone counts).
ROUNDING = 22
FRAME, OFFSETS = 23, 35

# `pieces`: one record a piece. CAP2 bounds x inside the piece, ENTRY2 at its start; REACH2 is what `backward`
# finds there, SPEED2 what `forward` chooses, END2 the x that it leaves the piece with, TIME the seconds. PULL
# is the acceleration along a straight piece, the seconds of a timed one. `forward` also says how: up to PEAK2 and
# down again at RATE. PAUSE are the seconds that the axes rest before the piece so that the averages come to
# rest. HOLD2 and HOLD_PULL bound speed and acceleration along the path on HOLD_WAY before and behind its start
# (`hold.py`). RAMP and BLEND are the averages of the run that begins with the piece, seconds. MARGIN is the factor
# by which q' and q'' are stored larger than they are. EARLY are the seconds by which the run that begins with the piece
# may begin before the averages of the one before have come to rest; PAUSE bounds them. PATH_PULL bounds the
# acceleration along a curved piece beside its axes. Behind VECTORS stand q' at start and end, q'' at start and end, and
# the axes' positions at start and end: 6·n numbers.
(
    LENGTH, CAP2, PULL, ENTRY2, REACH2, SPEED2, END2, TIME, FORM, ROW, SLOT,
    PEAK2, RATE, PAUSE, HOLD2, HOLD_PULL, HOLD_WAY, RAMP, BLEND, MARGIN, EARLY, PATH_PULL, VECTORS,
) = range(23)  # fmt: skip
PLACES, PIECE_BLOCKS = 4, 6
#: A line; a part of a curve under the limits of a line (with limited jerk); a part of a curve under limits that
#: change along it; a rapid of every axis by itself.
STRAIGHT, BENT, CURVED, TIMED = 0, 1, 2, 3

# `state`: what is carried from row to row,
STOP, EXIT2, ROW_LENGTH, METRIC, AT_STATION, SMOOTH, PIECES, WITHOUT_FEED = range(8)
# for limited jerk: pull of the last row around its end; highest cap and pull since the axes last stood, lowest
# holds within reach, way for which holds reach ahead; seconds that a change of speed is spread over; the last row
# is a line (1), and one from rest (2); speed that it asks for; whether overrides will act on feeds (not the planner's):
# 1, or 2 if a dry run will act on threads,
EXIT_PULL, TOP2, TOP_PULL, LOW2, LOW_PULL, AHEAD, WINDOW, ALONE, WANTED, FREE = range(8, 18)
# the joint at hand: pull around it, seconds of rest, averages of a run that begins there, OVERLAP of the row before,
JOINT_PULL, REST, RUN_RAMP, RUN_BLEND, OVERLAP_BEFORE = range(18, 23)
# the row at hand (CURVE: where its record in `curves` begins, or -1; FACING: its end in X, work coordinates),
KIND, NUMBER, ROW_SLOT, FEED, CURVE, FACING = range(23, 29)
# its largest speed, and EASE at its start (1 without transformation); that at the end of the row before; its shares,
# behind which come the factors for corners at its ends,
ROW_TOP, EASE, LAST_EASE, SHARE_COUNT, SHARE_END, SHARE_TOP, SHARE_EASE = 29, 30, 31, 32, 33, 65, 97
# pieces of the straight run from rest that the row at hand goes on with; rows that wait for a spindle at rest,
STRAIGHT_RUN, STANDING_SPINDLE = 129, 130
# its arc (unit vectors to the start, along the way there, and of the axis; angle, radius, growth of the
# radius, rise),
BASIS, SWEEP, RADIUS, GROWTH, RISE = 131, 140, 141, 142, 143
# the factor for the corner at hand, and that at the end of the row before,
CORNER_EASE, LAST_CORNER, STATE_BLOCKS = 144, 145, 146
# and blocks of n numbers: machine position before the row, q' at the end of the last piece; end of the row,
# way there, and room for one q' and q''; q'' at the end of the last piece.
POSITION, TANGENT, TARGET, DELTA, UNIT, BEND, BENT_BEFORE, BLOCKS = range(8)

#: Of a tap, in its record in `curves`: how much faster than at its lead it runs, and the largest override (0: none).
FACTOR, LARGEST_OVERRIDE = 2, 3
#: With limited jerk lines are cut: room for so many pieces more than a row has, and for each of its pieces.
SPARE_PIECES, CUTS_PER_PIECE = 64, 3
#: Pieces of a full turn. Over 7.5° an axis exceeds what holds at both ends by little; `lay_arc` says by how
#: much.
PIECES_PER_TURN = 48
#: Pieces of a straight cut under constant surface speed, where the speed follows the radius.
FACING_PIECES = 16
#: Cosine of the angle between two spline chords from which on it counts as a corner.
SMOOTH_COS = 0.8
#: Two ends of an arc nearer than this (mm) make it a full circle.
SAME_POINT_MM = 1e-7


def piece_width(n: int) -> int:
    """Numbers of one record of `pieces` with n axes."""
    return VECTORS + PIECE_BLOCKS * n
