"""Seconds and way of pieces by what held on them.

A piece is passed in three phases: up to its highest speed, along it, and down. Up, what bounds the acceleration holds;
along it, what bounds the speed there. Where the axes brake, and where they are steady below all that bounds the piece
itself, what asks for that comes later: it is the next bound that is met.
"""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.explain.kernels.bounds import (
    arc,
    curve_axis,
    is_transformed,
    note_of,
    peak_speed,
    pull_axis,
    resolve_rest,
    rise,
    top_of,
)
from polycnc.motion.explain.kernels.held import (
    BINDS,
    EVEN,
    SAME,
    SAME_JOINT,
    WHOLE,
    Held,
    Ledger,
    Limit,
    Note,
    Tables,
    add,
    resolve,
    wait,
)
from polycnc.motion.explain.kernels.law import share_law
from polycnc.motion.explain.kernels.rapids import share_timed
from polycnc.motion.kernels.columns import (
    SPLINE,
    THREAD,
    ContextRecord,
    Form,
    PieceRecord,
    piece_width,
    square,
)
from polycnc.motion.kernels.speeds import ways_to_cap


def share_out(
    records: Floats,
    count: int,
    n: int,
    tables: Tables,
    origin: int,
    ledger: Ledger,
    parts: Floats,
    real: Floats,
) -> int:
    """Share the seconds and the way of pieces out.

    Args:
        records: The pieces.
        count: How many.
        n: Number of axes.
        tables: What they refer to.
        origin: Row whose note is the first.
        ledger: Carried from call to call.
        parts: Seconds and way, in turn, of each cause for none of the axes and for each of them; they are added.
        real: Room for three numbers for each piece: those at whose real axes somebody must look, with the seconds and
            the way that hang on it.

    Returns:
        How many such pieces there are.
    """
    width, found = piece_width(n), 0
    ledger.end = count * width
    for piece in range(count):
        at = piece * width
        note = note_of(records, at, origin)
        share_pause(records, at, n, tables, note, ledger, parts)
        if records[at + PieceRecord.FORM] == Form.TIMED:
            share_timed(records, at, n, tables, note, ledger, parts)
            continue
        if records[at + PieceRecord.FORM] == Form.JERKED:
            share_law(records, at, n, tables, note, ledger, parts)
            continue
        seconds, level = share_piece(records, at, n, tables, note, ledger, parts)
        if ledger.cause == Held.REAL:
            real[3 * found], real[3 * found + 1], real[3 * found + 2] = piece, seconds, level
            found += 1
    return found


def share_pause(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, parts: Floats
) -> None:
    """Count the seconds in which averages come to rest before a piece: those of a limited jerk, or time constants."""
    pause = records[at + PieceRecord.PAUSE]
    pause -= min(records[at + PieceRecord.EARLY], pause)
    if pause <= 0.0:
        return
    record, behind = int(tables.notes[note + Note.RECORD]), 0.0
    if tables.notes[note + Note.AFTER] != 0.0:
        behind = pause
    elif tables.contexts[record + ContextRecord.AHEAD] != 0.0 and tables.notes[note + Note.RAPID] == 0.0:
        behind = min(pause, 2.0 * tables.contexts[record + ContextRecord.BEHIND_S])
    resolve_rest(tables, note, n, ledger, parts)
    add(parts, n, int(Held.TIME_CONSTANT), WHOLE, behind, 0.0)
    add(parts, n, int(Held.SETTLING), WHOLE, pause - behind, 0.0)


def share_piece(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, parts: Floats
) -> tuple[float, float]:
    """Share a piece out whose speed goes up, along and down; seconds and way of what it is steady for."""
    top = top_of(records, at, n, tables, note, ledger)
    cause, axis = ledger.cause, ledger.axis
    look_at_joint(records, at, n, tables, note, ledger, parts, top)
    up, level, up_s, level_s, down_s = phases(records, at)
    down = records[at + PieceRecord.LENGTH] - up - level
    if up > 0.0:
        if ledger.pending_s > 0.0:
            valley(records, at, n, tables, note, ledger, records[at + PieceRecord.SPEED2])
            resolve(parts, n, ledger, ledger.cause, ledger.axis)
        rise(records, at, n, tables, note, ledger)
        add(parts, n, ledger.cause, ledger.axis, up_s, up)
    if level > 0.0 or level_s > 0.0:
        steady(records, at, n, tables, note, ledger, top, cause, axis)
        cause, axis = ledger.cause, ledger.axis
        wait(ledger, level_s, level)
        level_s, level = ledger.pending_s, ledger.pending_mm
        if cause != Held.LATER:
            resolve(parts, n, ledger, cause, axis)
    else:
        cause = int(Held.LATER)
    wait(ledger, down_s, down)
    ledger.known2, ledger.row = min(top, tables.notes[note + Note.TOP]), int(records[at + PieceRecord.ROW])
    ledger.known2, ledger.cause = square(ledger.known2), cause
    return level_s, level


