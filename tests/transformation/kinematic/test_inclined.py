from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.geometry.vectors import times
from polycnc.machine import load_machine
from polycnc.transformation.kinematic.inclined import InclinedAxis
from tests.transformation.kinds import places


@pytest.mark.parametrize(
    ("angle", "point", "axes"),
    [
        (0.0, [5.0, 7.0], [5.0, 7.0]),
        (60.0, [5.0, 0.0], [10.0, -5.0 * 3.0**0.5]),
        (-60.0, [5.0, 1.0], [10.0, 1.0 + 5.0 * 3.0**0.5]),
        (45.0, [0.0, 7.0], [0.0, 7.0]),
    ],
)
def test_the_other_axis_takes_back_what_the_inclined_one_adds(
    angle: float, point: list[float], axes: list[float]
) -> None:
    assert InclinedAxis(0, 1, angle, (0, -1, 1)).to_machine(point) == pytest.approx(axes)


@given(places, places)
def test_the_grinder_with_an_inclined_infeed_reaches_the_cartesian_point(x: float, z: float) -> None:
    infeed_axis = load_machine("grinder-mu-mz").tool_chain[-1]
    assert infeed_axis.axis == "MU"
    infeed, along = InclinedAxis(0, 1, 45.0, (0, -1, 1)).to_machine([x, z])
    way = times(infeed_axis.direction, infeed)
    assert (way[0], way[2] + along) == pytest.approx((x, z), abs=1e-9)


def test_the_cartesian_axis_may_have_a_column_of_its_own() -> None:
    inclined = InclinedAxis(0, 1, 60.0, (2, -1, 1), virtual=2)
    axes = inclined.to_machine([0.0, 3.0, 5.0])
    assert axes == pytest.approx([10.0, 3.0 - 5.0 * 3.0**0.5, 0.0])
    assert inclined.to_work(axes) == pytest.approx([0.0, 3.0, 5.0])
    assert inclined.jacobian(axes) == [
        pytest.approx(row) for row in ([0, 0, 2], [0, 1, -(3.0**0.5)], [0, 0, 0])
    ]


@given(st.sampled_from([90.0, -90.0, 270.0, 90.0 + 1e-7]))
def test_an_axis_along_the_other_one_spans_no_plane_with_it(angle: float) -> None:
    with pytest.raises(ValueError, match="parallel"):
        InclinedAxis(0, 1, angle, (0, -1, 1))
