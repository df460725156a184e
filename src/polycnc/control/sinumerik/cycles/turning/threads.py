"""Threads CYCLE97 to CYCLE99 on a lathe (strokes: `polycnc.cycles.turning.thread_chain`)."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, degrees

from polycnc.control.sinumerik.cycles.drilling import METRIC_PITCHES, pitch, written_pitch
from polycnc.control.sinumerik.cycles.turning.work import LIFT_MM
from polycnc.control.sinumerik.errors import not_supported
from polycnc.cycles.turning import thread_chain as thread_turning
from polycnc.cycles.turning.thread_chain import Thread
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
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
    """CYCLE98: three threads in a row; newer calls say in the digits of VARI what CYCLE99 says there.

    Raises:
        AlarmError: As `thread_of_plane`.
    """
    corners = [(a[f"PO{i}"], a[f"DM{i}"]) for i in range(1, 5)]
    leads = [abs(written_pitch(a, f"PP{i}")) for i in range(1, 4)]
    if not all(leads):
        raise AlarmError("61001")
    _thread(moves, a, corners, leads, technology=_technology(a, ""))


#: CYCLE98, CYCLE99: what their parameters must be, as far as they are executed: pitches that do not change, absolute.
_ONLY_ZERO = "_GDEP _PIT1 _FDEP _GST _GUD _AMODE".split()  # noqa: SIM905 - a table
#: Digits of their VARI: how cuts go in, whether it roughs and finishes, the order of the starts.
INFEED_PLACE, STAGE_PLACE, ORDER_PLACE, ALTERNATING = 2, 5, 6, 2
ROUGHING, FINISHING, COMPLETE = 1, 2, 3
#: Greatest digits that are known at the other places; which of number and depth the mask shows is one of them.
MOST_OF_VARI = {1: 0, INFEED_PLACE: ALTERNATING, 3: 0, 4: 1, ORDER_PLACE: 1, 7: 0}


def thread_of_plane(moves: Moves, a: Arguments) -> None:
    """CYCLE99: thread lengthwise, on a cone or a face, roughed, finished or both.

    Raises:
        AlarmError: 61001 without pitch, 61002 for VARI, 61601 for one deeper than its radius, 61605 for one without
            length, 61610 for roughing without number or depth of cuts; PC0001 for what is not executed.
    """
    technology = _technology(a, "_")
    lead = abs(written_pitch(a, "_PIT"))
    if not lead:
        raise AlarmError("61001")
    stage = technology.stage
    if stage != FINISHING and not a.integer("_NRC") and not abs(a["_MID"]):
        raise AlarmError("61610")
    # The editor leaves the second diameter out where the thread is none of a taper.
    corners = [(a["_SPL"], a["_DM1"]), (a["_FPL"], a["_DM2"] or a["_DM1"])]
    _thread(moves, a, corners, [lead], prefix="_", technology=technology, lift=a["_SDIS"])


class Technology(NamedTuple):
    """What the digits of VARI say: units as CYCLE97, the angle of infeed, whether it roughs and finishes."""

    kind: int
    flank: float
    stage: int = COMPLETE


def _technology(a: Arguments, prefix: str) -> Technology:
    """What a call of CYCLE98 or CYCLE99 says in its digits; names of CYCLE99 have a prefix.

    Raises:
        AlarmError: 61002 for digits that do not exist; PC0001 for what is not executed.
    """
    vari = f"{prefix}VARI"
    kind = a.digit(vari, 0)
    if kind not in KINDS or a.integer(vari) < 0:
        raise AlarmError("61002")
    wrong = [name for name in _ONLY_ZERO if a.has(name) and a.plain(name)]
    is_ordered = a.digit(vari, ORDER_PLACE) and a.integer(f"{prefix}NUMT") > 1
    if is_ordered or any(a.digit(vari, place) > most for place, most in MOST_OF_VARI.items()):
        wrong.append("_VARI")
    if a.integer(f"{prefix}NRC") and a["_MID"]:
        wrong.append("_MID")  # which of both counts?
    if wrong:
        raise not_supported(f"{a.cycle} {wrong[0]}")
    stage = a.digit(vari, STAGE_PLACE) or COMPLETE
    if stage > COMPLETE:
        raise AlarmError("61002")
    flank = a[f"{prefix}IANG"]
    if not flank and a["_IFLANK"]:
        flank = degrees(atan2(abs(a["_IFLANK"]), abs(a[f"{prefix}TDEP"])))
    if a.digit(vari, INFEED_PLACE) == ALTERNATING:
        flank = -abs(flank)
    return Technology(kind, flank, stage)


def _thread(
    moves: Moves,
    a: Arguments,
    corners: Sequence[Point],
    leads: Sequence[float],
    *,
    prefix: str = "",
    technology: Technology | None = None,
    lift: float | None = None,
) -> None:
    """Cut a thread; what is not given here has the names of CYCLE97, behind a prefix.

    A thread that is steeper than 45 degrees lies on a face: its cuts run along X, its depth is one along Z.
    """
    kind, flank, stage = technology or Technology(a.integer("VARI"), a["IANG"])
    lift = a["_VRT"] if lift is None else lift
    if kind not in KINDS:
        raise AlarmError("61002")
    is_face = _on_face(a, corners)
    if is_face:
        corners = [(radius, along) for along, radius in corners]
    elif kind not in INSIDE_KINDS and min(radius for _, radius in corners) < abs(a[f"{prefix}TDEP"]):
        raise AlarmError("61601")
    cuts, degressive = max(abs(a.integer(f"{prefix}NRC")), 1), kind in (3, 4)
    if a.has("_MID") and a["_MID"]:
        rough = max(abs(a[f"{prefix}TDEP"]) - abs(a[f"{prefix}FAL"]), 0.0)
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
        flank_deg=flank,
        start_angle_deg=a[f"{prefix}NSP"],
        starts=max(a.integer(f"{prefix}NUMT"), 1),
        lift=lift if lift > 0.0 else LIFT_MM,
        roughs=stage != FINISHING,
        finishes=stage != ROUGHING,
    )
    for stroke in thread_turning.strokes(cutting):
        end = stroke.end[::-1] if is_face else stroke.end
        if stroke.lead:
            moves.thread(*end, stroke.lead, stroke.start_angle_deg)
        else:
            moves.rapid(*end)
        moves.end_block()


def _on_face(a: Arguments, corners: Sequence[Point]) -> bool:
    """Whether a thread lies on a face.

    Raises:
        AlarmError: 61605 for a part without length; PC0001 for a chain that lies on both.
    """
    steep = set()
    for (a0, b0), (a1, b1) in pairwise(corners):
        if a0 == a1 and b0 == b1:
            raise AlarmError("61605")
        steep.add(abs(b1 - b0) > abs(a1 - a0))
    if len(steep) > 1:
        raise not_supported(f"{a.cycle}: face thread")
    return steep == {True}
