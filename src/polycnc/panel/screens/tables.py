"""Tables of fields that can be written: offsets, tools, variables."""

from __future__ import annotations

from types import MappingProxyType

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused
from polycnc.panel.screens.pages import DIGITS, in_language
from polycnc.panel.screens.sources import SOURCES
from polycnc.panel.screens.view import Cell

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.pages import Column, WindowSpec
    from polycnc.panel.screens.state import ScreenState

Rows = tuple[tuple[Cell, ...], ...]


class Table:
    """A table on a screen.

    Args:
        control: The control whose variables it shows.
        spec: What its page says of it.
        latched: Work coordinates that the signal PRC has kept, by axis.
    """

    def __init__(
        self, control: VirtualControl, spec: WindowSpec, latched: Mapping[str, float] = MappingProxyType({})
    ) -> None:
        self._control = control
        self._latched = latched
        self.spec = spec

    @property
    def numbers(self) -> range:
        """The numbers of its rows."""
        return range(self.spec.first, self.spec.first + self.spec.count)

    def exists(self, number: int) -> bool:
        """Whether a row is there: tools and edges need not be."""
        if not self.spec.exists:
            return True
        try:
            return self._control.read_variable(self.spec.exists.format(n=number)) is not None
        except (KeyError, ValueError):
            return False

    def value(self, column: Column, row: int) -> object:
        """A field; None where it is vacant or not there."""
        return SOURCES[column.source].read(self._control, column, row)

    def number(self, column: Column, row: int) -> float:
        """The value of a field that is a number; 0 where it is vacant."""
        value = self.value(column, row)
        return float(value) if isinstance(value, int | float) else 0.0

    def write(self, column: Column, row: int, value: float | str) -> None:
        """Write a field.

        Raises:
            CommandRefused: It is not there or cannot be written.
        """
        if not self.exists(row) or row not in self.numbers:
            raise CommandRefused("screen.no-field")
        SOURCES[column.source].write(self._control, column, row, value, self._latched)

    def text(self, column: Column, row: int, digits: int) -> str:
        """A field as it is shown; vacant ones are blank."""
        value = self.value(column, row)
        if value is None:
            return ""
        if isinstance(value, float):
            return f"{value:.{column.digits if column.digits != DIGITS else digits}f}"
        return str(value)


def rows_of(screen: ScreenState, spec: WindowSpec, lang: str) -> Rows:
    """The rows of a table: its heads, and the page of it on which the cursor stands."""
    table = Table(screen.control, spec)
    row, at = screen.cursor
    present = [n for n in table.numbers if table.exists(n)]
    if not present:
        return ()
    if row not in present:
        row = screen.place(present[0], at)
    first = present.index(row) // spec.shown * spec.shown
    heads = (
        Cell(in_language(spec.head, lang), "label"),
        *(Cell(in_language(column.head, lang), "label") for column in spec.columns),
    )
    rows = [heads]
    for place, number in enumerate(present[first : first + spec.shown], first):
        own = spec.labels[place] if place < len(spec.labels) else spec.label.format(n=number)
        name = in_language(own, lang)
        fields = (
            Cell(table.text(column, number, screen.digits), "value", cursor=(number, i) == (row, at))
            for i, column in enumerate(spec.columns)
        )
        rows.append((Cell(name, "label"), *fields))
    return tuple(rows)
