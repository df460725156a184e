"""Records of a law along a bent path: the motion of that law, row by row, and the times of the rows."""

from __future__ import annotations

from array import array
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.motion.kernels.columns import PIECE_BLOCKS, PLACES, Form, PieceRecord
from polycnc.motion.sampling.run import Run
from polycnc.motion.third_order.law import quickest_law
from polycnc.motion.third_order.laws import compiled
from polycnc.motion.third_order.laws.records import NEAR
from tests.kernels.strict import strict
from tests.motion.third_order.laws import AXES, wild
from tests.motion.third_order.recorded import (
    driven,
    phases_of,
    recorded,
    times_of,
    walk_of,
    written,
)

if TYPE_CHECKING:
    from polycnc.motion.third_order.bent_path import BentPath
    from polycnc.motion.third_order.law import JerkLaw
    from tests.motion.third_order.recorded import Numbers

ENDS2 = PieceRecord.SPEED2, PieceRecord.END2
#: Of the thirty paths: corners, short lines, facets, an arc, a helix, a spline.
PATHS = (3, 7, 12, 20, 23, 28)


def in_rows(path: BentPath, ways: list[float]) -> BentPath:
    """A path whose rows end at these ways, and at its end."""
    ends = np.array([*ways, path.way[-1]])
    return replace(path, rows=np.arange(7, 7 + len(ends)), row_way=ends)


def rowed(seed: int, count: int, shares: list[float]) -> tuple[BentPath, JerkLaw]:
    """A random path in rows, some of which end where a piece of the spline does, or a phase of the law."""
    path = wild(seed, count)
    law = quickest_law(path, AXES)
    knots, phases = path.way[1:-1:3], law.way[1:-1:7]
    ways = {*(path.way[-1] * np.array(shares)).tolist(), *knots.tolist(), *phases.tolist()}
    return in_rows(path, sorted(ways)), law


@pytest.mark.parametrize("number", PATHS)
def test_a_run_of_records_is_the_law_along_the_path(number: int) -> None:
    path, law = driven(number)
    run = Run(recorded(path, law), 3)
    times = np.linspace(0.0, law.seconds, 3001)
    way, speed, pull, _ = law.at(times)
    place, first, second = path.at(way)
    position, velocity, acceleration = run.at(times)
    assert run.seconds == pytest.approx(law.seconds, rel=1e-12)
    assert np.abs(position - place).max() <= 1e-9
    assert np.abs(velocity - first * speed[:, None]).max() <= 1e-7
    assert np.abs(acceleration - first * pull[:, None] - second * speed[:, None] ** 2).max() <= 1e-5


@pytest.mark.parametrize("number", PATHS)
def test_third_differences_of_positions_keep_the_jerk(number: int) -> None:
    path, law = driven(number)
    run, step = Run(recorded(path, law), 3), 1e-3
    position = run.at(np.arange(-4.0 * step, law.seconds + 4.0 * step, step))[0]
    for order, limit in ((1, AXES.speed), (2, AXES.pull), (3, AXES.jerk)):
        assert np.abs(np.diff(position, order, axis=0) / step**order / np.array(limit)).max() <= 1.0 + 1e-5


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 25), st.lists(st.floats(1e-6, 1.0), max_size=8))
def test_a_record_is_a_part_of_one_phase_one_piece_and_one_row(
    seed: int, count: int, shares: list[float]
) -> None:
    path, law = rowed(seed, count, shares)
    pieces = recorded(path, law)
    length, speed2, end2 = (pieces[:, field] for field in (PieceRecord.LENGTH, *ENDS2))
    ends = np.cumsum(length)
    assert np.all(pieces[:, PieceRecord.FORM] == Form.JERKED)
    assert length.min() > NEAR
    assert abs(ends[-1] - path.way[-1]) <= 1e-9 * path.way[-1]
    # what is said of the speed fits together, and only the first begins at rest, as only the last one ends there
    assert (speed2[0], end2[-1]) == (0.0, 0.0)
    assert np.abs(np.sqrt(end2[:-1]) - np.sqrt(speed2[1:])).max(initial=0.0) <= 1e-6
    assert np.all(speed2[1:] > 0.0)
    assert np.all(pieces[:, PieceRecord.PEAK2] >= np.maximum(speed2, end2))
    middle = ends - 0.5 * length
    assert np.array_equal(pieces[:, PieceRecord.CAP2], path.cap2[path.piece_at(middle)])
    assert np.array_equal(pieces[:, PieceRecord.ROW], path.rows[np.searchsorted(path.row_way, middle)])
    assert np.array_equal(pieces[:, PieceRecord.SLOT], pieces[:, PieceRecord.ROW] % 3)
    jerk = law.at(law.times_at(middle))[3]
    assert np.array_equal(pieces[:, PieceRecord.JERK], jerk)
    # each begins where the one before ends, with its q' and q''
    vectors = pieces[:, PieceRecord.VECTORS :].reshape(-1, PIECE_BLOCKS, 3)
    for block in range(0, PIECE_BLOCKS, 2):
        assert np.abs(vectors[1:, block] - vectors[:-1, block + 1]).max(initial=0.0) <= 1e-9
    assert np.array_equal(vectors[-1, PLACES + 1], path.place[-1])


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 25), st.lists(st.floats(1e-6, 1.0), max_size=8))
def test_times_of_rows_are_those_of_the_law(seed: int, count: int, shares: list[float]) -> None:
    path, law = rowed(seed, count, shares)
    pieces, (times, slots) = recorded(path, law), times_of(path, law)
    ends = np.cumsum(times, axis=0)
    assert ends[:, 0] == pytest.approx(law.times_at(path.row_way), rel=1e-12, abs=1e-9)
    assert ends[:, 1] == pytest.approx(path.row_way, rel=1e-12)
    assert float(pieces[:, PieceRecord.TIME].sum()) == pytest.approx(law.seconds, rel=1e-12)
    for fields, found, least in ((PieceRecord.ROW, times, int(path.rows[0])), (PieceRecord.SLOT, slots, 0)):
        numbers = (pieces[:, fields] - least).astype(int)
        for column, field in enumerate((PieceRecord.TIME, PieceRecord.LENGTH)):
            by_record = np.bincount(numbers, pieces[:, field], len(found))
            assert by_record == pytest.approx(found[:, column], rel=1e-9, abs=1e-9)


