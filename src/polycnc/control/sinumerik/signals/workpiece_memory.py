"""What has been written for MEASURE, and what it has given (Function Manual FB2, M5)."""

from __future__ import annotations

from enum import IntEnum

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass, field
from polycnc.language.sinumerik.names.frame import NEUTRAL, NcFrame

#: A geometry axis by its number, another one by its name.
AxisKey = int | str


class Result(IntEnum):
    """What MEASURE() gives."""

    OK = 0
    NO_TYPE = 1
    TOOL_ERROR = 2
    NO_POINT_1 = 3
    NO_POINT_2 = 4
    NO_POINT_3 = 5
    NO_DIRECTION = 8
    EQUAL_POINTS = 9
    WRONG_ANGLE = 10
    WRONG_CORNER = 11
    WRONG_DIRECTION = 12
    NO_CROSSING = 13
    NO_PLANE = 14
    WRONG_FRAME = 15


POINTS, RESULTS, INPUTS = 4, 10, 10


class Bit(IntEnum):
    """Bits of $AC_MEAS_VALID behind those of the points."""

    SETPOINT = 4
    SETANGLE = 5
    CORNER_SETANGLE = 6
    TOOL = 7
    EDGE = 8
    DIRECTION = 9
    PLANE = 10
    SELECT = 11
    TYPE = 12
    FINE = 13
    SETANGLES = 14
    MASK = 16
    FROM = 17
    TO = 18
    INPUT = 27


@dataclass(slots=True)
class Measurement(State, lifetime=Lifetime.POWER):
    """What has been written for MEASURE, and what it has given; lengths as programs count them.

    Attributes:
        valid: What counts, as $AC_MEAS_VALID has it.
        points: Measured places by point and axis: the number of a geometry axis, the name of another one.
        setpoint: Where the measured place shall be, by axis.
        setangles: $AA_MEAS_SETANGLE, by axis.
        whole: Whole numbers by the bit that makes them valid.
        angles: Angles that are asked for, by the bit that makes them valid.
        inputs: $AC_MEAS_INPUT, those that have been written.
        frame: $AC_MEAS_FRAME.
        found: What else it has given, by the name of its variable.
        results: $AC_MEAS_RESULTS.
    """

    valid: int = 0
    points: list[dict[AxisKey, float]] = field(default_factory=lambda: [{} for _ in range(POINTS)])
    setpoint: dict[AxisKey, float] = field(default_factory=dict)
    setangles: dict[AxisKey, float] = field(default_factory=dict)
    whole: dict[int, int] = field(default_factory=dict)
    angles: dict[int, float] = field(default_factory=dict)
    inputs: dict[int, float] = field(default_factory=dict)
    frame: NcFrame = NEUTRAL
    found: dict[str, float] = field(default_factory=dict)
    results: list[float] = field(default_factory=lambda: [0.0] * RESULTS)

    def number(self, bit: int) -> int | None:
        """A whole number that counts; None for one that does not."""
        return self.whole.get(bit) if self.valid >> bit & 1 else None

    def angle(self, bit: int) -> float | None:
        """An angle that is asked for; None where none is."""
        return self.angles.get(bit) if self.valid >> bit & 1 else None

    def point(self, number: int) -> dict[AxisKey, float] | None:
        """A point that counts, from 0."""
        return self.points[number] if self.valid >> number & 1 and self.points[number] else None
