"""What bounds the speed on a piece, apart from its neighbours."""

from __future__ import annotations

from math import inf, sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.explain.kernels.held import (
    PACES,
    SAME,
    SAME_RADIUS,
    WHOLE,
    Held,
    Ledger,
    Limit,
    Note,
    Pacing,
    Tables,
    resolve,
)
from polycnc.motion.kernels.columns import PLACES, ContextRecord, Form, PieceRecord, square
from polycnc.motion.kernels.feeds import revolutions_s
from polycnc.motion.kernels.jerk import ARC_ACROSS, ARC_DEVIATION, ARC_JERK


def note_of(records: Floats, at: int, origin: int) -> int:
    """Where the note of a piece's row begins."""
    return (int(records[at + PieceRecord.ROW]) - origin) * int(Note.SIZE)


def limits_of(tables: Tables, note: int, n: int) -> int:
    """Where the limits of a row begin."""
    return int(tables.notes[note + Note.LIMITS]) * int(Limit.SIZE) * n


def pace_of(tables: Tables, note: int, n: int) -> int:
    """Where what the program says of the axes of a row begins."""
    context = int(tables.notes[note + Note.RECORD]) // (int(ContextRecord.OFFSETS) + n)
    return context * (int(Pacing.BLOCKS) + 2 * PACES * n)


def is_transformed(tables: Tables, note: int, n: int) -> bool:
    """Whether a transformation acts in a row."""
    return tables.paces[pace_of(tables, note, n) + Pacing.TRANSFORMED] != 0.0


def share_of(records: Floats, at: int, n: int, i: int) -> float:
    """The greatest way of an axis by the way of the path, on a piece."""
    here = at + PieceRecord.VECTORS + i
    if records[at + PieceRecord.FORM] != Form.STRAIGHT:
        return max(abs(records[here]), abs(records[here + n]))
    length, place = records[at + PieceRecord.LENGTH], here + PLACES * n
    return abs(records[place + n] - records[place]) / length if length > 0.0 else 0.0


def top_of(records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger) -> float:
    """The highest speed on a piece by all that bounds it apart from its neighbours; `ledger` gets the cause."""
    notes, rapid = tables.notes, tables.notes[note + Note.RAPID] != 0.0
    ledger.cause, ledger.axis = Held.FEED, WHOLE
    top = asked_on(records, at, n, tables, note)
    if rapid:
        ledger.cause = Held.RAPID
    if notes[note + Note.PATH] < top:
        top, ledger.cause = notes[note + Note.PATH], Held.PATH_FEED
    if notes[note + Note.BLOCK] < top:
        top, ledger.cause = notes[note + Note.BLOCK], Held.BLOCK_TIME
    if notes[note + Note.ARC] < top:
        top, ledger.cause = notes[note + Note.ARC], Held.ARC_PULL
    own, pace = limits_of(tables, note, n), pace_of(tables, note, n)
    faster = tables.contexts[int(notes[note + Note.RECORD]) + ContextRecord.RAPID_SHARE] if rapid else 1.0
    tops = own + (Limit.TOP_RAPID if rapid else Limit.TOP_FEED) * n
    paced, larger = tables.paces[pace + Pacing.PACED] != 0.0, 1.0
    if records[at + PieceRecord.FORM] == Form.CURVED and notes[note + Note.SHARED] == 0.0:
        larger = notes[note + Note.EASE]  # MARGIN has it in it (`shared_ease`)
    for i in range(n):
        share = larger * share_of(records, at, n, i)
        if share > 0.0:
            if faster * tables.limits[tops + i] < top * share:
                top, ledger.axis = faster * tables.limits[tops + i] / share, i
                capped = tables.limits[own + Limit.CAPPED * n + i] != 0.0
                ledger.cause = Held.RAPID if rapid else Held.AXIS_FEED if capped else Held.AXES
            if paced:
                if records[at + PieceRecord.VECTORS + 2 * n + i] != 0.0:
                    share = max(share, notes[note + Note.PLANAR])  # one bound for all of an arc
                top = paced_top(tables, pace, n, i, rapid, share, top, ledger)
    return top


def paced_top(
    tables: Tables, pace: int, n: int, i: int, rapid: bool, share: float, top: float, ledger: Ledger
) -> float:
    """The same with what the program, or what moves over an axis, leaves of its velocity."""
    for kind in range(PACES):
        block = pace + Pacing.BLOCKS + (PACES * (1 if rapid else 0) + kind) * n + i
        if tables.paces[block] < top * share:
            top, ledger.axis = tables.paces[block] / share, i
            ledger.cause = Held.PROGRAM_AXIS if kind == 0 else Held.AXES if kind == 1 else Held.OVERLAID
    return top


