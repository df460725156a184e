"""Blocks that name the direction of the tool and turn it by little: told as data, for scanner and interpreter alike.

Both ask one kernel (`transformation.orientation.standing`) where the rotary axes go; what it does not decide is worked
out by `orientation`. So both ways give the same bits.
"""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from polycnc.control.sinumerik.transformations import data_sets, seat
from polycnc.control.sinumerik.transformations.posture import Orienting, Posture
from polycnc.control.sinumerik.transformations.words import DIRECTION
from polycnc.geometry.frames import IDENTITY
from polycnc.transformation.orientation.directions import great_circle, tangent_at_end
from polycnc.transformation.orientation.records import StandRecord
from polycnc.transformation.orientation.standing import stand
from polycnc.transformation.orientation.stood import stand_record

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.transformations.words import Words
    from polycnc.geometry.frames import Vector

#: Half the opening of the cone about a pole in which the axes go evenly, degrees (MD24540 as delivered).
POLE_LIMIT = 2.0
#: How the tool turns in blocks that are told so, and motions that they have.
WAYS, MOTIONS = ("ORIVECT", "ORIAXES"), ("G0", "G1")


def places_of(words: Words, mode: Mode, kind: str) -> tuple[int, int, int] | None:
    """Where A3, B3 and C3 stand in a block, -1 for those left out, if it says no more of the direction; else None.

    `kind` is the function of group 51 by which the direction goes.
    """
    others = words.single or words.second or words.polynomials or words.columns
    if others or words.triples.keys() != {DIRECTION}:
        return None
    if kind not in WAYS or mode["motion"] not in MOTIONS or mode["point_to_point"] not in ("CP", "PTPG0"):
        return None
    if mode["point_to_point"] == "PTPG0" and mode["motion"] == "G0":
        return None
    if mode["orientation_smoothing"] != "OSOF" or mode["rotation_vector"] == "ORIROTC":
        return None
    found = words.triples[DIRECTION]
    return found.get(0, -1), found.get(1, -1), found.get(2, -1)


def record_of(channel: SinumerikChannel, mode: Mode, kind: str) -> array[float]:
    """What the kernel must know while a transformation acts; without two rotary joints it decides nothing."""
    point = seat.centre_point(channel)
    if point is None or kind not in WAYS:
        return stand_record(None)
    posture = Posture.of(channel, mode)
    return stand_record(
        point,
        frame=posture.seated.frame if posture.turned else IDENTITY,
        shifts=posture.seated.shifts,
        travel=posture.travel,
        cone_deg=pole_limit(channel),
        evenly=kind == "ORIAXES",
    )


def pole_limit(channel: SinumerikChannel) -> float:
    """MD24540 and its like: where the direction is nearer to a pole, the axes go evenly; degrees."""
    build = seat.Transformations.of(channel).build
    order = 1 if build is None else build.order
    return data_sets.number_of(channel, f"$MC_TRAFO5_POLE_LIMIT_{order}", 0, POLE_LIMIT)


def turned_end(
    channel: SinumerikChannel, mode: Mode, kind: str, vector: Vector, end: Sequence[float]
) -> list[float] | None:
    """The end of a block whose tool then stands along a programmed vector; None where the kernel does not decide it."""
    start, found = channel.coordinates.position, array("d", end)
    tool = record_of(channel, mode, kind)
    if not stand(tool, array("d", start), *vector, found):
        return None
    for column in (int(tool[StandRecord.OUTER]), int(tool[StandRecord.INNER])):
        channel.coordinates.pending[column] = 0.0
    channel.turning = None
    if kind == "ORIVECT":
        note_tangent(channel, mode, start, found.tolist())
    return found.tolist()


def note_tangent(channel: SinumerikChannel, mode: Mode, start: Sequence[float], end: Sequence[float]) -> None:
    """Remember how the direction changed at the end of a block that has turned the tool on a great circle."""
    posture = Posture.of(channel, mode)
    first, last = (posture.direction(posture.angles(list(place))) for place in (start, end))
    way = great_circle(first, last)
    Orienting.of(channel).tangent = None if way is None else tangent_at_end(way)
