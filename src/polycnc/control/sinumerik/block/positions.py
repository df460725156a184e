"""From the axis words of a block to its target: dimensions, units, diameters, and the ways of rotary axes.

Source: Fundamentals (G90/G91, AC, IC, DC, ACP, ACN, G70/G71, G700/G710, DIAMON, DIAM90, DAC, DIC, RAC, RIC).
"""

from __future__ import annotations

from enum import Enum
from math import floor

from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.motion import indexing
from polycnc.control.sinumerik.tables import length_factor
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.geometry.units import INCH_MM
from polycnc.language.sinumerik.names.values import Axis
from polycnc.language.sinumerik.words import WordAlarm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.channel.mode import Mode
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.machine.model import Axis as MachineAxis

TURN = 360.0
#: A position this little below a range lies in it: what calculations leave of 0.
_ROUNDING = 1e-9
#: MD30455 bit 2: G90 means the shortest way on a modulo axis.
_SHORTEST_BY_DEFAULT = 4


class Dimension(Enum):
    """How the value of an axis word leads to a target."""

    ABSOLUTE = "AC"
    INCREMENTAL = "IC"
    SHORTEST = "DC"
    POSITIVE = "ACP"
    NEGATIVE = "ACN"
    MODULO = "modulo"


class ModuloRange(NamedTuple):
    """Where positions of a modulo axis lie (MD30330, MD30340), and what becomes of others (MD30455 bit 0).

    Attributes:
        start: Its lower end, degrees; that itself lies within.
        length: To its upper end, which lies outside.
        wraps: A position outside means the one within that is whole ranges away; else it is alarm 16830.
    """

    start: float = 0.0
    length: float = TURN
    wraps: bool = False

    @classmethod
    def of(cls, data: MachineData, axis: str) -> ModuloRange:
        """The range of an axis or spindle."""
        return cls(
            data.number("$MA_MODULO_RANGE_START", axis),
            data.number("$MA_MODULO_RANGE", axis),
            bool(data.integer("$MA_MISC_FUNCTION_MASK", axis) & 1),
        )

    def within(self, value: float, position: int) -> float:
        """The value of a word as one within the range; alarm 16830 for one outside where that is not converted."""
        if self.start <= value < self.start + self.length:
            return value
        if not self.wraps:
            raise WordAlarm("16830", position)
        return self.shown(value)

    def shown(self, value: float) -> float:
        """Any position as one within the range."""
        return self.start + (value - self.start) % self.length

    def below(self, value: float) -> float:
        """How far the range in which a position lies is from the first one."""
        return self.length * floor((value - self.start + _ROUNDING) / self.length)


#: Of a rotary axis that is none of modulo positions, for DC, ACP and ACN.
FULL_TURN = ModuloRange()


#: Machine positions of the reference points, MD34100.
_REFERENCES = "$MA_REFP_SET_POS"


def configured_axes(channel: SinumerikChannel) -> tuple[MachineAxis, ...]:
    """The channel's axes as the machine file tells them; MD30310 makes rotary ones modulo axes or not.

    MD34100 tells the first to fourth reference point.
    """
    data = MachineData.of(channel)
    return tuple(_configured(axis, data) for axis in channel.axis_data)


def _configured(axis: MachineAxis, data: MachineData) -> MachineAxis:
    if axis.rotary and data.is_set("$MA_ROT_IS_MODULO", axis.name):
        axis = replace(axis, modulo=bool(data.integer("$MA_ROT_IS_MODULO", axis.name)))
    points = [
        data.number(_REFERENCES, i, axis.name) if data.is_set(_REFERENCES, i, axis.name) else point
        for i, point in enumerate(axis.reference_points)
    ]
    first, second, third, fourth = points
    return replace(axis, reference_points=(first, second, third, fourth))


class AxisTerm(NamedTuple):
    """An axis word of a block, worked out for a modal state.

    Attributes:
        position: Which word of the block.
        column: Which axis of the channel.
        way: How the value is meant.
        factor: From the programmed value to mm (radius) or degrees.
        coded: CAC, CIC … for a coded position, else empty.
        modulo: The range of positions of a rotary axis.
    """

    position: int
    column: int
    way: Dimension
    factor: float
    coded: str = ""
    modulo: ModuloRange = FULL_TURN


#: For each modifier: the way it asks for, and whether the value is a diameter (None: as the modal state
#: says).
_MODIFIERS: dict[str, tuple[Dimension, bool | None]] = {
    "AC": (Dimension.ABSOLUTE, None),
    "IC": (Dimension.INCREMENTAL, None),
    "DC": (Dimension.SHORTEST, None),
    "ACP": (Dimension.POSITIVE, None),
    "ACN": (Dimension.NEGATIVE, None),
    "DAC": (Dimension.ABSOLUTE, True),
    "DIC": (Dimension.INCREMENTAL, True),
    "RAC": (Dimension.ABSOLUTE, False),
    "RIC": (Dimension.INCREMENTAL, False),
}
#: Alarm for a modifier of rotary axes on an axis that has none of their ways.
_ROTARY_ONLY = {"DC": "16800", "ACP": "16810", "ACN": "16820"}


SHOWS_DIAMETERS = ("DIAMON", "DIAM90")


class _GroupOfAxis(dict[int, str]):
    """Name of the modal group of each axis that holds its own diameter function."""

    def __missing__(self, column: int) -> str:
        name = self[column] = f"diameter of axis {column}"
        return name


DIAMETER_OF_AXIS = _GroupOfAxis()


def own_diameter(mode: Mode, column: int) -> str:
    """The diameter function that a single axis was given (DIAMONA …); empty for none."""
    return mode.codes.get(DIAMETER_OF_AXIS[column], "")


