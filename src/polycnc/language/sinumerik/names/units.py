"""Physical units of variables (PHU), and which of them follow the measuring system (job planning 1.1.9).

A value with a unit of length is kept in metric units; a program in inches (G700) reads and writes it in inches.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.emitter import provide

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel

#: Numbers of all units.
KNOWN = frozenset({*range(17), *range(18, 38), 42, 43, 46, 48, 49, *range(65, 70), 155, 156})
_M_PER_INCH, _M_PER_FOOT = 0.0254, 0.3048
#: How much of a metric unit one of the unit in inches is; the others are never converted.
FACTORS: dict[int, float] = {
    **dict.fromkeys((1, 2, 4, 5, 15, 16), INCH_MM),  # position, velocity, feed per revolution
    **dict.fromkeys((7, 8, 10, 11), _M_PER_INCH),  # acceleration, jerk
    **dict.fromkeys((29, 30), _M_PER_FOOT),  # cutting speed, peripheral speed
}


def shown(channel: Channel, value: float, factor: float) -> float:
    """A kept value as the program reads it."""
    return value / factor if channel.control.reads_inches(channel) else value


def kept(channel: Channel, value: float, factor: float) -> float:
    """A value of the program as it is kept."""
    return value * factor if channel.control.reads_inches(channel) else value


provide(shown=shown, kept=kept)