def phases(records: Floats, at: int) -> tuple[float, float, float, float, float]:
    """Way up, way along the highest speed; seconds up, along it and down."""
    start2, peak2, end2, rate, length, seconds = (
        records[at + PieceRecord.SPEED2],
        records[at + PieceRecord.PEAK2],
        records[at + PieceRecord.END2],
        records[at + PieceRecord.RATE],
        records[at + PieceRecord.LENGTH],
        records[at + PieceRecord.TIME],
    )
    form = records[at + PieceRecord.FORM]
    if records[at + PieceRecord.RISE] != 0.0:
        return rising_phases(records, at)
    # Along a curve the speed that it allows changes from piece to piece.
    even = (form == Form.CURVED or form == Form.LED) and min(start2, end2) >= (1.0 - EVEN) * peak2
    if rate <= 0.0 or even:
        return 0.0, length, 0.0, seconds, 0.0
    up = max(min(0.5 * (peak2 - start2) / rate, length), 0.0)
    down = max(min(0.5 * (peak2 - end2) / rate, length - up), 0.0)
    up, down = up if up > SAME * length else 0.0, down if down > SAME * length else 0.0
    level = length - up - down
    if level <= SAME * length:
        up, down, level = up + level if up > 0.0 else 0.0, down if up > 0.0 else length, 0.0
    along = seconds if up + down == 0.0 else level / sqrt(peak2) if peak2 > 0.0 else 0.0
    along = min(along, seconds)
    peak = sqrt(peak2)
    up_s = 2.0 * up / (sqrt(start2) + peak) if up > 0.0 else 0.0
    up_s = seconds - along if down == 0.0 else min(up_s, seconds - along)
    return up, level, up_s, along, seconds - along - up_s


def rising_phases(records: Floats, at: int) -> tuple[float, float, float, float, float]:
    """The same where what bounds the speed rises or falls along the piece."""
    start2, end2, cap2, rise, pull, length, seconds = (
        records[at + PieceRecord.SPEED2],
        records[at + PieceRecord.END2],
        records[at + PieceRecord.CAP2],
        records[at + PieceRecord.RISE],
        records[at + PieceRecord.RATE],
        records[at + PieceRecord.LENGTH],
        records[at + PieceRecord.TIME],
    )
    up, down = ways_to_cap(start2, end2, cap2, rise, pull, length)
    up, down = up if up > SAME * length else 0.0, down if down > SAME * length else 0.0
    level = max(length - up - down, 0.0)
    up_s = (sqrt(start2 + 2.0 * pull * up) - sqrt(start2)) / pull
    down_s = (sqrt(end2 + 2.0 * pull * down) - sqrt(end2)) / pull
    if level <= SAME * length:
        return length - down, 0.0, seconds - down_s, 0.0, down_s
    return up, level, up_s, seconds - up_s - down_s, down_s


def look_at_joint(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, parts: Floats, top: float
) -> None:
    """Look at the joint before a piece: whether it bounds the speed, and whether the axes have braked for it."""
    start2, row = records[at + PieceRecord.SPEED2], int(records[at + PieceRecord.ROW])
    if start2 <= 0.0:
        resolve_rest(tables, note, n, ledger, parts)
        ledger.joint2 = 0.0
        return
    bound2 = records[at + PieceRecord.HOLD2]
    soft = records[at + PieceRecord.RAMP] > 0.0
    if not soft:
        bound2 = min(bound2, records[at + PieceRecord.ENTRY2])
    known2 = min(square(min(top, tables.notes[note + Note.TOP])), ledger.known2)
    inside = row == ledger.row and is_transformed(tables, note, n)  # what bounds a share of the row
    if inside or bound2 >= (1.0 - SAME_JOINT) * known2:
        return
    if (
        tables.notes[note + Note.KIND] == THREAD
        and bound2 >= (1.0 - SAME_JOINT) * records[at + PieceRecord.CAP2]
    ):
        return  # it is the lead of the thread behind it
    ledger.joint2 = bound2
    if row != ledger.row and tables.notes[note + Note.STEP2] <= (1.0 + SAME_JOINT) * bound2:
        ledger.joint_cause = int(tables.notes[note + Note.JOINT])
        ledger.joint_axis = int(tables.notes[note + Note.JOINT_AXIS])
    else:
        valley(records, at, n, tables, note, ledger, bound2)
        ledger.joint_cause, ledger.joint_axis = ledger.cause, ledger.axis
        if soft and row != ledger.row and ledger.joint_cause == Held.CORNERS:
            corner(tables, note, ledger, (1.0 + SAME_JOINT) * bound2)
    if start2 >= (1.0 - SAME_JOINT) * bound2:
        resolve(parts, n, ledger, ledger.joint_cause, ledger.joint_axis)


