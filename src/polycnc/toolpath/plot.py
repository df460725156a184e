"""Draws the path as SVG: projections side by side at one scale, rapids dashed, each tool in its colour.

What is drawn are coordinates of the work offset in millimetres: planes, turns and local systems lie where they are on
the work, which is as it is with the table at zero. The drawing is fitted around the cutting; rapids from and to afar
are cut off at its edge.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil, floor, log10
from xml.sax.saxutils import escape

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from polycnc.geometry.frames import Vector
    from polycnc.toolpath.strokes import Stroke

    Counted = Callable[[Iterable[Vector]], Iterable[Vector]]

#: Okabe and Ito's colours, told apart by people who see red and green alike.
TOOL_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c510a", "#000000")
FONT = "Arial, DejaVu Sans, sans-serif"
RAPID_COLOUR, GRID_COLOUR, TEXT_COLOUR = "#999999", "#e4e4e4", "#333333"
#: The largest side of a view, its margin for texts, and how near two drawn points may lie, all in pixels.
VIEW, MARGIN, NEAR = 560.0, 54.0, 0.15
#: Radius of the circle at a cut along the view, pixels.
HOLE = 2.5
_LEGEND_LINE = 18.0
_TITLE = 34.0


@dataclass(frozen=True, slots=True)
class AxisLabel:
    """What stands at an axis: its name, and the factor from what is drawn to what is written (2 for diameters)."""

    name: str
    factor: float = 1.0

    def __str__(self) -> str:
        return f"{self.name} ⌀ (mm)" if self.factor == 2.0 else f"{self.name} (mm)"


XYZ = (AxisLabel("X"), AxisLabel("Y"), AxisLabel("Z"))


@dataclass(frozen=True, slots=True)
class View:
    """A projection: index of the geometry axis that points right, and of the one that points up."""

    right: int
    up: int
    name: str


#: Views by the name of `--view`. Mills are drawn as in a three-view drawing, lathes with Z to the right.
VIEWS = {
    "xy": (View(0, 1, "XY"),),
    "xz": (View(0, 2, "XZ"),),
    "yz": (View(1, 2, "YZ"),),
    "zx": (View(2, 0, "ZX"),),
    "three": (View(0, 1, "XY"), View(0, 2, "XZ"), View(1, 2, "YZ")),
}


@dataclass(frozen=True, slots=True)
class _Frame:
    """Where a view lies on the sheet: millimetres to pixels."""

    view: View
    low: tuple[float, float]
    high: tuple[float, float]
    scale: float
    left: float
    top: float

    def x(self, value: float) -> float:
        return self.left + (value - self.low[0]) * self.scale

    def y(self, value: float) -> float:
        return self.top + (self.high[1] - value) * self.scale

    @property
    def width(self) -> float:
        return (self.high[0] - self.low[0]) * self.scale

    @property
    def height(self) -> float:
        return (self.high[1] - self.low[1]) * self.scale


def svg(
    strokes: Sequence[Stroke],
    views: Sequence[View],
    title: str,
    labels: Sequence[AxisLabel] = XYZ,
    counted: Counted = iter,
) -> str:
    """A drawing of the strokes.

    Args:
        strokes: What `strokes.strokes` gave.
        views: The projections, drawn from left to right.
        title: Written above the drawing.
        labels: What the control calls the geometry axes X, Y and Z.
        counted: Gives points on to be drawn, where somebody counts them: those of all strokes in every view.
    """
    low, high = _box(strokes)
    span = max(max(high[v.right] - low[v.right], high[v.up] - low[v.up]) for v in views)
    scale = VIEW / span
    frames: list[_Frame] = []
    left = MARGIN
    for view in views:
        corner, far = (low[view.right], low[view.up]), (high[view.right], high[view.up])
        frames.append(_Frame(view, corner, far, scale, left, _TITLE + 10.0))
        left += frames[-1].width + MARGIN + 20.0
    tools = list(dict.fromkeys(stroke.tool for stroke in strokes if not stroke.rapid))
    colours = {tool: TOOL_COLOURS[i % len(TOOL_COLOURS)] for i, tool in enumerate(tools)}
    bottom = _TITLE + 10.0 + max(frame.height for frame in frames) + MARGIN
    height = bottom + _LEGEND_LINE * (len(tools) + 1) + 10.0
    body = [line for frame in frames for line in _view(frame, strokes, colours, labels, counted)]
    body += _legend(bottom, colours)
    return "\n".join([*_head(max(left, 320.0), height, title), *body, "</svg>", ""])


def _box(strokes: Sequence[Stroke]) -> tuple[list[float], list[float]]:
    """The box around the cutting (around everything where nothing is cut), never without extent, with some air."""
    cutting = [stroke for stroke in strokes if not stroke.rapid] or strokes
    low, high = [0.0] * 3, [0.0] * 3
    for i in range(3):
        values = [point[i] for stroke in cutting for point in stroke.points] or [0.0]
        low[i], high[i] = min(values), max(values)
    air = 0.06 * max(*(h - n for h, n in zip(high, low, strict=True)), 1.0)
    return [value - air for value in low], [value + air for value in high]


def _head(width: float, height: float, title: str) -> Iterator[str]:
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}"'
        f' viewBox="0 0 {width:.0f} {height:.0f}" font-family="{FONT}" font-size="11" fill="{TEXT_COLOUR}">'
    )
    yield '<rect width="100%" height="100%" fill="#ffffff"/>'
    yield f'<text x="{MARGIN:.0f}" y="22" font-size="14">{escape(title)}</text>'


def _view(
    frame: _Frame,
    strokes: Sequence[Stroke],
    colours: dict[str, str],
    labels: Sequence[AxisLabel],
    counted: Counted,
) -> Iterator[str]:
    """One projection: grid, axis texts, path."""
    view = frame.view
    yield f'<g id="view-{view.name.lower()}">'
    yield from _grid(frame, labels[view.right].factor, labels[view.up].factor)
    right, down = frame.left + frame.width, frame.top + frame.height
    across, upward = (escape(str(labels[axis])) for axis in (view.right, view.up))
    yield f'<text x="{right:.1f}" y="{down + 34:.1f}" text-anchor="end">{across}</text>'
    yield f'<text x="{frame.left - 40:.1f}" y="{frame.top - 6:.1f}">{upward}</text>'
    name = view.name.lower()
    edge = f'x="{frame.left:.1f}" y="{frame.top:.1f}" width="{frame.width:.1f}" height="{frame.height:.1f}"'
    yield f'<clipPath id="edge-{name}"><rect {edge}/></clipPath><g clip-path="url(#edge-{name})">'
    for stroke in strokes:
        points = _drawn(frame, counted(stroke.points))
        if len(points) < 2:
            continue
        path = "M" + " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
        if stroke.rapid:
            look = f'stroke="{RAPID_COLOUR}" stroke-width="0.8" stroke-dasharray="4 3"'
        else:
            look = f'stroke="{colours[stroke.tool]}" stroke-width="1.2"'
        yield f'<path d="{path}" fill="none" {look}/>'
    for x, y, tool in dict.fromkeys(plunge for stroke in strokes for plunge in _plunges(frame, stroke)):
        yield f'<circle cx="{x}" cy="{y}" r="{HOLE}" fill="none" stroke="{colours[tool]}" stroke-width="1.2"/>'
    yield "</g></g>"


def _plunges(frame: _Frame, stroke: Stroke) -> Iterator[tuple[str, str, str]]:
    """Where a cut goes straight into or out of the sheet, as text, with its tool: a hole, seen along the drill."""
    if stroke.rapid:
        return
    right, up = frame.view.right, frame.view.up
    depth = 3 - right - up
    for start, end in pairwise(stroke.points):
        across, upward = frame.scale * abs(end[right] - start[right]), frame.scale * abs(end[up] - start[up])
        if max(across, upward) < NEAR <= frame.scale * abs(end[depth] - start[depth]):
            yield f"{frame.x(end[right]):.2f}", f"{frame.y(end[up]):.2f}", stroke.tool


def _drawn(frame: _Frame, points: Iterable[Vector]) -> list[tuple[float, float]]:
    """Points of a stroke on the sheet, without those that nobody could tell apart."""
    drawn: list[tuple[float, float]] = []
    last = (0.0, 0.0)
    for point in points:
        last = (frame.x(point[frame.view.right]), frame.y(point[frame.view.up]))
        if not drawn or abs(last[0] - drawn[-1][0]) >= NEAR or abs(last[1] - drawn[-1][1]) >= NEAR:
            drawn.append(last)
    if drawn and drawn[-1] != last:
        drawn.append(last)
    return drawn


def _grid(frame: _Frame, across: float, upward: float) -> Iterator[str]:
    """Lines at round values with their numbers; the axes through zero are darker.

    `across` and `upward` are the factors from what is drawn to the numbers that are written.
    """
    bottom, right = frame.top + frame.height, frame.left + frame.width
    for value in ticks(frame.low[0] * across, frame.high[0] * across):
        x, colour = frame.x(value / across), "#888888" if value == 0 else GRID_COLOUR
        yield f'<path d="M{x:.2f},{frame.top:.2f} V{bottom:.2f}" stroke="{colour}" stroke-width="0.7"/>'
        yield f'<text x="{x:.2f}" y="{bottom + 15:.2f}" text-anchor="middle">{value:g}</text>'
    for value in ticks(frame.low[1] * upward, frame.high[1] * upward):
        y, colour = frame.y(value / upward), "#888888" if value == 0 else GRID_COLOUR
        yield f'<path d="M{frame.left:.2f},{y:.2f} H{right:.2f}" stroke="{colour}" stroke-width="0.7"/>'
        yield f'<text x="{frame.left - 5:.2f}" y="{y + 4:.2f}" text-anchor="end">{value:g}</text>'


def ticks(low: float, high: float, most: int = 8) -> list[float]:
    """Round values between two bounds, in steps of 1, 2 or 5 of a power of ten."""
    rough = (high - low) / most
    power = 10.0 ** floor(log10(rough))
    step = next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= rough)
    return [round(k * step, 10) + 0.0 for k in range(ceil(low / step), floor(high / step) + 1)]


def _legend(top: float, colours: dict[str, str]) -> Iterator[str]:
    """Which colour is which tool, and what dashes mean."""
    entries = [(tool, colour, "") for tool, colour in colours.items()]
    entries.append(("G0", RAPID_COLOUR, ' stroke-dasharray="4 3"'))
    for i, (name, colour, dashes) in enumerate(entries):
        y = top + _LEGEND_LINE * i
        yield f'<path d="M{MARGIN:.0f},{y:.1f} h26" stroke="{colour}" stroke-width="2"{dashes}/>'
        yield f'<text x="{MARGIN + 34:.0f}" y="{y + 4:.1f}">{escape(name)}</text>'
