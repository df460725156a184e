"""Functions that read values of curve tables (job planning 9.2.6).

Places are in the units of the program: those of a linear axis in mm or inches. An axis in the call says whether the
value is that of a linear or of a rotary axis; without one those count with which the table was defined. The slope goes
into the variable that the call names.
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.curve_tables.memory import table_of
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.curve_tables.curve import CurveTable, Place
    from polycnc.control.sinumerik.family import SinumerikChannel


class Reading:
    """A table, and the units in which a call speaks of it.

    Args:
        channel: The channel.
        number: Number of the table; alarm 16776 where there is none.
        following: The following axis, None where the call names none.
        leading: The leading axis.
    """

    def __init__(
        self, channel: SinumerikChannel, number: Any, following: Any = None, leading: Any = None
    ) -> None:
        self.table: CurveTable = table_of(channel, arguments.whole(number))
        factor = length_factor(channel.mode)
        units = []
        for axis, own in zip((leading, following), self.table.turning, strict=True):
            turning = own if axis is None else channel.memory.axes[arguments.column(channel, axis)].rotary
            units.append(1.0 if turning else factor)
        self.leading, self.following = units

    def slope(self, variable: Any, slope: float) -> None:
        """Hand over a slope."""
        if variable is not None:
            variable.value = slope * self.leading / self.following

    def place(self, variable: Any, place: Place) -> float:
        """A place of the following axis, with its slope."""
        self.slope(variable, place.slope)
        return place.place / self.following


def _end_value(*, start: bool) -> Callable[[SinumerikChannel, Arguments], float]:
    """CTABTSV, CTABTEV(n,slope[,following]): the following axis at the start, at the end."""

    def value(channel: SinumerikChannel, args: Arguments) -> float:
        reading = Reading(channel, args[0], args[2])
        _, place = reading.table.start if start else reading.table.end
        return reading.place(args[1], place)

    return value


def _end_place(*, start: bool) -> Callable[[SinumerikChannel, Arguments], float]:
    """CTABTSP, CTABTEP(n,slope[,leading]): the leading axis at the start, at the end."""

    def value(channel: SinumerikChannel, args: Arguments) -> float:
        reading = Reading(channel, args[0], None, args[2])
        leading, place = reading.table.start if start else reading.table.end
        reading.slope(args[1], place.slope)
        return leading / reading.leading

    return value


def _segment_value(p: float) -> Callable[[SinumerikChannel, Arguments], float]:
    """CTABSSV, CTABSEV(leading value,n,slope[,following]): the following axis at an end of a segment."""

    def value(channel: SinumerikChannel, args: Arguments) -> float:
        reading = Reading(channel, args[1], args[3])
        segment = reading.table.segment_at(args[0] * reading.leading)
        return reading.place(args[2], segment.at(p))

    return value


def following_value(channel: SinumerikChannel, args: Arguments) -> float:
    """CTAB(leading value,n,slope[,following,leading])."""
    reading = Reading(channel, *args[1:2], *args[3:5])
    return reading.place(args[2], reading.table.at(args[0] * reading.leading))


def leading_value(channel: SinumerikChannel, args: Arguments) -> float:
    """CTABINV(following value,about,n,slope[,following,leading]): the nearest one to the leading value `about`."""
    reading = Reading(channel, *args[2:3], *args[4:6])
    leading, slope = reading.table.inverse(args[0] * reading.following, args[1] * reading.leading)
    reading.slope(args[3], slope)
    return leading / reading.leading


def _extreme(*, highest: bool) -> Callable[[SinumerikChannel, Arguments], float]:
    """CTABTMIN, CTABTMAX(n[,following]) or (n,a,b[,following,leading]); 14020 for a range beyond the table."""
    name = "CTABTMAX" if highest else "CTABTMIN"

    def value(channel: SinumerikChannel, args: Arguments) -> float:
        number, *rest = args
        in_range = isinstance(rest[0], (int, float))
        if in_range and not isinstance(rest[1], (int, float)):
            raise AlarmError("14020", text=name)
        reading = Reading(channel, number, *(rest[2:4] if in_range else rest[:1]))
        low, high = domain = reading.table.domain
        if in_range:
            low, high = (float(each) * reading.leading for each in rest[:2])
            if not domain[0] <= low <= high <= domain[1]:
                raise AlarmError("14020", text=f"{name}({number},{rest[0]},{rest[1]})")
        return reading.table.extremes(low, high)[int(highest)] / reading.following

    return value


FUNCTIONS = {
    "CTABTSV": _end_value(start=True),
    "CTABTEV": _end_value(start=False),
    "CTABTSP": _end_place(start=True),
    "CTABTEP": _end_place(start=False),
    "CTABSSV": _segment_value(0.0),
    "CTABSEV": _segment_value(1.0),
    "CTAB": following_value,
    "CTABINV": leading_value,
    "CTABTMIN": _extreme(highest=False),
    "CTABTMAX": _extreme(highest=True),
}
