from __future__ import annotations

from math import tau

import pytest

from polycnc.transformation.kinematic.cylinder import Cylinder


def test_once_round_is_the_circumference() -> None:
    surface = Cylinder.of_radius(1, 50.0, (0, 1, 2))
    assert surface.to_work([3.0, 360.0, 4.0]) == pytest.approx([3.0, 50.0 * tau, 4.0])
    assert surface.to_machine([3.0, 50.0 * tau, 4.0]) == pytest.approx([3.0, 360.0, 4.0])
    assert surface.jacobian([3.0, 1.0, 4.0])[1][1] == pytest.approx(360.0 / (50.0 * tau))
    assert surface.pole is None


def test_the_length_may_have_a_column_of_its_own() -> None:
    surface = Cylinder.of_radius(3, 50.0, (0, 1, 2), virtual=1)
    axes = surface.to_machine([3.0, 25.0 * tau, 4.0, 0.0])
    assert axes == pytest.approx([3.0, 0.0, 4.0, 180.0])
    assert surface.to_work(axes) == pytest.approx([3.0, 25.0 * tau, 4.0, 0.0])
    assert surface.jacobian(axes)[1] == [0.0, 0.0, 0.0, 1.0]
    assert surface.jacobian(axes)[3] == pytest.approx([0.0, 360.0 / (50.0 * tau), 0.0, 0.0])


def test_an_axis_beside_the_length_stands_where_it_is() -> None:
    surface = Cylinder.of_radius(3, 50.0, (0, 1, 2), virtual=1)
    assert surface.to_work([3.0, 5.0, 4.0, 180.0]) == pytest.approx([3.0, 25.0 * tau, 4.0, 5.0])
    assert surface.to_machine([3.0, 25.0 * tau, 4.0, 5.0]) == pytest.approx([3.0, 5.0, 4.0, 180.0])
