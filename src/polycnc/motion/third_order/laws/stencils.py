"""Value, slope and bend of a quadratic B-spline at its nodes, by its control values.

The spline has its knots in the middles between the nodes, so that its control points lie a quarter of the difference of
both distances behind the nodes. Beside a rest x grows with the way to the power of 4/3, which no parabola does: up to
the first node it is that, and the spline begins there.
"""

from __future__ import annotations

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Ends, Nodes, Stencil


def lay_stencils(nodes: Nodes, ends: Floats) -> None:
    """How value, slope and bend at each node follow from the control values at three."""
    last = len(nodes.way) - 1
    rest, stop = nodes.x[0] == 0.0, nodes.x[last] == 0.0
    here, there = _control(nodes, 0, last, rest, stop), _control(nodes, 1, last, rest, stop)
    behind, fall = nodes.way[1] - nodes.way[0], 1.0 / (there - here)
    for k in range(1, last):
        before, rise = behind, fall
        behind = nodes.way[k + 1] - nodes.way[k]
        here, there = there, _control(nodes, k + 1, last, rest, stop)
        fall = 1.0 / (there - here)
        _inner(nodes, k, before, behind, rise, fall)
    for k in range(last + 1):
        _cell(nodes, k, last)
    _end(nodes, 0, 1, ends[Ends.START_SPEED], ends[Ends.START_PULL])
    _end(nodes, last, -1, ends[Ends.END_SPEED], ends[Ends.END_PULL])


def _cell(nodes: Nodes, k: int, last: int) -> None:
    """The cell of a node; the time for it is `cell/√x`, from or to rest `3·way/√x`."""
    count, near, far = last + 1, max(k - 1, 0), min(k + 1, last)
    before, behind, time = nodes.way[k] - nodes.way[near], nodes.way[far] - nodes.way[k], 1.0
    cell = 0.5 * (before + behind)
    if nodes.x[near] == 0.0:
        time += 2.5 * before / cell
    if nodes.x[far] == 0.0:
        time *= 1.0 + 2.5 * behind / cell
    for field in range(Stencil.VALUE_FIXED, Stencil.BEFORE):
        nodes.stencil[field * count + k] = 0.0
    nodes.stencil[Stencil.BEFORE * count + k] = before
    nodes.stencil[Stencil.CELL * count + k] = cell
    nodes.stencil[Stencil.TIME * count + k] = time


def _control(nodes: Nodes, k: int, last: int, rest: bool, stop: bool) -> float:
    """The way at a control point."""
    way = nodes.way[k]
    before = 0.0 if k == 0 or (rest and k == 1) else way - nodes.way[k - 1]
    behind = 0.0 if k == last or (stop and k == last - 1) else nodes.way[k + 1] - way
    return way + 0.25 * (behind - before)


def _inner(nodes: Nodes, k: int, before: float, behind: float, rise: float, fall: float) -> None:
    """The stencil of a node by the distances of its neighbours; slopes are differences times `rise` and `fall`."""
    s, count, inverse = nodes.stencil, len(nodes.way), 1.0 / (before + behind)
    bend, bend2 = 2.0 * inverse * rise, 2.0 * inverse * fall
    value_, shift = 0.125 * before * before, 0.25 * (before - behind) * rise
    s[Stencil.SLOPE * count + k] = -behind * inverse * rise
    s[(Stencil.SLOPE + 1) * count + k] = before * inverse * fall
    s[Stencil.BEND * count + k] = bend
    s[(Stencil.BEND + 1) * count + k] = bend2
    s[Stencil.VALUE * count + k] = value_ * bend - shift
    s[(Stencil.VALUE + 1) * count + k] = value_ * bend2


def _end(nodes: Nodes, k: int, side: int, speed: float, pull: float) -> None:
    """The stencil at an end, or of the first node behind a rest; `side` is where the path lies."""
    count, rest = len(nodes.way), 0.0
    last = count - 1
    outer, inner, s = (1 - side) // 2, (1 + side) // 2, nodes.stencil
    if speed == 0.0:
        k += side
        rest = abs(nodes.way[k] - nodes.way[k - side])
    for field in range(Stencil.BEFORE):
        s[field * count + k] = 0.0
    step = abs(nodes.way[k + side] - nodes.way[k])
    starts, stops = nodes.x[0] == 0.0, nodes.x[last] == 0.0
    own = _control(nodes, k, last, starts, stops)
    bend = 2.0 / step / abs(_control(nodes, k + side, last, starts, stops) - own)
    if speed > 0.0:
        slope = 2.0 * pull
        s[(Stencil.BEND + inner) * count + k] = bend
        s[Stencil.VALUE_FIXED * count + k] = -0.25 * side * step * slope
        s[Stencil.SLOPE_FIXED * count + k] = slope
        s[Stencil.BEND_FIXED * count + k] = -2.0 * side * slope / step
        return
    # at the rest x is zero: so its factors are free, and make up for those of x at the node
    value_ = 1.0 / (1.0 + step / (3.0 * rest))
    slope = side * 4.0 / (3.0 * rest) * value_
    # the mean bend of way^(4/3) up to the middle, and the one beside the rest
    found = 8.0 / 3.0 / step * ((rest + 0.5 * step) ** (1.0 / 3.0) - rest ** (1.0 / 3.0))
    factor = 4.0 / 9.0 * rest ** (-2.0 / 3.0) / found
    s[(Stencil.VALUE + outer) * count + k] = 1.0 - value_
    s[(Stencil.SLOPE + outer) * count + k] = -slope
    s[(Stencil.BEND + inner) * count + k] = bend * factor
    s[(Stencil.BEND + outer) * count + k] = 2.0 * side / step * slope * factor


def value(nodes: Nodes, k: int) -> tuple[float, float, float]:
    """x, x' and x'' at a node."""
    count, here, s = len(nodes.way), nodes.x[k], nodes.stencil
    before, behind = nodes.x[max(k - 1, 0)] - here, nodes.x[min(k + 1, count - 1)] - here
    return (
        here
        + s[Stencil.VALUE * count + k] * before
        + s[(Stencil.VALUE + 1) * count + k] * behind
        + s[Stencil.VALUE_FIXED * count + k],
        s[Stencil.SLOPE * count + k] * before
        + s[(Stencil.SLOPE + 1) * count + k] * behind
        + s[Stencil.SLOPE_FIXED * count + k],
        s[Stencil.BEND * count + k] * before
        + s[(Stencil.BEND + 1) * count + k] * behind
        + s[Stencil.BEND_FIXED * count + k],
    )
