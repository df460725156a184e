"""The course of the feed over a block: FNORM, FLIN, FCUB, F=FPO(…) (job planning 8.2).

A course is a cubic in p, the part of the block's way from 0 to 1. It counts feeds in the units of the feed type,
whatever G90 and G91 say. FLIN and FCUB act under G93 and G94; elsewhere F is constant.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil, isnan, nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.tables import LINEAR, POLYNOMIAL
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

#: A course that falls to nothing would never end: so much of its greatest end is left.
LEAST_SHARE = 0.01
#: The feed changes by this part of itself from one slice to the next; so many slices at least and at most.
_STEP, LEAST_SLICES, MOST_SLICES = 0.03, 16, 64
#: The last slice has the feed of the end of the block, which displays show.
LAST_SLICE = 0.001
#: Places and weights of a Gauss quadrature over 0 to 1.
_GAUSS = ((0.1127016653792583, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.8872983346207417, 5.0 / 18.0))


@dataclass(slots=True)
class ProgrammedFeed(State, lifetime=Lifetime.RESET):
    """The feed in front of the running block, and what its FPO says, in internal units."""

    before: float = nan
    coefficients: tuple[float, float] | None = None


class Profile(NamedTuple):
    """What a block says of its feed.

    Attributes:
        kind: One of the codes.
        start: Feed in front of the block; NaN for none.
        end: Feed at its end.
        coefficients: Of p² and p³, of a polynomial.
    """

    kind: str
    start: float
    end: float
    coefficients: tuple[float, float] = (0.0, 0.0)

    @property
    def first(self) -> float:
        """The feed at the start of the block: without any before, that of its end."""
        return self.end if isnan(self.start) else self.start


class Course(NamedTuple):
    """A feed of `a + b·p + c·p² + d·p³`."""

    a: float
    b: float = 0.0
    c: float = 0.0
    d: float = 0.0

    def at(self, p: float) -> float:
        """The feed at a part of the way; never as little as none."""
        least = LEAST_SHARE * max(self.a, self.a + self.b + self.c + self.d)
        return max(self.a + p * (self.b + p * (self.c + p * self.d)), least)

    def slope(self, p: float) -> float:
        """How the feed changes with the part of the way."""
        return self.b + p * (2.0 * self.c + p * 3.0 * self.d)

    def mean(self, first: float, last: float) -> float:
        """The constant feed that takes as long from one part to another."""
        width = last - first
        return 1.0 / sum(weight / self.at(first + width * place) for place, weight in _GAUSS)

    def slices(self, *, most: int = MOST_SLICES) -> list[float]:
        """Parts of the way at which the feed has changed by about as much each; the last ones are the end."""
        values = [self.at(k / MOST_SLICES) for k in range(MOST_SLICES + 1)]
        change = sum(abs(b - a) for a, b in pairwise(values)) / min(values)
        count = min(max(ceil(change / _STEP), LEAST_SLICES), MOST_SLICES, most)
        if change == 0.0:
            return [1.0]
        return [*((1.0 - LAST_SLICE) * k / count for k in range(1, count + 1)), 1.0]


def course_of(profile: Profile) -> Course:
    """The course of a block that stands alone: linear, polynomial, or constant."""
    if profile.kind == LINEAR:
        return Course(profile.first, profile.end - profile.first)
    if profile.kind == POLYNOMIAL:
        c, d = profile.coefficients
        return Course(profile.first, profile.end - profile.first - c - d, c, d)
    return Course(profile.end)


def spline(feeds: Sequence[float], lengths: Sequence[float], before: float, after: float) -> list[Course]:
    """The courses of blocks whose ends a cubic spline over their way joins.

    Args:
        feeds: At the start of the first block and at the end of each.
        lengths: Of the blocks, all more than 0.
        before: Slope over the way with which the spline begins.
        after: Slope with which it ends.
    """
    slopes = _slopes(feeds, lengths, before, after)
    courses = []
    for k, length in enumerate(lengths):
        rise = feeds[k + 1] - feeds[k]
        first, last = slopes[k] * length, slopes[k + 1] * length
        courses.append(Course(feeds[k], first, 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise))
    return courses


def _slopes(feeds: Sequence[float], lengths: Sequence[float], before: float, after: float) -> list[float]:
    """Slopes at the points such that the curvature has no jumps: a tridiagonal system, solved forwards and back."""
    upper, right = [0.0], [before]
    for k in range(1, len(lengths)):
        h, g = lengths[k - 1], lengths[k]
        rises = 3.0 * ((feeds[k] - feeds[k - 1]) * g / h + (feeds[k + 1] - feeds[k]) * h / g)
        pivot = 2.0 * (h + g) - g * upper[-1]
        right.append((rises - g * right[-1]) / pivot)
        upper.append(h / pivot)
    slopes = [after]
    for k in range(len(lengths) - 1, -1, -1):
        slopes.append(right[k] - upper[k] * slopes[-1])
    return slopes[::-1]
