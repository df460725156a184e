"""The planner against its limits: segments a second, and the time-optimal bound that toppra computes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import cos, pi, sin, sqrt
from random import Random
from typing import Any, NamedTuple

from benchmarks.measure import Figure, best_of, rate, skipped
from benchmarks.planner_paths import Path, Section, Vector, paths
from polycnc.machine import load_machine
from polycnc.motion import Settings
from polycnc.motion.kernels.columns import PIECE_BLOCKS, PLACES, Form, PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.settings import DEFAULT
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.modes import AccelerationMode, CornerMode

SEGMENTS_PER_SECOND = 300_000
#: Rows of contours in which jerk binds everywhere.
CORNERS = 20_000
WORST_RATIO = 1.02
#: Part of the rate of short programs that long ones keep: the cost is linear.
LINEAR = 0.8
#: Steps of the reference over a path whose corners are bent, and over a piece of it at least.
STEPS, STEPS_OF_PIECE = 3000, 6


def spiral(rows: int) -> Iterator[list[float]]:
    """Short cuts over a wavy surface."""
    for k in range(rows):
        angle, radius = 0.01 * k, 10.0 + 2e-4 * k
        yield [radius * cos(angle), radius * sin(angle), 2.0 * sin(0.07 * k)]


def staircase(rows: int) -> Iterator[list[float]]:
    """Rows of 0.5 mm in X and in Y, in turn."""
    for k in range(1, rows + 1):
        yield [0.5 * ((k + 1) // 2), 0.5 * (k // 2), 0.0]


def wandering(rows: int) -> Iterator[list[float]]:
    """Rows of 0.2 to 2 mm in random directions of half a plane."""
    random, x, y = Random(5), 0.0, 0.0
    for _ in range(rows):
        heading, length = random.uniform(-1.3, 1.3), random.uniform(0.2, 2.0)
        x, y = x + length * cos(heading), y + length * sin(heading)
        yield [x, y, 0.0]


def segments_per_second(
    rows: int = 600_000,
    settings: Settings = DEFAULT,
    contour: Callable[[int], Iterator[list[float]]] = spiral,
    corners: CornerMode = CornerMode.CONTINUOUS,
) -> float:
    """Rows of a contour planned a second, kernels compiled and warm."""
    toolpath = Toolpath(("X", "Y", "Z"))
    number = toolpath.context_number(Context(tolerance_mm=0.01, corner_mode=corners))
    for k, end in enumerate(contour(rows), 1):
        toolpath.append(Kind.FEED, 0, k, number, 80.0, end)
        toolpath.block_boundary()
    machine = load_machine("mill3")

    def planned_once() -> object:
        return Planner(toolpath, machine, settings=settings).finish()

    planned_once()
    return rows / best_of(planned_once)


class Driven(NamedTuple):
    """What the planner makes of a path.

    Attributes:
        seconds: How long it takes.
        sections: The path that is driven.
        joints: The bound on squared speed at the start of each section where the path is not smooth.
    """

    seconds: float
    sections: list[Section]
    joints: dict[int, float]


def planned(path: Path) -> Driven:
    """Plan a path. One whose corners are bent is driven as its pieces tell, and is smooth; every other as it is."""
    n, records, entries = len(path.axes), list[list[float]](), dict[int, float]()
    width = piece_width(n)

    def note(pieces: Any, count: int) -> None:
        for at in range(0, count * width, width):
            records.append(pieces[at : at + width].tolist())
            entries.setdefault(int(pieces[at + PieceRecord.ROW]), pieces[at + PieceRecord.ENTRY2])

    seconds = Planner(path.toolpath, path.machine, on_pieces=note).finish().total_s
    if any(record[PieceRecord.ZONE] for record in records):
        way = sum(record[PieceRecord.LENGTH] for record in records)
        return Driven(seconds, [_section(record, n, way) for record in records], {})
    joints = {row: entries[row] for row in range(1, len(path.sections))}
    return Driven(seconds, path.sections, joints)


def _section(record: list[float], n: int, way: float) -> Section:
    """A piece of a path that is so long as a section: a line, or the cubic through its ends with their tangents."""
    length, at = record[PieceRecord.LENGTH], PieceRecord.VECTORS
    blocks = [record[at + k * n : at + (k + 1) * n] for k in range(PIECE_BLOCKS)]
    scale, (first, last) = length / record[PieceRecord.MARGIN], blocks[PLACES:]
    ways = [b - a for a, b in zip(first, last, strict=True)]
    ends = [ways, ways]
    if record[PieceRecord.FORM] != Form.STRAIGHT:
        ends = [[scale * q for q in tangent] for tangent in blocks[:2]]
    leaves, arrives = ([t - d for t, d in zip(tangent, ways, strict=True)] for tangent in ends)
    axes = list(zip(first, ways, leaves, arrives, strict=True))

    def curve(s: float) -> tuple[Vector, Vector, Vector]:
        f = min(max(s / length, 0.0), 1.0)
        return (
            tuple(p + f * (d + (1.0 - f) * ((1.0 - f) * b - f * e)) for p, d, b, e in axes),
            tuple(
                (d + (1.0 - f) * (1.0 - 3.0 * f) * b + f * (3.0 * f - 2.0) * e) / length
                for _, d, b, e in axes
            ),
            tuple(((6.0 * f - 4.0) * b + (6.0 * f - 2.0) * e) / length**2 for _, _, b, e in axes),
        )

    return Section(length, curve, max(STEPS_OF_PIECE, round(STEPS * length / way)))


def reference(path: Path, driven: Driven) -> float:
    """Seconds of the time-optimal plan that toppra finds on the path that is driven, given the bounds at its joints."""
    import numpy as np
    import toppra
    from toppra.constraint import (
        DiscretizationType,
        JointAccelerationConstraint,
        JointVelocityConstraintVarying,
    )

    toppra.setup_logging("ERROR")
    machine = path.machine
    sections = driven.sections
    starts = np.concatenate([[0.0], np.cumsum([section.length for section in sections])])
    # No derivative is taken across a joint: there is a grid point at either side of it.
    gap = 1e-9 * starts[-1]
    # The path's length is one more axis; its speed limit is the feed.
    tops = np.array([machine.axis[name].max_feed for name in path.axes] + [path.feed])
    pulls = np.array([machine.axis[name].acceleration for name in path.axes] + [1e6])
    joints = {float(starts[i]): max(sqrt(entry2), 0.01) for i, entry2 in driven.joints.items()}

    def speeds(s: float) -> Any:
        top = tops.copy()
        top[-1] = min([top[-1], *(speed for joint, speed in joints.items() if abs(s - joint) < 2.0 * gap)])
        return np.stack([-top, top], axis=1)

    points = _grid(sections, starts, gap)
    scheme = DiscretizationType.Collocation
    limits = [
        JointVelocityConstraintVarying(speeds),
        JointAccelerationConstraint(np.stack([-pulls, pulls], axis=1), discretization_scheme=scheme),
    ]
    algorithm = toppra.algorithm.TOPPRA(
        limits, _curve(sections, starts, len(path.axes)), gridpoints=points, solver_wrapper="seidel"
    )
    _, speed, _ = algorithm.compute_parameterization(0.0, 0.0)
    return float(np.sum(2.0 * np.diff(points) / (speed[1:] + speed[:-1])))


def _grid(sections: list[Section], starts: Any, gap: float) -> Any:
    """Places along the path, closer near the joints, where the speed changes most."""
    import numpy as np

    inner = [
        start
        + gap
        + (0.5 - 0.5 * np.cos(np.linspace(0.0, pi, section.steps + 1))) * (section.length - 2.0 * gap)
        for start, section in zip(starts[:-1], sections, strict=True)
    ]
    return np.concatenate([[0.0], *inner, [starts[-1]]])


def _curve(sections: list[Section], starts: Any, axes: int) -> Any:
    """The sections end to end, in the form that toppra reads."""
    import numpy as np
    from toppra.interpolator import AbstractGeometricPath

    class Curve(AbstractGeometricPath):  # type: ignore[misc]
        """All axes, and the length."""

        dof = axes + 1
        path_interval = np.array([0.0, starts[-1]])
        waypoints = None

        def __call__(self, places: Any, order: int = 0) -> Any:
            values = [self.at(float(s), order) for s in np.atleast_1d(places)]
            return np.array(values[0] if np.ndim(places) == 0 else values)

        def at(self, s: float, order: int) -> list[float]:
            """Position or derivative at a length."""
            i = min(int(np.searchsorted(starts, s, "right")) - 1, len(sections) - 1)
            return [*sections[i].curve(s - starts[i])[order], (s, 1.0, 0.0)[order]]

    return Curve()


def ratios() -> dict[str, float]:
    """The planner's time over the reference's, by name of the path."""
    result = {}
    for path in paths():
        driven = planned(path)
        result[path.name] = driven.seconds / reference(path, driven)
    return result


def speed() -> Iterator[Figure]:
    """Segments a second, without and with limited jerk, and the growth of the cost with their number."""
    yield rate("planner", segments_per_second(), SEGMENTS_PER_SECOND, "segments/s")
    soft = Settings(acceleration=AccelerationMode.JERK_LIMITED)
    yield rate("planner, limited jerk", segments_per_second(settings=soft), SEGMENTS_PER_SECOND, "segments/s")
    bent = segments_per_second(settings=replace(soft, bends_by_way=True))
    yield rate("planner, jerk by a law of third order", bent, SEGMENTS_PER_SECOND, "segments/s")
    for name, contour in (("a staircase", staircase), ("random directions", wandering)):
        found = segments_per_second(
            CORNERS, replace(soft, bends_by_way=True), contour, corners=CornerMode.ROUNDED
        )
        yield rate(f"planner, law of third order, {name}", found, SEGMENTS_PER_SECOND, "segments/s")
    few, *more = (segments_per_second(rows) for rows in (10_000, 100_000, 1_000_000))
    for name, many in zip(("1e5", "1e6"), more, strict=True):
        said = f"{name} segments at {many / few:.2f} of the rate of 1e4, limit {LINEAR}"
        yield Figure(f"planner, cost of {name} segments", said, many / few / LINEAR)


def optimum() -> Iterator[Figure]:
    """Time against the bound that toppra computes, path by path."""
    try:
        import toppra  # noqa: F401
    except ImportError:
        yield skipped("time-optimal bound", "toppra is not installed (extra `bench`)")
        return
    for name, ratio in ratios().items():
        said = f"{ratio:.4f} of the time-optimal bound, limit {WORST_RATIO}"
        yield Figure(f"planned time, {name}", said, WORST_RATIO / ratio)
