"""Random programmed paths, and the distance of a bent path from one."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from hypothesis import strategies as st

from polycnc.motion.third_order.bend import legs
from polycnc.motion.third_order.bends.stretches import LINE, curve_lines
from tests.motion.third_order.programmed import Bounds, ProgrammedPath

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.bent_path import BentPath

Numbers: TypeAlias = "NDArray[np.float64]"
#: Angle between points that stand for an arc, radians.
FINE = 0.002
TOPS = (250.0, 250.0, 250.0, 90.0)


@dataclass
class Drawn:
    """A path of X, Y, Z and a rotary axis: as it is programmed, and as the points of each row."""

    path: ProgrammedPath = field(
        default_factory=lambda: ProgrammedPath([0.0] * 4, TOPS, (False, False, False, True))
    )
    points: list[Numbers] = field(default_factory=list)
    bounds: list[Bounds] = field(default_factory=list)
    heading: float = 0.0

    def _row(self, points: Numbers, bounds: Bounds) -> int:
        self.points.append(points)
        self.bounds.append(bounds)
        return len(self.points) - 1

    def line(self, length: float, turn: float, rise: float, degrees: float, bounds: Bounds) -> None:
        self.heading += turn
        here = np.array(self.path.position)
        end = here + np.array(
            [length * cos(self.heading), length * sin(self.heading), rise * length, degrees]
        )
        self.path.line(end.tolist(), self._row(np.stack([here, end]), bounds), bounds)

    def facets(self, radius: float, sweep: float, count: int, bounds: Bounds) -> None:
        for _ in range(count):
            self.line(2.0 * radius * sin(abs(sweep) / count / 2.0), sweep / count, 0.0, 0.0, bounds)

    def wave(self, length: float, height: float, count: int, bounds: Bounds) -> None:
        """Chords of a spline, which goes on straight before and behind it."""
        here, (c, s) = np.array(self.path.position), (cos(self.heading), sin(self.heading))
        for k in range(1, count + 1):
            x, y = length * k / count, height * (1.0 - cos(2.0 * pi * k / count))
            end = here + np.array([c * x - s * y, s * x + c * y, 0.0, 0.0])
            before = np.array(self.path.position)
            self.path.chord(end.tolist(), self._row(np.stack([before, end]), bounds), bounds)

    def arc(
        self, radius: float, sweep: float, growth: float, rise: float, degrees: float, bounds: Bounds
    ) -> None:
        """Tangentially on, unless its radius grows."""
        sense = 1.0 if sweep > 0.0 else -1.0
        here = np.array(self.path.position)
        inward = np.array([-sin(self.heading), cos(self.heading)]) * sense
        centre, first = here[:2] + radius * inward, self.heading - sense * pi / 2.0
        share = np.linspace(0.0, 1.0, int(abs(sweep) / FINE) + 2)
        own, angle = radius + growth * radius * share, first + sweep * share
        points = np.stack(
            [
                centre[0] + own * np.cos(angle),
                centre[1] + own * np.sin(angle),
                here[2] + rise * share,
                here[3] + degrees * share,
            ],
            axis=1,
        )
        points[0] = here
        number = self._row(points, bounds)
        self.path.arc(
            points[-1].tolist(), (centre[0], centre[1], 0.0), (0.0, 0.0, 1.0), sweep, number, bounds
        )
        self.heading += sweep


SIZES = st.floats(0.05, 20.0)
TURNS = st.one_of(st.floats(-0.3, 0.3), st.floats(-2.6, 2.6), st.just(0.0))


@st.composite
def drawn_paths(draw: st.DrawFn, tolerances: st.SearchStrategy[float], *, turning: bool = True) -> Drawn:
    """Lines, facets, arcs and splines in random order."""
    drawn, degrees = Drawn(), st.floats(-20.0, 20.0) if turning else st.just(0.0)
    one = draw(tolerances)
    for _ in range(draw(st.integers(1, 8))):
        bounds = Bounds(one, draw(st.floats(10.0, 500.0)), 2.0 * one)
        kind = draw(st.sampled_from(("line", "lines", "facets", "arc", "wave")))
        if kind == "line":
            drawn.line(draw(SIZES), draw(TURNS), draw(st.sampled_from((0.0, 0.3))), draw(degrees), bounds)
        elif kind == "lines":
            short, turns = draw(st.floats(0.01, 2.0)), draw(st.lists(TURNS, min_size=2, max_size=12))
            for turn in turns:
                drawn.line(short, turn, 0.0, 0.0, bounds)
        elif kind == "facets":
            drawn.facets(draw(SIZES), draw(st.floats(0.2, 6.0)), draw(st.integers(3, 60)), bounds)
        elif kind == "wave":
            drawn.wave(draw(SIZES), draw(st.floats(0.01, 2.0)), draw(st.integers(8, 40)), bounds)
        else:
            sense = draw(st.sampled_from((-1.0, 1.0)))
            growth = draw(st.sampled_from((0.0, 0.0, 0.5, -0.4)))
            rise, turn = draw(st.sampled_from((0.0, 3.0))), draw(degrees)
            drawn.arc(draw(SIZES), sense * draw(st.floats(0.1, 7.0)), growth, rise, turn, bounds)
    return drawn


def parts_of_tolerance(drawn: Drawn, bent: list[BentPath], each: int = 8) -> tuple[float, float]:
    """The largest parts of the tolerances that a bent path uses, of linear and of rotary axes, looked at densely.

    The distance is that from the place of the programmed path at the same way: no less than that to the path. A line
    counts as one; arcs and chords of splines are the curves of their stretches.
    """
    lines = turns = 0.0
    for part, leg in zip(legs(drawn.path.path), bent, strict=True):
        line, turn = parts_of_leg(part, leg, each)
        lines, turns = max(lines, line), max(turns, turn)
    return float(lines), float(turns)


def parts_of_leg(path: Stretches, leg: BentPath, each: int) -> tuple[float, float]:
    """The same of one leg."""
    n = len(path.rotary)
    curve_lines(path, n, array("q", bytes(8 * len(path.way))))
    way, form = np.asarray(path.way), np.asarray(path.form)
    place = np.asarray(path.place).reshape(-1, n)
    leave, arrive = (np.asarray(v).reshape(-1, n) for v in (path.leave, path.arrive))
    inner = leg.way[:-1, None] + np.diff(leg.way)[:, None] * (np.arange(each) / each)
    s = np.concatenate([inner.ravel(), way])
    k = np.clip(np.searchsorted(way, s, "right") - 1, 0, len(form) - 1)
    length = (way[k + 1] - way[k])[:, None]
    f = np.clip((s - way[k])[:, None] / length, 0.0, 1.0)
    chord = place[k + 1] - place[k]
    curve = (1.0 - f) * (leave[k] * length - chord) - f * (arrive[k] * length - chord)
    there = place[k] + f * (chord + np.where(form[k, None] == LINE, 0.0, 1.0 - f) * curve)
    apart = leg.at(s)[0] - there
    turns = np.asarray(path.rotary) != 0.0
    part = np.sqrt((apart[:, ~turns] ** 2).sum(1)) / np.asarray(path.tolerance)[k]
    turned = np.abs(apart[:, turns]) / np.asarray(path.turn_tolerance)[k, None]
    return float(part.max()), float(turned.max(initial=0.0))
