"""The figures as a page: a table, and a chart of what was compared with peers."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from html import escape
from math import log10
from pathlib import Path

from benchmarks import processes
from benchmarks.measure import Figure

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE, CHART = DOCS / "benchmarks.md", DOCS / "benchmarks.svg"
_ROW, _LEFT, _WIDTH, _ROOM = 22, 330, 330, 110


def write(figures: Sequence[Figure]) -> None:
    """Write the page and its chart."""
    compared = [figure for figure in figures if figure.times is not None]
    CHART.write_text(chart(compared), encoding="utf-8")
    PAGE.write_text(page(figures), encoding="utf-8")


_HEAD = """# Figures

Written by `make bench`: processor time of whole processes with the default installation, in turn with the peer where
one is named, smallest of {turns}. Python {python}, {cores} cores, {machine}.

![Times as fast as the peer](benchmarks.svg)

The line in the chart is the peer. The ratio in the table says how much better than asked a figure is: 1 is the goal.

| work | figure | ratio |
|---|---|---|
"""


def page(figures: Sequence[Figure]) -> str:
    """The page."""
    here: dict[str, object] = {
        "turns": processes.TURNS,
        "python": platform.python_version(),
        "cores": os.cpu_count(),
        "machine": platform.machine(),
    }
    return _HEAD.format(**here) + "".join(f"| {f.name} | {f.said} | {_mark(f)} |\n" for f in figures)


def _mark(figure: Figure) -> str:
    return (
        ""
        if figure.ratio is None
        else f"{figure.ratio:.2f}"
        if figure.ratio >= 1.0
        else f"**{figure.ratio:.2f}**"
    )


def chart(figures: Sequence[Figure]) -> str:
    """Bars on a logarithmic scale, from a tenth to a hundred times the peer."""
    width, height, one = _LEFT + _WIDTH + _ROOM, _ROW * (len(figures) + 2), _place(1.0)
    size, font = f'width="{width}" height="{height}"', 'font-family="sans-serif" font-size="12"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} {font}>',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<text x="{_LEFT}" y="15">times as fast as the peer</text>',
    ]
    for number, figure in enumerate(figures, 1):
        assert figure.times is not None
        y, end = _ROW * number, _place(figure.times)
        colour = "#2a7" if (figure.ratio or 0.0) >= 1.0 else "#c84"
        bar = f'x="{min(one, end):.1f}" y="{y + 4}" width="{abs(end - one):.1f}" height="{_ROW - 8}"'
        parts += [
            f'<text x="{_LEFT - 8}" y="{y + 15}" text-anchor="end">{escape(figure.name)}</text>',
            f'<rect {bar} fill="{colour}"/>',
            f'<text x="{max(one, end) + 5:.1f}" y="{y + 15}">{figure.times:.2f}</text>',
        ]
    bottom = height - _ROW + 4
    parts.append(f'<line x1="{one:.1f}" y1="{_ROW}" x2="{one:.1f}" y2="{bottom}" stroke="black"/></svg>')
    return "\n".join(parts) + "\n"


def _place(times: float) -> float:
    return _LEFT + _WIDTH * (log10(min(max(times, 0.1), 100.0)) + 1.0) / 3.0
