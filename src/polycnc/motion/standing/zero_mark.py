"""Where a spindle is on its turn: a thread begins when the spindle comes to its start angle.

Nobody knows at which angle a spindle has come up to speed. So the first thread waits for half a turn, which is the
average, and says where the zero mark is; each one behind it waits until the spindle is there again, also at another
speed. A spindle that has followed a surface speed, a tap, or an order to a position has an angle that nobody knows. The
plan and the main run ask the same objects, the samples wait as the plan does.
"""

from __future__ import annotations

from math import sqrt

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import PieceRecord
from polycnc.motion.kernels.jerk import averaged_s2

if TYPE_CHECKING:
    from collections.abc import Sequence

TURN_DEG, DEGREES_S = 360.0, 6.0
"""Degrees of a turn; degrees per second of a revolution per minute."""
#: An angle that counts as none: the mark is there.
THERE_DEG = 1e-6


def lag_s(pieces: Sequence[float], at: int) -> float:
    """Seconds by which an axis that takes up its speed in a piece is behind one that has had it from the start.

    With an acceleration u up to v it is v/2u, besides half the averages. Where the lead changes so that it accelerates
    by c, the axis meets it behind the way s at the speed w, both as `kernels/leads.py` has them: it has taken w/u to
    where a lead from the start on would have come in (w - v)/c.
    """
    cap2, pull = pieces[at + PieceRecord.CAP2], pieces[at + PieceRecord.PULL]
    ramp, blend = pieces[at + PieceRecord.RAMP], pieces[at + PieceRecord.BLEND]
    late = 0.5 * ramp + blend
    if pull <= 0.0:
        return late
    change = 0.5 * pieces[at + PieceRecord.RISE]
    if change >= pull:  # it never meets it
        change = 0.0
    way = 0.5 * cap2 / (pull - change)
    raised = change * averaged_s2(ramp, blend)
    speed, met = sqrt(max(cap2 - change * raised, 0.0)), sqrt(2.0 * pull * way)
    return late + met / pull - (2.0 * way + raised) / (met + speed) if met > 0.0 else late


class SpindleAngle:
    """The angle of a spindle over time, from its zero mark on.

    Attributes:
        factor: What an override makes of its speed.
        is_known: Whether the mark has been found since the angle was lost.
    """

    def __init__(self) -> None:
        self.factor, self.is_known = 1.0, False
        self._rpm, self._angle, self._time = 0.0, 0.0, 0.0

    def let_pass(self, time: float) -> None:
        """It turns evenly until a time."""
        if time > self._time:
            turned = DEGREES_S * self.factor * self._rpm * (time - self._time)
            self._angle, self._time = (self._angle + turned) % TURN_DEG, time

    def turn_with(self, factor: float, time: float) -> None:
        """From a time on the override is another one."""
        if factor != self.factor:
            self.let_pass(time)
            self.factor = factor

    def go_to(self, rpm: float, ramp_s: float, time: float) -> None:
        """From a time on it goes evenly to another speed, negative counter-clockwise."""
        self.let_pass(time)
        turned = 0.5 * DEGREES_S * self.factor * (self._rpm + rpm) * ramp_s
        self._angle, self._time = (self._angle + turned) % TURN_DEG, time + ramp_s
        self._rpm = rpm

    def lose(self) -> None:
        """Its angle does not follow from its speed any more."""
        self.is_known = False

    def until_start(self, rpm: float, start_deg: float, lag: float, time: float) -> float:
        """Seconds from a time on until a thread begins.

        Args:
            rpm: Speed, negative counter-clockwise; 0 where it does not turn by itself.
            start_deg: Start angle of the thread.
            lag: Seconds by which its axes are late, up to speed; they begin so much earlier that they are then
                where the spindle's angle asks them to be, however fast they take up speed.
            time: The time.
        """
        speed = DEGREES_S * self.factor * rpm
        if speed == 0.0:
            return 0.0
        aim = (start_deg if speed > 0.0 else -start_deg) - speed * lag
        if not self.is_known:
            self.is_known, self._rpm, self._time = True, rpm, time
            self._angle = (aim - 0.5 * TURN_DEG) % TURN_DEG
        self.let_pass(time)
        left = (aim - self._angle if speed > 0.0 else self._angle - aim) % TURN_DEG
        return 0.0 if left > TURN_DEG - THERE_DEG or left < THERE_DEG else left / abs(speed)


class Turns(NamedTuple):
    """At a row a spindle goes to another speed, `after_s` seconds later than the row; None where its angle is lost."""

    row: int
    angle: SpindleAngle
    rpm: float | None
    ramp_s: float = 0.0
    after_s: float = 0.0


class Mark(NamedTuple):
    """A thread that begins with a row waits for the zero mark, behind what the row waits for besides (`after_s`)."""

    row: int
    angle: SpindleAngle
    rpm: float
    start_deg: float
    context: int
    after_s: float
