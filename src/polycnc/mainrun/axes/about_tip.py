"""Rotary axes by hand while an orientation transformation is active: the tool turns about its tip (TRAORI).

The linear axes follow the rotary ones; the tip stays where it is on the work (SINUMERIK job planning 6.2.7, JOG).
"""

from __future__ import annotations

from math import inf, sqrt

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.tolerances import NO_WAY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.mainrun.axes.axis import Axis
    from polycnc.mainrun.reading.display import MainRunDisplay
    from polycnc.toolpath import Context

#: Degrees between two places at which limits and speeds of the linear axes are looked at.
STEP_DEG = 0.5
#: A turn: what follows is the same again.
TURN_DEG = 360.0


class AboutTip:
    """Where the linear axes go while the rotary ones turn. Positions are machine positions, mm and degrees.

    Args:
        axes: The axes of the channel.
        display: Knows their transformation.
        context: What holds.
        here: Where the axes are.
        time: When that is, s.

    Attributes:
        leads: The linear axes follow.
    """

    def __init__(
        self,
        axes: Sequence[Axis],
        display: MainRunDisplay,
        context: Context,
        here: Sequence[float],
        time: float,
    ) -> None:
        self._axes, self._display, self._context = axes, display, context
        self.leads = False
        self._here = list(here)
        self._path = display.on_path(here, context)
        self._rotary = [i for i, axis in enumerate(axes) if axis.data.rotary]
        self._linear = [i for i in display.geometry if i >= 0]
        self._begun = [axes[i].hand.at(time) for i in self._rotary]

    @property
    def turns(self) -> bool:
        """Whether a rotary axis is under way, and the linear ones with it."""
        return self.leads and any(self._axes[i].hand.moves for i in self._rotary)

    def lead(self) -> None:
        """The linear axes follow from now on."""
        self.leads = True
        for column in self._linear:
            self._axes[column].hand.follow(self._share_of(column))

    def _share_of(self, column: int) -> Callable[[float], float]:
        def share(time: float) -> float:
            ways = [self._axes[i].hand.at(time) for i in self._rotary]
            if all(abs(way - begun) <= NO_WAY for way, begun in zip(ways, self._begun, strict=True)):
                return 0.0
            turned = {
                i: self._here[i] + way - begun
                for i, way, begun in zip(self._rotary, ways, self._begun, strict=True)
            }
            return self._real(turned)[column] - self._here[column]

        return share

    def _real(self, angles: dict[int, float]) -> list[float]:
        """Where the axes are with the tip where it was, and rotary axes at these angles."""
        path = [angles.get(i, value) for i, value in enumerate(self._path)]
        return self._display.real(path, self._context)

    def reach(self, column: int, target: float, speed: float) -> tuple[float, float]:
        """How far a rotary axis may turn towards a target, and how fast, so that the linear axes stand it.

        Returns:
            The angle, and the speed in degrees/s.
        """
        start = self._here[column]
        way = min(max(target - start, -TURN_DEG), TURN_DEG)
        count = max(1, round(abs(way) / STEP_DEG))
        before = self._here
        last: list[float] | None = None
        for step in range(1, count + 1):
            angle = start + way * step / count
            real = self._real({column: angle})
            if not all(self._is_within(i, real[i]) for i in self._linear):
                return start + way * (step - 1) / count, speed
            speed = min(speed, self._fastest(before, real, last, abs(way) / count))
            last, before = [b - a for a, b in zip(before, real, strict=True)], real
        return target, speed

    def fastest(self, column: int, target: float, speed: Callable[[], float]) -> float:
        """How fast the axis may turn towards a target now, degrees/s."""
        return self.reach(column, target, speed())[1]

    def _is_within(self, column: int, place: float) -> bool:
        hand, here = self._axes[column].hand, self._here[column]
        return hand.end_of_travel(-1, here) - NO_WAY <= place <= hand.end_of_travel(1, here) + NO_WAY

    def _fastest(
        self, before: Sequence[float], real: Sequence[float], last: Sequence[float] | None, step: float
    ) -> float:
        """The speed of the rotary axis at which no linear axis is too fast, or turns off too hard."""
        fastest = inf
        if step <= 0.0:
            return fastest
        for i in self._linear:
            data, way = self._axes[i].data, real[i] - before[i]
            if abs(way) > NO_WAY:
                fastest = min(fastest, data.rapid * step / abs(way))
            bend = abs(way - last[i]) if last is not None else 0.0
            if bend > NO_WAY and data.acceleration:
                fastest = min(fastest, step * sqrt(data.acceleration / bend))
        return fastest