def asked_on(records: Floats, at: int, n: int, tables: Tables, note: int) -> float:
    """The speed that the program asks for on a piece, infinite where it asks for none."""
    asked, radius = tables.notes[note + Note.ASKED], tables.notes[note + Note.RADIUS]
    if not asked > 0.0:
        return inf
    if radius == 0.0:
        return asked
    record, place = int(tables.notes[note + Note.RECORD]), at + PieceRecord.VECTORS + PLACES * n
    facing = int(tables.notes[note + Note.COLUMN])
    here = 0.5 * (records[place + facing] + records[place + n + facing]) + tables.notes[note + Note.FACING]
    fast = revolutions_s(tables.contexts, record, radius)
    now = revolutions_s(tables.contexts, record, here)
    return asked * now / fast * (1.0 - SAME_RADIUS) if fast > 0.0 else inf


def curve_axis(records: Floats, at: int, n: int, tables: Tables, note: int, x2: float) -> tuple[int, float]:
    """The axis whose acceleration a curve uses most at a squared speed, and the part of it."""
    own, axis, most = limits_of(tables, note, n) + Limit.PULL * n, WHOLE, 0.0
    if records[at + PieceRecord.FORM] == Form.STRAIGHT:
        return axis, most
    for i in range(n):
        here = at + PieceRecord.VECTORS + 2 * n + i
        used = max(abs(records[here]), abs(records[here + n])) * x2 / tables.limits[own + i]
        if used > most:
            axis, most = i, used
    return axis, most


def pull_axis(records: Floats, at: int, n: int, tables: Tables, note: int, block: int) -> tuple[int, float]:
    """The axis that allows the least acceleration (or jerk, by the block) along a piece, and what that is."""
    own, axis, least = limits_of(tables, note, n) + block * n, WHOLE, inf
    for i in range(n):
        share = share_of(records, at, n, i)
        if share > SAME and tables.limits[own + i] < least * share:
            axis, least = i, tables.limits[own + i] / share
    return axis, least * tables.notes[note + Note.EASE]


def arc(records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger) -> None:
    """What bounds an arc whose jerk is limited by averages (`arc_hold`); `ledger` gets the cause."""
    axis, used = curve_axis(records, at, n, tables, note, 1.0)
    bend2, record = 0.0, int(tables.notes[note + Note.RECORD])
    for i in range(n):
        bend2 += square(records[at + PieceRecord.VECTORS + 2 * n + i] / records[at + PieceRecord.MARGIN])
    own, least = limits_of(tables, note, n) + Limit.JERK * n, inf
    for i in range(n):
        if (
            records[at + PieceRecord.VECTORS + 2 * n + i] != 0.0
            or records[at + PieceRecord.VECTORS + 3 * n + i] != 0.0
        ):
            least = min(least, tables.limits[own + i])
    blend2 = square(records[at + PieceRecord.BLEND])
    pull2 = ARC_ACROSS / used if used > 0.0 else inf
    near2 = 12.0 * ARC_DEVIATION * tables.contexts[record + ContextRecord.TOLERANCE]
    near2 = near2 / (blend2 * sqrt(bend2)) if blend2 * bend2 > 0.0 else inf
    jerk2 = (ARC_JERK * least / bend2) ** (2.0 / 3.0) if bend2 > 0.0 else inf
    ledger.cause, ledger.axis = Held.CURVATURE, axis
    if jerk2 < min(pull2, near2):
        ledger.cause = Held.CORNER_JERK
    elif near2 < pull2:
        ledger.cause, ledger.axis = Held.CORNERS, WHOLE


def rise(records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger) -> None:
    """What bounds the acceleration of a piece on which the axes go faster; `ledger` gets the cause."""
    ledger.cause, record = Held.ACCELERATION, int(tables.notes[note + Note.RECORD])
    rate, tap = (1.0 + SAME) * records[at + PieceRecord.RATE], tables.notes[note + Note.TAP_PULL]
    ledger.axis, least = pull_axis(records, at, n, tables, note, int(Limit.PULL))
    if records[at + PieceRecord.FORM] > Form.BENT or rate >= least:
        return
    if tables.notes[note + Note.AFTER] != 0.0 or tables.contexts[record + ContextRecord.LAG_S] > 0.0:
        ledger.cause, ledger.axis = Held.TIME_CONSTANT, WHOLE
    elif 0.0 < tap <= rate:
        ledger.cause, ledger.axis = Held.SPINDLE_PULL, WHOLE
    elif records[at + PieceRecord.RAMP] > 0.0:
        ledger.cause = Held.JERK
        ledger.axis, least = pull_axis(records, at, n, tables, note, int(Limit.JERK))


def resolve_rest(tables: Tables, note: int, n: int, ledger: Ledger, parts: Floats) -> None:
    """The axes rest before a row: because something asks for that, or for its corner."""
    cause, axis = int(Held.CORNERS), WHOLE
    if tables.notes[note + Note.STOP] != 0.0:
        cause = int(Held.STANDSTILL)
    elif tables.notes[note + Note.STEP2] < tables.notes[note + Note.CORNER2]:
        cause, axis = int(tables.notes[note + Note.JOINT]), int(tables.notes[note + Note.JOINT_AXIS])
    resolve(parts, n, ledger, cause, axis)


def peak_speed(x2: float) -> float:
    """A speed by its square, larger by what counts as none."""
    return sqrt(x2) * (1.0 + SAME)
