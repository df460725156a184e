"""The quickest x at given nodes: steps of Newton's method, and where they begin."""

from __future__ import annotations

from polycnc.kernels.layout import Floats
from polycnc.motion.third_order.laws.barrier import lay_forces
from polycnc.motion.third_order.laws.courses import BATCH, Axes, Ends, Force, Nodes, Shape, Work

#: Parts of x that one step may take away and add.
FALL, RISE = 0.7, 3.0
#: Numbers of a node that a step of Newton's method keeps for its way back.
BANDS = 3


def improve(nodes: Nodes, axes: Axes, work: Work, weight: float, first: int, last: int) -> None:
    """One step of Newton's method for all x between two nodes, which keep theirs.

    The matrix has five diagonals, and becomes L·D·Lᵀ row by row: as soon as the barriers of a node are known, the row
    of the one before is whole.

    Args:
        nodes: Their x becomes a better one.
        axes: Limits.
        work: Which axes move; room.
        weight: Of the barriers.
        first: The one node.
        last: The other one.
    """
    low = first if nodes.x[first] > 0.0 else first + 1  # a rest has no barriers
    end = last + 1 if nodes.x[last] > 0.0 else last
    bands, f = work.bands, work.forces
    own = beside = rest = own2 = rest2 = 0.0  # the rows before and at a node, as far as they are known
    for batch in range(low, end, BATCH):
        behind = min(batch + BATCH, end)
        lay_forces(nodes, axes, work, weight, batch, behind)
        for k in range(batch, behind):
            at = k - batch
            own, beside = own + f[Force.H00 * BATCH + at], beside + f[Force.H01 * BATCH + at]
            rest, beyond = rest + f[Force.G0 * BATCH + at], f[Force.H02 * BATCH + at]
            here, ahead = own2 + f[Force.H11 * BATCH + at], f[Force.H12 * BATCH + at]
            here_rest = rest2 + f[Force.G1 * BATCH + at]
            own2, rest2 = f[Force.H22 * BATCH + at], f[Force.G2 * BATCH + at]
            if k > first + 1:
                inverse = 1.0 / own if own > 0.0 else 0.0  # if rounding has left nothing the node keeps its x
                near, far = beside * inverse, beyond * inverse
                here, ahead, here_rest = here - near * beside, ahead - near * beyond, here_rest - near * rest
                own2, rest2 = own2 - far * beyond, rest2 - far * rest
                _keep(bands, k - 1, near, far, rest * inverse)
            own, beside, rest = here, ahead, here_rest
    if end == last and last - 1 > first:  # before a rest
        _keep(bands, last - 1, 0.0, 0.0, rest / own if own > 0.0 else 0.0)
    _go_back(nodes, bands, first, last)


def _keep(bands: Floats, k: int, near: float, far: float, rest: float) -> None:
    """What is left of the row of a node."""
    bands[BANDS * k], bands[BANDS * k + 1], bands[BANDS * k + 2] = near, far, rest


def _go_back(nodes: Nodes, bands: Floats, first: int, last: int) -> None:
    """Take the step of Newton's method from the last node to the first."""
    behind = far = 0.0  # the steps of the next two nodes
    for k in range(last - 1, first, -1):
        at, here = BANDS * k, nodes.x[k]
        step = bands[at + 2] - bands[at + 1] * far - bands[at] * behind
        far, behind = behind, step
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
    start, end = ends[Ends.START_SPEED], ends[Ends.END_SPEED]
    nodes.x[0] = start * start + 0.5 * ends[Ends.START_PULL] * (nodes.way[1] - nodes.way[0])
    nodes.x[last] = end * end - 0.5 * ends[Ends.END_PULL] * (nodes.way[last] - nodes.way[last - 1])
    for k in range(1, last):
        if start == 0.0:
            _from_rest(nodes, axes, k, 1, nodes.way[k] - nodes.way[0], share)
        if end == 0.0:
            _from_rest(nodes, axes, k, last - 1, nodes.way[last] - nodes.way[k], share)
        nodes.x[k] = max(nodes.x[k], 1e-15)


def _from_rest(nodes: Nodes, axes: Axes, k: int, beside: int, way: float, share: float) -> None:
    """Bound x by a jerk from rest on."""
    n, most = len(axes.jerk), 1e-12
    for i in range(n):
        most = max(most, 2.0 * abs(nodes.shape[(i * Shape.SIZE + Shape.FIRST) * len(nodes.way) + k]))
    cube, part = 4.5 * nodes.room[k] / most * way * way, nodes.x[k] / share
    if k != beside and part * part * part <= cube * cube:
        return
    top = cube ** (2.0 / 3.0)
    nodes.x[k] = min(nodes.x[k], share * top)
    if k == beside:
        nodes.cap2[k] = min(nodes.cap2[k], 0.95 * top)
