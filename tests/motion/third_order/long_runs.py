"""Long runs for tests: paths behind one another as stretches, and the windows that a planner makes of them."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any

import numpy as np

from polycnc.motion.third_order.bend import as_path
from polycnc.motion.third_order.bent_path import BentPath
from polycnc.motion.third_order.law import law_of
from polycnc.motion.third_order.runs import RunPlanner, Sizes
from tests.motion.third_order.laws import AXES, used

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from polycnc.motion.third_order.bends.stretches import Stretches
    from polycnc.motion.third_order.laws.courses import Axes
    from polycnc.motion.third_order.windows import Window

#: So short windows that a test has many of them.
SHORT = Sizes(stretches=120, seconds=0.3, most=400, range=16, around=32)


def behind_one_another(paths: Iterable[Stretches]) -> Stretches:
    """Each path begins where the one before ends."""
    whole: Stretches | None = None
    for path in paths:
        if whole is None:
            whole = path._replace(**{name: array(v.typecode, v) for name, v in _columns(path).items()})
            continue
        n, end, rows = len(path.rotary), whole.place[-len(path.rotary) :], whole.row[-1] + 1
        gone = whole.way[-1]
        whole.way.extend([gone + way for way in path.way[1:]])
        moved = (place - path.place[i % n] + end[i % n] for i, place in enumerate(path.place))
        whole.place.extend(list(moved)[n:])
        whole.row.extend(rows + row - path.row[0] for row in path.row)
        for name, values in _columns(path).items():
            if name not in ("way", "place", "row"):
                getattr(whole, name).extend(values)
    assert whole is not None
    return whole


def _columns(path: Stretches) -> dict[str, Any]:
    return {name: v for name, v in path._asdict().items() if name not in ("rotary", "top")}


def chunks(path: Stretches, counts: Iterable[int]) -> Iterator[Stretches]:
    """A path in chunks of so many stretches each, the last one with what is left."""
    n, first, all_ = len(path.rotary), 0, len(path.form)
    for count in counts:
        end = min(first + count, all_)
        if end > first:
            yield part_of(path, n, first, end)
        first = end
    if first < all_:
        yield part_of(path, n, first, all_)


def part_of(path: Stretches, n: int, first: int, end: int) -> Stretches:
    """Some of the stretches of a path, whose ways go on."""
    cut: dict[str, Any] = {name: v[first:end] for name, v in _columns(path).items()}
    cut |= {name: getattr(path, name)[first * n : end * n] for name in ("leave", "arrive")}
    cut |= {"way": path.way[first : end + 1], "place": path.place[first * n : (end + 1) * n]}
    return path._replace(**cut)


def windows_of(
    path: Stretches, sizes: Sizes = SHORT, axes: Axes = AXES, counts: Iterable[int] = ()
) -> list[Window]:
    """What a planner makes of a run; no law must begin elsewhere than where it shall."""
    made: list[Window] = []
    planner = RunPlanner(axes, made.append, sizes=sizes)
    for chunk in chunks(path, counts):
        planner.take(chunk)
    planner.finish()
    assert planner.detours == 0
    return made


def seconds_of(windows: list[Window]) -> float:
    """How long they take."""
    return sum(law_of(w.phases, w.part.way[-1]).seconds for w in windows)


def most_used(windows: list[Window], axes: Axes = AXES) -> float:
    """The largest part of any limit in any of them."""
    return max(float(used(as_path(w.part), law_of(w.phases, w.part.way[-1]), axes).max()) for w in windows)


def gaps(windows: list[Window]) -> NDArray[np.float64]:
    """By how much place, q', q'', speed and acceleration of neighbours differ, and the latter from rest at rests."""
    found = [np.zeros(5)]
    motion = np.zeros(2)
    for before, behind in zip([None, *windows], [*windows, None], strict=True):
        apart = np.zeros(5)
        if before is not None:
            law = law_of(before.phases, before.part.way[-1])
            _, speed, pull, _ = law.at(np.array([law.seconds]))
            motion = np.array([speed[0], pull[0]])
            if before.stops:
                apart[3:] = np.abs(motion * [1.0, 0.0])
                motion = np.zeros(2)
        if behind is not None:
            start = law_of(behind.phases, behind.part.way[-1])
            apart[3:] = np.maximum(apart[3:], np.abs(motion - [start.speed[0], start.pull[0]]))
            if before is not None:
                one, other = as_path(before.part), as_path(behind.part)
                for k, name in enumerate(("place", "first", "second")):
                    if k == 0 or not before.stops:
                        apart[k] = np.abs(getattr(one, name)[-1] - getattr(other, name)[0]).max()
        found.append(apart)
    worst: NDArray[np.float64] = np.array(found).max(axis=0)
    return worst


def joined(before: BentPath, behind: BentPath) -> BentPath:
    """One path of two."""
    offset = before.way[-1]
    pairs = {name: (getattr(before, name), getattr(behind, name)) for name in BentPath.__annotations__}
    both = {
        name: np.concatenate([one, other[1:] if name in ("place", "first", "second") else other])
        for name, (one, other) in pairs.items()
    }
    both["way"] = np.append(before.way, offset + behind.way[1:])
    both["row_way"] = np.append(before.row_way, offset + behind.row_way)
    return BentPath(**both)


def legs_of(windows: list[Window]) -> list[BentPath]:
    """Their paths from rest to rest."""
    legs: list[BentPath] = []
    begun = False
    for window in windows:
        path = as_path(window.part)
        if begun:
            legs[-1] = joined(legs[-1], path)
        else:
            legs.append(path)
        begun = not window.stops
    return legs


def positions(windows: list[Window], step: float) -> NDArray[np.float64]:
    """Positions of the axes at even times of all windows."""
    places, begin = [], 0.0
    for window in windows:
        law, path = law_of(window.phases, window.part.way[-1]), as_path(window.part)
        first = np.ceil(begin / step - 1e-9)
        times = np.arange(first * step - begin, law.seconds, step)
        places.append(path.at(law.at(times)[0])[0])
        begin += law.seconds
    return np.concatenate(places)