def test_batches_and_windows_write_the_same_records() -> None:
    path, law = driven(12)
    whole = recorded(path, law, batch=10_000)
    assert np.array_equal(recorded(path, law, batch=1), whole)
    phases, walk = phases_of(law), walk_of(path, phases_of(law))
    parts = []
    for first in range(0, len(law.start), 37):
        window = phases[5 * first : 5 * (first + 37)]
        walk.phase, walk.phases = 0, len(window) // 5
        parts.append(written(path, window, walk))
    assert np.concatenate(parts) == pytest.approx(whole, rel=1e-9, abs=1e-6)
    assert np.array_equal(np.concatenate(parts)[:, PieceRecord.ROW], whole[:, PieceRecord.ROW])


def test_phases_without_time_make_no_record() -> None:
    path, law = driven(12)
    phases, made = phases_of(law), array("d")
    for k in range(len(law.start)):
        made += array("d", (0.0, *phases[5 * k + 1 : 5 * k + 3], 0.0, 0.0)) + phases[5 * k : 5 * k + 5]
    made += array("d", (0.0, path.way[-1], 0.0, 0.0, 0.0))
    assert written(path, made, walk_of(path, made)) == pytest.approx(recorded(path, law), rel=1e-12, abs=1e-9)


def test_a_row_that_ends_beside_a_knot_leaves_no_crumb() -> None:
    path, law = driven(12)
    off = in_rows(path, [path.way[20] - 3e-10, path.way[40] + 3e-10, path.way[60]])
    exact = in_rows(path, [path.way[20], path.way[40], path.way[60]])
    pieces = recorded(off, law)
    assert pieces[:, PieceRecord.LENGTH].min() > NEAR
    assert pieces == pytest.approx(recorded(exact, law), rel=1e-6, abs=1e-3)


def test_a_row_without_a_way_takes_no_time() -> None:
    path, law = driven(12)
    twice = in_rows(path, [path.way[20], path.way[20], path.way[60]])
    times, _ = times_of(twice, law)
    assert times[1].tolist() == [0.0, 0.0]
    assert times[:, 0].sum() == pytest.approx(law.seconds, rel=1e-12)
    assert 8.0 not in recorded(twice, law)[:, PieceRecord.ROW]


def test_times_and_places_of_a_run_are_those_of_the_law() -> None:
    path, law = driven(12)
    pieces = recorded(path, law)
    run, ways = Run(pieces, 3), np.cumsum(pieces[:, PieceRecord.LENGTH])
    starts = law.times_at(np.append(0.0, path.row_way[:-1]))
    assert run.enters(path.rows.astype(np.int64)).tolist() == pytest.approx(starts.tolist(), abs=1e-9)
    for share in (0.1, 0.5, 0.9):
        time = float(law.times_at(np.array([share * path.way[-1]]))[0])
        assert run.time_of(share) == pytest.approx(time, abs=1e-9)
        assert run.share_at(time) == pytest.approx(share, abs=1e-9)
    times = np.linspace(0.001, law.seconds - 0.001, 77)
    assert np.array_equal(run.piece_at(times), np.searchsorted(ways, law.at(times)[0], "right"))
    assert (run.start.tolist(), run.end.tolist()) == (path.place[0].tolist(), path.place[-1].tolist())


@pytest.mark.skipif(compiled.LIBRARY.lack is not None, reason="no machine code")
@pytest.mark.parametrize("number", PATHS)
def test_both_ways_to_run_the_kernels_write_the_same_bits(number: int) -> None:
    assert alike(*driven(number))


def test_no_kernel_reads_from_the_end() -> None:
    assert alike(*driven(12))


def alike(path: BentPath, law: JerkLaw) -> bool:
    """Whether the kernels in force and the plain ones give the same numbers."""
    plain = compiled.plain()
    plain = plain._replace(put_records=strict(plain.put_records), add_times=strict(plain.add_times))
    found: list[tuple[Numbers, ...]] = [
        (recorded(path, law, by=way), *times_of(path, law, by=way)) for way in (compiled.kernels(), plain)
    ]
    return all(np.array_equal(one, other) for one, other in zip(*found, strict=True))
