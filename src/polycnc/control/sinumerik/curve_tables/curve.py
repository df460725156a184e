"""A curve table: the place of a following axis as a function of that of a leading axis (job planning 9.2).

Places are of the axes (basic coordinate system), mm or degrees. A segment is a pair of polynomials of degree five at
most in a parameter from 0 to 1, one for each axis; that of the leading axis only grows, or only shrinks, in all of a
table.
"""

from __future__ import annotations

from math import floor, inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry import polynomials
from polycnc.geometry.polynomials import Coefficients
from polycnc.geometry.tolerances import NO_WAY
from polycnc.memory.encoding import encoded

if TYPE_CHECKING:
    from collections.abc import Iterator

#: Periodicity (CTABDEF): processed once; periodic in the leading axis; periodic in both.
ONCE, PERIODIC, PERIODIC_IN_BOTH = 0, 1, 2
#: Degree of a polynomial that is a line.
_STRAIGHT = 2


class Place(NamedTuple):
    """A place of one axis, and the slope of the table there: way of the following axis by that of the leading one."""

    place: float
    slope: float


@encoded("curve segment")
@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of a table; where the leading axis stands in it, the following axis jumps.

    Attributes:
        leading: Polynomial of the leading axis.
        following: Polynomial of the following axis.
    """

    leading: Coefficients
    following: Coefficients

    @property
    def ends(self) -> tuple[float, float]:
        """Where the leading axis is at its start and at its end."""
        return self.leading[0], sum(self.leading)

    @property
    def is_jump(self) -> bool:
        """Whether the leading axis stands."""
        return len(self.leading) == 1

    @property
    def is_straight(self) -> bool:
        """Whether it is a line."""
        return len(self.leading) <= _STRAIGHT and len(self.following) <= _STRAIGHT

    @property
    def polynomials(self) -> int:
        """How many polynomials it takes: none for a line, one more where the leading axis does not move evenly."""
        return 0 if self.is_straight else 1 if len(self.leading) <= _STRAIGHT else 2

    def at(self, p: float) -> Place:
        """The following axis at a parameter."""
        slope = polynomials.value(polynomials.derivative(self.leading), p)
        rise = polynomials.value(polynomials.derivative(self.following), p)
        return Place(polynomials.value(self.following, p), rise / slope if slope else 0.0)

    def parameter(self, leading: float) -> float:
        """The parameter at which the leading axis is at a place, held within the segment."""
        return polynomials.solved(self.leading, leading)

    def where(self, following: float) -> Iterator[float]:
        """Where the leading axis is while the following one is at a place."""
        first, *others = self.following
        if not others or not any(others):
            if abs(first - following) <= NO_WAY:
                yield from self.ends
            return
        for p in polynomials.roots((first - following, *others)):
            yield polynomials.value(self.leading, p)


@encoded("curve table")
@dataclass(frozen=True, slots=True)
class CurveTable:
    """A table.

    Attributes:
        number: Its number.
        period: ONCE, PERIODIC, PERIODIC_IN_BOTH.
        segments: In the order in which they were programmed; at least one.
        turning: Whether the leading and the following axis with which it was defined are rotary.
    """

    number: int
    period: int
    segments: tuple[Segment, ...]
    turning: tuple[bool, bool] = (False, False)

    @property
    def start(self) -> tuple[float, Place]:
        """Leading and following axis where the table begins."""
        return self.segments[0].leading[0], self.segments[0].at(0.0)

    @property
    def end(self) -> tuple[float, Place]:
        """The same where it ends."""
        return self.segments[-1].ends[1], self.segments[-1].at(1.0)

    @property
    def domain(self) -> tuple[float, float]:
        """The lowest and the highest place of the leading axis."""
        first, last = self.start[0], self.end[0]
        return min(first, last), max(first, last)

    def periods(self, leading: float) -> int:
        """How many periods lie between the domain and a place; 0 for a table that is not periodic."""
        low, high = self.domain
        if self.period == ONCE or low <= leading <= high:
            return 0
        return floor((leading - low) / (high - low))

    def within(self, leading: float) -> float:
        """The place of the domain that counts for any place: of its end, or of another period."""
        low, high = self.domain
        if self.period == ONCE:
            return min(max(leading, low), high)
        return leading - self.periods(leading) * (high - low)

    def segment_at(self, leading: float) -> Segment:
        """The segment in which a place lies; of two that meet there the later one."""
        place = self.within(leading)
        grows = self.end[0] >= self.start[0]
        found = self.segments[0]
        for segment in self.segments:
            begin = segment.leading[0]
            if not segment.is_jump and (begin <= place if grows else begin >= place):
                found = segment
        return found

    def at(self, leading: float) -> Place:
        """The following axis for a place of the leading axis; beyond the domain as its period says."""
        low, high = self.domain
        if self.period == ONCE and not low <= leading <= high:
            _, end = self.end if (leading > high) == (self.end[0] >= self.start[0]) else self.start
            return Place(end.place, 0.0)
        segment = self.segment_at(leading)
        return segment.at(segment.parameter(self.within(leading)))

    def followed(self, leading: float) -> Place:
        """The same for a coupling: where both axes are periodic, the following one goes on from period to period."""
        here = self.at(leading)
        if self.period != PERIODIC_IN_BOTH:
            return here
        rise = self.end[1].place - self.start[1].place
        if self.end[0] < self.start[0]:
            rise = -rise
        return Place(here.place + self.periods(leading) * rise, here.slope)

    def kinks(self, low: float, high: float) -> Iterator[float]:
        """Places of the leading axis between two at which segments meet or the table ends, in every period."""
        first, last = self.domain
        places = {first, last, *(place for segment in self.segments for place in segment.ends)}
        period = last - first
        once = self.period == ONCE or period <= NO_WAY
        for k in range(
            0 if once else floor((low - last) / period), 1 if once else floor((high - first) / period) + 1
        ):
            for place in places:
                if low <= place + k * period <= high:
                    yield place + k * period

    def inverse(self, following: float, near: float) -> tuple[float, float]:
        """Where the leading axis is while the following one is at a place, nearest to `near`, and the slope there.

        Where the following axis never gets there: where it comes nearest.
        """
        low, high = self.domain
        reached = min(max(following, self.lowest(low, high)), self.highest(low, high))
        best = inf
        for segment in self.segments:
            for leading in segment.where(reached):
                place = leading
                if self.period != ONCE:
                    place += round((near - leading) / (high - low)) * (high - low)
                if abs(place - near) < abs(best - near):
                    best = place
        flat = [segment for segment in self.segments if not any(segment.following[1:])]
        for segment in flat:  # anywhere on a piece on which it stands
            a, b = sorted(segment.ends)
            if abs(segment.following[0] - reached) <= NO_WAY and a <= near <= b:
                best = near
        return best, self.at(best).slope

    def extremes(self, low: float, high: float) -> tuple[float, float]:
        """The lowest and the highest place of the following axis between two places of the leading one."""
        seen = [self.at(low).place, self.at(high).place]
        for segment in self.segments:
            seen += [
                polynomials.value(segment.following, p)
                for p in (0.0, *polynomials.turns(segment.following), 1.0)
                if low <= polynomials.value(segment.leading, p) <= high
            ]
        return min(seen), max(seen)

    def lowest(self, low: float, high: float) -> float:
        """The lowest place of the following axis between two places of the leading one."""
        return self.extremes(low, high)[0]

    def highest(self, low: float, high: float) -> float:
        """The highest one."""
        return self.extremes(low, high)[1]
