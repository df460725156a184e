"""What the offset screens of the lathe do with the control's memory (0i-TF Plus III.2.1).

A panel shows these values and calls these functions; here is no drawing. A `Page` is one list of offsets: geometry,
wear, both in one (8136#6), or second geometry. A field is an axis by its name, `R` the nose radius, `T` the tip.
"""

from __future__ import annotations

from enum import Enum

from polycnc.control.fanuc.lathe.coordinates.limits import renew_zones
from polycnc.control.fanuc.lathe.parameters import LatheParameters
from polycnc.control.fanuc.lathe.tools.data_input import MAX_OFFSET_MM
from polycnc.control.fanuc.lathe.tools.files import MAX_TIP, shown, taken
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.offsets import MAX_OFFSETS, offset_changed, refresh
from polycnc.control.word_address.macro_b.parameter_input import set_parameter
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import UserError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.fanuc.lathe.tools.offset_memory import TurningOffset
    from polycnc.control.parameters import Parameter

RADIUS, TIP = "R", "T"
#: The two pages of the barrier: symbols and their parameters (III.2.1.9).
BARRIER: Mapping[str, Mapping[str, Parameter[float]]] = {
    "chuck": {
        "TY": LatheParameters.jaw_kind,
        "CX": LatheParameters.chuck_x,
        "CZ": LatheParameters.chuck_z,
        "L": LatheParameters.jaw_length,
        "W": LatheParameters.jaw_size,
        "L1": LatheParameters.grip_length,
        "W1": LatheParameters.grip_step,
    },
    "tailstock": {
        "TZ": LatheParameters.tailstock_z,
        "L": LatheParameters.tailstock_length,
        "D": LatheParameters.tailstock_diameter,
        "L1": LatheParameters.tailstock_length_1,
        "D1": LatheParameters.tailstock_diameter_1,
        "L2": LatheParameters.tailstock_length_2,
        "D2": LatheParameters.tailstock_diameter_2,
        "D3": LatheParameters.tailstock_hole,
    },
}
#: Symbols that take the present position by [SET], with their axis.
BARRIER_POSITIONS = {"CX": "X", "CZ": "Z", "TZ": "Z"}
#: Modal groups of the display, column by column (III.2.1.6); a code stands for a group that polycnc does not have.
MODAL_COLUMNS: tuple[tuple[str, ...], ...] = (
    ("motion", "surface_speed", "turret_mirror", "feed", "unit", "compensation", "fluctuation", "stroke"),
    ("cycle", "macro", "wcs", "path", "plane", "rotation", "normal_line", "polygon"),
    ("polar_interpolation", "mirror", "atc_offset", "G15", "G5.5", "", "G80.5", "G80.4"),
)


class Page(Enum):
    """One list of offsets."""

    GEOMETRY = "geometry"
    WEAR = "wear"
    SECOND = "second"


class ScreenRefusal(UserError):  # noqa: N818 - the screen shows a warning, nothing is wrong
    """The screen does not take an input: why (a text of the table `screen`), and how many values it has set."""

    def __init__(self, reason: str, done: int = 0) -> None:
        super().__init__(f"screen.{reason}")
        self.reason, self.done = reason, done


# ---- offsets ----------------------------------------------------------------------------------------------------


def pages(channel: LatheChannel) -> tuple[Page, ...]:
    """The lists that the control has; where geometry and wear are one, that one is `WEAR`."""
    separate = not channel.memory.parameters.NGW
    return (Page.GEOMETRY, Page.WEAR, Page.SECOND) if separate else (Page.WEAR, Page.SECOND)


def offset(channel: LatheChannel, page: Page, number: int, field: str) -> float:
    """A value of a list, as it is shown."""
    entry: TurningOffset = OffsetMemory.of(channel).at(_checked(number))
    if field == TIP:
        return entry.tip
    if field == RADIUS:
        radius = entry.radius if page is Page.GEOMETRY else entry.radius_wear
        return channel.memory.to_program_unit(radius)
    return shown(channel, field, _values(entry, page).get(field, 0.0))


def set_offset(channel: LatheChannel, page: Page, number: int, field: str, value: float) -> None:
    """[INPUT]: a value of a list; it acts as 5002#4 and #6 say.

    Raises:
        ScreenRefusal: The list or the number is protected, or the value is too large.
    """
    _refuse_protected(channel, page, number)
    _write(channel, page, number, field, value)


