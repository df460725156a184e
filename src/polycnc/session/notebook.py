"""A result in HTML, as a notebook shows it."""

from __future__ import annotations

from html import escape

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from polycnc.messages import Alarm
    from polycnc.motion.times import ToolTimes


def as_html(head: str, alarms: Sequence[Alarm], time: float | None, tools: Sequence[ToolTimes]) -> str:
    """Head, alarms with their remedies, cycle time (seconds, None for none) and tools."""
    parts = [f"<p><b>{escape(head)}</b></p>"]
    if alarms:
        parts.append(_table((str(alarm), alarm.remedy) for alarm in alarms))
    else:
        parts.append(f"<p>{escape(text('run.no-alarm'))}</p>")
    if time is not None:
        rows = ((tool.name or f"T{tool.tool}", f"{tool.times.total_s:.1f} s") for tool in tools)
        parts.append(f"<p>{time:.1f} s</p>{_table(rows)}")
    return "".join(parts)


def _table(rows: Iterable[Iterable[str]]) -> str:
    cells = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
    return f"<table>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"
