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
#: Part of speed and acceleration up to which they count for nothing. The jerk counts everywhere: without it nothing
#: would keep x from bending to and fro.
FREE = 0.5
#: Diagonals of the matrix that are kept, and the right side.
BANDS = 4


def lay_stencils(nodes: Nodes, ends: Floats) -> None:
    """How value, slope and bend at each node follow from the control values at three.

    The spline has its knots in the middles between the nodes, so that its control points lie a quarter of the
    difference of both distances behind the nodes. Beside a rest x grows with the way to the power of 4/3, which no
    parabola does: up to the first node it is that, and the spline begins there.
    """
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
    _end(nodes, 0, 1, ends[Ends.START_SPEED], ends[Ends.START_PULL])
    _end(nodes, last, -1, ends[Ends.END_SPEED], ends[Ends.END_PULL])


def _control(nodes: Nodes, k: int, last: int, rest: bool, stop: bool) -> float:
    """The way at a control point."""
    way = nodes.way[k]
    before = 0.0 if k == 0 or (rest and k == 1) else way - nodes.way[k - 1]
    behind = 0.0 if k == last or (stop and k == last - 1) else nodes.way[k + 1] - way
    return way + 0.25 * (behind - before)


def _inner(nodes: Nodes, k: int, before: float, behind: float, rise: float, fall: float) -> None:
    """The stencil of a node by the distances of its neighbours; slopes are differences times `rise` and `fall`."""
    s, at, inverse = nodes.stencil, k * Stencil.SIZE, 1.0 / (before + behind)
    bend, bend2 = 2.0 * inverse * rise, 2.0 * inverse * fall
    slope, slope2 = behind * inverse * rise, before * inverse * fall
    value_, shift = 0.125 * before * before, 0.25 * (before - behind) * rise
    s[at + Stencil.SLOPE] = -slope
    s[at + Stencil.SLOPE + 1] = slope - slope2
    s[at + Stencil.SLOPE + 2] = slope2
    s[at + Stencil.BEND] = bend
    s[at + Stencil.BEND + 1] = -bend - bend2
    s[at + Stencil.BEND + 2] = bend2
    s[at + Stencil.VALUE] = value_ * bend - shift
    s[at + Stencil.VALUE + 1] = 1.0 + shift - value_ * (bend + bend2)
    s[at + Stencil.VALUE + 2] = value_ * bend2


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
    for i in range(BANDS * first, BANDS * (last + 3)):
        bands[i] = 0.0
    n = len(axes.jerk)
    for k in range(first, last + 1):
        if nodes.stencil[k * Stencil.SIZE + Stencil.VALUE + 1] > 0.0:
            _barriers(nodes, n, k, weight, bands)
    _solve(nodes, bands, first, last)


def _forces(top: float, sum_: float, soft: float) -> tuple[float, float, float, float]:
    """Slopes and bends of the barriers `-log(slack)` above and below a sum, whose slacks are `top` less and more it.

    Where less than `soft` is left, a barrier goes on as a parabola.

    Returns:
        The difference of the slopes (above less below), their sum, that of the bends (below less above), their sum.
    """
    above, below = top - sum_, top + sum_
    if above > soft and below > soft:
        inverse = 1.0 / (above * below)
        plus, minus = below * inverse, above * inverse
        both, all_ = plus - minus, plus + minus
        return both, all_, -both * all_, plus * plus + minus * minus
    plus, minus = 1.0 / max(above, soft), 1.0 / max(below, soft)
    plus2, minus2 = plus * plus, minus * minus
    if above < soft:
        plus *= 2.0 - above * plus
    if below < soft:
        minus *= 2.0 - below * minus
    return plus - minus, plus + minus, minus2 - plus2, plus2 + minus2


def _barriers(nodes: Nodes, n: int, k: int, weight: float, bands: Floats) -> None:
    """Add slopes and bends of time and barriers of a node, in x, x' and x'' there, and then in x at three nodes."""
    x, slope, bend = value(nodes, k)
    x = max(x, 1e-18)
    inverse, root, steep = 1.0 / x, sqrt(x), abs(slope)
    near, far = max(k - 1, 0), min(k + 1, len(nodes.x) - 1)
    before, behind, cell = nodes.way[near], nodes.way[far], 0.5 * (nodes.way[far] - nodes.way[near])
    room, cap, soft = nodes.room[k], nodes.cap2[k], SOFT * weight * nodes.room[k]
    rises = behind - nodes.way[k] if slope > 0.0 else nodes.way[k] - before
    wide = room / sqrt(x + 0.25 * rises * steep)  # in the quicker half of the cell
    half, soft_jolt = 0.5 * wide * inverse, soft * root * inverse
    gx = 0.5 * inverse / weight  # time, `cell/√x`; from or to rest it is `3·way/√x`
    if nodes.x[near] == 0.0:
        gx *= 1.0 + 2.5 * (nodes.way[k] - before) / cell
    if nodes.x[far] == 0.0:
        gx *= 1.0 + 2.5 * (behind - nodes.way[k]) / cell
    hxx = 1.5 * gx * inverse
    gs = gb = hxs = hxb = hss = hsb = hbb = 0.0
    s = nodes.shape
    if x > FREE * cap:
        slack, least = cap - x, LEVEL * SOFT * weight * cap
        force = 1.0 / max(slack, least)
        gx -= LEVEL * force * (1.0 if slack >= least else 2.0 - slack * force)
        hxx += LEVEL * force * force
    for at in range(k * n * Shape.SIZE, (k + 1) * n * Shape.SIZE, Shape.SIZE):
        turn, second, extra = s[at + Shape.FIRST], s[at + Shape.SECOND], s[at + Shape.SECOND_RANGE]
        sum_ = turn * slope + second * x
        used = abs(sum_) + extra * x
        if used > FREE * room:
            top = room - extra * x
            both, all_, odd, even = _forces(top, sum_, soft)
            # the slack top ∓ sum has the slope -extra ∓ second by x, ∓ turn by x'
            gx -= second * both + extra * all_
            gs -= turn * both
            mixed = even * second - odd * extra
            hxx += second * mixed + extra * (even * extra - odd * second)
            hxs += turn * mixed
            hss += even * turn * turn
        turn, second, third = s[at + Shape.JOLT_FIRST], s[at + Shape.JOLT_SECOND], s[at + Shape.THIRD]
        extra = s[at + Shape.THIRD_RANGE]
        sum_ = turn * bend + second * slope + third * x
        used = abs(sum_) + extra * x + s[at + Shape.JOLT_RANGE] * steep
        if used > 0.0:
            top = wide - extra * x - s[at + Shape.JOLT_RANGE] * steep
            falls = half + extra
            both, all_, odd, even = _forces(top, sum_, soft_jolt)
            gx -= third * both + falls * all_
            gs -= second * both
            gb -= turn * both
            mixed, sloped, bent = even * third - odd * falls, even * second, even * turn
            hxx += third * mixed + falls * (even * falls - odd * third)
            hxs += second * mixed
            hxb += turn * mixed
            hss += sloped * second
            hsb += sloped * turn
            hbb += bent * turn
    _add(nodes, k, weight * cell * root * inverse, (gx, gs, gb, hxx, hxs, hxb, hss, hsb, hbb), bands)


