"""The spline: control points on the programmed path, and what its knots have of place, q' and q''.

The control point of the knots a, b, c lies at their mean, the Greville abscissa: a straight line comes out exactly, and
by its length (C. de Boor, "A Practical Guide to Splines", IX and XI). A curve is left towards its inside by
`q''·((b - a)² + (c - b)² + (c - a)²)/36`, a sixth of q''·h² where knots are h apart.
"""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.layout import Floats, Ints
from polycnc.motion.third_order.bends.stretches import Stretches, put_place


class Spline(NamedTuple):
    """A cubic spline of m pieces: way (m + 1) of its knots, control points (m + 3)·n, place, q' and q'' (m + 1)·n.

    `room` is how far apart knots might be around each of them, if it is a corner between lines, else 0; `alone` is 1
    where it is such a corner, and nothing else bends the path around (`knots.py`). `moving` are the knots whose control
    points are moved, `moved` by what part of its bow each of all is (`levelling.py`). `kept` is 1 at knots that keep
    their control point from a round before, -1 where the tolerance is exceeded beside them (`keeping.py`), else 0.
    """

    way: Floats
    room: Floats
    moved: Floats
    alone: Ints
    moving: Ints
    kept: Ints
    control: Floats
    place: Floats
    first: Floats
    second: Floats


def knot(spline: Spline, pieces: int, k: int) -> float:
    """Way of knot k; those beyond the ends lie at the ends."""
    way: float = spline.way[min(max(k, 0), pieces)]
    return way


def greville(spline: Spline, pieces: int, k: int) -> float:
    """Greville abscissa of control point k, around knot k - 1."""
    return (knot(spline, pieces, k - 2) + knot(spline, pieces, k - 1) + knot(spline, pieces, k)) / 3.0


def lay_controls(path: Stretches, n: int, spline: Spline, pieces: int) -> None:
    """Put the control points on the path, but for those that are kept."""
    e, last, before, here = 0, len(path.form) - 1, spline.way[0], spline.way[0]
    for k in range(pieces + 3):
        behind = spline.way[min(k, pieces)]
        way = (before + here + behind) / 3.0
        before, here = here, behind
        if 0 < k <= pieces + 1 and spline.kept[k - 1] > 0:
            continue
        while e < last and path.way[e + 1] <= way:
            e += 1
        put_place(path, e, way, n, spline.control, k * n)


def shape(spline: Spline, n: int, pieces: int) -> None:
    """Set place, q' and q'' at the knots from the control points, but where all around are kept."""
    far = back = here = spline.way[0]
    ahead = spline.way[min(1, pieces)]
    for k in range(pieces + 1):
        beyond = spline.way[min(k + 2, pieces)]
        if not is_kept(spline, pieces, k - 1, k + 1):
            shape_by(spline, n, k, far, back, here, ahead, beyond)
        far, back, here, ahead = back, here, ahead, beyond


def is_kept(spline: Spline, pieces: int, first: int, last: int) -> bool:
    """Whether all knots from one to another keep their control points; those beyond the ends count for nothing."""
    for k in range(max(first, 0), min(last, pieces) + 1):  # noqa: SIM110 - kernels have no generators
        if spline.kept[k] <= 0:
            return False
    return True


def shape_knot(spline: Spline, n: int, pieces: int, k: int) -> None:
    """Set those of knot k, from its three control points."""
    far, back = knot(spline, pieces, k - 2), knot(spline, pieces, k - 1)
    shape_by(
        spline,
        n,
        k,
        far,
        back,
        spline.way[k],
        knot(spline, pieces, k + 1),
        knot(spline, pieces, k + 2),
    )


def shape_by(
    spline: Spline, n: int, k: int, far: float, back: float, here: float, ahead: float, beyond: float
) -> None:
    """The same by the ways of five knots: this one, and the two before and behind."""
    low = (here - far) / (ahead - far) if ahead > far else 0.0
    high = (here - back) / (beyond - back) if beyond > back else 0.0
    middle = (here - back) / (ahead - back)
    before, behind, turn = 3.0 / (ahead - far), 3.0 / (beyond - back), 2.0 / (ahead - back)
    for i in range(n):
        a, b, c = (
            spline.control[k * n + i],
            spline.control[(k + 1) * n + i],
            spline.control[(k + 2) * n + i],
        )
        leave, arrive = (b - a) * before, (c - b) * behind
        start, end = a + low * (b - a), b + high * (c - b)
        spline.place[k * n + i] = start + middle * (end - start)
        spline.first[k * n + i] = leave + middle * (arrive - leave)
        spline.second[k * n + i] = (arrive - leave) * turn
