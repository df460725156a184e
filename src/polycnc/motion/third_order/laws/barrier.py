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
from polycnc.motion.third_order.laws.courses import BATCH, Axes, Force, Nodes, Shape, Stencil, Work
from polycnc.motion.third_order.laws.stencils import value

#: Weight of the highest speed's barrier in parts of the others': a steady speed is near its limit.
LEVEL = 0.1
#: Slack, in parts of the limit and of the weight, below which a barrier goes on as a parabola.
SOFT = 1.0
#: Part of speed and acceleration up to which they count for nothing. The jerk counts everywhere: without it nothing
#: would keep x from bending to and fro.
FREE = 0.5


def lay_forces(nodes: Nodes, axes: Axes, work: Work, weight: float, first: int, end: int) -> None:
    """Slopes and bends of time and barriers of a batch of nodes by x at three nodes.

    Every loop does one thing for all of them: so processors do it for several at once.
    """
    _motions(nodes, work.forces, first, end)
    _begin_forces(nodes, weight, work.forces, first, end)
    for i in range(len(axes.jerk)):
        if work.moves[i] > 0.0:
            _add_axis(nodes, i, axes.pull[i] / axes.jerk[i], SOFT * weight, work.forces, first, end)
    _spread(nodes, work.forces, first, end)


def _motions(nodes: Nodes, forces: Floats, first: int, end: int) -> None:
    """x, x' and x'' at nodes."""
    count, x, s = len(nodes.way), nodes.x, nodes.stencil
    for k in range(max(first, 1), min(end, count - 1)):
        at, here = k - first, x[k]
        before, behind = x[k - 1] - here, x[k + 1] - here
        value_ = here + s[Stencil.VALUE * count + k] * before + s[(Stencil.VALUE + 1) * count + k] * behind
        forces[Force.X * BATCH + at] = max(value_, 1e-18)
        forces[Force.SLOPE * BATCH + at] = (
            s[Stencil.SLOPE * count + k] * before + s[(Stencil.SLOPE + 1) * count + k] * behind
        )
        forces[Force.BEND * BATCH + at] = (
            s[Stencil.BEND * count + k] * before + s[(Stencil.BEND + 1) * count + k] * behind
        )
    for k in (0, count - 1):
        if first <= k < end:
            value_, slope, bend = value(nodes, k)
            forces[Force.X * BATCH + k - first] = max(value_, 1e-18)
            forces[Force.SLOPE * BATCH + k - first], forces[Force.BEND * BATCH + k - first] = slope, bend


def _begin_forces(nodes: Nodes, weight: float, forces: Floats, first: int, end: int) -> None:
    """Slopes and bends of time and of the highest speed; what limits of jerk need besides."""
    count, share, least_part = len(nodes.way), 0.5 / weight, LEVEL * SOFT * weight
    for k in range(first, end):
        at = k - first
        x, slope = forces[Force.X * BATCH + at], forces[Force.SLOPE * BATCH + at]
        before, cell = nodes.stencil[Stencil.BEFORE * count + k], nodes.stencil[Stencil.CELL * count + k]
        cap = nodes.cap2[k]
        at_root = 1.0 / sqrt(x)
        inverse = at_root * at_root
        rises = 2.0 * cell - before if slope > 0.0 else before
        wide = nodes.room[k] / sqrt(x + 0.25 * rises * abs(slope))  # in the quicker half of the cell
        gx = share * nodes.stencil[Stencil.TIME * count + k] * inverse
        level = LEVEL if x > FREE * cap else 0.0
        slack = cap - x
        force = 1.0 / max(slack, least_part * cap)
        forces[Force.HXX * BATCH + at] = 1.5 * gx * inverse + level * force * force
        forces[Force.GX * BATCH + at] = gx - level * force * (2.0 - slack * force)
        forces[Force.OWN * BATCH + at] = weight * cell * at_root
        forces[Force.WIDE * BATCH + at], forces[Force.HALF * BATCH + at] = wide, 0.5 * wide * inverse
        forces[Force.SOFT * BATCH + at] = SOFT * weight * nodes.room[k] * at_root
        forces[Force.GS * BATCH + at] = forces[Force.GB * BATCH + at] = 0.0
        forces[Force.HXS * BATCH + at] = forces[Force.HXB * BATCH + at] = 0.0
        forces[Force.HSS * BATCH + at] = forces[Force.HSB * BATCH + at] = forces[Force.HBB * BATCH + at] = 0.0


def _add_axis(
    nodes: Nodes, i: int, build: float, soft_part: float, forces: Floats, first: int, end: int
) -> None:
    """Add the barriers of the jerk of an axis, in x, x' and x''; those of its acceleration if they count anywhere."""
    count, f = len(nodes.way), forces
    s, shape = nodes.shape, i * Shape.SIZE * count
    near = 0
    for k in range(first, end):
        at, own = k - first, shape + k
        x, slope, bend = f[Force.X * BATCH + at], f[Force.SLOPE * BATCH + at], f[Force.BEND * BATCH + at]
        turn, second = s[own + Shape.FIRST * count], s[own + Shape.SECOND * count]
        extra, third = s[own + Shape.SECOND_RANGE * count], s[own + Shape.THIRD * count]
        range_, moves = s[own + Shape.THIRD_RANGE * count], s[own + Shape.MOVES * count]
        used = abs(turn * slope + 2.0 / 3.0 * second * x) + 2.0 / 3.0 * extra * x
        near += used > FREE * build * nodes.room[k]
        # the slack top ∓ sum has the slope -falls ∓ third by x, ∓ second by x', ∓ turn by x''
        top = f[Force.WIDE * BATCH + at] - range_ * x - extra * abs(slope)
        sum_, falls = turn * bend + second * slope + third * x, moves * f[Force.HALF * BATCH + at] + range_
        both, all_, odd, even = _forces(top, sum_, f[Force.SOFT * BATCH + at])
        mixed, sloped, bent = even * third - odd * falls, even * second, even * turn
        f[Force.GX * BATCH + at] -= third * both + falls * all_
        f[Force.GS * BATCH + at] -= second * both
        f[Force.GB * BATCH + at] -= turn * both
        f[Force.HXX * BATCH + at] += third * mixed + falls * (even * falls - odd * third)
        f[Force.HXS * BATCH + at] += second * mixed
        f[Force.HXB * BATCH + at] += turn * mixed
        f[Force.HSS * BATCH + at] += sloped * second
        f[Force.HSB * BATCH + at] += sloped * turn
        f[Force.HBB * BATCH + at] += bent * turn
    if near > 0:
        _add_pulls(nodes, shape, build, soft_part, forces, first, end)


