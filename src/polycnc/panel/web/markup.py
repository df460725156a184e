"""A screen as HTML. Every text comes from the control, so every text is escaped."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.panel.screens.view import Cell, View, Window

#: The picture: directions of X, Y and Z on the page, seen from the front right above.
_X, _Y = (0.866, -0.866, 0.0), (-0.5, -0.5, -1.0)
_MARGIN = 0.08


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
        return f'<section class="window graph">{title}{_graph(window)}</section>'
    rows = "".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in window.rows)
    return f'<section class="window {escape(window.kind)}">{title}<table>{rows}</table></section>'


def _cell(cell: Cell) -> str:
    style = f"{cell.style} cursor" if cell.cursor else cell.style
    return f'<td class="{escape(style)}">{escape(cell.text)}</td>'


def _graph(window: Window) -> str:
    """The way of the tool, as a line in parallel projection."""
    points = [_projected([float(cell.text) for cell in row]) for row in window.rows]
    if not points:
        return '<svg viewBox="0 0 1 1"></svg>'
    left, top = (min(values) for values in zip(*points, strict=True))
    right, bottom = (max(values) for values in zip(*points, strict=True))
    size = max(right - left, bottom - top, 1.0)
    edge = size * _MARGIN
    box = f"{left - edge:.3f} {top - edge:.3f} {size + 2 * edge:.3f} {size + 2 * edge:.3f}"
    line = " ".join(f"{x:.3f},{y:.3f}" for x, y in points)
    x, y = points[-1]
    return (
        f'<svg viewBox="{box}" role="img"><polyline points="{line}" stroke-width="{size / 300:.4f}"/>'
        f'<circle cx="{x:.3f}" cy="{y:.3f}" r="{size / 80:.4f}"/></svg>'
    )


def _projected(point: list[float]) -> tuple[float, float]:
    x, y, z = (*point, 0.0, 0.0)[:3]
    return _X[0] * x + _X[1] * y + _X[2] * z, _Y[0] * x + _Y[1] * y + _Y[2] * z
