"""Threads CYCLE97 to CYCLE99 on a lathe (strokes: `polycnc.cycles.turning.thread_chain`)."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, degrees
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.cycles.drilling import METRIC_PITCHES, pitch
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.turning import thread_chain as thread_turning
from polycnc.cycles.turning.thread_chain import Thread
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.control.sinumerik.cycles.arguments import Arguments
    from polycnc.control.sinumerik.cycles.moves import Moves
    from polycnc.geometry.arcs import Point

#: Kinds of threads: outside, inside with equal depths of cuts, then both with equal cross-sections.
KINDS = (1, 2, 3, 4)
INSIDE_KINDS = (2, 4)
#: Further coarse metric threads that can be cut, but not tapped, by their nominal diameter.
LARGE_PITCHES = {52: 5.0, 56: 5.5, 60: 5.5}


def thread(moves: Moves, a: Arguments) -> None:
    """CYCLE97: thread between SPL and FPL."""
    corners = [(a["SPL"], a["DM1"]), (a["FPL"], a["DM2"])]
    lead = abs(pitch(a, {**METRIC_PITCHES, **LARGE_PITCHES}))
    _thread(moves, a, corners, [lead])


def thread_chain(moves: Moves, a: Arguments) -> None:
    """CYCLE98: three threads in a row."""
    corners = [(a[f"PO{i}"], a[f"DM{i}"]) for i in range(1, 5)]
    leads = [abs(a[f"PP{i}"]) for i in range(1, 4)]
    if not all(leads):
        raise AlarmError("61001")
    _thread(moves, a, corners, leads)


#: CYCLE99: what its parameters must be, as far as it is executed: one pitch, lengthwise, absolute.
_ONLY_ZERO = "_GDEP _PIT1 _FDEP _GST _GUD _AMODE".split()  # noqa: SIM905 - a table
_PITCH_UNITS = (0, 1)
#: Digits of its VARI: how cuts go in, whether it roughs and finishes, the order of the starts.
INFEED_PLACE, STAGE_PLACE, ORDER_PLACE, ALTERNATING = 2, 5, 6, 2
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
#: Greatest digits that are known at the other places; which of number and depth the mask shows is one of them.
MOST_OF_VARI = {1: 0, INFEED_PLACE: ALTERNATING, 3: 0, 4: 1, ORDER_PLACE: 1, 7: 0}


def thread_of_plane(moves: Moves, a: Arguments) -> None:
    """CYCLE99: thread lengthwise, roughed, finished or both; other kinds are PC0001.

    Raises:
        AlarmError: 61001 without pitch, 61002 for VARI, 61601 for one deeper than its radius, 61610 for roughing
            without number or depth of cuts; PC0001 for what is not executed.
    """
    kind = a.digit("_VARI", 0)
    if kind not in KINDS or a.integer("_VARI") < 0:
        raise AlarmError("61002")
    lead = abs(a["_PIT"])
    if not lead:
        raise AlarmError("61001")
    wrong = [name for name in _ONLY_ZERO if a.plain(name)]
    if a.integer("_PITA") not in _PITCH_UNITS:
        wrong.append("_PITA")
    is_ordered = a.digit("_VARI", ORDER_PLACE) and a.integer("_NUMT") > 1
    if is_ordered or any(a.digit("_VARI", place) > most for place, most in MOST_OF_VARI.items()):
        wrong.append("_VARI")
    if a.integer("_NRC") and a["_MID"]:
        wrong.append("_MID")  # which of both counts?
    if wrong:
        raise not_supported(f"CYCLE99 {wrong[0]}")
    stage = a.digit("_VARI", STAGE_PLACE) or COMPLETE
    if stage > COMPLETE:
        raise AlarmError("61002")
    if stage != FINISHING and not a.integer("_NRC") and not abs(a["_MID"]):
        raise AlarmError("61610")
    flank = a["_IANG"]
    if not flank and a["_IFLANK"]:
        flank = degrees(atan2(abs(a["_IFLANK"]), abs(a["_TDEP"])))
    if a.digit("_VARI", INFEED_PLACE) == ALTERNATING:
        flank = -abs(flank)
    # The editor leaves the second diameter out where the thread is none of a taper.
    corners = [(a["_SPL"], a["_DM1"]), (a["_FPL"], a["_DM2"] or a["_DM1"])]
    _thread(moves, a, corners, [lead], prefix="_", kind=kind, flank=flank, lift=a["_SDIS"], stage=stage)


def _thread(
    moves: Moves,
    a: Arguments,
    corners: Sequence[Point],
    leads: Sequence[float],
    *,
    prefix: str = "",
    kind: int | None = None,
    flank: float | None = None,
    lift: float | None = None,
    stage: int = COMPLETE,
) -> None:
    """Cut a thread; what is not given here has the names of CYCLE97, behind a prefix."""
    kind = a.integer("VARI") if kind is None else kind
    lift = a["_VRT"] if lift is None else lift
    if kind not in KINDS:
        raise AlarmError("61002")
    for (a0, b0), (a1, b1) in pairwise(corners):
        if a0 == a1 or abs(b1 - b0) > abs(a1 - a0):
            raise not_supported(f"{a.cycle}: face thread")
    if kind not in INSIDE_KINDS and min(radius for _, radius in corners) < abs(a[f"{prefix}TDEP"]):
        raise AlarmError("61601")
    cuts, degressive = max(abs(a.integer(f"{prefix}NRC")), 1), kind in (3, 4)
    if a.has("_MID") and a["_MID"]:
        rough = max(abs(a["_TDEP"]) - abs(a["_FAL"]), 0.0)
        cuts = thread_turning.cuts_of_first(rough, abs(a["_MID"]), degressive=degressive)
    cutting = Thread(
        corners,
        leads,
        run_in=abs(a[f"{prefix}APP"]),
        run_out=abs(a[f"{prefix}ROP"]),
        depth=abs(a[f"{prefix}TDEP"]),
        allowance=abs(a[f"{prefix}FAL"]),
        cuts=cuts,
        idle=abs(a.integer(f"{prefix}NID")),
        inside=kind in INSIDE_KINDS,
        degressive=degressive,
        flank_deg=a[f"{prefix}IANG"] if flank is None else flank,
        start_angle_deg=a[f"{prefix}NSP"],
        starts=max(a.integer(f"{prefix}NUMT"), 1),
        lift=lift if lift > 0.0 else LIFT_MM,
        roughs=stage != FINISHING,
        finishes=stage != ROUGHING,
    )
    for stroke in thread_turning.strokes(cutting):
        if stroke.lead:
            moves.thread(*stroke.end, stroke.lead, stroke.start_angle_deg)
        else:
            moves.rapid(*stroke.end)
        moves.end_block()