def corner(tables: Tables, note: int, ledger: Ledger, bound2: float) -> None:
    """What bounds a corner that averages pass at a squared speed: tolerance, acceleration or jerk."""
    near2, pull2 = tables.notes[note + Note.CORNER2], tables.notes[note + Note.PULL2]
    if pull2 < near2 and pull2 <= bound2:
        ledger.joint_cause, ledger.joint_axis = Held.CURVATURE, int(tables.notes[note + Note.PULL_AXIS])
    elif near2 > bound2:
        ledger.joint_cause, ledger.joint_axis = Held.CORNER_JERK, int(tables.notes[note + Note.JERK_AXIS])


def valley(records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, x2: float) -> None:
    """Why the axes are slow where a piece begins: for its curve, or for a corner; `ledger` gets the cause."""
    ledger.cause, ledger.axis = Held.CORNERS, WHOLE
    if records[at + PieceRecord.ZONE] != 0.0:
        return
    if records[at + PieceRecord.FORM] == Form.BENT:
        arc(records, at, n, tables, note, ledger)
        return
    if tables.notes[note + Note.KIND] == SPLINE:
        chord(records, at, tables, note, ledger, x2)
        return
    axis, used = curve_axis(records, at, n, tables, note, x2)
    if used >= BINDS:
        ledger.cause, ledger.axis = Held.CURVATURE, axis


def chord(records: Floats, at: int, tables: Tables, note: int, ledger: Ledger, x2: float) -> None:
    """What bounds a chord of a spline at a squared speed: acceleration or, with averages, jerk."""
    ledger.cause, ledger.axis = Held.CURVATURE, int(tables.notes[note + Note.PULL_AXIS])
    if records[at + PieceRecord.RAMP] > 0.0 and x2 < BINDS * tables.notes[note + Note.PULL2]:
        ledger.cause, ledger.axis = Held.CORNER_JERK, int(tables.notes[note + Note.JERK_AXIS])


def is_at_real(records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger) -> bool:
    """Whether a piece is as fast as real axes under a transformation let it be.

    A bound that the averages spread from the next row's joint is none of theirs.
    """
    peak2, row = records[at + PieceRecord.PEAK2], records[at + PieceRecord.ROW]
    if not is_transformed(tables, note, n):
        return False
    if tables.notes[note + Note.SHARED] == 0.0:
        return peak_speed(peak2) >= tables.notes[note + Note.TOP]
    if peak2 < (1.0 - SAME) * records[at + PieceRecord.CAP2]:
        return False
    while at < ledger.end and records[at + PieceRecord.ROW] == row:
        at += piece_width(n)
    return at >= ledger.end or abs(records[at + PieceRecord.HOLD2] - peak2) > SAME_JOINT * peak2


def steady(
    records: Floats,
    at: int,
    n: int,
    tables: Tables,
    note: int,
    ledger: Ledger,
    top: float,
    cause: int,
    axis: int,
) -> None:
    """Why a piece is run at its highest speed, and no faster; `ledger` gets the cause."""
    peak2 = records[at + PieceRecord.PEAK2]
    ledger.cause, ledger.axis = cause, axis
    if peak_speed(peak2) >= top:
        return
    ledger.axis = WHOLE
    is_thread = tables.notes[note + Note.KIND] == THREAD and records[at + PieceRecord.FORM] == Form.STRAIGHT
    if is_thread and (
        records[at + PieceRecord.RISE] != 0.0 or peak2 >= (1.0 - SAME) * records[at + PieceRecord.CAP2]
    ):
        ledger.cause = Held.FEED  # its lead changes
        return
    if records[at + PieceRecord.ZONE] != 0.0:
        ledger.cause = Held.CORNERS
        return
    if records[at + PieceRecord.ALONE] != 0.0:
        ledger.cause = Held.JERK
        ledger.axis, _ = pull_axis(records, at, n, tables, note, int(Limit.JERK))
        return
    if ledger.joint2 > 0.0 and abs(peak2 - ledger.joint2) <= SAME_JOINT * peak2:
        ledger.cause, ledger.axis = ledger.joint_cause, ledger.joint_axis
        return
    if records[at + PieceRecord.FORM] == Form.BENT:
        arc(records, at, n, tables, note, ledger)
        return
    at_cap = peak2 >= (1.0 - SAME) * records[at + PieceRecord.CAP2]
    if at_cap and tables.notes[note + Note.KIND] == SPLINE:
        chord(records, at, tables, note, ledger, peak2)
        return
    worst, used = curve_axis(records, at, n, tables, note, peak2)
    ledger.cause, ledger.axis = Held.CURVATURE, worst
    if at_cap and tables.notes[note + Note.RADIUS] > 0.0:
        ledger.cause, ledger.axis = cause, axis
    elif is_at_real(records, at, n, tables, note, ledger):
        ledger.cause, ledger.axis = Held.REAL, WHOLE
    elif used < BINDS and not (at_cap and used > 0.0):
        ledger.cause, ledger.axis = Held.LATER, WHOLE