def add_offset(channel: LatheChannel, page: Page, number: int, field: str, value: float) -> None:
    """[+INPUT]: change a value by an amount; raises `ScreenRefusal` as `set_offset` does."""
    set_offset(channel, page, number, field, offset(channel, page, number, field) + value)


def set_offsets(channel: LatheChannel, page: Page, first: int, field: str, values: Sequence[float]) -> None:
    """[INPUT] of consecutive numbers: those in front of a protected range are set, then comes the warning (3294, 3295).

    Raises:
        ScreenRefusal: A number is protected; `done` says how many have been set.
    """
    for done, value in enumerate(values):
        try:
            set_offset(channel, page, first + done, field, value)
        except ScreenRefusal as refusal:
            raise ScreenRefusal(refusal.reason, done) from None


def clear_offsets(channel: LatheChannel, chosen: Sequence[Page], fields: Sequence[str]) -> None:
    """[CLEAR] with [ALL], [WEAR] or [GEOM]: zero in all numbers (4th and 5th axis offsets, III.2.1.8).

    Raises:
        ScreenRefusal: Some are protected, as against input: they have kept their values.
    """
    protected = False
    for number, entry in OffsetMemory.of(channel).numbers.items():
        for page in chosen:
            if is_protected(channel, page, number):
                protected = protected or any(_values(entry, page).get(field) for field in fields)
            else:
                for field in fields:
                    _values(entry, page).pop(field, None)
    offset_changed(channel)
    if protected:
        raise ScreenRefusal("protected")


def further_fields(channel: LatheChannel) -> tuple[str, ...]:
    """Columns of the screen of 4th and 5th axis offsets: names of axes (5044, 5045)."""
    from polycnc.control.fanuc.lathe.tools.data_input import further_words

    return tuple(further_words(channel).values())


def is_protected(channel: LatheChannel, page: Page, number: int) -> bool:
    """Whether values of a number cannot be typed in (3290#0 WOF, #1 GOF, #5 GO2; 3294, 3295)."""
    parameters = channel.memory.parameters
    if page is Page.SECOND:
        return not parameters.GO2
    first, count = parameters.locked_offset, parameters.locked_offsets
    in_range = first <= number < first + count if first > 0 else False
    return in_range or (parameters.GOF if page is Page.GEOMETRY else parameters.WOF)


def _refuse_protected(channel: LatheChannel, page: Page, number: int) -> None:
    if is_protected(channel, page, _checked(number)):
        raise ScreenRefusal("protected")


def _checked(number: int) -> int:
    if not 1 <= number <= MAX_OFFSETS:
        raise ScreenRefusal("number")
    return number


def _values(entry: TurningOffset, page: Page) -> dict[str, float]:
    values: dict[str, float] = getattr(entry, page.value)
    return values


def _write(channel: LatheChannel, page: Page, number: int, field: str, value: float) -> None:
    entry: TurningOffset = OffsetMemory.of(channel).at(number)
    if field == TIP:
        if value not in range(MAX_TIP + 1):
            raise ScreenRefusal("value")
        entry.tip = int(value)
    elif not abs(value) <= MAX_OFFSET_MM:
        raise ScreenRefusal("value")
    elif field == RADIUS:
        radius = float(channel.memory.from_program_unit(value))
        if page is Page.GEOMETRY:
            entry.radius = radius
        else:
            entry.radius_wear = radius
    else:
        _values(entry, page)[field] = taken(channel, field, value)
    offset_changed(channel)


# ---- measured values --------------------------------------------------------------------------------------------


def measure(
    channel: LatheChannel, page: Page, number: int, axis: str, measured: float, latched: float | None = None
) -> None:
    """[MEASURE]: the offset is the coordinate of the axis less the measured value (III.2.1.2).

    On the geometry list all of it becomes geometry and wear becomes 0; on the wear list it is taken less the wear
    that there is. `latched` is the coordinate that the signal PRC has kept (5005#2).
    """
    _refuse_protected(channel, page, number)
    amount = _coordinate(channel, axis, latched) - measured
    if channel.memory.parameters.ORC and channel.control.is_diameter(channel, channel.axis_index[axis]):
        amount /= 2.0
    if page is Page.GEOMETRY:
        _write(channel, page, number, axis, amount)
        _write(channel, Page.WEAR, number, axis, 0.0)
    elif channel.memory.parameters.NGW:
        _write(channel, page, number, axis, amount)
    else:
        _write(channel, page, number, axis, amount - offset(channel, page, number, axis))