def diameter_function(mode: Mode, column: int, transverse: int) -> str:
    """DIAMON, DIAM90 or DIAMOF as it holds for an axis: its own, or that of the channel on the transverse axis."""
    return own_diameter(mode, column) or (mode["diameter"] if column == transverse else "DIAMOF")


def diameter_of_channel(mode: Mode, column: int, transverse: int) -> str:
    """What DIAMCHANA gives an axis: the channel's function as it is now, on the transverse axis whatever it will be."""
    return "" if column == transverse else mode["diameter"]


def is_diameter(mode: Mode, way: Dimension, column: int, transverse: int) -> bool:
    """Whether a value of an axis is a diameter."""
    function = diameter_function(mode, column, transverse)
    return function == "DIAMON" or (function == "DIAM90" and way is not Dimension.INCREMENTAL)


def axis_term(
    channel: SinumerikChannel, mode: Mode, position: int, column: int, modifier: str, *, path: bool = True
) -> AxisTerm:
    """Work out an axis word. `path` is false for words that are no positions (offsets): always radius.

    Raises:
        WordAlarm: 12020 for a modifier that axis words do not have, 16800 to 16820 for the way of a rotary
            axis on a linear one.
    """
    memory = channel.memory
    axis = channel.memory.axes[column]
    diameter: bool | None = None
    if not modifier:
        way = Dimension.INCREMENTAL if mode["distance"] == "G91" else Dimension.ABSOLUTE
    elif modifier in _MODIFIERS:
        way, diameter = _MODIFIERS[modifier]
    elif modifier in indexing.WAYS:
        return axis_term(channel, mode, position, column, indexing.WAYS[modifier])._replace(coded=modifier)
    else:
        raise WordAlarm("12020", position, text=modifier)
    if modifier in _ROTARY_ONLY and not axis.rotary:
        raise WordAlarm(_ROTARY_ONLY[modifier], position, axis=channel.axes[column])
    if axis.rotary:
        if not axis.modulo:
            return AxisTerm(position, column, way, 1.0)
        name = channel.axes[column]
        if way is Dimension.ABSOLUTE:
            mask = memory.data.integer("$MA_MISC_FUNCTION_MASK", name)
            is_shortest = not modifier and mask & _SHORTEST_BY_DEFAULT
            way = Dimension.SHORTEST if is_shortest else Dimension.MODULO
        return AxisTerm(position, column, way, 1.0, modulo=ModuloRange.of(memory.data, name))
    factor = length_factor(mode)
    if diameter is None:
        diameter = is_diameter(mode, way, column, memory.transverse)
    if path and diameter:
        factor *= 0.5
    return AxisTerm(position, column, way, factor)


def number(values: tuple[Any, ...], position: int) -> float:
    """The value of a word as a number; alarm 12150 for a text, an axis or a frame."""
    value = values[position]
    if value.__class__ is float:
        return value
    if isinstance(value, (int, float)):
        return float(value)
    raise WordAlarm("12150", position, text=str(value.name if isinstance(value, Axis) else value))


def whole(values: tuple[Any, ...], position: int) -> int:
    """The value of a word as a whole number; alarm 12150 for a fraction."""
    value = number(values, position)
    if value != int(value):
        raise WordAlarm("12150", position, text=f"{value:g}")
    return int(value)


def target(channel: SinumerikChannel, terms: Sequence[AxisTerm], values: tuple[Any, ...]) -> list[float]:
    """The target of a block in work coordinates of all axes; axes without a word stay where they are."""
    coordinates = channel.coordinates
    end = coordinates.position.copy()
    owed = coordinates.pending
    for term in terms:
        value = number(values, term.position) * term.factor
        column = term.column
        if term.coded:
            value = indexing.position(channel, column, term.coded, number(values, term.position))
        if term.way is Dimension.ABSOLUTE:
            end[column] = value
        elif term.way is Dimension.INCREMENTAL:
            end[column] += owed[column] + value
        else:
            end[column] = _rotary_target(end[column], value, term)
        owed[column] = 0.0
    return end


def _rotary_target(now: float, value: float, term: AxisTerm) -> float:
    """Target of a modulo rotary axis; without DC, ACP or ACN it stays within the turn in which it stands.

    So it turns in positive direction to a larger angle and in negative direction to a smaller one.

    Raises:
        WordAlarm: 16830 for an angle outside the modulo range.
    """
    modulo = term.modulo
    value = modulo.within(value, term.position)
    if term.way is Dimension.MODULO:
        return modulo.below(now) + value
    turn = modulo.length
    way = (value - now) % turn
    if (term.way is Dimension.SHORTEST and way > turn / 2) or (term.way is Dimension.NEGATIVE and way > 0.0):
        way -= turn
    return now + way


def of_display(channel: SinumerikChannel, column: int, value: float) -> float:
    """A position of the work as displays show it (setups tell inputs so), as a radius."""
    is_shown = is_diameter(channel.mode, Dimension.ABSOLUTE, column, channel.memory.transverse)
    return 0.5 * value if is_shown else value


def shown(channel: SinumerikChannel, column: int, value: float, *, work: bool = True) -> float:
    """A position as a program reads it: in diameter, inches under G700, modulo axes within a turn."""
    axis = channel.memory.axes[column]
    if axis.rotary:
        return ModuloRange.of(channel.memory.data, axis.name).shown(value) if axis.modulo else value
    if work and is_diameter(channel.mode, Dimension.ABSOLUTE, column, channel.memory.transverse):
        value *= 2.0
    return value / INCH_MM if channel.mode["unit"] == "G700" else value
