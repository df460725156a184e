"""Edge positions and angles of a tool that a holder turns."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.tools.cutting_data import plane_of, turned
from polycnc.control.sinumerik.tools.edges import (
    DP_CLEARANCE,
    DP_DIRECTION,
    DP_HOLDER_ANGLE,
    DP_TIP,
    Edge,
)
from polycnc.geometry.frames import rotation


def edge(tip: float, direction: float = 3.0) -> Edge:
    found = Edge()
    found.values[DP_TIP], found.values[DP_DIRECTION] = tip, direction
    found.values[DP_HOLDER_ANGLE], found.values[DP_CLEARANCE] = 95.0, 40.0
    return found


@pytest.mark.parametrize(
    ("tip", "angle", "position"),
    [
        (3, 90, 4),
        (4, 90, 1),
        (1, 90, 2),
        (2, 90, 3),
        (3, 44, 8),
        (3, 20, 3),
        (8, 45, 4),
        (5, -90, 8),
        (7, 180, 5),
    ],
)
def test_positions_go_round_in_eighths(tip: int, angle: float, position: int) -> None:
    assert turned(edge(tip), "G18", rotation(1, angle)).position == position


@pytest.mark.parametrize(("angle", "direction"), [(90, 1), (180, 4), (270, 2), (44, 3), (46, 1), (-44, 3)])
def test_cutting_directions_go_round_in_quarters(angle: float, direction: int) -> None:
    assert turned(edge(3), "G18", rotation(1, angle)).direction == direction


@pytest.mark.parametrize(("angle", "opening"), [(20, -20), (-20, 20), (100, -10), (90, 0)])
def test_angles_take_up_what_directions_leave(angle: float, opening: float) -> None:
    data = turned(edge(3), "G18", rotation(1, angle))
    assert data.holder_deg == pytest.approx(95 + opening)
    assert data.clearance_deg == pytest.approx(40 - opening)


def test_a_half_turn_about_an_axis_of_the_plane_shows_the_edge_from_behind() -> None:
    data = turned(edge(3), "G18", rotation(2, 180))
    assert (data.position, data.is_inverted) == (2, True)


def test_a_tool_without_a_position_keeps_it_and_tells_the_angle() -> None:
    data = turned(edge(0, 0), "G17", rotation(2, 33))
    assert (data.position, data.is_inverted) == (0, False)
    assert data.angle_deg == pytest.approx(33)


def test_a_plane_of_setting_data_counts_instead_of_the_active_one() -> None:
    assert plane_of(-18, "G17") == "G18"
    assert plane_of(5, "G17") == "G17"
