"""The record of `standing` by name: all that a scanner needs of it while no block turns the tool."""

from __future__ import annotations

from polycnc.kernels.layout import Places, place


class StandRecord(Places):
    """What `stand` must know; `d = R(outer) R(inner) along` is the tool seen from the work.

    Of each axis: its column (-1: there is no such record), its direction, 1 or -1 as it turns the tool, what is added
    to its position for the angle of its joint, and the lowest and highest angle. FRAME are nine numbers by rows that
    turn a programmed direction. CONE is half the opening of the cones about poles, degrees; EVENLY is 1 where the axes
    go evenly however far they turn.
    """

    OUTER = place()
    INNER = place()
    OUTER_DIRECTION = place(3)
    INNER_DIRECTION = place(3)
    SENSE = place(2)
    ADDED = place(2)
    LOW = place(2)
    HIGH = place(2)
    ALONG = place(3)
    FRAME = place(9)
    CONE = place()
    EVENLY = place()
