"""Spindles: speed, direction, position, limits, and which one is the master.

Source: Fundamentals (S, M3, M4, M5, SPOS, SETMS, G96, LIMS, G25/G26 S).
"""

from __future__ import annotations

from math import inf

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Container

    from polycnc.channel.channel import Channel


@dataclass(slots=True)
class Spindle:
    """One spindle.

    Attributes:
        speed: Programmed S, rpm.
        cutting_speed: Programmed S under constant cutting speed, m/min; 0 where none was.
        direction: 1 for M3, -1 for M4, 0 for M5.
        position: Degrees, 0 to 360.
        controlled: In position control (SPCON, SPOS).
        positioning: Speed of positioning that FA has told, degrees/s; 0 for that of the machine data.
        most: While it leads axes (EGON), which follow what it turns by M3 and M4: the highest speed, rpm, at which they
            can; infinite while it leads none.
        override: OVRA, 1 for 100 %.
        has_wheel_speed: S is the speed of the grinding wheel's circumference, m/s (GWPSON).
    """

    number: int
    speed: float = 0.0
    cutting_speed: float = 0.0
    direction: int = 0
    position: float = 0.0
    controlled: bool = False
    positioning: float = 0.0
    has_wheel_speed: bool = False
    override: float = 1.0
    most: float = inf

    def refuse_leading(self, code: str) -> None:
        """PC0001 for what turns a spindle in a way that no axis follows, while it leads one."""
        if self.most < inf:
            raise not_supported(f"{code}: EGON S{self.number}")


@dataclass(slots=True)
class Spindles(State, lifetime=Lifetime.POWER):
    """The spindles of a channel.

    Attributes:
        all: By number.
        default_master: Master spindle of the machine data; `SETMS` alone returns to it.
        master: Number of the master spindle.
    """

    all: dict[int, Spindle] = field(default_factory=dict)
    default_master: int = 1
    master: int = 1

    @classmethod
    def first(cls, channel: Channel) -> Spindles:
        """All stand still; the master spindle is that of MD20090, where the channel has it."""
        numbers = channel.machine.channel(channel.number).spindles
        master = MachineData.of(channel).integer("$MC_SPIND_DEF_MASTER_SPIND")
        if numbers and master not in numbers:
            master = numbers[0]
        return cls({number: Spindle(number) for number in numbers}, master, master)

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """A reset stops the spindles, but for those that MD35040 keeps turning."""
        super().end(channel, lifetime)
        if lifetime is Lifetime.RESET:
            for spindle in self.all.values():
                spindle.override = 1.0
            data = MachineData.of(channel)
            self.stop(kept=[n for n in self.all if data.integer("$MA_SPIND_ACTIVE_AFTER_RESET", f"S{n}")])

    def stop(self, kept: Container[int] = ()) -> None:
        """The spindles stop, but for some."""
        for number, spindle in self.all.items():
            if number not in kept:
                spindle.direction = 0

    def get(self, number: int | None = None) -> Spindle:
        """A spindle by number, the master without one.

        Raises:
            AlarmError: 10810 if there is no master spindle, 16761 for a number that the channel does not
                have.
        """
        wanted = self.master if number is None else number
        if wanted not in self.all:
            raise AlarmError("10810") if number is None else AlarmError("16761", axis=f"S{number}")
        return self.all[wanted]
