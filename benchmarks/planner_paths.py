"""Paths of different kind, each as rows of a toolpath and as the curve itself, for comparison."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import cos, hypot, pi, sin, sqrt

from polycnc.machine import Machine, load_machine
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.modes import CornerMode

Vector = tuple[float, ...]
#: Position, first and second derivative of all axes by the length `s` (mm) from the section's start.
Curve = Callable[[float], tuple[Vector, Vector, Vector]]


@dataclass
class Section:
    """A smooth part of a path: `length` mm of `curve`, and the steps that the reference takes over it."""

    length: float
    curve: Curve
    steps: int


@dataclass
class Path:
    """A path from rest to rest. `sections` is the curve; the rows are written by the functions below."""

    name: str
    axes: tuple[str, ...] = ("X", "Y", "Z")
    context: Context = field(default_factory=Context)
    feed: float = 1000.0
    sections: list[Section] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.toolpath = Toolpath(self.axes)
        self.number = self.toolpath.context_number(self.context)
        self.position: Vector = (0.0,) * len(self.axes)

    @property
    def machine(self) -> Machine:
        """A machine whose axes differ in speed and acceleration."""
        built = load_machine("mill3" if self.axes == ("X", "Y", "Z") else "mill4")
        factors = {"X": (1.0, 1.0), "Y": (0.8, 0.7), "Z": (0.5, 0.4)}
        axes = []
        for axis in built.axes:
            speed, pull = factors.get(axis.name, (1.0, 1.0))
            top, acceleration = axis.max_feed * speed, axis.acceleration * pull
            axes.append(replace(axis, rapid=top, max_feed=top, acceleration=acceleration))
        return replace(built, axes=tuple(axes))

    def row(self, kind: Kind, end: Vector, *curve: float) -> None:
        """Write one row."""
        number = self.toolpath.add_curve(*curve) if curve else -1
        line = len(self.toolpath) + 1
        self.toolpath.append(kind, 0, line, self.number, self.feed, list(end), number)
        self.position = end

    def line(self, *end: float, steps: int = 400) -> Path:
        """A straight cut."""
        start = self.position
        way = tuple(b - a for a, b in zip(start, end, strict=True))
        length = sqrt(sum(d * d for d in way))
        unit = tuple(d / length for d in way)
        still = (0.0,) * len(way)
        self.sections.append(
            Section(
                length,
                lambda s: (tuple(a + u * s for a, u in zip(start, unit, strict=True)), unit, still),
                steps,
            )
        )
        self.row(Kind.FEED, end)
        return self

    def arc(self, cx: float, cy: float, angle: float, rise: float = 0.0, growth: float = 0.0) -> Path:
        """A counter-clockwise arc, helix or spiral about a centre in XY, by an angle (radians)."""
        x, y, z = self.position
        ux, uy = x - cx, y - cy
        radius = hypot(ux, uy)
        ux, uy = ux / radius, uy / radius
        end_radius = radius + growth
        c, s = cos(angle), sin(angle)
        end = (cx + end_radius * (c * ux - s * uy), cy + end_radius * (s * ux + c * uy), z + rise)
        slope, climb = growth / angle, rise / angle
        steps = 4000
        ways = [
            hypot(radius + slope * angle * (k + 0.5) / steps, slope, climb) * angle / steps
            for k in range(steps)
        ]

        def curve(s: float) -> tuple[Vector, Vector, Vector]:
            a = _angle_at(s, radius, slope, climb)
            c, sn, r = cos(a), sin(a), radius + slope * a
            ox, oy, fx, fy = c * ux - sn * uy, sn * ux + c * uy, -sn * ux - c * uy, c * ux - sn * uy
            first = (slope * ox + r * fx, slope * oy + r * fy, climb)
            second = (2.0 * slope * fx - r * ox, 2.0 * slope * fy - r * oy, 0.0)
            return ((cx + r * ox, cy + r * oy, z + climb * a), *_by_length(first, second))

        self.sections.append(Section(sum(ways), curve, 1500))
        turns = int(angle / (2.0 * pi) - 1e-9)
        kind = Kind.HELIX_CCW if rise else Kind.CCW
        self.row(kind, end, cx, cy, 0.0, 0.0, 0.0, 1.0, float(turns))
        return self

    def spline(
        self, point: Callable[[float], tuple[Vector, Vector, Vector]], end: float, points: int
    ) -> Path:
        """A smooth curve by a parameter from 0 to `end`, as spline rows through even points."""
        fine = 20 * points
        ways, parameters, total = [0.0], [0.0], 0.0
        for k in range(fine):
            t = end * (k + 0.5) / fine
            total += sqrt(sum(d * d for d in point(t)[1])) * end / fine
            ways.append(total)
            parameters.append(end * (k + 1) / fine)

        def curve(s: float) -> tuple[Vector, Vector, Vector]:
            position, first, second = point(_interpolated(s, ways, parameters))
            return (position, *_by_length(first, second))

        self.sections.append(Section(total, curve, 3000))
        for k in range(1, points + 1):
            self.row(Kind.SPLINE, point(end * k / points)[0])
        return self


def _angle_at(s: float, radius: float, slope: float, climb: float) -> float:
    """Angle after a length of an arc whose radius grows by `slope` a radian (by Newton's method)."""
    angle = s / hypot(radius, climb)
    if slope == 0.0:
        return angle
    for _ in range(20):
        # Simpson's rule over the whole angle, in 64 parts.
        parts, total = 64, 0.0
        for k in range(parts + 1):
            weight = 1.0 if k in (0, parts) else 4.0 if k % 2 else 2.0
            total += weight * hypot(radius + slope * angle * k / parts, slope, climb)
        angle += (s - total * angle / (3.0 * parts)) / hypot(radius + slope * angle, slope, climb)
    return angle


def _by_length(first: Vector, second: Vector) -> tuple[Vector, Vector]:
    way = sqrt(sum(d * d for d in first))
    unit = tuple(d / way for d in first)
    along = sum(u * d for u, d in zip(unit, second, strict=True))
    return unit, tuple((d - u * along) / (way * way) for d, u in zip(second, unit, strict=True))


def _interpolated(s: float, ways: list[float], parameters: list[float]) -> float:
    from bisect import bisect_right

    k = min(max(bisect_right(ways, s), 1), len(ways) - 1)
    share = (s - ways[k - 1]) / (ways[k] - ways[k - 1])
    return parameters[k - 1] + share * (parameters[k] - parameters[k - 1])


def _loop(t: float) -> tuple[Vector, Vector, Vector]:
    """A Lissajous figure with a wavy height."""
    return (
        (60.0 * sin(2.0 * t), 40.0 * (1.0 - cos(3.0 * t)), 5.0 * sin(5.0 * t)),
        (120.0 * cos(2.0 * t), 120.0 * sin(3.0 * t), 25.0 * cos(5.0 * t)),
        (-240.0 * sin(2.0 * t), 360.0 * cos(3.0 * t), -125.0 * sin(5.0 * t)),
    )


def _wave(t: float) -> tuple[Vector, Vector, Vector]:
    return (t, 8.0 * sin(t / 4.0), 0.0), (1.0, 2.0 * cos(t / 4.0), 0.0), (0.0, -0.5 * sin(t / 4.0), 0.0)


def _zigzag(path: Path) -> Path:
    for k in range(1, 13):
        path.line(4.0 * k, 15.0 * (k % 2), 0.5 * k, steps=200)
    return path


def _facets(path: Path) -> Path:
    """A sine in short straight cuts, as a CAM system writes it."""
    for k in range(1, 401):
        path.line(0.25 * k, 6.0 * sin(0.125 * k), 0.0, steps=8)
    return path


def paths() -> list[Path]:
    """The paths."""
    slot = Path("slot").line(60.0, 0.0, 0.0).arc(60.0, 12.0, pi).line(0.0, 24.0, 0.0).arc(0.0, 12.0, pi)
    return [
        Path("line", feed=200.0).line(120.0, 80.0, -30.0),
        _zigzag(Path("zigzag, exact stop", context=Context(corner_mode=CornerMode.EXACT_STOP))),
        _zigzag(Path("zigzag, corner speed", context=Context(corner_mode=CornerMode.CONTINUOUS))),
        _facets(Path("facets, rounded", context=Context(corner_mode=CornerMode.ROUNDED, tolerance_mm=0.01))),
        Path("small circle").line(0.0, -5.0, 0.0).arc(0.0, 0.0, 2.0 * pi),
        Path("large arc", feed=80.0).line(0.0, -400.0, 0.0).arc(0.0, 0.0, 0.5),
        slot,
        Path("helix").line(20.0, 0.0, 0.0).arc(0.0, 0.0, 6.0 * pi, rise=15.0),
        Path("spiral")
        .line(4.0, 0.0, 0.0)
        .arc(0.0, 0.0, 2.0 * pi, growth=6.0)
        .arc(0.0, 0.0, 2.0 * pi, growth=6.0),
        Path("spline").spline(_loop, 2.0 * pi, 600),
        Path("wave as spline", feed=120.0).spline(_wave, 100.0, 300),
        Path("rotary", axes=("X", "Y", "Z", "A")).line(50.0, 0.0, 0.0, 90.0).line(100.0, 30.0, 0.0, 100.0),
    ]
