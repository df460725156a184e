"""The quickest law at given nodes: Newton's method with barriers, in a few passes.

Between the nodes the square x of the speed is a quadratic B-spline over the way: its bend x'' is constant on the cell
of each node, and value, slope and bend at a node follow from three neighbours (`Stencil`). With u = x'/2 and the jerk
along the path w = √x·x''/2 an axis has the acceleration `q'·x'/2 + q''·x` and the jerk
`√x·(q'·x''/2 + 3/2·q''·x' + q'''·x)`: terms with their signs, which may cancel out. Divided by √x the jerk is linear,
and its limit `j/√x` convex: as F. Debrouwere et al. have it ("Time-Optimal Path Following for Robots With
Convex-Concave Constraints Using Sequential Convex Programming", IEEE T-RO 29, 2013). Time is convex in x.

With limits of acceleration alone a greatest x is there, and two passes from end to end find it (L. Consolini,
M. Locatelli et al., "A solution of the minimum-time speed planning problem based on lattice theory", 2020): so does the
estimate (`grid.py`). With limits of jerk there is none: where x bends up, more at one place is less at another (the
same authors with a line search, 2021).

Each pass is a step of Newton's method for the time less `weight · log(slack)` of every limit; the weights, in parts of
the time that a node stands for, fall from pass to pass. The matrix has five diagonals. Where little of a limit or
nothing is left the barrier goes on as a parabola: so every start will do, every step is a whole one, and a long path
needs no more passes than a short one.
"""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.courses import Axes, Ends, Nodes, Shape, Stencil

#: Parts of x that one step may take away and add.
FALL, RISE = 0.7, 3.0
#: Weight of the highest speed's barrier in parts of the others': a steady speed is near its limit.
LEVEL = 0.1
#: Slack, in parts of the limit and of the weight, below which a barrier goes on as a parabola.
SOFT = 1.0
#: Diagonals of the matrix that are kept, and the right side.
BANDS = 4


def lay_stencils(nodes: Nodes, ends: Floats) -> None:
    """How value, slope and bend at each node follow from the control values at three.

    The spline has its knots in the middles between the nodes, so that its control points lie a quarter of the
    difference of both distances behind the nodes. Beside a rest x grows with the way to the power of 4/3, which no
    parabola does: up to the first node it is that, and the spline begins there.
    """
    last = len(nodes.way) - 1
    for i in range(Stencil.SIZE * (last + 1)):
        nodes.stencil[i] = 0.0
    for k in range(1, last):
        _inner(nodes, k, last)
    _end(nodes, 0, 1, ends[Ends.START_SPEED], ends[Ends.START_PULL])
    _end(nodes, last, -1, ends[Ends.END_SPEED], ends[Ends.END_PULL])


def _control(nodes: Nodes, k: int, last: int, rest: bool, stop: bool) -> float:
    """The way at a control point."""
    way = nodes.way[k]
    before = 0.0 if k == 0 or (rest and k == 1) else way - nodes.way[k - 1]
    behind = 0.0 if k == last or (stop and k == last - 1) else nodes.way[k + 1] - way
    return way + 0.25 * (behind - before)


def _inner(nodes: Nodes, k: int, last: int) -> None:
    s, at = nodes.stencil, k * Stencil.SIZE
    before, behind = nodes.way[k] - nodes.way[k - 1], nodes.way[k + 1] - nodes.way[k]
    both = before + behind
    rest, stop = nodes.x[0] == 0.0, nodes.x[last] == 0.0
    here = _control(nodes, k, last, rest, stop)
    rise = 1.0 / (here - _control(nodes, k - 1, last, rest, stop))  # slopes are differences times these
    fall = 1.0 / (_control(nodes, k + 1, last, rest, stop) - here)
    s[at + Stencil.SLOPE] = -behind / both * rise
    s[at + Stencil.SLOPE + 1] = (behind * rise - before * fall) / both
    s[at + Stencil.SLOPE + 2] = before / both * fall
    s[at + Stencil.BEND] = 2.0 / both * rise
    s[at + Stencil.BEND + 1] = -2.0 / both * (rise + fall)
    s[at + Stencil.BEND + 2] = 2.0 / both * fall
    for i in range(3):
        s[at + Stencil.VALUE + i] = 0.125 * before * before * s[at + Stencil.BEND + i]
    s[at + Stencil.VALUE] -= 0.25 * (before - behind) * rise
    s[at + Stencil.VALUE + 1] += 1.0 + 0.25 * (before - behind) * rise