def _add(
    nodes: Nodes,
    k: int,
    own: float,
    found: tuple[float, float, float, float, float, float, float, float, float],
    bands: Floats,
) -> None:
    """Bring slopes and bends in x, x' and x'' at a node to x at three nodes. `bands` has less the slopes."""
    gx, gs, gb, hxx, hxs, hxb, hss, hsb, hbb = found
    gx, gs, gb, hxx, hxs, hxb = own * gx, own * gs, own * gb, own * hxx, own * hxs, own * hxb
    hss, hsb, hbb = own * hss, own * hsb, own * hbb
    s, at, to = nodes.stencil, k * Stencil.SIZE, k * BANDS
    v0, v1, v2 = s[at + Stencil.VALUE], s[at + Stencil.VALUE + 1], s[at + Stencil.VALUE + 2]
    d0, d1, d2 = s[at + Stencil.SLOPE], s[at + Stencil.SLOPE + 1], s[at + Stencil.SLOPE + 2]
    b0, b1, b2 = s[at + Stencil.BEND], s[at + Stencil.BEND + 1], s[at + Stencil.BEND + 2]
    x, y, z = hxx * v0 + hxs * d0 + hxb * b0, hxs * v0 + hss * d0 + hsb * b0, hxb * v0 + hsb * d0 + hbb * b0
    bands[to] += x * v0 + y * d0 + z * b0
    bands[to + 1] += x * v1 + y * d1 + z * b1
    bands[to + 2] += x * v2 + y * d2 + z * b2
    bands[to + 3] += gx * v0 + gs * d0 + gb * b0
    x, y, z = hxx * v1 + hxs * d1 + hxb * b1, hxs * v1 + hss * d1 + hsb * b1, hxb * v1 + hsb * d1 + hbb * b1
    bands[to + 4] += x * v1 + y * d1 + z * b1
    bands[to + 5] += x * v2 + y * d2 + z * b2
    bands[to + 7] += gx * v1 + gs * d1 + gb * b1
    x, y, z = hxx * v2 + hxs * d2 + hxb * b2, hxs * v2 + hss * d2 + hsb * b2, hxb * v2 + hsb * d2 + hbb * b2
    bands[to + 8] += x * v2 + y * d2 + z * b2
    bands[to + 11] += gx * v2 + gs * d2 + gb * b2


def _solve(nodes: Nodes, bands: Floats, first: int, last: int) -> None:
    """Take the step of Newton's method: a matrix of five diagonals as L·D·Lᵀ. Of D the inverse is kept."""
    begin_, end = BANDS * (first + 2), BANDS * last
    bands[end + 1] = bands[end + 2] = bands[end - 2] = 0.0  # the node behind keeps its x
    for at in range(begin_, end + 1, BANDS):
        own = bands[at]
        if own <= 0.0:  # rounding has left nothing: the node keeps its x
            own = 1.0
            bands[at + 1] = bands[at + 2] = bands[at + 3] = 0.0
        inverse, beside, beyond = 1.0 / own, bands[at + 1], bands[at + 2]
        rest, near, far = bands[at + 3], beside * inverse, beyond * inverse
        bands[at] = inverse
        bands[at + 4] -= near * beside
        bands[at + 5] -= near * beyond
        bands[at + 7] -= near * rest
        bands[at + 8] -= far * beyond
        bands[at + 11] -= far * rest
    behind = far = 0.0  # the steps of the next two nodes
    for k in range(last - 1, first, -1):
        at = BANDS * (k + 1)
        step = (bands[at + 3] - bands[at + 1] * behind - bands[at + 2] * far) * bands[at]
        here, far, behind = nodes.x[k], behind, step
        nodes.x[k] = here + min(max(step, -FALL * here), RISE * here)


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
        most = max(most, 2.0 * abs(nodes.shape[(k * n + i) * Shape.SIZE + Shape.JOLT_FIRST]))
    cube, part = 4.5 * nodes.room[k] / most * way * way, nodes.x[k] / share
    if k != beside and part * part * part <= cube * cube:
        return
    top = cube ** (2.0 / 3.0)
    nodes.x[k] = min(nodes.x[k], share * top)
    if k == beside:
        nodes.cap2[k] = min(nodes.cap2[k], 0.95 * top)
