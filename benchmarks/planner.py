"""The planner against its limits: segments a second, and the time-optimal bound that toppra computes."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, sin, sqrt
from typing import Any

from benchmarks.measure import Figure, best_of, rate, skipped
from benchmarks.planner_paths import Path, paths
from polycnc.machine import load_machine
from polycnc.motion import Settings
from polycnc.motion.kernels.columns import PieceRecord, piece_width
from polycnc.motion.planner import Planner
from polycnc.motion.settings import DEFAULT
from polycnc.toolpath import Context, Kind, Toolpath
from polycnc.toolpath.modes import AccelerationMode

SEGMENTS_PER_SECOND = 300_000
WORST_RATIO = 1.03
#: Part of the rate of short programs that long ones keep: the cost is linear.
LINEAR = 0.8


def segments_per_second(rows: int = 600_000, settings: Settings = DEFAULT) -> float:
    """Rows planned a second: a spiral of short cuts over a wavy surface, kernels compiled and warm."""
    toolpath = Toolpath(("X", "Y", "Z"))
    number = toolpath.context_number(Context(tolerance_mm=0.01))
    for k in range(rows):
        angle, radius = 0.01 * k, 10.0 + 2e-4 * k
        end = [radius * cos(angle), radius * sin(angle), 2.0 * sin(0.07 * k)]
        toolpath.append(Kind.FEED, 0, k + 1, number, 80.0, end)
        toolpath.block_boundary()
    machine = load_machine("mill3")

    def planned_once() -> object:
        return Planner(toolpath, machine, settings=settings).finish()

    planned_once()
    return rows / best_of(planned_once)


def planned(path: Path) -> tuple[float, dict[int, float]]:
    """Seconds that the planner gives a path, and the bound on squared speed at the start of each row."""
    entries: dict[int, float] = {}
    width = piece_width(len(path.axes))

    def note(pieces: Any, count: int) -> None:
        for at in range(0, count * width, width):
            entries.setdefault(int(pieces[at + PieceRecord.ROW]), pieces[at + PieceRecord.ENTRY2])

    return Planner(path.toolpath, path.machine, on_pieces=note).finish().total_s, entries


def reference(path: Path, entries: dict[int, float]) -> float:
    """Seconds of the time-optimal plan that toppra finds, given the planner's bounds at the joints."""
    import numpy as np
    import toppra
    from toppra.constraint import (
        DiscretizationType,
        JointAccelerationConstraint,
        JointVelocityConstraintVarying,
    )

    toppra.setup_logging("ERROR")
    machine = path.machine
    starts = np.concatenate([[0.0], np.cumsum([section.length for section in path.sections])])
    # No derivative is taken across a joint: there is a grid point at either side of it.
    gap = 1e-9 * starts[-1]
    # The path's length is one more axis; its speed limit is the feed.
    tops = np.array([machine.axis[name].max_feed for name in path.axes] + [path.feed])
    pulls = np.array([machine.axis[name].acceleration for name in path.axes] + [1e6])
    joints = {float(starts[i]): max(sqrt(entries[i]), 0.01) for i in range(1, len(path.sections))}

    def speeds(s: float) -> Any:
        top = tops.copy()
        top[-1] = min([top[-1], *(speed for joint, speed in joints.items() if abs(s - joint) < 2.0 * gap)])
        return np.stack([-top, top], axis=1)

    points = _grid(path, starts, gap)
    scheme = DiscretizationType.Collocation
    limits = [
        JointVelocityConstraintVarying(speeds),
        JointAccelerationConstraint(np.stack([-pulls, pulls], axis=1), discretization_scheme=scheme),
    ]
    algorithm = toppra.algorithm.TOPPRA(
        limits, _curve(path, starts), gridpoints=points, solver_wrapper="seidel"
    )
    _, speed, _ = algorithm.compute_parameterization(0.0, 0.0)
    return float(np.sum(2.0 * np.diff(points) / (speed[1:] + speed[:-1])))


def _grid(path: Path, starts: Any, gap: float) -> Any:
    """Places along the path, closer near the joints, where the speed changes most."""
    import numpy as np

    inner = [
        start
        + gap
        + (0.5 - 0.5 * np.cos(np.linspace(0.0, pi, section.steps + 1))) * (section.length - 2.0 * gap)
        for start, section in zip(starts[:-1], path.sections, strict=True)
    ]
    return np.concatenate([[0.0], *inner, [starts[-1]]])


def _curve(path: Path, starts: Any) -> Any:
    """The sections end to end, in the form that toppra reads."""
    import numpy as np
    from toppra.interpolator import AbstractGeometricPath

    class Curve(AbstractGeometricPath):  # type: ignore[misc]
        """All axes, and the length."""

        dof = len(path.axes) + 1
        path_interval = np.array([0.0, starts[-1]])
        waypoints = None

        def __call__(self, places: Any, order: int = 0) -> Any:
            values = [self.at(float(s), order) for s in np.atleast_1d(places)]
            return np.array(values[0] if np.ndim(places) == 0 else values)

        def at(self, s: float, order: int) -> list[float]:
            """Position or derivative at a length."""
            i = min(int(np.searchsorted(starts, s, "right")) - 1, len(path.sections) - 1)
            return [*path.sections[i].curve(s - starts[i])[order], (s, 1.0, 0.0)[order]]

    return Curve()


def ratios() -> dict[str, float]:
    """The planner's time over the reference's, by name of the path."""
    result = {}
    for path in paths():
        seconds, entries = planned(path)
        result[path.name] = seconds / reference(path, entries)
    return result


def speed() -> Iterator[Figure]:
    """Segments a second, without and with limited jerk, and the growth of the cost with their number."""
    yield rate("planner", segments_per_second(), SEGMENTS_PER_SECOND, "segments/s")
    soft = Settings(acceleration=AccelerationMode.JERK_LIMITED)
    yield rate("planner, limited jerk", segments_per_second(settings=soft), SEGMENTS_PER_SECOND, "segments/s")
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
