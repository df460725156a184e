"""CALCPOSI: how far the geometry axes can go without leaving limits or entering protection zones (job planning 3.3)."""

from __future__ import annotations

from math import hypot

from polycnc.control.sinumerik.limits import protection, working_area
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.variables import Array
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.control.sinumerik.family import SinumerikChannel

#: Bits of the last argument.
SWITCHES, AREA, ACTIVE_ZONES, PREACTIVE_ZONES = 1, 2, 4, 8
ALL = SWITCHES | AREA | ACTIVE_ZONES | PREACTIVE_ZONES
#: Digits of the status: units, tens and hundreds.
OF_SWITCH, OF_AREA, OF_ZONE = 1, 2, 3
AT_START, ON_THE_WAY = 10, 20
UPPER_OR_MACHINE, LOWER_OR_CHANNEL = 100, 200
NEGATIVE_CLEARANCE = -1
_SLACK = 1e-6


class Violation(NamedTuple):
    """What restricts a way: the part of it that is free, and the status."""

    part: float
    status: int


def calculate(channel: SinumerikChannel, args: tuple[Any, ...]) -> int:
    """CALCPOSI(start, way, clearances, free way[, basic system][, what to test]).

    Returns:
        0, -1 for a negative clearance, or the status of the strongest restriction.

    Raises:
        AlarmError: 14020 for an array that is too short.
    """
    start, way, clearances, free = (
        _items(arg, count) for arg, count in zip(args, (3, 3, 5, 3), strict=False)
    )
    in_basic_system, tested = (*args[4:], None, None)[:2]
    if any(value < 0.0 for value in clearances[:5]):
        return NEGATIVE_CLEARANCE
    inches = channel.mode["unit"] in ("G70", "G700") and not in_basic_system
    factor = INCH_MM if inches else 1.0
    first, last = _machine_ways(channel, [v * factor for v in start[:3]], [v * factor for v in way[:3]])
    margins = [value * factor for value in clearances[:5]]
    found = [
        *_of_limits(channel, first, last, margins, ALL if tested is None else int(tested)),
        *_of_zones(channel, first, last, margins[3], ALL if tested is None else int(tested)),
    ]
    worst = min(found, key=lambda each: each.part, default=Violation(1.0, 0))
    free[:3] = [value * worst.part for value in way[:3]]
    return worst.status


def _items(value: Any, count: int) -> list[float]:
    if not isinstance(value, Array) or len(value.items) < count:
        raise AlarmError("14020", text="CALCPOSI")
    return value.items


def _machine_ways(
    channel: SinumerikChannel, start: list[float], way: list[float]
) -> tuple[list[float], list[float]]:
    """Start and end of a way of the workpiece coordinate system, abscissa first, as positions of the machine's axes."""
    geometry = channel.coordinates.geometry
    first = channel.coordinates.position.copy()
    last = first.copy()
    for axis, a, b in zip(PLANES[channel.mode["plane"]], start, way, strict=True):
        column = geometry[axis]
        if column >= 0:
            first[column], last[column] = a, a + b
    return channel.coordinates.to_machine(first), channel.coordinates.to_machine(last)


def _of_limits(
    channel: SinumerikChannel, first: list[float], last: list[float], margins: list[float], tested: int
) -> Iterator[Violation]:
    """Software limit switches by machine axis, working area by geometry axis."""
    geometry = channel.coordinates.geometry
    plane = PLANES[channel.mode["plane"]]
    for limit in working_area.Ranges.of(channel).limits:
        unit = OF_SWITCH if limit.alarm == working_area.SWITCH else OF_AREA
        if limit.column not in geometry or not tested & unit:
            continue
        axis = geometry.index(limit.column)
        number = (
            axis + 1 if unit == OF_AREA else channel.machine.axis_number(channel.axis_data[limit.column].name)
        )
        length = channel.coordinates.offsets[limit.column] if limit.system == working_area.BASIC else 0.0
        start, end = first[limit.column] - length, last[limit.column] - length
        violation = _beyond(start, end, limit, margins[plane.index(axis)])
        if violation is not None:
            yield Violation(violation.part, violation.status + unit + 1000 * number)


def _beyond(start: float, end: float, limit: working_area.Limit, margin: float) -> Violation | None:
    """How far an axis can go within one range; none where nothing restricts it."""
    if start > limit.high + _SLACK:
        return Violation(0.0, AT_START + UPPER_OR_MACHINE)
    if start < limit.low - _SLACK:
        return Violation(0.0, AT_START + LOWER_OR_CHANNEL)
    if end > start and end > limit.high - margin + _SLACK:
        part = (limit.high - margin - start) / (end - start)
        return Violation(max(part, 0.0), ON_THE_WAY + UPPER_OR_MACHINE)
    if end < start and end < limit.low + margin - _SLACK:
        part = (limit.low + margin - start) / (end - start)
        return Violation(max(part, 0.0), ON_THE_WAY + LOWER_OR_CHANNEL)
    return None


def _of_zones(
    channel: SinumerikChannel, first: list[float], last: list[float], margin: float, tested: int
) -> Iterator[Violation]:
    """The first zone on the way; the clearance shortens the way in front of it."""
    found = protection.Protection.of(channel)
    placed = list(found.placed(channel)) if tested & ACTIVE_ZONES else []
    tools = [each for each in found.placed(channel) if each[0].of_tool]
    if tested & PREACTIVE_ZONES:
        waiting = list(found.placed(channel, preactive=True))
        placed = [*placed, *waiting] if tested & ACTIVE_ZONES else [*tools, *waiting]
    met = protection.contact(channel, placed, first, last)
    if met is None:
        return
    part, zone = met
    geometry = [i for i in channel.coordinates.geometry if i >= 0]
    length = hypot(*(last[i] - first[i] for i in geometry))
    unit = OF_ZONE + 1000 * zone.number
    unit += UPPER_OR_MACHINE if zone.kind == protection.MACHINE else LOWER_OR_CHANNEL
    if part <= 0.0 and _is_inside(channel, placed, first):
        yield Violation(0.0, unit + AT_START)
        return
    free = part - margin / length if length else 0.0
    if free < 1.0 - 1e-12:
        yield Violation(max(free, 0.0), unit + ON_THE_WAY)


def _is_inside(channel: SinumerikChannel, placed: protection.Placed, point: list[float]) -> bool:
    return protection.contact(channel, placed, point, point) is not None
