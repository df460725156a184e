"""SETTCOR: parts of a tool's length are changed, whatever turns, mirrors or inverts them on their way to the axes.

The change is told along axes of the work, or by the lengths themselves. What is written acts when the edge is selected
again, as everything that a program writes into tool data. Source: job planning 16.1 (what the function does); Function
Manual W1 (parameters and results, as known).
"""

from __future__ import annotations

from polycnc.control.sinumerik.block import arguments
from polycnc.control.sinumerik.tables import data_factor
from polycnc.control.sinumerik.tools.edges import (
    COARSE,
    DP_BASE_LENGTH,
    DP_HOLDER_ANGLE,
    DP_LENGTH,
    DP_RADIUS,
    DP_SIDE_ANGLE,
    DP_TIP,
    DP_TYPE,
    FINE,
    WEAR,
    Edge,
)
from polycnc.control.sinumerik.tools.management.components import (
    BASE,
    DONE,
    GEOMETRY,
    NO_ADDITIVE,
    SETUP,
    SUM,
    WRONG_COMPONENTS,
    WRONG_SYSTEM,
    Asked,
    asked_of,
    length_along,
)
from polycnc.control.sinumerik.tools.management.components import WEAR as OF_WEAR
from polycnc.control.sinumerik.tools.management.environments import ORDER, field_of
from polycnc.control.sinumerik.tools.management.systems import TOOL, WORK
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.sinumerik.names.values import Axis
from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel

#: Further results: wrong kind of value, wrong operation, parts that do not go with them, no geometry axis, no set-up.
WRONG_KIND, WRONG_MODE, CONTRADICTION, NO_AXIS, NO_SETUP = -10, -11, -12, -13, -14
#: Parts that can be written.
PARTS = frozenset((BASE, SETUP, GEOMETRY, SUM, OF_WEAR))
#: What the value tells: a length along one axis of the work, along all three, lengths 1 to 3, one parameter from 3 on.
ALONG_AXIS, ALL_LENGTHS = 0, 2
#: Parameters that are lengths; $TC_DP10 and 11 are angles.
LENGTH_PARAMETERS = range(DP_LENGTH, DP_HOLDER_ANGLE)
#: Operations: set, add; set, or add to both, and take the second part away.
SET, ADD, SET_ALONE, GATHER = range(4)


class _Place(NamedTuple):
    """Where a part of the lengths lies in an edge."""

    edge: Edge
    part: str
    additive: int

    def read(self, parameter: int) -> float:
        """A parameter from 3 to 11 of the part."""
        if self.part in _ADDITIVE:
            return self.edge.added(_ADDITIVE[self.part], self.additive, parameter)
        return self.edge.values[parameter + _SHIFT[self.part]]

    def write(self, parameter: int, value: float) -> None:
        """Put a parameter from 3 to 11 of the part."""
        if self.part in _ADDITIVE:
            self.edge.additive[_ADDITIVE[self.part], 10 * self.additive + parameter] = value
        else:
            self.edge.values[parameter + _SHIFT[self.part]] = value


#: Additive offsets of a location, and from $TC_DP3 to where other parts lie.
_ADDITIVE = {SUM: FINE, SETUP: COARSE}
_SHIFT = {GEOMETRY: 0, OF_WEAR: WEAR, BASE: DP_BASE_LENGTH - DP_LENGTH}


def correct(channel: SinumerikChannel, args: Arguments) -> int:
    """SETTCOR(value[3], parts[, kind[, operation[, axis[, environment[, T[, D[, DL]]]]]]]): change parts of a length.

    `parts` are one or two letters of C E G S W, then a colon and W or T for the system, the work where none is told.
    Kind: 0 along one geometry axis (number or identifier), 1 along abscissa, ordinate and applicate, 2 by lengths 1 to
    3, 3 to 11 the parameter $TC_DP3 to 11 or its like. Operation: 0 the first part is the value, 1 the value is added,
    2 as 0 and 3 the second part and the value are added, each with nothing left in the second part. 0, or -2 to -6 and
    -9 as GETTCOR, -10 to -14 (above).

    Raises:
        AlarmError: 17210 for wear of the active edge under FTOCON; what `seen_from` finds.
    """
    field_of("SETTCOR", args[0], (3,))
    given = [*args[1:], *[None] * 8][:8]
    parts, system = [*str(given[0]).upper().replace("\t", "").replace(" ", "").split(":", 1), WORK][:2]
    kind, mode = (0 if each is None else arguments.whole(each) for each in given[1:3])
    wrong = _wrong(parts, system, kind, mode)
    if wrong:
        return wrong
    asked = asked_of(channel, given[4:])
    if isinstance(asked, int):
        return asked
    axis = _axis_of(channel, given[3])
    if kind == ALONG_AXIS and axis is None:
        return NO_AXIS
    if asked.edge is None:
        return DONE
    places = [_Place(asked.edge, part, asked.additive) for part in parts]
    if asked.additive == 0 and not _ADDITIVE.keys().isdisjoint(parts):
        return NO_SETUP if SETUP in parts else NO_ADDITIVE
    _refuse_fine(channel, asked, parts)
    values = [float(value) for value in args[0].items[:3]]
    unit = data_factor(channel.mode)
    if kind >= ALL_LENGTHS:
        is_length = kind == ALL_LENGTHS or kind in LENGTH_PARAMETERS
        wanted = [value * unit for value in values] if is_length else values
        numbers = range(DP_LENGTH, DP_RADIUS) if kind == ALL_LENGTHS else (kind,)
        for number, value in zip(numbers, wanted, strict=False):
            old = [place.read(number) for place in places]
            for place, new in zip(places, _operated(old, value, mode), strict=True):
                place.write(number, new)
        return DONE
    axes = ORDER[channel.mode["plane"]] if kind != ALONG_AXIS else (axis,)
    wanted_along = {k: value * unit for k, value in zip(axes, values, strict=False) if k is not None}
    _along_axes(channel, asked, places, system, wanted_along, mode)
    return DONE


