from __future__ import annotations

import pytest

from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.kinematic.polar import PolarPlane

POLAR, INCLINED = PolarPlane(0, 2, (0, 2, 1)), InclinedAxis(0, 1, 60.0, (0, -1, 1))


def test_the_second_link_takes_what_the_first_one_gives() -> None:
    chain = Chain((POLAR, INCLINED))
    assert chain.to_machine([3.0, 0.0, 4.0]) == INCLINED.to_machine(POLAR.to_machine([3.0, 0.0, 4.0]))
    assert chain.to_machine([3.0, 0.0, 4.0])[0] == pytest.approx(10.0)
    assert (chain.pole, chain.geometry) == (POLAR.pole, POLAR.geometry)
    assert len(chain.solutions([3.0, 0.0, 4.0])) == 2


def test_a_chain_of_one_link_is_the_link() -> None:
    chain, point = Chain((POLAR,)), [3.0, 5.0, 4.0]
    assert chain.to_machine(point) == POLAR.to_machine(point)
    assert chain.jacobian(point) == POLAR.jacobian(point)


def test_a_pole_behind_the_first_link_has_no_fixed_place() -> None:
    with pytest.raises(ValueError, match="pole"):
        Chain((ParallelAxes((0, 2, 1)), POLAR))
