"""Threads on a lathe in several cuts, over one part or a chain of parts (SINUMERIK CYCLE97, CYCLE98).

Points are (a, b): `a` along the thread, `b` the radius.
"""

from __future__ import annotations

from math import copysign, radians, sqrt, tan

from polycnc.cycles import count
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.geometry.arcs import Point


_WHOLE = 1e-9


class ThreadStroke(NamedTuple):
    """A stroke of a threading cycle: rapid where `lead` is 0."""

    end: Point
    lead: float = 0.0
    start_angle_deg: float = 0.0


@dataclass(frozen=True, slots=True)
class Thread:
    """A thread; mm.

    Attributes:
        corners: Points of the thread's crest: start, joints of a chain, end.
        leads: Lead of each part.
        run_in, run_out: Ways in front of the start and behind the end; a run-out above 0 goes beyond the end.
        depth: Of the thread.
        allowance: Left for one finishing cut.
        cuts, idle: Numbers of roughing cuts and of cuts at full depth afterwards.
        inside: An internal thread.
        degressive: Every cut takes the same cross-section; else the same depth.
        flank_deg: Angle of infeed: 0 straight, above along one flank, below along both in turn.
        start_angle_deg: Spindle angle of the first start.
        starts: Number of starts.
        lift: Way off the thread between cuts.
        roughs: The roughing cuts are made; `finishes`: the one that takes the allowance, and the idle ones.
    """

    corners: Sequence[Point]
    leads: Sequence[float]
    run_in: float
    run_out: float
    depth: float
    allowance: float
    cuts: int
    idle: int
    inside: bool
    degressive: bool
    flank_deg: float
    start_angle_deg: float
    starts: int
    lift: float
    roughs: bool = True
    finishes: bool = True


def cuts_of_first(rough: float, first: float, *, degressive: bool) -> int:
    """Number of roughing cuts of which the first one is at most so deep."""
    share = rough / first
    return max(count.parts(share * share if degressive else share, 1.0, _WHOLE), 1)


def depths(thread: Thread) -> list[float]:
    """Depth of each cut that is made, below the crest: roughing, finishing, idle."""
    rough = thread.depth - thread.allowance
    parts = [k / thread.cuts for k in range(1, thread.cuts + 1)]
    found = [rough * (sqrt(part) if thread.degressive else part) for part in parts] if thread.roughs else []
    if not thread.finishes:
        return found
    last = 1 if thread.allowance > 0.0 or not thread.roughs else 0
    return found + [thread.depth] * (last + thread.idle)


def strokes(thread: Thread) -> Iterator[ThreadStroke]:
    """All cuts of all starts, from the start point in front of the thread and back to it."""
    corners = _with_runs(thread)
    inwards = 1.0 if thread.inside else -1.0
    onwards = copysign(1.0, corners[-1][0] - corners[0][0])
    edge = max if inwards < 0.0 else min
    off = edge(b for _, b in corners) - inwards * thread.lift
    slope = tan(radians(abs(thread.flank_deg)))
    yield ThreadStroke((corners[0][0], off))
    for start in range(thread.starts):
        angle = (thread.start_angle_deg + start * 360.0 / thread.starts) % 360.0
        for number, depth in enumerate(depths(thread), 0 if thread.roughs else thread.cuts):
            shift = onwards * depth * slope * (-1.0 if thread.flank_deg < 0.0 and number % 2 else 1.0)
            if shift:
                yield ThreadStroke((corners[0][0] + shift, off))
            yield ThreadStroke((corners[0][0] + shift, corners[0][1] + inwards * depth))
            for (a, b), lead in zip(corners[1:], thread.leads, strict=True):
                yield ThreadStroke((a, b + inwards * depth), lead, angle)
            yield ThreadStroke((corners[-1][0], off))
            yield ThreadStroke((corners[0][0], off))


def _with_runs(thread: Thread) -> list[Point]:
    """The corners with run-in and run-out, on the lines of the first and last part."""
    corners = list(thread.corners)
    first = _extended(corners[1], corners[0], thread.run_in)
    last = _extended(corners[-2], corners[-1], thread.run_out)
    return [first, *corners[1:-1], last]


def _extended(before: Point, end: Point, way: float) -> Point:
    """A point beyond the end of a line, `way` further along `a`."""
    da, db = end[0] - before[0], end[1] - before[1]
    part = way / abs(da)
    return end[0] + part * da, end[1] + part * db
