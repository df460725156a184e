"""Parts of a bent path that a law of third order leads, each under one constant jerk: every one counts as a whole."""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.explain.kernels.bounds import limits_of, resolve_rest, top_of
from polycnc.motion.explain.kernels.held import (
    BELOW,
    STEADY,
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
from polycnc.motion.kernels.columns import CW, SPLINE, PieceRecord, square


def share_law(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, parts: Floats
) -> None:
    """Count a part for what bounds its speed, else for the axis that uses most of its acceleration or jerk.

    An axis does so for the change of the speed, or for the curve. Braking is for what comes next.
    """
    seconds, length = records[at + PieceRecord.TIME], records[at + PieceRecord.LENGTH]
    start2, end2 = records[at + PieceRecord.SPEED2], records[at + PieceRecord.END2]
    if start2 <= 0.0:
        resolve_rest(tables, note, n, ledger, parts)
    ledger.joint2 = ledger.known2 = 0.0
    fast = sqrt(records[at + PieceRecord.PEAK2]) / (1.0 - BELOW)
    top = top_of(records, at, n, tables, note, ledger)
    if fast < top and fast * fast >= records[at + PieceRecord.CAP2]:
        if not at_corner(tables, note, fast, ledger) and fast >= tables.notes[note + Note.TOP]:
            ledger.cause, ledger.axis = Held.CURVATURE, WHOLE
        top = 0.0
    if fast < top:
        used, along = most_used(records, at, n, tables, note, ledger)
        if used < STEADY or (along and end2 < start2):
            wait(ledger, seconds, length)
            return
        if along:
            resolve(parts, n, ledger, curve_of(tables, note), WHOLE)
    resolve(parts, n, ledger, ledger.cause, ledger.axis)
    add(parts, n, ledger.cause, ledger.axis, seconds, length)


def at_corner(tables: Tables, note: int, fast: float, ledger: Ledger) -> bool:
    """Whether parameters for the corner at an end of the row bound the speed; `ledger` gets the cause."""
    for corner in range(note, min(note + 2 * Note.SIZE, len(tables.notes)), Note.SIZE):
        x2, least = tables.notes[corner + Note.STEP2], fast * (1.0 - 2.0 * BELOW)
        if square(least) <= x2 <= square(fast):
            ledger.cause = int(tables.notes[corner + Note.JOINT])
            ledger.axis = int(tables.notes[corner + Note.JOINT_AXIS])
            return True
    return False


def curve_of(tables: Tables, note: int) -> int:
    """What a curve of the bent path is there for: curves of the program, or corners that are rounded."""
    kind = int(tables.notes[note + Note.KIND])
    return int(Held.CURVATURE) if CW <= kind <= SPLINE else int(Held.CORNERS)


def most_used(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger
) -> tuple[float, bool]:
    """The largest part of an axis's acceleration or jerk in the middle of a part, and whether it is along the path.

    `ledger` gets the cause.
    """
    time, length = 0.5 * records[at + PieceRecord.TIME], records[at + PieceRecord.LENGTH]
    speed, jerk = sqrt(records[at + PieceRecord.SPEED2]), records[at + PieceRecord.JERK]
    pull = records[at + PieceRecord.PULL] + time * jerk
    speed += time * (pull - 0.5 * time * jerk)
    own, ease = limits_of(tables, note, n), tables.notes[note + Note.EASE]
    most, is_along = 0.0, False
    for i in range(n):
        here = at + PieceRecord.VECTORS + i
        turn = 0.5 * (records[here] + records[here + n])
        bend = 0.5 * (records[here + 2 * n] + records[here + 3 * n])
        third = (records[here + 3 * n] - records[here + 2 * n]) / length if length > 0.0 else 0.0
        along, across = turn * pull, bend * speed * speed
        used = abs(along + across) / (ease * tables.limits[own + Limit.PULL * n + i])
        if used > most:
            most, is_along, ledger.axis = used, abs(along) > abs(across), i
            ledger.cause = Held.ACCELERATION if is_along else curve_of(tables, note)
        along, across = turn * jerk, speed * (3.0 * bend * pull + third * speed * speed)
        used = abs(along + across) / (ease * tables.limits[own + Limit.JERK * n + i])
        if used > most:
            most, is_along, ledger.axis = used, abs(along) > abs(across), i
            ledger.cause = Held.JERK if is_along else Held.CORNER_JERK
    if ledger.cause == Held.CORNERS:
        ledger.axis = WHOLE
    return most, is_along
