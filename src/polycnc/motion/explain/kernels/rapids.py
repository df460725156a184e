"""Rapids on which every axis runs alone: the slowest one counts."""

from __future__ import annotations

from polycnc.kernels.layout import Floats
from polycnc.motion.explain.kernels.bounds import limits_of, resolve_rest
from polycnc.motion.explain.kernels.held import WHOLE, Held, Ledger, Limit, Note, Tables, add, wait
from polycnc.motion.kernels.alone import alone_pull, alone_top, best_ramp
from polycnc.motion.kernels.columns import PLACES, ContextRecord, PieceRecord


def share_timed(
    records: Floats, at: int, n: int, tables: Tables, note: int, ledger: Ledger, parts: Floats
) -> None:
    """Share a rapid out: its slowest axis has its highest speed, and before and behind that accelerates and brakes."""
    resolve_rest(tables, note, n, ledger, parts)
    ledger.joint2 = ledger.known2 = 0.0
    own, record = limits_of(tables, note, n), int(tables.notes[note + Note.RECORD])
    soft, place = records[at + PieceRecord.RAMP] > 0.0, at + PieceRecord.VECTORS + PLACES * n
    longest, even, share, axis = 0.0, 0.0, 0.0, WHOLE
    for i in range(n):
        way = abs(records[place + n + i] - records[place + i])
        if way == 0.0:
            continue
        limit, jerk = tables.limits[own + Limit.PULL * n + i], tables.limits[own + Limit.JERK * n + i]
        highest = rapid_top_of(tables, own, record, n, i)
        ramp = best_ramp(way, highest, limit, jerk) if soft else 0.0
        pull = alone_pull(ramp, limit, jerk)
        top = alone_top(way, highest, pull, ramp)
        seconds = way / top + top / pull + ramp
        if seconds > longest:
            longest, axis, even = seconds, i, max(way / top - top / pull, 0.0)
            share = min(even * top / way, 1.0)
    seconds, length = records[at + PieceRecord.TIME], records[at + PieceRecord.LENGTH]
    even = min(even, seconds)
    add(parts, n, int(Held.RAPID), axis, even, share * length)
    # It brakes for as long as it accelerates.
    half_s, half = 0.5 * (seconds - even), 0.5 * (1.0 - share) * length
    add(parts, n, int(Held.ACCELERATION), axis, half_s, half)
    wait(ledger, half_s, half)


def rapid_top_of(tables: Tables, own: int, record: int, n: int, i: int) -> float:
    """Highest speed of an axis that runs a rapid alone."""
    speed = tables.contexts[record + ContextRecord.RAPID_SPEED]
    if tables.limits[own + Limit.ROTARY * n + i] != 0.0:
        speed = speed / tables.contexts[record + ContextRecord.TURN_WEIGHT]
    top = tables.contexts[record + ContextRecord.RAPID_SHARE] * tables.limits[own + Limit.TOP_RAPID * n + i]
    return min(top, speed) if speed > 0.0 else top
