"""Averages under a tent around many times at once (`motion/averaging.py` has them around one).

The average of places under a tent of half width `b` is a second difference of their second integral Q:
`(Q(t+b) - 2 Q(t) + Q(t-b)) / b²`; its derivative is that of their first integral, and so on. Between edges places are
polynomials in time, so each stretch is looked at a few times, however many samples lie in it. Integrals that are
counted from far away are large, and their differences would be noise: they are counted from marks that stand every
`b`, and brought from one mark to the next.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

Numbers: TypeAlias = "NDArray[np.float64]"
Places: TypeAlias = "NDArray[np.int64]"

#: Degree in time of a place along a line, where the way is cubic; along a curve, which is cubic in the way.
LINE, CURVE = 3, 9


def under_tents(
    place: Callable[[Numbers], Numbers], middle: Numbers, blend: float, edges: Numbers, degree: int = CURVE
) -> tuple[Numbers, Numbers, Numbers]:
    """Averages under tents around many times, and their first and second derivatives, (k, n) each.

    Args:
        place: Places at times, (k, n).
        middle: The times, (k,).
        blend: Half width of the tent.
        edges: All times between which places are polynomials, in order.
        degree: Their highest degree.
    """
    integrals = _Integrals(place, middle, blend, edges, degree)
    groups = integrals.group(middle)
    before, here, behind = (integrals.at(middle + late, groups) for late in (-blend, 0.0, blend))
    position, velocity, acceleration = (
        (first - 2.0 * now + last) / (blend * blend)
        for first, now, last in zip(before, here, behind, strict=True)
    )
    return integrals.origin + position, velocity, acceleration


@cache
def _fit(degree: int) -> tuple[Numbers, Numbers]:
    """Where a stretch from -1 to 1 is looked at, its middle included, and what makes coefficients of the places."""
    count = degree + degree % 2
    nodes = np.cos(np.pi * np.arange(count, -1, -1) / count)
    nodes[count // 2] = 0.0
    return nodes, np.linalg.inv(np.vander(nodes, increasing=True))


class _Integrals:
    """Places around some times and their integrals, by stretches between edges and marks.

    Attributes:
        origin: Places are counted from here, (n,).
    """

    def __init__(
        self,
        place: Callable[[Numbers], Numbers],
        middle: Numbers,
        blend: float,
        edges: Numbers,
        degree: int,
    ) -> None:
        self._low, self._blend = float(middle.min()) - 1.5 * blend, blend
        own = np.unique(self._count(middle))
        self._groups = np.unique(np.concatenate([own - 1, own, own + 1]))
        self._start, span = self._stretches(edges)
        self._half = 0.5 * span
        nodes, fit = _fit(degree)
        times = (self._start + self._half)[:, None] + self._half[:, None] * nodes
        places = place(times.ravel()).reshape(*times.shape, -1)
        centre = places[:, len(nodes) // 2]
        self.origin = centre[0]
        self._terms = np.einsum("ck,mkn->mcn", fit, places - centre[:, None])
        self._terms[:, 0] = centre - self.origin
        order = np.arange(len(nodes))
        self._once, self._twice = 1.0 / (order + 1.0), 1.0 / ((order + 1.0) * (order + 2.0))
        self._own = self.group(self._start + self._half)
        self._integrate()

    def _count(self, times: Numbers) -> Places:
        counts: Places = np.floor((times - self._low) / self._blend).astype(np.int64)
        return counts

    def group(self, times: Numbers) -> Places:
        """Which mark stands in front of times, as an index."""
        found: Places = np.searchsorted(self._groups, self._count(times))
        return found

    def _mark(self, group: Places) -> Numbers:
        marks: Numbers = self._low + self._groups[group] * self._blend
        return marks

    def _stretches(self, edges: Numbers) -> tuple[Numbers, Numbers]:
        """Start and duration of all stretches between marks that are near one of the times."""
        marks = self._low + np.union1d(self._groups, self._groups + 1) * self._blend
        within = edges[(edges > marks[0]) & (edges < marks[-1])]
        bounds = np.unique(np.concatenate([marks, within[np.isin(self._count(within), self._groups)]]))
        start, span = bounds[:-1], np.diff(bounds)
        near = np.isin(self._count(start + 0.5 * span), self._groups)
        return start[near], span[near]

    def _integrate(self) -> None:
        """Integrals in the middle of every stretch, and over all between two marks, each from its own mark on."""
        half, terms = self._half[:, None], self._terms
        signs = np.where(np.arange(terms.shape[1]) % 2, -1.0, 1.0)
        up, down = (np.einsum("mcn,c->mn", terms, self._once * sign) for sign in (1.0, signs))
        up2, down2 = (np.einsum("mcn,c->mn", terms, self._twice * sign) for sign in (1.0, signs))
        begins = np.searchsorted(self._own, np.arange(len(self._groups)))
        more = half * (up + down)
        first = _before(more, begins, self._own)
        self._first = first + half * down  # in the middle
        more2 = half * half * (up2 - down2) + 2.0 * half * self._first
        second = _before(more2, begins, self._own)
        self._second = second + half * self._first - half * half * down2
        ends = np.append(begins[1:], len(half)) - 1
        self._whole, self._whole2 = (first + more)[ends], (second + more2)[ends]

    def at(self, times: Numbers, groups: Places) -> tuple[Numbers, Numbers, Numbers]:
        """Second and first integral, counted from marks, and the places themselves, (k, n) each."""
        k = np.clip(np.searchsorted(self._start, times, "right") - 1, 0, len(self._start) - 1)
        half, terms = self._half[k], self._terms[k]
        u = np.clip((times - self._start[k]) / half - 1.0, -1.0, 1.0)
        along = (half * u)[:, None]
        powers = np.ones((len(u), terms.shape[1]))
        for order in range(1, terms.shape[1]):
            powers[:, order] = powers[:, order - 1] * u
        place = np.einsum("kcn,kc->kn", terms, powers)
        once = self._first[k] + along * np.einsum("kcn,kc->kn", terms, powers * self._once)
        twice = self._second[k] + along * self._first[k]
        twice += along * along * np.einsum("kcn,kc->kn", terms, powers * self._twice)
        own = self._own[k]
        while len(late := np.flatnonzero(own > groups)):
            left = (times[late] - self._mark(own[late]))[:, None]
            own[late] -= 1
            twice[late] += self._whole2[own[late]] + self._whole[own[late]] * left
            once[late] += self._whole[own[late]]
        while len(early := np.flatnonzero(own < groups)):
            left = (times[early] - self._mark(own[early] + 1))[:, None]
            twice[early] -= self._whole2[own[early]] + self._whole[own[early]] * left
            once[early] -= self._whole[own[early]]
            own[early] += 1
        return twice, once, place


def _before(more: Numbers, begins: Places, own: Places) -> Numbers:
    """Sums of what stands in front of each row, from the first row of its group on."""
    sums = np.cumsum(more, axis=0) - more
    before: Numbers = sums - sums[begins][own]
    return before
