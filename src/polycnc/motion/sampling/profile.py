"""Draws speed and acceleration over time as SVG, one panel above the other."""

from __future__ import annotations

from xml.sax.saxutils import escape

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text
from polycnc.toolpath.plot import FONT, GRID_COLOUR, TEXT_COLOUR, TOOL_COLOURS, ticks

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.motion.sampling.run import Moved, Numbers
    from polycnc.motion.sampling.samples import Samples

#: Pixels: width and height of a panel, its left margin, and the top of the first one.
WIDTH, HEIGHT, LEFT, TOP, GAP = 900.0, 240.0, 64.0, 60.0, 46.0
#: A curve is drawn by the lowest and highest value in each of so many parts of the time.
PARTS = 900
_PATH_COLOUR = "#333333"


class Profile:
    """Collects samples and draws them.

    Args:
        axes: Names of the axes.
        rotary: Indices of those that count degrees; the path speed is that of the others.
    """

    def __init__(self, axes: tuple[str, ...], rotary: set[int]) -> None:
        self._axes, self._rotary = axes, rotary
        self._samples: list[Moved] = []

    def take(self, samples: Samples) -> None:
        """Note samples."""
        self._samples.append((samples.time, samples.velocity, samples.acceleration))

    def svg(self, title: str) -> str:
        """The drawing."""
        import numpy as np

        n = len(self._axes)
        empty = (np.zeros(1), np.zeros((1, n)), np.zeros((1, n)))
        time, velocity, acceleration = (
            np.concatenate(column) for column in zip(*(self._samples or [empty]), strict=True)
        )
        linear = [i for i in range(n) if i not in self._rotary]
        path = np.sqrt((velocity[:, linear] ** 2).sum(axis=1))
        colours = [TOOL_COLOURS[i % len(TOOL_COLOURS)] for i in range(n)]
        speeds = [(velocity[:, i] * 60.0, colours[i]) for i in range(n)] + [(path * 60.0, _PATH_COLOUR)]
        pulls = [(acceleration[:, i] / 1000.0, colours[i]) for i in range(n)]
        height = TOP + 2.0 * HEIGHT + GAP + 60.0
        width = LEFT + WIDTH + 30.0
        lines = [
            (
                f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" viewBox="0 0'
                f' {width:.0f} {height:.0f}" font-family="{FONT}" font-size="11" fill="{TEXT_COLOUR}">'
            ),
            '<rect width="100%" height="100%" fill="#ffffff"/>',
            f'<text x="{LEFT:.0f}" y="22" font-size="14">{escape(title)}</text>',
            *_panel(TOP, text("profile.speed"), time, speeds),
            *_panel(TOP + HEIGHT + GAP, text("profile.acceleration"), time, pulls),
            f'<text x="{LEFT + WIDTH:.0f}" y="{height - 26:.0f}" text-anchor="end">{text("profile.time")}</text>',
        ]
        names = [*zip(self._axes, colours, strict=True), (text("profile.path"), _PATH_COLOUR)]
        for k, (name, colour) in enumerate(names):
            x, y = LEFT + 80.0 * k, height - 10.0
            lines.append(f'<path d="M{x:.0f},{y - 4:.0f} h22" stroke="{colour}" stroke-width="2"/>')
            lines.append(f'<text x="{x + 28:.0f}" y="{y:.0f}">{escape(name)}</text>')
        return "\n".join([*lines, "</svg>", ""])


def _panel(top: float, title: str, time: Numbers, curves: list[tuple[Numbers, str]]) -> Iterator[str]:
    """One panel: grid with numbers, and the curves."""
    low = min(float(values.min()) for values, _ in curves)
    high = max(float(values.max()) for values, _ in curves)
    air = 0.05 * ((high - low) or 1.0)
    low, high, end = low - air, high + air, float(time[-1]) or 1.0

    def y(value: float) -> float:
        return top + (high - value) / (high - low) * HEIGHT

    def x(seconds: float) -> float:
        return LEFT + seconds / end * WIDTH

    yield f'<text x="{LEFT:.0f}" y="{top - 8:.0f}">{escape(title)}</text>'
    for value in ticks(0.0, end, 10):
        yield f'<path d="M{x(value):.1f},{top:.1f} v{HEIGHT:.1f}" stroke="{GRID_COLOUR}" stroke-width="0.7"/>'
        yield f'<text x="{x(value):.1f}" y="{top + HEIGHT + 15:.1f}" text-anchor="middle">{value:g}</text>'
    for value in ticks(low, high):
        colour = "#888888" if value == 0 else GRID_COLOUR
        yield f'<path d="M{LEFT:.1f},{y(value):.1f} h{WIDTH:.1f}" stroke="{colour}" stroke-width="0.7"/>'
        yield f'<text x="{LEFT - 6:.1f}" y="{y(value) + 4:.1f}" text-anchor="end">{value:g}</text>'
    for values, colour in curves:
        points = " ".join(f"{x(t):.1f},{y(v):.2f}" for t, v in _thinned(time, values))
        yield f'<path d="M{points}" fill="none" stroke="{colour}" stroke-width="1.1"/>'


def _thinned(time: Numbers, values: Numbers) -> Iterator[tuple[float, float]]:
    """Lowest and highest value of each part of the time, where they are many."""
    step = max(len(time) // PARTS, 1)
    for k in range(0, len(time), step):
        part = values[k : k + step]
        for place in sorted({int(part.argmin()), int(part.argmax())}):
            yield float(time[k + place]), float(part[place])
