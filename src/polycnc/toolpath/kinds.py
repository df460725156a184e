"""Kinds of rows in a toolpath, and what rows of curves have beside their ends."""

from __future__ import annotations

from enum import IntEnum


class Kind(IntEnum):
    """What a row is. The lower-case name is the `type` of the trace; `EVENT` rows point to an `Event`."""

    RAPID = 0
    FEED = 1
    CW = 2
    CCW = 3
    HELIX_CW = 4
    HELIX_CCW = 5
    SPLINE = 6
    THREAD = 7
    TAP = 8
    REF = 9
    SKIP = 10
    DWELL = 11
    EVENT = 12


#: Value of the `curve` column where a row has no curve parameters.
NO_CURVE = -1
#: Numbers a curve row: centre x y z (work coordinates, mm), unit normal x y z of the arc's plane, full turns
#: beyond the first, spare. A dwell: seconds, revolutions. A thread or tap: lead mm, start angle degrees;
#: of a straight thread what its lead grows by each revolution and the ways on which it takes up its speed and brakes
#: (0: what the axes allow), mm; of a circular one its centre and the normal about which it turns counter-clockwise.
#: A skip move that a signal ends: way that is left to its programmed end, mm. A cut that is led beside its end
#: (`fairing.py`): how far, x y z of the machine, and the most that its line is off the programmed one, mm; the first
#: three rotary axes, degrees, and the most as a part of what each may be off.
CURVE_WIDTH = 8

#: The `type` of each kind in the trace, by its number.
TYPE_NAMES = tuple(kind.name.lower() for kind in Kind)
ARC_KINDS = frozenset((Kind.CW, Kind.CCW, Kind.HELIX_CW, Kind.HELIX_CCW))
#: Kinds whose curve parameters need no record of their own in a trace: columns show them, or nobody does.
SHOWN_IN_COLUMNS = frozenset((*ARC_KINDS, Kind.FEED))
CCW_KINDS = frozenset((Kind.CCW, Kind.HELIX_CCW))
HELIX_KINDS = frozenset((Kind.HELIX_CW, Kind.HELIX_CCW))
RAPID_KINDS = frozenset((Kind.RAPID, Kind.REF))


def arc_kind(*, ccw: bool, helix: bool) -> Kind:
    """The kind of an arc by its sense, and by whether it climbs along its normal."""
    if helix:
        return Kind.HELIX_CCW if ccw else Kind.HELIX_CW
    return Kind.CCW if ccw else Kind.CW
