"""A screen as HTML. Every text comes from the control, so every text is escaped.

Cells are what stands in windows and in the status line; what is around them is the frame.
"""

from __future__ import annotations

from html import escape

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.panel.screens.view import Cell, View, Window


def of_view(view: View, *, empty: bool = False) -> str:
    """Title, windows, key-in line and status line; `empty` is the frame alone, whatever its cells say."""
    windows = "".join(_window(window, empty=empty) for window in view.windows)
    status = "".join(_element("span", cell, empty=empty) for cell in view.status)
    alarm = f'<div class="alarm-line">{escape(view.alarm)}</div>'
    note = f'<div class="note-line">{escape(view.note)}</div>' if view.note else ""
    running = f"{view.program} {view.sequence}".rstrip()
    message = f'<span class="message" role="status">{escape(view.message)}</span>' if view.message else ""
    return (
        f'<div class="title"><span>{escape(view.title)}</span><span>{escape(running)}</span></div>{alarm}{note}'
        f'<div class="windows">{windows}</div>'
        f'<div class="buffer"><span>{escape(view.entry)}</span>{message}</div>'
        f'<div class="status">{status}</div>'
    )


def cells_of(view: View) -> tuple[tuple[str, str], ...]:
    """Text and style of every cell, in the order in which they stand in the markup."""
    return tuple((cell.text, _style(cell)) for cell in _cells(view))


def _cells(view: View) -> Iterator[Cell]:
    for window in view.windows:
        if window.kind != "graph":
            for row in window.rows:
                yield from row
    yield from view.status


def _window(window: Window, *, empty: bool) -> str:
    title = f"<h2>{escape(window.title)}</h2>" if window.title else ""
    if window.kind == "graph":
        return f'<section class="window graph">{title}</section>'
    rows = "".join(
        f"<tr>{''.join(_element('td', cell, empty=empty) for cell in row)}</tr>" for row in window.rows
    )
    return f'<section class="window {escape(window.kind)}">{title}<table>{rows}</table></section>'


def _element(name: str, cell: Cell, *, empty: bool) -> str:
    if empty:
        return f"<{name}>"
    return f'<{name} class="{escape(_style(cell))}">{escape(cell.text)}</{name}>'


def _style(cell: Cell) -> str:
    return f"{cell.style} cursor" if cell.cursor else cell.style