def _add_pulls(
    nodes: Nodes, shape: int, build: float, soft_part: float, forces: Floats, first: int, end: int
) -> None:
    """Add the barriers of the acceleration of an axis, in x and x', where they count."""
    count, f, s = len(nodes.way), forces, nodes.shape
    for k in range(first, end):
        at, own = k - first, shape + k
        x, slope, turn = f[Force.X * BATCH + at], f[Force.SLOPE * BATCH + at], s[own + Shape.FIRST * count]
        more = 2.0 / 3.0 * s[own + Shape.SECOND * count]
        less = 2.0 / 3.0 * s[own + Shape.SECOND_RANGE * count]
        top, sum_, used = build * nodes.room[k], turn * slope + more * x, less * x
        counts = 1.0 if abs(sum_) + used > FREE * top else 0.0
        both, all_, odd, even = _forces(top - used, sum_, soft_part * top)
        both, even = counts * both, counts * even
        mixed = even * more - counts * odd * less
        f[Force.GX * BATCH + at] -= more * both + counts * less * all_
        f[Force.GS * BATCH + at] -= turn * both
        f[Force.HXX * BATCH + at] += more * mixed + less * (even * less - counts * odd * more)
        f[Force.HXS * BATCH + at] += turn * mixed
        f[Force.HSS * BATCH + at] += even * turn * turn


def _forces(top: float, sum_: float, soft: float) -> tuple[float, float, float, float]:
    """Slopes and bends of the barriers `-log(slack)` above and below a sum, whose slacks are `top` less and more it.

    Where less than `soft` is left, a barrier goes on as a parabola: its bend stays, its slope grows evenly.

    Returns:
        The difference of the slopes (above less below), their sum, that of the bends (below less above), their sum.
    """
    above, below = top - sum_, top + sum_
    least, least2 = max(above, soft), max(below, soft)
    inverse = 1.0 / (least * least2)
    plus, minus = least2 * inverse, least * inverse
    bend, bend2 = plus * plus, minus * minus
    plus, minus = plus * (2.0 - above * plus), minus * (2.0 - below * minus)
    return plus - minus, plus + minus, bend2 - bend, bend + bend2


def _spread(nodes: Nodes, forces: Floats, first: int, end: int) -> None:
    """Bring slopes and bends in x, x' and x'' at nodes to x at three nodes.

    The factors of x at the node itself are what those of both others leave of 1, 0 and 0.
    """
    count, s, f = len(nodes.way), nodes.stencil, forces
    for k in range(first, end):
        at = k - first
        own = f[Force.OWN * BATCH + at]
        gx, gs, gb = f[Force.GX * BATCH + at], f[Force.GS * BATCH + at], f[Force.GB * BATCH + at]
        hxx, hxs, hxb = f[Force.HXX * BATCH + at], f[Force.HXS * BATCH + at], f[Force.HXB * BATCH + at]
        hss, hsb, hbb = f[Force.HSS * BATCH + at], f[Force.HSB * BATCH + at], f[Force.HBB * BATCH + at]
        v0, v2 = s[Stencil.VALUE * count + k], s[(Stencil.VALUE + 1) * count + k]
        d0, d2 = s[Stencil.SLOPE * count + k], s[(Stencil.SLOPE + 1) * count + k]
        b0, b2 = s[Stencil.BEND * count + k], s[(Stencil.BEND + 1) * count + k]
        v, d, b = own * v0, own * d0, own * b0
        x, y, z = hxx * v + hxs * d + hxb * b, hxs * v + hss * d + hsb * b, hxb * v + hsb * d + hbb * b
        h00, h02, g0 = x * v0 + y * d0 + z * b0, x * v2 + y * d2 + z * b2, gx * v + gs * d + gb * b
        v, d, b = own * v2, own * d2, own * b2
        x2, y, z = hxx * v + hxs * d + hxb * b, hxs * v + hss * d + hsb * b, hxb * v + hsb * d + hbb * b
        h22, g2 = x2 * v2 + y * d2 + z * b2, gx * v + gs * d + gb * b
        h01, h12 = x - h00 - h02, x2 - h02 - h22
        f[Force.H00 * BATCH + at], f[Force.H01 * BATCH + at], f[Force.H02 * BATCH + at] = h00, h01, h02
        f[Force.H11 * BATCH + at] = own * hxx - x - x2 - h01 - h12
        f[Force.H12 * BATCH + at], f[Force.H22 * BATCH + at] = h12, h22
        f[Force.G0 * BATCH + at], f[Force.G1 * BATCH + at] = g0, own * gx - g0 - g2
        f[Force.G2 * BATCH + at] = g2
