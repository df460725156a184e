"""What every transformation keeps: there and back, derivatives, and the same bits for one point as for a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.kinematic.standing import StandingAxes
from polycnc.transformation.rows import jacobian_rows, machine_rows, work_rows
from tests.transformation.kinds import ROTARY, WIDTH, XYZ, away_from_pole, every, points

if TYPE_CHECKING:
    from polycnc.transformation.contract import Transformation

#: Points for each parameter set: 500 draws of them are 10,000 poses.
TABLE = st.lists(points, min_size=20, max_size=20)
#: A millimetre or a degree of the axes, as exact as numbers of this size are.
EXACT = 1e-9


@settings(max_examples=500, deadline=None)
@given(every, TABLE)
def test_from_the_work_to_the_machine_and_back_nothing_is_lost(
    transformation: Transformation, table: list[tuple[float, ...]]
) -> None:
    work = np.array([point for point in table if away_from_pole(transformation, point) > 1e-3])
    assume(len(work))
    back = work_rows(transformation, machine_rows(transformation, work))
    # A direction is the same after a whole turn; polar planes name it from -180 to 180.
    assert np.abs(back - work).max() < EXACT


@settings(max_examples=200, deadline=None)
@given(every, TABLE)
def test_a_table_has_the_bits_of_its_single_points(
    transformation: Transformation, table: list[tuple[float, ...]]
) -> None:
    work = np.array(table)
    axes = machine_rows(transformation, work)
    assert axes.tolist() == [transformation.to_machine(point) for point in table]
    assert work_rows(transformation, axes).tolist() == [
        transformation.to_work(position) for position in axes.tolist()
    ]
    assert jacobian_rows(transformation, work).tolist() == [transformation.jacobian(point) for point in table]


@settings(max_examples=300, deadline=None)
@given(every, points)
def test_the_jacobian_is_what_small_steps_give(
    transformation: Transformation, point: tuple[float, ...]
) -> None:
    assume(away_from_pole(transformation, point) > 1.0)
    step = 1e-4
    steps = step * np.eye(WIDTH)
    ahead = machine_rows(transformation, np.array(point) + steps)
    behind = machine_rows(transformation, np.array(point) - steps)
    way = ahead - behind
    way[:, ROTARY] = (way[:, ROTARY] + 180.0) % 360.0 - 180.0
    found = np.array(transformation.jacobian(point))
    # A virtual axis that is not part of the plane is no free number.
    assert np.abs(found - (way / (2.0 * step)).T).max() < 1e-4 * (1.0 + np.abs(found).max())


@given(every, points)
def test_every_solution_is_the_same_point_of_the_path(
    transformation: Transformation, point: tuple[float, ...]
) -> None:
    first, *others = transformation.solutions(point)
    assert first == transformation.to_machine(point)
    for other in others:
        back = transformation.to_work(other)
        assert [back[i] for i in XYZ] == pytest.approx([point[i] for i in XYZ], abs=1e-6)


def test_axes_that_stand_follow_nothing() -> None:
    standing = StandingAxes(((1, 7.0),), XYZ)
    assert standing.to_machine([1.0, 2.0, 3.0]) == [1.0, 7.0, 3.0]
    assert standing.to_work([1.0, 7.0, 3.0]) == [1.0, 7.0, 3.0]
    assert standing.jacobian([1.0, 2.0, 3.0]) == [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    assert machine_rows(standing, np.array([[1.0, 2.0, 3.0]])).tolist() == [[1.0, 7.0, 3.0]]
    assert standing.columns == {1}
    assert standing.pole is None


def test_a_table_without_rows_stays_empty() -> None:
    assert machine_rows(ParallelAxes(XYZ), np.empty((0, 3))).shape == (0, 3)
