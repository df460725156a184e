"""Axes that turn in step with the spindle, beside the program: polygon turning, electronic gears (FANUC G51.2, G81).

On the path such an axis stands where it stood when the coupling began. The main run turns it at a ratio of the
spindle's speed; laws of `transformation/couplings` add what other axes make of it.
"""

from __future__ import annotations

from math import copysign

from polycnc.channel.interpolator import PassiveWatcher
from polycnc.channel.states.state import Lifetime, State
from polycnc.channel.waits import PreprocessingStop
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.transformation.couplings.laws import Law

#: Degrees in a second of a revolution in a minute.
DEGREES_PER_RPM = 6.0


class Lead(NamedTuple):
    """How an axis is led: its turns for one of the spindle, signed, and what other axes add."""

    ratio: float
    laws: tuple[Law, ...] = ()


@dataclass(slots=True)
class SpindleLed(PassiveWatcher, State, lifetime=Lifetime.POWER):
    """The axes of a channel that the spindle leads; satisfies the channel's `Watcher`.

    Attributes:
        channel: The channel.
        leads: How each is led, by its column.
        rpm: Speed of the spindle that they turn by.
    """

    channel: Channel
    leads: dict[int, Lead] = field(default_factory=dict)
    rpm: float = 0.0

    @classmethod
    def first(cls, channel: Channel) -> SpindleLed:
        """None is led."""
        return cls(channel)

    def begin(self, column: int, lead: Lead) -> None:
        """From here on the spindle leads an axis."""
        clocked = self.channel.on_clock()

        def start() -> None:
            clocked.watch(self)
            clocked.move_static(column, static=True)
            clocked.follow(column, lead.laws)
            self.leads[column] = lead
            self._turn(column)

        self.channel.event(Deed("SYNCHRONOUS", None, start, is_silent=False))

    def release(self, column: int) -> None:
        """The axis comes to rest and belongs to the program again, where it then stands.

        Raises:
            PreprocessingStop: It still turns.
        """
        channel = self.channel
        clocked = channel.on_clock()
        channel.flush()
        channel.synchronise()
        if self.leads.pop(column, None) is not None:
            clocked.follow(column, ())
            clocked.commanded(column).stop()
        if clocked.commanded(column).moves:
            raise PreprocessingStop
        clocked.move_static(column, static=False)
        machine = channel.coordinates.machine
        machine[column] = clocked.take_back(column)
        channel.coordinates.arrive_machine(machine)

    # ---- in the main run ---------------------------------------------------------------------------------------

    def look(self) -> None:
        """An interpolation cycle has come."""
        clocked = self.channel.on_clock()
        rpm = clocked.spindle_rpm if clocked.has_power else 0.0
        if rpm != self.rpm:
            self.rpm = rpm
            for column in self.leads:
                self._turn(column)

    def _turn(self, column: int) -> None:
        speed = self.rpm * self.leads[column].ratio * DEGREES_PER_RPM
        axis = self.channel.on_clock().commanded(column)
        axis.run_on(int(copysign(1.0, speed)) if speed else 0, abs(speed))

    @property
    def lingers(self) -> bool:
        """The end of the program ends the couplings, and waits until their axes stand."""
        clocked = self.channel.on_clock()
        for column in tuple(self.leads):
            if self.leads[column] == Lead(0.0):
                continue
            self.leads[column] = Lead(0.0)
            clocked.follow(column, ())
            clocked.commanded(column).stop()
        return any(clocked.commanded(column).moves for column in self.leads)

    @property
    def is_quiet(self) -> bool:
        """The speed of the spindle may change while an axis is led."""
        return not self.leads

    def abandon(self, *, reset: bool) -> None:  # noqa: ARG002 - both end it
        """The program has ended, or was given up."""
        clocked = self.channel.on_clock()
        for column in self.leads:
            clocked.commanded(column).stop()
            clocked.move_static(column, static=False)
        self.leads.clear()
        self.rpm = 0.0
