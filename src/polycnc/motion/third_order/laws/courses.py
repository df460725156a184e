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
        low2: The same, and low enough for q'' and q''' alone: an estimate (m).
        x: Square of the speed at the knots by the estimate of second order (m + 1).
    """

    way: Floats
    first: Floats
    second: Floats
    cap2: Floats
    ease: Floats
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
    """What a node knows of one axis on its cell: half of q' at it, the middles and half the ranges of q'' and q'''.

    They are parts of the limits: of the acceleration first; those of the jerk have half of q', 3/2 of q'', and q'''.
    """

    FIRST = place()
    SECOND = place()
    SECOND_RANGE = place()
    JOLT_FIRST = place()
    JOLT_SECOND = place()
    JOLT_RANGE = place()
    THIRD = place()
    THIRD_RANGE = place()


class Nodes(NamedTuple):
    """Places at which the square x of the speed is looked for, k of them.

    Attributes:
        way: mm, (k).
        x: Square of the speed as found, between which x is a quadratic B-spline, (k).
        cap2: Largest x on the cell of a node, half the way to both neighbours, (k).
        room: The part of acceleration and jerk that may be used there, (k).
        shape: `Shape` of each axis, k · n of them.
        stencil: `Stencil`, k of them.
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
    """How value, slope and bend of x at a node follow from x at the node before, at itself, and behind."""

    SLOPE = place(3)
    BEND = place(3)
    VALUE = place(3)
    VALUE_FIXED = place()
    SLOPE_FIXED = place()
    BEND_FIXED = place()


class Phase(Places):
    """A phase of constant jerk: its duration s, way mm, speed, acceleration and jerk at its start."""

    TIME = place()
    WAY = place()
    SPEED = place()
    PULL = place()
    JERK = place()
