"""What tests of records share: a law along a bent path as records of pieces."""

from __future__ import annotations

from array import array
from functools import cache
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.motion.kernels.columns import piece_width
from polycnc.motion.third_order.bend import bend
from polycnc.motion.third_order.law import quickest_law
from polycnc.motion.third_order.laws.compiled import kernels
from polycnc.motion.third_order.laws.records import RowEnds, Track, Walk
from tests.motion.jerk_paths import jerk_paths
from tests.motion.third_order.laws import AXES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polycnc.motion.third_order.bent_path import BentPath
    from polycnc.motion.third_order.law import JerkLaw
    from polycnc.motion.third_order.laws.compiled import Kernels

Numbers: TypeAlias = "NDArray[np.float64]"
#: Records that are written at once.
BATCH = 50


@cache
def driven(number: int) -> tuple[BentPath, JerkLaw]:
    """The first leg of one of the thirty paths, bent, and its law."""
    path = bend(jerk_paths()[number].programmed.path)[0]
    return path, quickest_law(path, AXES)


def track_of(path: BentPath) -> Track:
    return Track(*map(numbers, (path.way, path.place, path.first, path.second, path.cap2)))


def rows_of(path: BentPath) -> RowEnds:
    """Its rows; each counts in the slot of its number, of three."""
    slots = array("q", [int(row) % 3 for row in path.rows])
    return RowEnds(numbers(path.row_way), array("q", path.rows.tolist()), slots)


def phases_of(law: JerkLaw) -> array[float]:
    """`Phase` records."""
    seconds = np.diff(np.append(law.start, law.seconds))
    return numbers(np.stack([seconds, law.way, law.speed, law.pull, law.jerk], axis=1))


def walk_of(path: BentPath, phases: array[float]) -> Walk:
    return Walk(axes=path.axes, pieces=len(path.cap2), phases=len(phases) // 5)


def recorded(path: BentPath, law: JerkLaw, batch: int = BATCH, by: Kernels | None = None) -> Numbers:
    """Records of all pieces, (m, width)."""
    phases = phases_of(law)
    return written(path, phases, walk_of(path, phases), batch, by)


def written(
    path: BentPath, phases: array[float], walk: Walk, batch: int = BATCH, by: Kernels | None = None
) -> Numbers:
    """Records of the pieces that phases lead over."""
    put, width = (by or kernels()).put_records, piece_width(path.axes)
    track, rows = track_of(path), rows_of(path)
    room, found = array("d", bytes(8 * width * batch)), [np.zeros((0, width))]
    while count := put(track, phases, rows, walk, room):
        found.append(np.array(room).reshape(-1, width)[:count])
    return np.concatenate(found)


def times_of(path: BentPath, law: JerkLaw, by: Kernels | None = None) -> tuple[Numbers, Numbers]:
    """Seconds and length of every row, and of every slot, as `add_times` has them, (r, 2) and (3, 2)."""
    phases, first = phases_of(law), int(path.rows[0])
    slots, times = array("d", bytes(48)), array("d", bytes(16 * (int(path.rows[-1]) - first + 1)))
    (by or kernels()).add_times(phases, rows_of(path), walk_of(path, phases), slots, times, first)
    return np.array(times).reshape(-1, 2), np.array(slots).reshape(-1, 2)


def numbers(values: Numbers) -> array[float]:
    return array("d", values.ravel().tolist())
