"""What the kernels share: the numbers of kinds and fields in the flat arrays that they read and write.

Everything is an array, a record, or a group of them, so that the same source runs as it is and as machine code. `n` is
the number of axes.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Places, Words32, place, record
from polycnc.transformation.orientation.linkage import room_for

# Numbers of the row kinds (`toolpath.Kind`), as plain integers that a compiler can fold.
RAPID, FEED, CW, CCW, HELIX_CW, HELIX_CCW, SPLINE, THREAD, TAP, REF, SKIP, DWELL, EVENT = (
    0,
    1,
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
    columns' limits at corners, and in `share` how much of the row a bend for them may take (`motion/transformed.py`).
    All empty where none acts.
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


@record
class PathLimits(Structure):
    """What the machine allows along the path.

    Attributes:
        rapid_stops: Whether the axes stop between rapid and cutting (1).
        path_feed: Highest speed of a cut.
        arc_pull: Highest acceleration across the path on an arc that is planned ahead.
        arc_least: Speed below which neither that nor what axes may accelerate on arcs slows one.
        bend_least: Speed below which what axes may accelerate from line to line slows none.
        block_s: How long a cut lasts at least, because the control processes no more blocks a second (0: any).
        feed_along_arc: Whether the feed of an arc is that along the arc, other axes beside it (1).
        arc_by_radius: Whether inverse time counts the radius of an arc, not its length (1).
    """

    rapid_stops: float
    path_feed: float
    arc_pull: float
    arc_least: float
    bend_least: float
    block_s: float
    feed_along_arc: float
    arc_by_radius: float


class Limits(NamedTuple):
    """What the machine allows, mm or degrees and seconds: n numbers each, and what is there once.

    Attributes:
        top_rapid: Highest velocity in rapids.
        top_feed: Highest velocity in cuts.
        acceleration: Highest acceleration.
        jump: Highest step of the velocity at a corner.
        step: That which the control's parameters allow at a corner of two cuts that are planned ahead.
        arc: Highest acceleration that they allow on an arc that is planned ahead.
        bend: The same where a line of such a cut goes over into the next one.
        rotary: 1 for a rotary axis.
        jerk: Highest jerk.
        geometry: The columns of X, Y, Z, -1 for a missing one.
        path: Along the path.
        linkage: How the axes follow the tip that the columns stand for (`transformation.orientation.linkage`); empty
            where they do not, or in no such form.
    """

    top_rapid: Floats
    top_feed: Floats
    acceleration: Floats
    jump: Floats
    step: Floats
    arc: Floats
    bend: Floats
    rotary: Floats
    jerk: Floats
    geometry: Ints
    path: PathLimits
    linkage: Floats


class ContextRecord(Places):
    """A record of `contexts`; behind it stand n offsets.

    RAMP_S is the time over which the speed along the path is averaged (0: the jerk has no limit), BLEND_S that over
    which the axes' positions are, twice; DRIVE_SPEED and DRIVE_REDUCTION are those of the settings (1 and 0 without
    DRIVE). RAPID_SPEED bounds rapids along the path (0: nothing does).
    """

    PER_REVOLUTION = place()
    INVERSE_TIME = place()
    RPM = place()
    SURFACE_MM_S = place()
    RPM_LIMIT = place()
    SPINDLE_REV_S2 = place()
    EXACT_STOP = place()
    TOLERANCE = place()
    ROTARY_WEIGHT = place()
    STATION = place()
    HAS_FRAME = place()
    MIRROR = place()
    RAPID_BY_AXIS = place()
    RAMP_S = place()
    BLEND_S = place()
    DRIVE_SPEED = place()
    DRIVE_REDUCTION = place()
    RAPID_SPEED = place()
    #: How a stroke of a cycle meets the next one, and a rapid the next rapid (`toolpath.context`).
    OVERLAP = place()
    RAPID_OVERLAP = place()
    #: Acceleration after interpolation: seconds by which the axes are behind at speed, the speed from which it acts.
    LAG_S = place()
    LAG_FROM = place()
    #: Factor on the highest rapid of every axis.
    RAPID_SHARE = place()
    #: How far before and behind a corner its rounding reaches at most, mm (infinite: the tolerance alone counts).
    ROUNDING = place()
    #: How far rotary axes may leave their way at a corner, degrees; how far before and behind it they may, mm. Zero for
    #: both: the corner's own tolerance counts for them; for one of them: it bounds nothing.
    TURN_TOLERANCE = place()
    TURN_DISTANCE = place()
    #: How far rotary axes may leave their way where a corner is rounded within TOLERANCE, degrees (0: by as many).
    SWING = place()
    #: Straight rows are laid out under the limits of the axes behind the tip (1; `led.py`).
    LED = place()
    #: Cuts are planned ahead (1): what parameters allow at corners and on arcs holds.
    AHEAD = place()
    #: They are averaged behind that, twice over so many seconds, whatever the tolerance.
    BEHIND_S = place()
    #: Speed of a cut in which nothing moves but rotary axes, degrees/s (0: its feed).
    TURN_SPEED = place()
    #: How many millimetres of that feed are a degree.
    TURN_WEIGHT = place()
    #: With limited jerk: the path is bent by its way, and a law leads along it (1), in place of averages.
    BY_WAY = place()
    #: Rows of feed are chords of a smooth curve of the rotary axes (1).
    CHORDS = place()
    #: The least part of its velocity that the program leaves an axis (VELOLIM).
    SPEED_LEFT = place()
    #: Nine numbers by rows, then the shift.
    FRAME = place(12)
    OFFSETS = place(0)


class PieceRecord(Places):
    """A record of `pieces`. Behind VECTORS stand 6·n numbers: q', q'' and the axes' positions, at start and end each.

    CAP2 bounds x inside the piece, ENTRY2 at its start; REACH2 is what `backward` finds there, SPEED2 what `forward`
    chooses, END2 the x that it leaves the piece with, TIME the seconds. PULL is the acceleration along a straight
    piece, the seconds of a timed one. `forward` also says how: up to PEAK2 and down again at RATE. PAUSE are the
    seconds that the axes rest before the piece so that the averages come to rest. HOLD2 and HOLD_PULL bound speed and
    acceleration along the path on HOLD_WAY before and behind its start (`hold.py`). RAMP and BLEND are the averages of
    the run that begins with the piece, seconds. MARGIN is the factor by which q' and q'' are stored larger than they
    are. EARLY are the seconds by which the run that begins with the piece may begin before the averages of the one
    before have come to rest; PAUSE bounds them. PATH_PULL bounds the acceleration along a curved piece beside its axes.
    ZONE says that the piece is bent for the corner behind it (TO_CORNER) or before it (FROM_CORNER, `rounding.py`),
    ALONE (1) that it is of a line from rest to rest with averages of its own. RISE is what CAP2, then that at the start
    of a line, rises by in a mm (`leads.py`); PEAK2 is the highest x then, and RATE the acceleration to the cap and from
    it. ASKED is the path speed that the program asks for on the piece, without overrides; 0 where it asks for none.

    Of a JERKED piece, which `third_order/laws/records.py` writes, PULL is the acceleration along the path at its start
    and JERK what that changes by in a second, to either side; q' and q'' are what they are, and RATE is nothing.
    """

    LENGTH = place()
    CAP2 = place()
    PULL = place()
    ENTRY2 = place()
    REACH2 = place()
    SPEED2 = place()
    END2 = place()
    TIME = place()
    FORM = place()
    ROW = place()
    SLOT = place()
    PEAK2 = place()
    RATE = place()
    PAUSE = place()
    HOLD2 = place()
    HOLD_PULL = place()
    HOLD_WAY = place()
    RAMP = place()
    BLEND = place()
    MARGIN = place()
    EARLY = place()
    PATH_PULL = place()
    ZONE = place()
    ALONE = place()
    JERK = place()
    RISE = place()
    ASKED = place()
    VECTORS = place(0)


#: Of the vectors of a piece: the first of the two positions, and how many there are.
PLACES, PIECE_BLOCKS = 4, 6


#: `RunState.chord`: the tangent at the chord's end is open yet; it is known.
OPEN, CLOSED = 2.0, 1.0
#: ZONE of a piece that is bent for a corner.
TO_CORNER, FROM_CORNER = 1.0, 2.0


class Form(Places):
    """Forms of a piece.

    A line; a part of a curve under the limits of a line (with limited jerk); a part of a curve under limits that change
    along it; a rapid of every axis by itself; a line of the tip, whose q' and q'' are those of the axes behind it; a
    part of a bent path under one constant jerk along it, which is planned already.
    """

    STRAIGHT = place()
    BENT = place()
    CURVED = place()
    TIMED = place()
    LED = place()
    JERKED = place()


#: Forms of pieces whose limits change along them.
UNEVEN_FORMS = (Form.CURVED, Form.LED)


@record
class RunState(Structure):
    """What is carried from row to row.

    Attributes:
        stop: The axes stand before the next row (1).
        exit2: x with which the last row may be left.
        length: Of the last row.
        metric: What a degree counts in it.
        station: What must be the same for the axes not to stand between two rows.
        smooth: The last row is a chord of a spline (1), which the row at hand goes on with (2).
        pieces: In the buffer.
        without_feed: Rows without a feed.
        standing_spindle: Rows that wait for a spindle at rest.
        exit_pull: Pull of the last row around its end.
        top2: Highest cap since the axes last stood; `top_pull` likewise.
        low2: Lowest hold of those that reach the next piece, if it has not ended by then: `low2_way` is how far it
            reaches along that, mm. `low_pull` and `low_pull_way` likewise.
        ahead: Way for which holds reach ahead.
        window: Seconds that a change of speed is spread over.
        alone: The last row is a line (1), and one from rest (2).
        wanted: Speed that it asks for.
        line_top: What its transformation leaves of its speed; inf where there is none.
        behind: BEHIND_S of it, seconds; 0 of a rapid.
        free: Who says how fast feeds are (0: the plan): MAIN_RUN with overrides, 1 a dry run, 2 one that acts on
            threads too. `kernels/feeds.py` says what 1 and 2 mean, `kernels/alone.py` what MAIN_RUN does.
        override: Factor of overrides on the feed of the row at hand, which that has in it already.
        straight_pieces: Of the straight run from rest that the row at hand goes on with.
        ease: Factor on the limits at the end of the row before; `corner_ease` for its corner, which may bend no more of
            it than `corner_reach`, mm.
        overlap: OVERLAP of the row before; `rapid_overlap` likewise, 0 behind a cut.
        is_bent: The row before is bent already for the corner to the row at hand (1): the latter is laid out again.
        unseen: Nobody asks where the axes are within a piece (1).
        chord: With limited jerk: the last piece is a chord of a spline, OPEN or CLOSED (`chords.py`), and `hold.py` has
            not spread what bounds it.
        chord_mm: Length of the chord that was closed last, 0 where a row that is none came behind it.
        chord_entry2: Without limited jerk: highest x at the start of the last chord, whatever it bends itself.
        chord_ease: Factor on the limits along the last chord.
        tolerance: Contour tolerance along it.
        corner_top2: Highest x at a corner behind the row before, where that is led by a tip; 0 for no bound.
        row_top: What transformation and program leave of the speed of the row before, by its direction, at its end;
            `speed_left` is SPEED_LEFT.
        passed: With limited jerk: highest speed at the last joint; `lone` likewise, 0 where it is in a row (`jerk.py`).
        gap: Way from there to the row before.
        rate: Angle that the arc before turns by a mm at its end, 0 of a line; at the joint to an arc the larger one.
        off: How far the row before is led beside the programmed one, mm; `swung` its rotary axes, as a part of what
            each may be.
    """

    stop: float
    exit2: float
    length: float
    metric: float
    station: float
    smooth: float
    pieces: int
    without_feed: int
    standing_spindle: int
    exit_pull: float
    top2: float
    top_pull: float
    low2: float
    low2_way: float
    low_pull: float
    low_pull_way: float
    ahead: float
    window: float
    alone: float
    wanted: float
    line_top: float
    behind: float
    free: float
    override: float
    straight_pieces: int
    ease: float
    corner_ease: float
    corner_reach: float
    overlap: float
    rapid_overlap: float
    is_bent: float
    unseen: float
    chord: float
    chord_mm: float
    chord_entry2: float
    chord_ease: float
    tolerance: float
    corner_top2: float
    row_top: float
    speed_left: float
    passed: float
    lone: float
    gap: float
    rate: float
    off: float
    swung: float


@record
class JointState(Structure):
    """The joint at hand: pull around it, seconds of rest, averages of a run that begins there, factor on the limits.

    `bend_way` is the way before and behind it on which the path is bent (`rounding.py`), mm; `top2` bounds x there;
    `turn_way` is that of rotary axes that bend by themselves.
    """

    pull: float
    rest: float
    ramp: float
    blend: float
    ease: float
    bend_way: float
    turn_way: float
    top2: float


@record
class RowState(Structure):
    """The row at hand.

    Attributes:
        kind: As in the table.
        number: In the toolpath.
        slot: Where its time counts.
        feed: As in the table.
        curve: Where its record in `curves` begins, or negative.
        facing: Its end in X, work coordinates.
        top: Its largest speed.
        ease: Factor on the limits at its start (1 without transformation).
        shares: How many it has.
        off: How far it is led beside the programmed one at most, mm (`toolpath/fairing.py`); `swung` its rotary
            axes, as a part of what each may be.
    """

    kind: int
    number: int
    slot: int
    feed: float
    curve: int
    facing: float
    top: float
    ease: float
    shares: int
    off: float
    swung: float


@record
class ArcState(Structure):
    """The arc at hand: angle, radius, growth of the radius, rise along its axis.

    `ease` is the factor on what its axes accelerate, for its bend and for changes of speed together (`arcs.py`).
    """

    sweep: float
    radius: float
    growth: float
    rise: float
    ease: float


class State(NamedTuple):
    """What the kernels carry along, and room for what they work out; see `new_state`.

    Attributes:
        run: What is carried from row to row.
        joint: Between the row before and the row at hand.
        row: The row at hand.
        arc: Its arc.
        basis: Of the arc: unit vectors to the start, along the way there, and of the axis.
        share_end: Of the row's shares, where they end; `share_top` and `share_ease` likewise. Behind the factors of
            the shares stand those for corners at its ends, in `share_end` how much of the row they may bend.
        position: Machine position before the row; from here on n numbers each.
        tangent: q' at the end of the last piece.
        target: Machine position at the end of the row.
        delta: The way there.
        unit: Room for one q'.
        bend: Room for one q''.
        bent_before: q'' at the end of the last piece; with limited jerk its mean over the last chord of a spline.
        turn: What q' changes by at the joint at hand.
        bow: With limited jerk: what q' has changed by at the last joint of two lines, or two chords of a spline, over
            their mean length; zero from rest, and where the one follows the other.
        bowed: With limited jerk: what q' changes by at the joint at hand, over the mean length of its rows.
        asked: With limited jerk: what jerk the joint at hand asks for, in a row of joints.
        room: For what `linkage` works out.
    """

    run: RunState
    joint: JointState
    row: RowState
    arc: ArcState
    basis: Floats
    share_end: Floats
    share_top: Floats
    share_ease: Floats
    position: Floats
    tangent: Floats
    target: Floats
    delta: Floats
    unit: Floats
    bend: Floats
    bent_before: Floats
    turn: Floats
    bow: Floats
    bowed: Floats
    asked: Floats
    room: Floats


def new_state(n: int, start: Sequence[float] = ()) -> State:
    """The state before the first row of n axes that stand at a machine position, at zero where it is left out."""
    run = RunState(stop=1.0, low2=inf, low_pull=inf, override=1.0, row_top=inf, speed_left=1.0)
    records = run, JointState(top2=inf), RowState(), ArcState()
    position = zeros(n)
    position[: len(start)] = array("d", start)
    shares = zeros(SHARES), zeros(SHARES), zeros(SHARES)
    vectors = [*(zeros(n) for _ in range(10)), zeros(room_for(n))]
    return State(*records, zeros(9), *shares, position, *vectors)


def zeros(count: int) -> array[float]:
    """So many numbers."""
    return array("d", bytes(8 * count))


#: Of a cut that is led beside its end, in its record in `curves`: how far its line is off the programmed one, mm.
#: Behind that how far its rotary axes are, degrees, those that come first among the columns, and the largest part of
#: its tolerance by which one of them is.
MOST_OFF, SWUNG, MOST_SWUNG = 3, 4, 7
#: Of a straight thread, in its record in `curves`: what its lead grows by each revolution, mm, and the ways on which it
#: takes up its speed and brakes, mm along the axis with the longest way (0: what its axes allow).
GROWTH, WAY_IN, WAY_OUT = 2, 3, 4
#: Of a tap, in its record in `curves`: how much faster than at its lead it runs, and the largest override (0: none).
FACTOR, LARGEST_OVERRIDE = 2, 3
#: With limited jerk lines are cut: room for so many pieces more than a row has, and for each of its pieces.
SPARE_PIECES, CUTS_PER_PIECE = 64, 3
#: Pieces that following its lead adds to a thread.
LEAD_PIECES = 4
#: Without it: pieces that bending a corner cuts off the rows before and behind it.
BEND_PIECES = 2
#: Without it: pieces that a chord of a spline is parted into at most.
CHORD_PARTS = 12
#: Pieces of a full turn. Over 7.5° an axis exceeds what holds at both ends by little; `lay_arc` says by how
#: much.
PIECES_PER_TURN = 48
#: Pieces of a straight cut under constant surface speed, where the speed follows the radius.
FACING_PIECES = 16
#: Cosine of the angle between two spline chords from which on it counts as a corner.
SMOOTH_COS = 0.8
#: FREE in the main run: overrides act, for which rows are laid out again.
MAIN_RUN = -1.0
#: Two ends of an arc nearer than this (mm) make it a full circle.
SAME_POINT_MM = 1e-7
#: One number is above another for certain, whatever was rounded, if it is above so many times that.
SURELY = 1.000001


def square(value: float) -> float:
    """A product: a power of two is one in machine code, but in Python may be off it by the last bit."""
    return value * value


def lowered(bound: float, part: float, asked: float) -> float:
    """`min(bound, part / asked)`, none of them negative; a quotient that is certain to be larger is not worked out.

    At most joints few of the limits bind, and a division takes as long as ten products.
    """
    return min(bound, part / asked) if part < SURELY * bound * asked else bound


def piece_width(n: int) -> int:
    """Numbers of one record of `pieces` with n axes."""
    return PieceRecord.VECTORS + PIECE_BLOCKS * n
