"""Threads as strokes: a pass with its run-out, the passes of a whole thread (FANUC 0i-TF Plus II.4.1.2, 4.2.7)."""

from __future__ import annotations

from math import copysign, radians, sqrt, tan

from polycnc.cycles.turning.stroke import PlaneStroke, rapid
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.geometry.arcs import Point


@dataclass(frozen=True, slots=True)
class Runout:
    """How a thread leaves the material: over `length` mm of the first axis at an angle; length 0 for none."""

    length: float = 0.0
    angle_deg: float = 45.0


def thread_strokes(
    begin: Point, end: Point, retract: float, runout: Runout, start_angle_deg: float = 0.0
) -> Iterator[PlaneStroke]:
    """One pass from `begin` to `end`: straight, then out towards `retract` on the second axis, and no farther."""
    way = end[0] - begin[0]
    length = min(runout.length, abs(way)) if end[1] != retract else 0.0
    if length <= 0.0:
        yield PlaneStroke(Kind.THREAD, end, start_angle_deg=start_angle_deg)
        return
    part = 1.0 - length / abs(way)
    leaving = (begin[0] + part * way, begin[1] + part * (end[1] - begin[1]))
    if part > 0.0:
        yield PlaneStroke(Kind.THREAD, leaving, start_angle_deg=start_angle_deg)
    rise, room = length * tan(radians(runout.angle_deg)), retract - leaving[1]
    share = min(1.0, abs(room) / rise)
    out = (
        leaving[0] + share * (end[0] - leaving[0]),
        retract if share < 1.0 else leaving[1] + copysign(rise, room),
    )
    yield PlaneStroke(Kind.THREAD, out, start_angle_deg=start_angle_deg)


def thread_pass(
    start: Point, begin: Point, last: Point, runout: Runout, start_angle_deg: float = 0.0
) -> Iterator[PlaneStroke]:
    """One pass of a cycle: to where it begins, along the thread, off it, and back to the start."""
    yield rapid(*begin)
    strokes = list(thread_strokes(begin, last, start[1], runout, start_angle_deg))
    yield from strokes
    yield rapid(strokes[-1].end[0], start[1])
    yield rapid(*start)


@dataclass(frozen=True, slots=True)
class ThreadCuts:
    """How a thread is divided into passes; all depths mm of radius.

    Attributes:
        height: Full depth, measured from the crest.
        first: Depth of the first pass.
        least: Depth that a pass adds at least.
        allowance: Left for finishing.
        finishing: Passes at full depth.
        constant_depth: Every pass goes `first` deeper; else every pass takes away the same amount of material.
    """

    height: float
    first: float
    least: float = 0.0
    allowance: float = 0.0
    finishing: int = 1
    constant_depth: bool = False


def depths(cuts: ThreadCuts) -> Iterator[float]:
    """Depth of each pass below the crest: roughing, then finishing at full depth.

    Equal material on one flank means that the area, which grows with the square of the depth, grows by the same
    amount each pass: `t = first·sqrt(n)`; no pass adds less than `least`.
    """
    rough = cuts.height - cuts.allowance
    depth, number = 0.0, 0
    while depth < rough - 1e-9:
        number += 1
        if cuts.constant_depth:
            wanted = cuts.first * number
        else:
            wanted = (
                cuts.first * sqrt(number)
                if number == 1
                else max(cuts.first * sqrt(number), depth + cuts.least)
            )
        depth = min(wanted, rough)
        yield depth
    for _ in range(cuts.finishing):
        yield cuts.height


def thread_passes(
    start: Point,
    end: Point,
    taper: float,
    cuts: ThreadCuts,
    *,
    half_angle_deg: float = 0.0,
    zigzag: bool = False,
) -> Iterator[tuple[Point, Point]]:
    """G76: where each pass begins and ends, from the crest to full depth.

    Args:
        start: Where the cycle begins.
        end: End of the thread at full depth.
        taper: How much further along the second axis the thread begins.
        cuts: The passes.
        half_angle_deg: Infeed along the flank of half the tip angle; 0 for straight infeed. A pass of depth t
            begins t·tan(half angle) further on, so that the tool cuts with one edge.
        zigzag: Every other pass is infed along the other flank of the finished thread: (2·height - t)·tan(half angle)
            further on, so that both flanks meet at full depth.
    """
    outside = copysign(1.0, start[1] - end[1])
    onwards = copysign(1.0, end[0] - start[0])
    slope = tan(radians(half_angle_deg))
    for number, depth in enumerate(depths(cuts)):
        above = outside * (cuts.height - depth)
        along_flank = 2.0 * cuts.height - depth if zigzag and number % 2 else depth
        shift = onwards * along_flank * slope
        begin = (start[0] + shift, end[1] + taper + above)
        last = (end[0], end[1] + above)
        yield begin, last
