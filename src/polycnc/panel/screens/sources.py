"""Where the fields of a table come from: variables of the control, or the lists of the lathe's offset screens.

A column names its source. What a source cannot do it refuses.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.fanuc.lathe.tools import screens as lathe
from polycnc.control.fanuc.lathe.tools.screens import RADIUS, TIP, Page
from polycnc.control.syntec.coordinates import turns
from polycnc.control.syntec.coordinates.length import set_tool_datum, tool_datum
from polycnc.control.syntec.coordinates.systems import WORK_SYSTEMS
from polycnc.control.syntec.motion import conditions
from polycnc.control.word_address.tools.data_input import LARGEST_OFFSET
from polycnc.deferred.typing import TYPE_CHECKING, TypeAlias
from polycnc.mainrun import CommandRefused

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.pages import Column


#: Work coordinates that the signal PRC has kept, by axis.
Latched: TypeAlias = "Mapping[str, float]"
#: Rows of work offsets.
_SYSTEMS = ("EXT", "G54", "G55", "G56", "G57", "G58", "G59")
#: Measured values are taken from where the signal PRC came (0i-TF Plus III.2.1.2).
_LATCHES = "5005#2"


def _kept(control: VirtualControl, axis: str, latched: Latched) -> float | None:
    """The coordinate of an axis that counts for a measured value; None for the present one.

    Raises:
        CommandRefused: The one that was kept is wanted, and there is none yet.
    """
    if not control.read_parameter(_LATCHES):
        return None
    if axis not in latched:
        raise CommandRefused("screen.no-latch")
    return latched[axis]


class Source:
    """What a table shows and changes."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """A field; None where it is vacant or not there."""
        raise NotImplementedError

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """INPUT: a field has another value."""
        raise CommandRefused("screen.no-field")

    def measure(
        self, control: VirtualControl, column: Column, row: int, measured: float, latched: Latched
    ) -> None:
        """MEASURE: the offset that makes the axis read what was measured."""
        raise CommandRefused("screen.no-field")

    def here(self, control: VirtualControl, column: Column, row: int) -> None:
        """SET: the present position."""
        raise CommandRefused("screen.no-field")

    def restore(self, control: VirtualControl, column: Column, row: int) -> None:
        """The delivered value comes back."""
        raise CommandRefused("screen.no-field")


class Variables(Source):
    """Fields are variables of the control, by their names in programs."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The value of the variable."""
        try:
            return control.read_variable(column.name(row))
        except (KeyError, ValueError):
            return None

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """The variable has another value."""
        control.write_variable(column.name(row), value)

    def measure(
        self, control: VirtualControl, column: Column, row: int, measured: float, latched: Latched
    ) -> None:
        """The field changes by what the axis reads too much."""
        reads, now = control.positions.work[column.axis], self.read(control, column, row)
        before = float(now) if isinstance(now, int | float) else 0.0
        self.write(control, column, row, before + reads - measured, latched)


class ToolOffsets(Variables):
    """Offsets of the machining centres, whose values have an end (Hartford 3.3.2)."""

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """An offset has another value.

        Raises:
            CommandRefused: It is too large.
        """
        is_inch = "G20" in control.modal.values()
        if abs(float(value)) > LARGEST_OFFSET[is_inch]:
            raise CommandRefused("screen.value", value=f"{value:g}")
        super().write(control, column, row, value, latched)


class WorkOffsets(Variables):
    """Work offsets: rows are EXT, G54 to G59."""

    def measure(
        self, control: VirtualControl, column: Column, row: int, measured: float, latched: Latched
    ) -> None:
        """The axis would read the measured value where it stands, if the system of the row were chosen.

        Raises:
            CommandRefused: A system is chosen that is none of the rows.
        """
        active = control.modal.get("wcs", "")
        if active not in _SYSTEMS:
            raise CommandRefused("screen.other-system")
        now = self.read(control, column, _SYSTEMS.index(active) if row else row)
        before = float(now) if isinstance(now, int | float) else 0.0
        control.write_variable(column.name(row), before + control.positions.work[column.axis] - measured)


class SettableFrames(Variables):
    """Settable work offsets of SINUMERIK: rows are G54 to G57, then G505 on."""

    def measure(
        self, control: VirtualControl, column: Column, row: int, measured: float, latched: Latched
    ) -> None:
        """The axis would read the measured value where it stands, if the offset of the row were chosen."""
        code = control.modal.get("wcs", "G500")
        active = 0 if code == "G500" else int(code[1:]) - (500 if len(code) == len("G505") else 53)
        now = self.read(control, column, active)
        before = float(now) if isinstance(now, int | float) else 0.0
        control.write_variable(column.name(row), before + control.positions.work[column.axis] - measured)


