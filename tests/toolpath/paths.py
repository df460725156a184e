"""Small toolpaths for tests."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING

from polycnc.machine.layout import AxisLayout
from polycnc.toolpath import Context, Event, Kind, Toolpath
from polycnc.toolpath.trace import Display

if TYPE_CHECKING:
    from polycnc.toolpath.table import Row

MILL = AxisLayout(geometry=(0, 1, 2))
Z_UP = (0.0, 0.0, 1.0)


class Draft:
    """A toolpath under construction: `line` counts up with every row."""

    def __init__(self, axes: tuple[str, ...] = ("X", "Y", "Z"), *, chunk_rows: int = 65_536) -> None:
        self.toolpath = Toolpath(axes, chunk_rows=chunk_rows)
        self.context = self.toolpath.context_number(Context())
        self.program = self.toolpath.program_number("O0001")
        self.line = 0
        self.end = [0.0] * len(axes)

    def under(self, context: Context) -> Draft:
        self.context = self.toolpath.context_number(context)
        return self

    def move(self, kind: Kind, *end: float, feed: float = nan, curve: tuple[float, ...] = ()) -> Draft:
        self.line += 1
        self.end = list(end)
        number = self.toolpath.add_curve(*curve) if curve else -1
        self.toolpath.append(kind, self.program, self.line, self.context, feed, self.end, number)
        self.toolpath.block_boundary()
        return self

    def event(self, event: Event) -> Draft:
        self.line += 1
        self.toolpath.append_event(event, self.program, self.line, self.context, self.end)
        return self

    def display(self, layout: AxisLayout = MILL, names: tuple[str, ...] = ()) -> Display:
        return Display(self.toolpath, layout, names=names)

    def rows(self) -> list[Row]:
        return list(self.toolpath.rows())