def _end(nodes: Nodes, k: int, side: int, speed: float, pull: float) -> None:
    """The stencil at an end, or of the first node behind a rest; `side` is where the path lies."""
    last, rest = len(nodes.way) - 1, 0.0
    inner, s = 1 + side, nodes.stencil
    if speed == 0.0:
        k += side
        rest = abs(nodes.way[k] - nodes.way[k - side])
    at = k * Stencil.SIZE
    for i in range(Stencil.SIZE):
        s[at + i] = 0.0
    step = abs(nodes.way[k + side] - nodes.way[k])
    starts, stops = nodes.x[0] == 0.0, nodes.x[last] == 0.0
    own = _control(nodes, k, last, starts, stops)
    rise = 1.0 / abs(_control(nodes, k + side, last, starts, stops) - own)
    s[at + Stencil.BEND + inner] = 2.0 / step * rise
    s[at + Stencil.BEND + 1] = -2.0 / step * rise
    if speed > 0.0:
        slope = 2.0 * pull
        s[at + Stencil.VALUE + 1] = 1.0
        s[at + Stencil.VALUE_FIXED] = -0.25 * side * step * slope
        s[at + Stencil.SLOPE_FIXED] = slope
        s[at + Stencil.BEND_FIXED] = -2.0 * side * slope / step
        return
    s[at + Stencil.VALUE + 1] = 1.0 / (1.0 + step / (3.0 * rest))
    s[at + Stencil.SLOPE + 1] = side * 4.0 / (3.0 * rest) * s[at + Stencil.VALUE + 1]
    s[at + Stencil.BEND + 1] -= 2.0 * side / step * s[at + Stencil.SLOPE + 1]
    # the mean bend of way^(4/3) up to the middle, and the one beside the rest
    found = 8.0 / 3.0 / step * ((rest + 0.5 * step) ** (1.0 / 3.0) - rest ** (1.0 / 3.0))
    factor = 4.0 / 9.0 * rest ** (-2.0 / 3.0) / found
    for i in range(3):
        s[at + Stencil.BEND + i] *= factor


def value(nodes: Nodes, k: int) -> tuple[float, float, float]:
    """x, x' and x'' at a node."""
    at, last = k * Stencil.SIZE, len(nodes.x) - 1
    before, here, behind = nodes.x[max(k - 1, 0)], nodes.x[k], nodes.x[min(k + 1, last)]
    s = nodes.stencil
    return (
        s[at + Stencil.VALUE] * before
        + s[at + Stencil.VALUE + 1] * here
        + s[at + Stencil.VALUE + 2] * behind
        + s[at + Stencil.VALUE_FIXED],
        s[at + Stencil.SLOPE] * before
        + s[at + Stencil.SLOPE + 1] * here
        + s[at + Stencil.SLOPE + 2] * behind
        + s[at + Stencil.SLOPE_FIXED],
        s[at + Stencil.BEND] * before
        + s[at + Stencil.BEND + 1] * here
        + s[at + Stencil.BEND + 2] * behind
        + s[at + Stencil.BEND_FIXED],
    )


def improve(nodes: Nodes, axes: Axes, weight: float, bands: Floats, first: int, last: int) -> None:
    """One step of Newton's method for all x between two nodes, which keep theirs.

    Args:
        nodes: Their x becomes a better one.
        axes: Limits.
        weight: Of the barriers.
        bands: For `BANDS` numbers a node: three diagonals and the right side, then the step.
        first: The one node.
        last: The other one.
    """
    for i in range(BANDS * first, BANDS * (last + 1)):
        bands[i] = 0.0
    for k in range(first, last):
        _time(nodes, k, bands)
    for k in range(first, last + 1):
        if nodes.stencil[k * Stencil.SIZE + Stencil.VALUE + 1] > 0.0:
            _barriers(nodes, axes, k, first, last, weight, bands)
    _solve(bands, first, last)
    for k in range(first + 1, last):
        here = nodes.x[k]
        nodes.x[k] = here + min(max(bands[BANDS * k + 3], -FALL * here), RISE * here)


def _time(nodes: Nodes, k: int, bands: Floats) -> None:
    """Slope and bend of the time between two nodes, `2·h/(√x + √y)`; beside rest it is 3/2 of that."""
    step, here, there = nodes.way[k + 1] - nodes.way[k], sqrt(nodes.x[k]), sqrt(nodes.x[k + 1])
    if here == 0.0 or there == 0.0:
        step *= 1.5
    share = 1.0 / (here + there)
    squared = step * share * share
    if here > 0.0:
        own = squared / here
        bands[BANDS * k + 3] += own
        bands[BANDS * k] += own * (share + 0.5 / here) / here
    if there > 0.0:
        own = squared / there
        bands[BANDS * k + BANDS + 3] += own
        bands[BANDS * k + BANDS] += own * (share + 0.5 / there) / there
    if here > 0.0 and there > 0.0:
        bands[BANDS * k + 1] += squared * share / (here * there)