class LatheOffsets(Source):
    """A list of the lathe's offsets (III.2.1); the column's variable is an axis, `R` or `T`."""

    def __init__(self, page: Page) -> None:
        self._page = page

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """A value of the list."""
        if column.variable not in (*control.channel.axes, RADIUS, TIP):
            return None
        return lathe.offset(control.channel, self._page, row, column.variable)

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """A value of the list."""
        control.change(
            partial(lathe.set_offset, page=self._page, number=row, field=column.variable, value=float(value))
        )

    def measure(
        self, control: VirtualControl, column: Column, row: int, measured: float, latched: Latched
    ) -> None:
        """Geometry: wear becomes 0."""
        kept = _kept(control, column.variable, latched)
        control.change(
            partial(
                lathe.measure,
                page=self._page,
                number=row,
                axis=column.variable,
                measured=measured,
                latched=kept,
            )
        )


class WorkShift(Source):
    """The work shift (III.2.1.5): row 1 is the shift, row 2 takes a measured value."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The shift; a measured value is typed alone."""
        if column.variable not in control.channel.axes:
            return None
        return lathe.work_shift(control.channel, column.variable) if row == 1 else 0.0

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """The shift, or what the axis is to read."""
        if row == 1:
            control.change(partial(lathe.set_work_shift, axis=column.variable, value=float(value)))
        else:
            kept = _kept(control, column.variable, latched)
            control.change(
                partial(lathe.measure_work_shift, axis=column.variable, programmed=float(value), latched=kept)
            )


class Barrier(Source):
    """A page of the chuck and tailstock barrier (III.2.2): a row for each symbol."""

    def __init__(self, page: str) -> None:
        self._page = page
        self._symbols = tuple(lathe.BARRIER[page])

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The value of a symbol."""
        return lathe.barrier_value(control.channel, self._page, self._symbols[row - 1])

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """The value of a symbol, in state G23."""
        symbol = self._symbols[row - 1]
        control.change(partial(lathe.set_barrier, page=self._page, symbol=symbol, value=float(value)))

    def here(self, control: VirtualControl, column: Column, row: int) -> None:
        """CX, CZ, TZ are where the axis stands."""
        control.change(partial(lathe.set_barrier_here, page=self._page, symbol=self._symbols[row - 1]))


class ToolData(Source):
    """Tools of SYNTEC: length and radius with their wear; programs write them by G10 L10 to L13 (2.14)."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """A field of a tool."""
        return tool_datum(control.channel, row, column.variable)

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """A field of a tool."""
        control.change(partial(set_tool_datum, number=row, field=column.variable, value=float(value)))


class WorkTurn(Source):
    """Coordinate rotation page of SYNTEC (2.39.2): rows are work systems, G54 P1 to P100; columns X, Y, Z."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """An angle, degrees."""
        return turns.angle(control.channel, WORK_SYSTEMS[row - 1], "XYZ".index(column.variable))

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """An angle; it acts when the rotation or the tool length is called next."""
        axis, system = "XYZ".index(column.variable), WORK_SYSTEMS[row - 1]
        control.change(partial(turns.set_angle, system=system, axis=axis, value=float(value)))


class ConditionSets(Source):
    """The nine sets of machining conditions of SYNTEC (2.67.1)."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """What a set has, or what it is delivered with."""
        delivered = column.variable == "delivered"
        return conditions.DELIVERED if delivered else conditions.speed(control.channel, row)

    def write(
        self, control: VirtualControl, column: Column, row: int, value: float | str, latched: Latched
    ) -> None:
        """Another value; none below 0."""
        if column.variable == "delivered":
            raise CommandRefused("screen.no-field")
        if float(value) < 0.0:
            raise CommandRefused("screen.value", value=f"{value:g}")
        control.change(partial(conditions.set_speed, number=row, value=float(value)))

    def restore(self, control: VirtualControl, column: Column, row: int) -> None:
        """The delivered value comes back."""
        control.change(partial(conditions.set_speed, number=row, value=conditions.DELIVERED))


SOURCES: dict[str, Source] = {
    "": Variables(),
    "tool": ToolOffsets(),
    "work": WorkOffsets(),
    "geometry": LatheOffsets(Page.GEOMETRY),
    "wear": LatheOffsets(Page.WEAR),
    "second": LatheOffsets(Page.SECOND),
    "work-shift": WorkShift(),
    "chuck": Barrier("chuck"),
    "tailstock": Barrier("tailstock"),
    "settable": SettableFrames(),
    "work-turn": WorkTurn(),
    "tool-data": ToolData(),
    "conditions": ConditionSets(),
}