def _wrong(parts: str, system: str, kind: int, mode: int) -> int:
    """The result for words that are none, or do not go together; 0 else."""
    if not 1 <= len(parts) <= 2 or set(parts) - PARTS or len(set(parts)) < len(parts):
        return WRONG_COMPONENTS
    if system not in (WORK, TOOL):
        return WRONG_SYSTEM
    if not ALONG_AXIS <= kind <= DP_SIDE_ANGLE:
        return WRONG_KIND
    if not SET <= mode <= GATHER:
        return WRONG_MODE
    if (mode >= SET_ALONE and len(parts) < 2) or (kind >= DP_RADIUS and BASE in parts):
        return CONTRADICTION
    return DONE


def _axis_of(channel: SinumerikChannel, given: object) -> int | None:
    """The geometry axis (0 X, 1 Y, 2 Z) of a number from 1 on or an identifier; None for another one."""
    geometry = channel.coordinates.geometry
    if isinstance(given, Axis):
        column = channel.memory.column(given.name)
        return geometry.index(column) if column in geometry else None
    number = 0 if given is None else arguments.whole(given)
    return number - 1 if 1 <= number <= 3 and geometry[number - 1] >= 0 else None


def _refuse_fine(channel: SinumerikChannel, asked: Asked, parts: str) -> None:
    fine = channel.mode["fine_tool_offset"] == "FTOCON" and OF_WEAR in parts
    if fine and asked.edge is channel.memory.tools.edge:
        raise AlarmError("17210", text="SETTCOR")


def _operated(old: list[float], value: float, mode: int) -> list[float]:
    """What one or two parts of a length are behind an operation."""
    first, *second = old
    if mode == ADD:
        return [first + value, *second]
    if mode == GATHER:
        return [first + second[0] + value, 0.0]
    return [value, *([0.0] if mode == SET_ALONE else second)]


def _along_axes(
    channel: SinumerikChannel,
    asked: Asked,
    places: list[_Place],
    system: str,
    wanted: dict[int, float],
    mode: int,
) -> None:
    """Change what parts of the length come to along some axes; along the others they stay."""
    ways = [_ways(channel, asked, place.part, system) for place in places]
    lengths = [[place.read(DP_LENGTH + i) for i in range(3)] for place in places]
    along = [
        [sum(way[k] * length for way, length in zip(own, of, strict=True)) for k in range(3)]
        for own, of in zip(ways, lengths, strict=True)
    ]
    for k, value in wanted.items():
        for vector, new in zip(along, _operated([vector[k] for vector in along], value, mode), strict=True):
            vector[k] = new
    for place, own, vector in zip(places, ways, along, strict=True):
        for i, way in enumerate(own):  # the ways are square to each other, and of length 1
            place.write(DP_LENGTH + i, sum(a * b for a, b in zip(way, vector, strict=True)))


def _ways(
    channel: SinumerikChannel, asked: Asked, part: str, system: str
) -> list[tuple[float, float, float]]:
    """Along which way lengths 1 to 3 of a part act: its sign, its system, the toolholder and the frame are in it."""
    assert asked.edge is not None
    ways = []
    for i in range(3):
        edge = Edge()
        for number in (DP_TYPE, DP_TIP):
            edge.values[number] = asked.edge.values[number]
        _Place(edge, part, asked.additive).write(DP_LENGTH + i, 1.0)
        ways.append(length_along(channel, edge, asked, frozenset(part), system))
    return ways


FUNCTIONS: dict[str, Callable[[SinumerikChannel, Arguments], int]] = {"SETTCOR": correct}