def _force(slack: float, soft: float) -> tuple[float, float]:
    """Slope (less) and bend of a barrier `-log(slack)`, which goes on as a parabola where less than `soft` is left."""
    if slack > soft:
        inverse = 1.0 / slack
        return inverse, inverse * inverse
    inverse = 1.0 / soft
    return (2.0 - slack * inverse) * inverse, inverse * inverse


def _forces(top: float, sum_: float, soft: float) -> tuple[float, float, float, float]:
    """Those of the barriers above and below a sum, whose slacks are `top` less and more it.

    Returns:
        The difference of the slopes (above less below), their sum, that of the bends (below less above), their sum.
    """
    above, below = top - sum_, top + sum_
    if above > soft and below > soft:
        inverse = 1.0 / (above * below)
        plus, minus = below * inverse, above * inverse
        plus2, minus2 = plus * plus, minus * minus
    else:
        plus, plus2 = _force(above, soft)
        minus, minus2 = _force(below, soft)
    return plus - minus, plus + minus, minus2 - plus2, plus2 + minus2


def _barriers(nodes: Nodes, axes: Axes, k: int, first: int, last: int, weight: float, bands: Floats) -> None:
    """Add slopes and bends of the barriers of a node, in x, x' and x'' there, and then in x at three nodes."""
    x, slope, bend = value(nodes, k)
    x = max(x, 1e-18)
    root = sqrt(x)
    before, behind = nodes.way[max(k - 1, 0)], nodes.way[min(k + 1, len(nodes.x) - 1)]
    own = weight * 0.5 * (behind - before) / root
    room = nodes.room[k]
    gx = gs = gb = hxx = hxs = hxb = hss = hsb = hbb = 0.0
    n = len(axes.jerk)
    cap, soft = nodes.cap2[k], SOFT * weight * room
    rises = behind - nodes.way[k] if slope > 0.0 else nodes.way[k] - before
    wide = room / sqrt(x + 0.25 * rises * abs(slope))  # in the quicker half of the cell
    half, soft_jolt = 0.5 * wide / x, soft / root
    slope_of, bend_of = _force(cap - x, LEVEL * SOFT * weight * cap)
    gx -= LEVEL * slope_of
    hxx += LEVEL * bend_of
    for i in range(n):
        at = (k * n + i) * Shape.SIZE
        ratio = axes.pull[i] / axes.jerk[i]
        turn, second = 0.5 * nodes.shape[at + Shape.FIRST], nodes.shape[at + Shape.SECOND]
        extra = nodes.shape[at + Shape.SECOND_RANGE]
        sum_, top = turn * slope + second * x, room - extra * x
        both, all_, odd, even = _forces(top, sum_, soft)
        # the slack top ∓ sum has the slope -extra ∓ second by x, ∓ turn by x'
        gx += -second * both - extra * all_
        gs -= turn * both
        hxx += even * (extra * extra + second * second) - 2.0 * odd * extra * second
        hxs += turn * (even * second - odd * extra)
        hss += even * turn * turn
        third, extra = nodes.shape[at + Shape.THIRD], nodes.shape[at + Shape.THIRD_RANGE]
        turn, second = ratio * turn, 1.5 * ratio * second
        sum_ = turn * bend + second * slope + third * x
        top = wide - extra * x - 1.5 * ratio * nodes.shape[at + Shape.SECOND_RANGE] * abs(slope)
        falls = half + extra
        both, all_, odd, even = _forces(top, sum_, soft_jolt)
        gx += -third * both - falls * all_
        gs -= second * both
        gb -= turn * both
        hxx += even * (falls * falls + third * third) - 2.0 * odd * falls * third
        hxs += second * (even * third - odd * falls)
        hxb += turn * (even * third - odd * falls)
        hss += even * second * second
        hsb += even * turn * second
        hbb += even * turn * turn
    _add(nodes, k, first, last, own, (gx, gs, gb, hxx, hxs, hxb, hss, hsb, hbb), bands)


