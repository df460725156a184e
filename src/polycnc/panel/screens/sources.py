"""Where the fields of a table come from: variables of the control, or the lists of the lathe's offset screens.

A column names its source. What a source cannot do it refuses.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from polycnc.control.fanuc.lathe.tools import screens as lathe
from polycnc.control.fanuc.lathe.tools.screens import RADIUS, TIP, Page
from polycnc.mainrun import CommandRefused

if TYPE_CHECKING:
    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.pages import Column


class Source:
    """What a table shows and changes."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """A field; None where it is vacant or not there."""
        raise NotImplementedError

    def write(self, control: VirtualControl, column: Column, row: int, value: float | str) -> None:
        """INPUT: a field has another value."""
        raise CommandRefused("screen.no-field")

    def measure(self, control: VirtualControl, column: Column, row: int, measured: float) -> None:
        """MEASURE: the offset that makes the axis read what was measured."""
        raise CommandRefused("screen.no-field")

    def here(self, control: VirtualControl, column: Column, row: int) -> None:
        """SET: the present position."""
        raise CommandRefused("screen.no-field")


class Variables(Source):
    """Fields are variables of the control, by their names in programs."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The value of the variable."""
        try:
            return control.read_variable(column.name(row))
        except (KeyError, ValueError):
            return None

    def write(self, control: VirtualControl, column: Column, row: int, value: float | str) -> None:
        """The variable has another value."""
        control.write_variable(column.name(row), value)

    def measure(self, control: VirtualControl, column: Column, row: int, measured: float) -> None:
        """The field changes by what the axis reads too much."""
        reads, now = control.positions.work[column.axis], self.read(control, column, row)
        before = float(now) if isinstance(now, int | float) else 0.0
        control.write_variable(column.name(row), before + reads - measured)


class LatheOffsets(Source):
    """A list of the lathe's offsets (III.2.1); the column's variable is an axis, `R` or `T`."""

    def __init__(self, page: Page) -> None:
        self._page = page

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """A value of the list."""
        if column.variable not in (*control.channel.axes, RADIUS, TIP):
            return None
        return lathe.offset(control.channel, self._page, row, column.variable)

    def write(self, control: VirtualControl, column: Column, row: int, value: float | str) -> None:
        """A value of the list."""
        control.change(
            partial(lathe.set_offset, page=self._page, number=row, field=column.variable, value=float(value))
        )

    def measure(self, control: VirtualControl, column: Column, row: int, measured: float) -> None:
        """Geometry: wear becomes 0."""
        control.change(
            partial(lathe.measure, page=self._page, number=row, axis=column.variable, measured=measured)
        )


class WorkShift(Source):
    """The work shift (III.2.1.5): row 1 is the shift, row 2 takes a measured value."""

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The shift; a measured value is typed alone."""
        if column.variable not in control.channel.axes:
            return None
        return lathe.work_shift(control.channel, column.variable) if row == 1 else 0.0

    def write(self, control: VirtualControl, column: Column, row: int, value: float | str) -> None:
        """The shift, or what the axis is to read."""
        if row == 1:
            control.change(partial(lathe.set_work_shift, axis=column.variable, value=float(value)))
        else:
            control.change(partial(lathe.measure_work_shift, axis=column.variable, programmed=float(value)))


class Barrier(Source):
    """A page of the chuck and tailstock barrier (III.2.2): a row for each symbol."""

    def __init__(self, page: str) -> None:
        self._page = page
        self._symbols = tuple(lathe.BARRIER[page])

    def read(self, control: VirtualControl, column: Column, row: int) -> object:
        """The value of a symbol."""
        return lathe.barrier_value(control.channel, self._page, self._symbols[row - 1])

    def write(self, control: VirtualControl, column: Column, row: int, value: float | str) -> None:
        """The value of a symbol, in state G23."""
        symbol = self._symbols[row - 1]
        control.change(partial(lathe.set_barrier, page=self._page, symbol=symbol, value=float(value)))

    def here(self, control: VirtualControl, column: Column, row: int) -> None:
        """CX, CZ, TZ are where the axis stands."""
        control.change(partial(lathe.set_barrier_here, page=self._page, symbol=self._symbols[row - 1]))


SOURCES: dict[str, Source] = {
    "": Variables(),
    "geometry": LatheOffsets(Page.GEOMETRY),
    "wear": LatheOffsets(Page.WEAR),
    "second": LatheOffsets(Page.SECOND),
    "work-shift": WorkShift(),
    "chuck": Barrier("chuck"),
    "tailstock": Barrier("tailstock"),
}
