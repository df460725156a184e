"""The arrays that the kernels of a jerk law work on."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Places, place


class Course(NamedTuple):
    """A bent path of n axes in m pieces, as flat arrays.

    Attributes:
        way: At its knots, mm (m + 1).
        first: q' there, (m + 1) · n.
        second: q'' there, (m + 1) · n.
        cap2: Largest square of the speed on each piece, (mm/s)² (m).
        ease: The part of acceleration and jerk of all axes that may be used there (m).
        third: q''' on each piece, m · n; the estimate sets it.
        low2: The same as `cap2`, and low enough for q'' and q''' alone: an estimate (m).
        x: Square of the speed at the knots by the estimate of second order (m + 1).
    """

    way: Floats
    first: Floats
    second: Floats
    cap2: Floats
    ease: Floats
    third: Floats
    low2: Floats
    x: Floats


class Axes(NamedTuple):
    """What the n axes can do: highest speed mm/s, acceleration mm/s², jerk mm/s³."""

    speed: Floats
    pull: Floats
    jerk: Floats


class Ends(Places):
    """How a law begins and ends: speed and acceleration along the path; both zero at rest."""

    START_SPEED = place()
    START_PULL = place()
    END_SPEED = place()
    END_PULL = place()


class Shape(Places):
    """What a node knows of one axis on its cell: half of q' at it, middles and half the ranges of 3/2 q'' and of q'''.

    They are parts of the jerk that the axis may have there. And 1 where it moves, 0 where it stands still.
    """

    FIRST = place()
    SECOND = place()
    SECOND_RANGE = place()
    THIRD = place()
    THIRD_RANGE = place()
    MOVES = place()


class Nodes(NamedTuple):
    """Places at which the square x of the speed is looked for, k of them.

    Attributes:
        way: mm, (k).
        x: Square of the speed as found, between which x is a quadratic B-spline, (k).
        cap2: Largest x on the cell of a node, half the way to both neighbours, (k).
        room: The part that may be used there of what the axes have, (k).
        shape: `Shape` of each axis, n times; each field has its k numbers in a row.
        stencil: `Stencil`; likewise.
    """

    way: Floats
    x: Floats
    cap2: Floats
    room: Floats
    shape: Floats
    stencil: Floats


class Known(NamedTuple):
    """Nodes of a law with which another one goes on; the fields are those of `Nodes`."""

    way: Floats
    x: Floats
    cap2: Floats
    room: Floats


class Stencil(Places):
    """How x, x' and x'' at a node follow from x at the nodes before and behind, each less that at itself.

    Each is the sum of both by these factors and of a fixed number; for x that at the node itself comes to it.
    Besides, the way from the node before, that of the cell, and a factor of the time in which it is passed.
    """

    SLOPE = place(2)
    BEND = place(2)
    VALUE = place(2)
    VALUE_FIXED = place()
    SLOPE_FIXED = place()
    BEND_FIXED = place()
    BEFORE = place()
    CELL = place()
    TIME = place()


#: Nodes whose barriers are found at once.
BATCH = 128


class Force(Places):
    """What the barriers of nodes come to; each field has `BATCH` numbers in a row.

    x, x' and x'' there; a factor of all that follows; the part of jerk by √x that there is room for, and how it falls
    with x; the slack below which its barrier is a parabola. Slopes, with the other sign, and bends: at first by x (X),
    x' (S) and x'' (B), then by x at the nodes before (0), here (1) and behind (2).
    """

    X = place()
    SLOPE = place()
    BEND = place()
    OWN = place()
    WIDE = place()
    HALF = place()
    SOFT = place()
    GX = place()
    GS = place()
    GB = place()
    HXX = place()
    HXS = place()
    HXB = place()
    HSS = place()
    HSB = place()
    HBB = place()
    H00 = place()
    H01 = place()
    H02 = place()
    H11 = place()
    H12 = place()
    H22 = place()
    G0 = place()
    G1 = place()
    G2 = place()


class Work(NamedTuple):
    """Which axes move, and room for the steps of Newton's method.

    Attributes:
        moves: For each axis 1 where it moves anywhere, 0 where it stands still, (n).
        bands: What is left of the row of each node for the way back, `BANDS` numbers.
        forces: `Force` of a batch of nodes.
    """

    moves: Floats
    bands: Floats
    forces: Floats


class Phase(Places):
    """A phase of constant jerk: its duration s, way mm, speed, acceleration and jerk at its start."""

    TIME = place()
    WAY = place()
    SPEED = place()
    PULL = place()
    JERK = place()
