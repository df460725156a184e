"""What a screen is at one moment: the page, the cursor, the key-in buffer; and what windows and actions ask of it."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from polycnc.mainrun import CommandRefused
from polycnc.panel.screens.pages import family_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.mainrun import VirtualControl
    from polycnc.mainrun.reading.snapshot import Snapshot
    from polycnc.panel.screens.pages import Page, WindowSpec

#: Points of the way that the picture shows.
LONGEST_TRAIL = 4000
#: Letters of relative coordinates on screens of the CRT kind.
RELATIVE = {"X": "U", "Y": "V", "Z": "W", "A": "A", "B": "B", "C": "H"}


class ScreenState:
    """The state of a control's screen.

    Args:
        control: The control; its id says which screens it has.

    Attributes:
        control: The control.
        family: Its pages and keys.
        page: The page that is shown.
        menu: Name of the row of soft keys; `turned` says how far it has been turned on by ▷.
        buffer: What has been keyed in.
        message: What the control says of the last key.
        mdi_text: Blocks that were typed in at MDI; cycle start runs them.
        origins: Machine position at which the relative coordinate of an axis is 0.
        writes_parameters: Parameters may be written.
        trail: Where the axes have been, machine coordinates, the oldest first.

    Raises:
        CommandRefused: polycnc knows no screens of this control.
    """

    def __init__(self, control: VirtualControl) -> None:
        self.control = control
        try:
            self.family = family_of(control.control.id)
        except KeyError:
            raise CommandRefused("panel.none", control=control.control.id) from None
        axes = tuple(control.positions.work)
        self._pages = {name: page.of(axes) for name, page in self.family.pages.items()}
        self.page: Page = self._pages[self.family.start]
        self.menu, self.turned = self.page.menu, 0
        self.buffer = ""
        self.message = ""
        self.mdi_text = ""
        self.origins: dict[str, float] = {}
        self.writes_parameters = False
        self.trail: deque[tuple[float, ...]] = deque(maxlen=LONGEST_TRAIL)
        self._cursors: dict[str, tuple[int, int]] = {}

    def show(self, page: str) -> None:
        """Turn to a page."""
        self.page = self._pages[page]
        self.menu, self.turned = self.page.menu, 0

    # ---- the cursor ----------------------------------------------------------------------------------------

    @property
    def table(self) -> WindowSpec | None:
        """The table of the page; None where it has none."""
        return next((each for each in self.page.windows if each.kind == "table"), None)

    def shows(self, kind: str) -> bool:
        """Whether the page has a window of a kind."""
        return any(each.kind == kind for each in self.page.windows)

    @property
    def cursor(self) -> tuple[int, int]:
        """Row and column of the cursor: the number of a table's row, else the row from 0."""
        start = self.table.first if self.table is not None else 0
        return self._cursors.get(self.page.id, (start, 0))

    def place(self, row: int, column: int) -> int:
        """Put the cursor somewhere; gives the row."""
        self._cursors[self.page.id] = row, column
        return row

    def move(self, rows: int, columns: int) -> None:
        """Move the cursor; it stays on the table."""
        (row, column), table = self.cursor, self.table
        row, column = row + rows, column + columns
        if table is not None:
            row = max(table.first, min(row, table.first + table.count - 1))
            column = max(0, min(column, len(table.columns) - 1))
        self.place(max(row, 0), max(column, 0))

    # ---- what it shows -------------------------------------------------------------------------------------

    @property
    def digits(self) -> int:
        """Decimals of lengths: four in inches."""
        return 4 if {"G20", "G70", "G700"} & set(self.control.modal.values()) else 3

    def positions(self, snapshot: Snapshot, kind: str) -> Mapping[str, float]:
        """Positions of a kind by axis: `work`, `machine`, `to_go` or `relative`."""
        shown = snapshot.positions
        if kind == "relative":
            return {axis: at - self.origins.get(axis, 0.0) for axis, at in shown.machine.items()}
        by_kind = {"work": shown.work, "machine": shown.machine, "to_go": shown.to_go}
        return by_kind[kind]

    def axis_label(self, axis: str, kind: str) -> str:
        """How an axis is called in a list of positions."""
        return axis if kind != "relative" or self.family.layout != "crt" else RELATIVE.get(axis, axis)

    def axis_of_relative(self, letter: str) -> str:
        """The axis that a letter of relative coordinates means."""
        named = {label: axis for axis, label in RELATIVE.items() if axis in self.control.positions.work}
        return letter if letter in self.control.positions.work else named.get(letter, letter)

    def follow(self) -> None:
        """Note where the axes are; called while time passes."""
        here = tuple(self.control.positions.real.values())
        if not self.trail or here != self.trail[-1]:
            self.trail.append(here)
