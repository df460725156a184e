"""What is on the screen at one moment: values that never change, as a browser or a test reads them."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field


@dataclass(frozen=True, slots=True)
class Cell:
    """A text on the screen.

    Attributes:
        text: What it says.
        style: How it looks: `label`, `value`, `large`, `active`, `alarm`, `note`; empty for plain text.
        cursor: The cursor stands on it.
    """

    text: str
    style: str = ""
    cursor: bool = False


@dataclass(frozen=True, slots=True)
class Window:
    """A part of a page: a title and rows of cells. `kind` is that of the page's data."""

    kind: str
    title: str
    rows: tuple[tuple[Cell, ...], ...]

    @property
    def text(self) -> str:
        """All texts, one row a line: what a test reads."""
        return "\n".join(" ".join(cell.text for cell in row if cell.text) for row in self.rows)


@dataclass(frozen=True, slots=True)
class SoftKeyView:
    """A soft key: its text (empty for none), and whether its page or menu is the one that is shown."""

    text: str = ""
    active: bool = False


@dataclass(frozen=True, slots=True)
class View:
    """The whole screen.

    Attributes:
        page: Id of the page.
        title: Title of the page.
        program: The program that is loaded, as the title line shows it.
        windows: Its windows.
        soft_keys: The keys below the screen.
        side_keys: The keys at its right side; empty where the control has none.
        buffer: What has been keyed in.
        entry: The key-in line, as the control writes it.
        message: What the control says of the last key, or empty.
        status: What the status line shows, in order.
        alarm: The alarm or message line, or empty.
        sequence: The block number behind the program, as the title line shows it; empty where it shows none.
        note: The message line where alarms have one of their own, or empty.
    """

    page: str
    title: str
    program: str
    windows: tuple[Window, ...]
    soft_keys: tuple[SoftKeyView, ...]
    side_keys: tuple[SoftKeyView, ...] = ()
    buffer: str = ""
    entry: str = ""
    message: str = ""
    status: tuple[Cell, ...] = field(default=())
    alarm: str = ""
    sequence: str = ""
    note: str = ""

    @property
    def text(self) -> str:
        """All windows as text."""
        return "\n".join(window.text for window in self.windows)