def _add(
    nodes: Nodes,
    k: int,
    first: int,
    last: int,
    own: float,
    found: tuple[float, float, float, float, float, float, float, float, float],
    bands: Floats,
) -> None:
    """Bring slopes and bends in x, x' and x'' at a node to x at three nodes. `bands` has less the slopes."""
    gx, gs, gb, hxx, hxs, hxb, hss, hsb, hbb = found
    s, at = nodes.stencil, k * Stencil.SIZE
    for p in range(3):
        row = k - 1 + p
        if first <= row <= last:
            v, d, b = s[at + Stencil.VALUE + p], s[at + Stencil.SLOPE + p], s[at + Stencil.BEND + p]
            bands[BANDS * row + 3] += own * (gx * v + gs * d + gb * b)
            x = own * (hxx * v + hxs * d + hxb * b)
            y = own * (hxs * v + hss * d + hsb * b)
            z = own * (hxb * v + hsb * d + hbb * b)
            for q in range(p, 3):
                if k - 1 + q <= last:
                    bands[BANDS * row + q - p] += (
                        x * s[at + Stencil.VALUE + q]
                        + y * s[at + Stencil.SLOPE + q]
                        + z * s[at + Stencil.BEND + q]
                    )


def _solve(bands: Floats, first: int, last: int) -> None:
    """The step of Newton's method, into the last number of each node: a matrix of five diagonals as L·D·Lᵀ."""
    for k in (first, last):
        bands[BANDS * k] = 1.0
        bands[BANDS * k + 1] = bands[BANDS * k + 2] = bands[BANDS * k + 3] = 0.0
    bands[BANDS * (last - 1) + 1] = 0.0
    if last - first > 1:
        bands[BANDS * (last - 2) + 2] = 0.0
    for k in range(first, last + 1):
        at = BANDS * k
        own = bands[at]
        if own <= 0.0:  # rounding has left nothing: the node keeps its x
            own = bands[at] = 1.0
            bands[at + 1] = bands[at + 2] = bands[at + 3] = 0.0
        if k + 1 <= last:
            near = bands[at + 1] / own
            bands[at + BANDS] -= near * bands[at + 1]
            bands[at + BANDS + 1] -= near * bands[at + 2]
            bands[at + BANDS + 3] -= near * bands[at + 3]
            if k + 2 <= last:
                far = bands[at + 2] / own
                bands[at + 2 * BANDS] -= far * bands[at + 2]
                bands[at + 2 * BANDS + 3] -= far * bands[at + 3]
    for k in range(last, first - 1, -1):
        at = BANDS * k
        rest = bands[at + 3]
        if k + 1 <= last:
            rest -= bands[at + 1] * bands[at + BANDS + 3]
        if k + 2 <= last:
            rest -= bands[at + 2] * bands[at + 2 * BANDS + 3]
        bands[at + 3] = rest / bands[at]


def begin(
    places: Floats, squares: Floats, count: int, nodes: Nodes, axes: Axes, ends: Floats, share: float
) -> None:
    """A first x at the nodes: a share of the estimate, and from rest no more than the jerk allows."""
    last, at = len(nodes.way) - 1, 0
    for k in range(last + 1):
        way = nodes.way[k]
        while at < count - 2 and places[at + 1] < way:
            at += 1
        part = (way - places[at]) / (places[at + 1] - places[at])
        nodes.x[k] = share * (squares[at] + part * (squares[at + 1] - squares[at]))
    # the control values at both ends, from which the spline has the speed and the acceleration there
    nodes.x[0] = ends[Ends.START_SPEED] ** 2 + 0.5 * ends[Ends.START_PULL] * (nodes.way[1] - nodes.way[0])
    nodes.x[last] = ends[Ends.END_SPEED] ** 2 - 0.5 * ends[Ends.END_PULL] * (
        nodes.way[last] - nodes.way[last - 1]
    )
    for k in range(1, last):
        if ends[Ends.START_SPEED] == 0.0:
            _from_rest(nodes, axes, k, 1, nodes.way[k] - nodes.way[0], share)
        if ends[Ends.END_SPEED] == 0.0:
            _from_rest(nodes, axes, k, last - 1, nodes.way[last] - nodes.way[k], share)
        nodes.x[k] = max(nodes.x[k], 1e-15)


def _from_rest(nodes: Nodes, axes: Axes, k: int, beside: int, way: float, share: float) -> None:
    """Bound x by a jerk from rest on."""
    n, most = len(axes.jerk), 1e-12
    for i in range(n):
        most = max(
            most, abs(nodes.shape[(k * n + i) * Shape.SIZE + Shape.FIRST]) * axes.pull[i] / axes.jerk[i]
        )
    top = (4.5 * nodes.room[k] / most * way * way) ** (2.0 / 3.0)
    nodes.x[k] = min(nodes.x[k], share * top)
    if k == beside:
        nodes.cap2[k] = min(nodes.cap2[k], 0.95 * top)
