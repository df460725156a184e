"""Axes by hand that go together along a line: an axis of the work, or of the tool, or with one that they follow.

With frames that turn, or behind a transformation, such a line is none of the machine's axes (SINUMERIK job planning
6.2.7: geometry axes in the work or the tool coordinate system). One axis leads and the others follow in proportion.
"""

from __future__ import annotations

from math import inf

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY
from polycnc.mainrun.axes.hand import ENDLESS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.mainrun.axes.axis import Axis


class AlongLine:
    """Axes that go along a line.

    Args:
        axes: The axes of the channel.
        ways: How far each goes for a millimetre of the line; one of them at least goes anywhere.
        here: Where the axes are, machine position.
        column: The axis by whose key it is led.

    Attributes:
        leads: The axes go together.
        ways: See above.
        column: See above.
    """

    def __init__(
        self, axes: Sequence[Axis], ways: Sequence[float], here: Sequence[float], column: int
    ) -> None:
        self._axes, self._here = axes, list(here)
        self.ways, self.column = tuple(ways), column
        self.leads = False
        self._moved = [i for i, way in enumerate(ways) if abs(way) > NO_WAY]
        # The one whose acceleration bounds the line leads: the others stand what it does.
        self._leader = min(self._moved, key=lambda i: (axes[i].data.acceleration or inf) / abs(ways[i]))
        self._begun = 0.0

    @property
    def turns(self) -> bool:
        """Whether the axes are under way."""
        return self.leads and self._axes[self._leader].hand.moves

    @property
    def moved(self) -> tuple[int, ...]:
        """Columns of the axes that move."""
        return tuple(self._moved)

    def lead(self, time: float) -> None:
        """The axes go together from now on."""
        self.leads, self._begun = True, self._axes[self._leader].hand.at(time)
        for column in self._moved:
            if column != self._leader:
                self._axes[column].hand.follow(self._share_of(column))

    def _share_of(self, column: int) -> Callable[[float], float]:
        ratio, leader = self.ways[column] / self.ways[self._leader], self._axes[self._leader].hand
        return lambda time: ratio * (leader.at(time) - self._begun)

    def farthest(self, direction: int) -> float:
        """How far the line goes in a direction before an axis leaves its travel, mm; never less than nothing."""
        ends = [ENDLESS]
        for column in self._moved:
            hand, way, here = self._axes[column].hand, self.ways[column] * direction, self._here[column]
            end = hand.end_of_travel(1 if way > 0.0 else -1, here)
            ends.append((end - here) / way)
        return max(min(ends), 0.0)

    def send(self, way: float, speed: Callable[[], float], time: float) -> None:
        """Go along the line by a way, mm, further than asked for so far, as fast as all axes stand it."""
        leader = self._axes[self._leader].hand
        start, share = self._here[self._leader], self.ways[self._leader]
        goal = (leader.goal(start) - start) / share + way
        low, high = -self.farthest(-1), self.farthest(1)
        fastest = min((self._axes[i].data.rapid or inf) / abs(self.ways[i]) for i in self._moved)
        leader.towards(
            start + min(max(goal, low), high) * share, lambda: min(speed(), fastest) * abs(share), time
        )

    def brake(self, time: float) -> None:
        """The axes come to rest."""
        self._axes[self._leader].hand.brake(time)
