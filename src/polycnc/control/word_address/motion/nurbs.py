"""NURBS interpolation G06.2: blocks bring poles and knots; the last knot lets the curve be cut."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from math import dist

from polycnc.channel.moves.knots import write_chords
from polycnc.control.word_address.motion import path
from polycnc.control.word_address.states import Curve, CurveState
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath import Kind

if TYPE_CHECKING:
    from polycnc.control.word_address.block.codes import Step
    from polycnc.control.word_address.block.plan import Builder, Plan
    from polycnc.control.word_address.family import WordAddressChannel

ORDERS, DEFAULT_ORDER = (2, 3, 4), 4
WEIGHTS, DEFAULT_WEIGHT = (0.001, 1000.0), 1.0
#: How far the chords that are written may leave the curve, mm.
CHORD_TOLERANCE_MM = 0.001
#: How far the first pole may lie from where the tool stands, mm.
START_WINDOW_MM = 0.0015


def plan_nurbs(builder: Builder, plan: Plan) -> Step | None:
    """G06.2 [P] K X Y Z [R]: a pole with its knot; K alone: one of the knots that remain."""
    control = builder.control
    begins = any(row.code == "G6.2" for row in builder.codes)
    order_slot, knot, weight = (builder.slot(address) for address in "PKR")
    builder.take("P", "K", "R")
    if knot is None:
        if plan.axis_words or begins:
            raise control.fail("curve_format", address="K")
        return None

    def collect(channel: WordAddressChannel, values: list[float]) -> None:
        state = CurveState.of(channel)
        if begins:
            check_complete(channel)
            order = DEFAULT_ORDER if order_slot is None else values[order_slot]
            if order not in ORDERS:
                raise control.fail("curve_order", address="P")
            state.curve = Curve(int(order))
        curve = state.curve
        if curve is None or (curve.knots and values[knot] < curve.knots[-1]):
            raise control.fail("curve_knot", address="K")
        curve.knots.append(values[knot])
        if plan.axis_words:
            if len(curve.knots) != len(curve.poles) + 1:
                raise control.fail("curve_format", address="K")
            factor = DEFAULT_WEIGHT if weight is None else values[weight]
            if not WEIGHTS[0] <= factor <= WEIGHTS[1]:
                raise control.fail("curve_weight", address="R")
            pole = path.reach(channel, plan.axis_words, values)
            point = channel.coordinates.to_position(pole)
            if (
                begins
                and control.CURVE_BEGINS_AT_TOOL
                and dist(point, channel.coordinates.position) > START_WINDOW_MM
            ):
                raise control.fail("curve_start", address=plan.axis_words[0].address)
            channel.coordinates.programmed = pole
            curve.poles.append(tuple(point))
            curve.weights.append(factor)
        elif curve.is_complete:
            state.curve = None
            _cut(channel, curve)

    return collect


def then(step: Step | None) -> Step:
    """A step of another motion code behind a curve, which must be complete."""

    def act(channel: WordAddressChannel, values: list[float]) -> None:
        check_complete(channel)
        if step is not None:
            step(channel, values)

    return act


def check_complete(channel: WordAddressChannel) -> None:
    """Alarm for a curve whose knots have not all come."""
    if CurveState.of(channel).curve is not None:
        raise channel.control.fail("curve_knot", address="K")


def _cut(channel: WordAddressChannel, curve: Curve) -> None:
    from polycnc.geometry.nurbs import nurbs_chords

    order, poles = curve.order, curve.poles
    if not channel.feed > 0.0:
        raise channel.control.fail("no_feed")
    inside = curve.knots[order - 1 : len(poles) + 1]
    if len(poles) < order or not any(a < b for a, b in pairwise(inside)):
        raise channel.control.fail("curve_knot", address="K")
    points = nurbs_chords(order, curve.knots, poles, curve.weights, CHORD_TOLERANCE_MM)
    write_chords(channel, map(list, points), channel.feed, partial(channel.straight, Kind.SPLINE))


def close_curve(builder: Builder, _plan: Plan, step: Step | None) -> Step | None:
    """A block of another motion code behind a curve."""
    return then(step) if builder.before["motion"] == "G6.2" != builder.mode["motion"] else step
