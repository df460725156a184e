"""Random straight rows of a tool's tip on machines of five axes, and the least time in which their axes can run them.

The bound is that of time-optimal path parametrisation: the square x of the path speed at many places of a row, so large
that between two of them every axis keeps its velocity, and its acceleration `q''·x + q'·x'/2` at both. The largest x at
every place at once is the quickest motion (H. Pham and Q.-C. Pham, IEEE T-RO 34, 2018): one linear programme. The
derivatives of the axes are differences of their positions, so that nothing of the planner enters.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from polycnc.machine import Machine, load_machine
from polycnc.machine.kinematics import Kinematics
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polycnc.transformation.contract import Transformation

Numbers: TypeAlias = "NDArray[np.float64]"
#: Unknowns of a row; part of it over which a derivative is a difference.
PLACES, STEP = 300, 1e-4


class FiveAxes(NamedTuple):
    """A machine and what leads its axes."""

    machine: Machine
    tip: ToolCentrePoint


class TipPath(NamedTuple):
    """Rows from rest to rest, one after the other: points of the tip and angles of the rotary axes, and a feed."""

    name: str
    axes: FiveAxes
    points: list[list[float]]
    feed: float


def machines() -> dict[str, FiveAxes]:
    """Both rotary axes in the head, in the table, and one in each."""
    head, table = load_machine("mill5-bc-head"), load_machine("mill5-ac-table")
    joints = {joint.axis: joint for joint in head.tool_chain if joint.rotary}
    offset = replace(joints["C"], offset=(12.0, -7.0, 30.0))
    mixed = Kinematics((joints["B"],), (offset,))
    return {
        "head": FiveAxes(head, _tip(head, Kinematics.of(head))),
        "table": FiveAxes(table, _tip(table, Kinematics.of(table))),
        "mixed": FiveAxes(head, _tip(head, mixed)),
    }


def _tip(machine: Machine, kinematics: Kinematics) -> ToolCentrePoint:
    axes = machine.channel_axes(1)
    zero = tuple(3.0 * i - 5.0 for i in range(len(axes)))
    return ToolCentrePoint(kinematics, axes, (0, 1, 2), zero, (0.0, 0.0, -120.0))


def random_paths(count: int, seed: int) -> list[TipPath]:
    """Paths of one to three rows: short and long, that turn little or much, slow and faster than the axes can go."""
    random, kinds = Random(seed), list(machines().items())
    paths = []
    for number in range(count):
        name, axes = kinds[number % len(kinds)]
        size, turn = random.choice([2.0, 20.0, 150.0]), random.choice([5.0, 30.0, 90.0])
        points = [
            [
                *(random.uniform(-size, size) for _ in range(3)),
                *(random.uniform(-turn, turn) for _ in range(2)),
            ]
            for _ in range(random.randint(2, 4))
        ]
        paths.append(TipPath(f"{number} {name}", axes, points, random.choice([20.0, 100.0, 1000.0])))
    return paths


class TipArc(NamedTuple):
    """An arc or a helix of the tip from rest to rest, while the rotary axes turn evenly, and its feed."""

    name: str
    axes: FiveAxes
    center: list[float]
    radius: float
    angles: tuple[float, float]
    lift: float
    turns: list[tuple[float, float]]
    feed: float

    def at(self, shares: Numbers) -> Numbers:
        """Points of the path at shares of it, (k, 5)."""
        angle = self.angles[0] + (self.angles[1] - self.angles[0]) * shares
        x, y, z = self.center
        tip = [x + self.radius * np.cos(angle), y + self.radius * np.sin(angle), z + self.lift * shares]
        return np.stack([*tip, *(a + (b - a) * shares for a, b in self.turns)], axis=1)

    @property
    def length(self) -> float:
        """As the feed counts it, mm: the tip alone."""
        return float(np.hypot(self.radius * (self.angles[1] - self.angles[0]), self.lift))


def random_arcs(count: int, seed: int) -> list[TipArc]:
    """Arcs of all sizes, along which the rotary axes stand still or turn, slow and faster than the axes can go."""
    random, kinds, arcs = Random(seed), list(machines().items()), []
    for number in range(count):
        name, axes = kinds[number % len(kinds)]
        turn, begin = random.choice([0.0, 5.0, 30.0, 90.0]), random.uniform(0.0, 6.28)
        radius = random.choice([2.0, 20.0, 150.0]) * random.uniform(0.5, 1.5)
        arcs.append(
            TipArc(
                f"{number} {name}",
                axes,
                [random.uniform(-50.0, 50.0) for _ in range(3)],
                radius,
                (begin, begin + random.uniform(0.2, 6.28)),
                random.choice([0.0, 0.0, random.uniform(-20.0, 20.0)]),
                [(random.uniform(-turn, turn), random.uniform(-turn, turn)) for _ in range(2)],
                random.choice([20.0, 100.0, 1000.0]),
            )
        )
    return arcs


def least_time_of_arc(arc: TipArc) -> float:
    """Seconds that the axes of the machine need at least."""
    shares = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, PLACES + 1))
    before, here, after = (
        np.stack(arc.axes.tip.to_machine(list(arc.at(shares + late).T)), axis=1)
        for late in (-STEP, 0.0, STEP)
    )
    step = STEP * arc.length
    first, second = (after - before) / (2.0 * step), (after - 2.0 * here + before) / step**2
    return _quickest(arc.axes, first, second, np.diff(shares) * arc.length, arc.feed)


def least_time(path: TipPath) -> float:
    """Seconds that the axes of the machine need at least."""
    return sum(
        _row_time(path, np.array(a), np.array(b)) for a, b in zip(path.points, path.points[1:], strict=False)
    )


def derivatives(tip: Transformation, start: Numbers, end: Numbers, length: float, shares: Numbers) -> Any:
    """First and second derivative of the real axes by the way, each (k, n), at shares of a row."""
    before, here, after = (
        np.stack(tip.to_machine(list((start + (end - start) * (shares + late)[:, None]).T)), axis=1)
        for late in (-STEP, 0.0, STEP)
    )
    step = STEP * length
    return (after - before) / (2.0 * step), (after - 2.0 * here + before) / step**2


def _row_time(path: TipPath, start: Numbers, end: Numbers) -> float:
    length = float(np.linalg.norm((end - start)[:3]) or np.linalg.norm(end - start))
    shares = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, PLACES + 1))
    first, second = derivatives(path.axes.tip, start, end, length, shares)
    return _quickest(path.axes, first, second, np.diff(shares) * length, path.feed)


def _quickest(axes: FiveAxes, first: Numbers, second: Numbers, step: Numbers, feed: float) -> float:
    """Seconds from rest to rest, with derivatives of the real axes, (k, n), at places `step` apart."""
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix, vstack

    tops = np.array([axes.machine.axis[name].max_feed for name in axes.tip.axes])
    pulls = np.array([axes.machine.axis[name].acceleration for name in axes.tip.axes])
    cap2 = np.minimum(np.min((tops / np.maximum(np.abs(first), 1e-12)) ** 2, axis=1), feed**2)
    cap2[0] = cap2[-1] = 0.0
    here = np.arange(PLACES)
    rows = []
    for end_of in (0, 1):
        for i in range(len(pulls)):
            push = first[end_of : PLACES + end_of, i] / (2.0 * step)
            bend = second[end_of : PLACES + end_of, i]
            values = np.concatenate([-push + bend * (1 - end_of), push + bend * end_of]) / pulls[i]
            places = np.concatenate([here, here]), np.concatenate([here, here + 1])
            asked = coo_matrix((values, places), shape=(PLACES, PLACES + 1))
            rows += [asked, -asked]
    scale = float(cap2.max())
    found = linprog(
        -np.ones(PLACES + 1),
        A_ub=vstack(rows).tocsr() * scale,
        b_ub=np.ones(PLACES * len(rows)),
        bounds=np.stack([np.zeros(PLACES + 1), cap2 / scale], axis=1),
        method="highs",
    )
    assert found.status == 0, found.message
    speed = np.sqrt(np.maximum(found.x * scale, 0.0))
    return float(np.sum(2.0 * step / np.maximum(speed[1:] + speed[:-1], 1e-9)))
