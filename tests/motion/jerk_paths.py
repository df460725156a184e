"""Thirty paths of different kind for limited jerk: lines, facets, arcs, splines, each with its tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.toolpath import Context, Kind
from polycnc.toolpath.modes import AccelerationMode, CornerMode
from tests.motion.paths import MILL, Build
from tests.motion.third_order.programmed import Bounds, ProgrammedPath

if TYPE_CHECKING:
    from collections.abc import Callable

Place: TypeAlias = tuple[float, float, float]
#: Points of the path in a full turn.
AROUND = 2000


@dataclass
class JerkPath:
    """A path as rows, as points so close together that lines between them are the path, and for `bend`."""

    name: str
    tolerance: float
    feed: float = 1000.0
    acceleration: AccelerationMode | None = None

    def __post_init__(self) -> None:
        context = Context(
            corner_mode=CornerMode.ROUNDED, tolerance_mm=self.tolerance, acceleration=self.acceleration
        )
        self.rows = Build(context=context)
        self.points: list[Place] = [(0.0, 0.0, 0.0)]
        self.programmed = ProgrammedPath([0.0] * 3, [axis.max_feed for axis in MILL.axes[:3]])
        self._bounds = Bounds(self.tolerance, self.feed)

    def line(self, *end: float) -> JerkPath:
        self.rows.feed(*end, feed=self.feed)
        self.points.append((end[0], end[1], end[2]))
        self.programmed.line(end, self.rows.line, self._bounds)
        return self

    def arc(self, cx: float, cy: float, angle: float, rise: float = 0.0, growth: float = 0.0) -> JerkPath:
        """Counter-clockwise about a centre, by an angle (radians); clockwise by a negative one."""
        x, y, z = self.points[-1]
        radius, first = hypot(x - cx, y - cy), np.arctan2(y - cy, x - cx)
        for k in range(1, count := int(AROUND * abs(angle) / (2.0 * pi)) + 1):
            share = k / (count - 1)
            own = radius + growth * share
            turn = first + angle * share
            self.points.append((cx + own * cos(turn), cy + own * sin(turn), z + rise * share))
        curve = (cx, cy, 0.0, 0.0, 0.0, 1.0, float(int(abs(angle) / (2.0 * pi) - 1e-9)))
        kind = {(True, False): Kind.CCW, (False, False): Kind.CW, (True, True): Kind.HELIX_CCW}.get(
            (angle > 0.0, rise != 0.0), Kind.HELIX_CW
        )
        self.rows.row(kind, *self.points[-1], feed=self.feed, curve=curve)
        centre, up = (cx, cy, 0.0), (0.0, 0.0, 1.0)
        self.programmed.arc(self.points[-1], centre, up, angle, self.rows.line, self._bounds)
        return self

    def through(self, place: Callable[[float], Place], count: int, kind: Kind) -> JerkPath:
        """Rows through `count` even places of a curve by a parameter from 0 to 1: facets, or a spline."""
        for k in range(1, count + 1):
            self.rows.row(kind, *place(k / count), feed=self.feed)
            lead = self.programmed.line if kind is Kind.FEED else self.programmed.chord
            lead(place(k / count), self.rows.line, self._bounds)
        fine = count if kind is Kind.FEED else 8 * count
        self.points += [place(k / fine) for k in range(1, fine + 1)]
        return self


def circle(radius: float) -> Callable[[float], Place]:
    return lambda t: (radius * sin(2.0 * pi * t), radius * (1.0 - cos(2.0 * pi * t)), 0.0)


def wave(length: float, height: float, waves: float) -> Callable[[float], Place]:
    return lambda t: (length * t, height * (1.0 - cos(2.0 * pi * waves * t)), 0.0)


def loop(t: float) -> Place:
    """A Lissajous figure with a wavy height."""
    return 60.0 * sin(4.0 * pi * t), 40.0 * (1.0 - cos(6.0 * pi * t)), 5.0 * sin(10.0 * pi * t)


def growing(t: float) -> Place:
    """A spiral from a radius of 4 mm to one of 20 mm."""
    radius = 4.0 + 16.0 * t
    return radius * sin(4.0 * pi * t), 4.0 - radius * cos(4.0 * pi * t), 0.0


def zigzag(path: JerkPath, step: float, count: int, turn: float) -> JerkPath:
    """Lines whose direction turns by an angle, to either side in turn."""
    x, y = 0.0, 0.0
    for k in range(count):
        heading = 0.5 * turn * (1 - 2 * (k % 2))
        x, y = x + step * cos(heading), y + step * sin(heading)
        path.line(x, y, 0.0)
    return path


def polygon(path: JerkPath, step: float, corners: int) -> JerkPath:
    x, y = 0.0, 0.0
    for k in range(corners):
        x, y = x + step * cos(2.0 * pi * k / corners), y + step * sin(2.0 * pi * k / corners)
        path.line(x, y, 0.0)
    return path


def pocket(path: JerkPath) -> JerkPath:
    """A pocket with corners of ever smaller radius."""
    x = 0.0
    for k, radius in enumerate((8.0, 5.0, 3.0, 2.0)):
        path.line(x + 20.0, 60.0 * (k % 2), 0.0)
        side = 1.0 if k % 2 == 0 else -1.0
        y = 60.0 * (k % 2)
        path.arc(x + 20.0, y + side * radius, side * pi / 2.0)
        x += 20.0 + radius
        path.line(x, 60.0 - 60.0 * (k % 2) - side * radius, 0.0)
        path.arc(x + radius, 60.0 - 60.0 * (k % 2) - side * radius, -side * pi / 2.0)
        x += radius
    return path


def jerk_paths(acceleration: AccelerationMode | None = None) -> list[JerkPath]:
    """The paths, in a context that says how they are accelerated."""

    def made(name: str, tolerance: float, feed: float = 1000.0) -> JerkPath:
        return JerkPath(name, tolerance, feed, acceleration)

    return [
        made("line of 200 mm", 0.01).line(200.0, 0.0, 0.0),
        made("line of 200 mm at 100 mm/s", 0.01, 100.0).line(150.0, 120.0, 40.0),
        zigzag(made("zigzag 20 mm, 90°, 0.1 mm", 0.1), 20.0, 8, pi / 2.0),
        zigzag(made("zigzag 10 mm, 90°, 0.01 mm", 0.01), 10.0, 8, pi / 2.0),
        zigzag(made("zigzag 10 mm, 30°, 0.05 mm", 0.05), 10.0, 10, pi / 6.0),
        zigzag(made("zigzag 5 mm, 5°, 0.01 mm", 0.01), 5.0, 20, pi / 36.0),
        zigzag(made("zigzag 2 mm, 20°, 0.05 mm", 0.05), 2.0, 20, pi / 9.0),
        zigzag(made("zigzag 0.5 mm, 5°, 0.01 mm", 0.01), 0.5, 60, pi / 36.0),
        polygon(made("square of 50 mm, 0.2 mm", 0.2), 50.0, 4),
        polygon(made("hexagon of 15 mm, 0.05 mm", 0.05), 15.0, 6),
        polygon(made("24 corners of 6 mm, 0.02 mm", 0.02), 6.0, 24),
        made("facets of 0.2 mm on 10 mm", 0.01).through(circle(10.0), 314, Kind.FEED),
        made("facets of 0.5 mm on 20 mm", 0.01).through(circle(20.0), 251, Kind.FEED),
        made("facets of 1 mm on 30 mm", 0.02).through(circle(30.0), 188, Kind.FEED),
        made("facets of 0.1 mm on 3 mm", 0.005).through(circle(3.0), 188, Kind.FEED),
        made("facets of 0.2 mm on 20 mm at 60 mm/s", 0.01, 60.0).through(circle(20.0), 628, Kind.FEED),
        made("facets of a wave", 0.01).through(wave(100.0, 6.0, 2.0), 400, Kind.FEED),
        made("facets of a flat wave", 0.005).through(wave(200.0, 2.0, 2.0), 300, Kind.FEED),
        made("facets of a spiral", 0.01).through(growing, 500, Kind.FEED),
        made("facets of a loop", 0.02).through(loop, 1500, Kind.FEED),
        made("circle of 20 mm", 0.01).arc(0.0, 20.0, 2.0 * pi),
        made("circle of 5 mm", 0.01).arc(0.0, 5.0, 2.0 * pi),
        made("slot", 0.01).line(60.0, 0.0, 0.0).arc(60.0, 12.0, pi).line(0.0, 24.0, 0.0).arc(0.0, 12.0, pi),
        made("helix", 0.01).arc(0.0, 10.0, 6.0 * pi, rise=15.0),
        made("spiral", 0.01).arc(0.0, 5.0, 2.0 * pi, growth=6.0).arc(0.0, 5.0, 2.0 * pi, growth=6.0),
        pocket(made("lines and arcs of smaller radius", 0.01)),
        made("spline of a loop", 0.01).through(loop, 600, Kind.SPLINE),
        made("spline of a wave", 0.01).through(wave(100.0, 8.0, 4.0), 300, Kind.SPLINE),
        made("spline of a spiral", 0.01).through(growing, 300, Kind.SPLINE),
        made("spline of a flat wave at 120 mm/s", 0.01, 120.0).through(
            wave(200.0, 5.0, 3.0), 300, Kind.SPLINE
        ),
    ]
