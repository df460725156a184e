"""A screen as HTML. Every text comes from the control, so every text is escaped."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.panel.screens.view import Cell, View, Window


def of_view(view: View) -> str:
    """Title, windows, key-in line and status line."""
    windows = "".join(_window(window) for window in view.windows)
    status = "".join(f'<span class="{escape(cell.style)}">{escape(cell.text)}</span>' for cell in view.status)
    alarm = (
        f'<div class="alarm-line">{escape(view.alarm)}</div>'
        if view.alarm
        else '<div class="alarm-line"></div>'
    )
    note = f'<div class="note-line">{escape(view.note)}</div>' if view.note else ""
    running = f"{view.program} {view.sequence}".rstrip()
    message = f'<span class="message" role="status">{escape(view.message)}</span>' if view.message else ""
    return (
        f'<div class="title"><span>{escape(view.title)}</span><span>{escape(running)}</span></div>{alarm}{note}'
        f'<div class="windows">{windows}</div>'
        f'<div class="buffer"><span>A&gt;{escape(view.buffer)}_</span>{message}</div>'
        f'<div class="status">{status}</div>'
    )


def _window(window: Window) -> str:
    title = f"<h2>{escape(window.title)}</h2>" if window.title else ""
    if window.kind == "graph":
        return f'<section class="window graph">{title}</section>'
    rows = "".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in window.rows)
    return f'<section class="window {escape(window.kind)}">{title}<table>{rows}</table></section>'


def _cell(cell: Cell) -> str:
    style = f"{cell.style} cursor" if cell.cursor else cell.style
    return f'<td class="{escape(style)}">{escape(cell.text)}</td>'