def counter_input(channel: LatheChannel, page: Page, number: int, axis: str, relative: float) -> None:
    """[INP.C.]: the offset of the shown list is the relative coordinate; the other list stays (III.2.1.4)."""
    set_offset(channel, page, number, axis, relative)


def _coordinate(channel: LatheChannel, axis: str, latched: float | None) -> float:
    """The coordinate that counts for a measured value, as the absolute display shows it."""
    if latched is not None:
        return latched
    return shown(channel, axis, channel.coordinates.position[channel.axis_index[axis]], work=True)


# ---- work shift -------------------------------------------------------------------------------------------------


def work_shift(channel: LatheChannel, axis: str) -> float:
    """The shift of all work coordinate systems along an axis, as it is shown."""
    return shown(channel, axis, OffsetMemory.of(channel).work_shift[channel.axis_index[axis]], work=True)


def set_work_shift(channel: LatheChannel, axis: str, value: float) -> None:
    """[INPUT] on the screen of the work shift: the display is the old one less the shift, at once (III.2.1.5)."""
    if not abs(value) <= MAX_OFFSET_MM:
        raise ScreenRefusal("value")
    OffsetMemory.of(channel).work_shift[channel.axis_index[axis]] = taken(channel, axis, value, work=True)
    refresh(channel)


def add_work_shift(channel: LatheChannel, axis: str, value: float) -> None:
    """[+INPUT] on the screen of the work shift."""
    set_work_shift(channel, axis, work_shift(channel, axis) + value)


def measure_work_shift(
    channel: LatheChannel, axis: str, programmed: float, latched: float | None = None
) -> None:
    """A measured value: the place where the tool stands (or stood when PRC came) reads `programmed` from now on."""
    add_work_shift(channel, axis, _coordinate(channel, axis, latched) - programmed)


# ---- barrier ----------------------------------------------------------------------------------------------------


def barrier_value(channel: LatheChannel, page: str, symbol: str) -> float:
    """A value of the barrier's pages."""
    return channel.memory.parameters.value(BARRIER[page][symbol])


def set_barrier(channel: LatheChannel, page: str, symbol: str, value: float) -> None:
    """[INPUT] on a page of the barrier, in the state G23; the area is new with the next G22.

    Raises:
        ScreenRefusal: G22 is active, or the value makes no sense.
    """
    if channel.mode["stroke"] != "G23":
        raise ScreenRefusal("g23")
    if not abs(value) <= MAX_OFFSET_MM or (symbol == "TY" and value not in (0, 1)):
        raise ScreenRefusal("value")
    set_parameter(channel, BARRIER[page][symbol].key, value)
    renew_zones(channel)


def add_barrier(channel: LatheChannel, page: str, symbol: str, value: float) -> None:
    """[+INPUT] on a page of the barrier."""
    set_barrier(channel, page, symbol, barrier_value(channel, page, symbol) + value)


def set_barrier_here(channel: LatheChannel, page: str, symbol: str) -> None:
    """[SET]: CX, CZ or TZ becomes the present work coordinate; an active tool offset is in it."""
    axis = BARRIER_POSITIONS.get(symbol)
    if axis is None:
        raise ScreenRefusal("no-set")
    set_barrier(channel, page, symbol, _coordinate(channel, axis, None))


# ---- modal codes ------------------------------------------------------------------------------------------------


def modal_codes(channel: LatheChannel) -> list[list[str]]:
    """The modal codes as the screen shows them, column by column; an empty text where a place is free."""
    return [[_modal_code(channel, group) for group in column] for column in MODAL_COLUMNS]


def _modal_code(channel: LatheChannel, group: str) -> str:
    code = channel.control.written_code(channel, group) if group in channel.mode.codes else group
    number, point, fraction = code.partition(" ")[0].removeprefix("G").partition(".")
    return f"G{number.zfill(2)}{point}{fraction}" if code else ""
