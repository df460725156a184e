"""Edge positions and angles of a tool that a holder turns."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.tools.cutting_data import is_seen, plane_of, turned
from polycnc.control.sinumerik.tools.edges import (
    DP_CLEARANCE,
    DP_DIRECTION,
    DP_HOLDER_ANGLE,
    DP_TIP,
    DP_TYPE,
    Edge,
)
from polycnc.geometry.frames import rotation


def edge(
    tip: float, direction: float = 3.0, holder: float = 95.0, clearance: float = 40.0, kind: float = 500.0
) -> Edge:
    found = Edge()
    found.values[DP_TYPE] = kind
    found.values[DP_TIP], found.values[DP_DIRECTION] = tip, direction
    found.values[DP_HOLDER_ANGLE], found.values[DP_CLEARANCE] = holder, clearance
    return found


@pytest.mark.parametrize(
    ("tip", "angle", "position"),
    [
        (3, 90, 4),
        (4, 90, 1),
        (1, 90, 2),
        (2, 90, 3),
        (3, 23, 8),
        (3, 22, 3),
        (8, 45, 4),
        (5, -90, 8),
        (7, 180, 5),
    ],
)
def test_without_angles_positions_go_round_in_eighths(tip: int, angle: float, position: int) -> None:
    assert turned(edge(tip, 0, 0, 0), "G18", rotation(1, angle)).position == position


@pytest.mark.parametrize(
    ("angle", "position"), [(4, 3), (6, 8), (49, 8), (51, 4), (-39, 3), (-41, 7), (-84, 7), (-86, 2)]
)
def test_a_position_changes_where_an_edge_passes_an_axis(angle: float, position: int) -> None:
    """The edges lie 40 and 85 degrees from +Z to +X."""
    assert turned(edge(3), "G18", rotation(1, angle)).position == position


@pytest.mark.parametrize(
    ("angle", "direction"),
    [(90, 1), (180, 4), (270, 2), (30, 3), (46, 3), (49, 3), (51, 1), (-44, 2), (-38, 3)],
)
def test_a_cutting_direction_belongs_to_its_position(angle: float, direction: int) -> None:
    """At 46 degrees -X would be nearer, but position 8 cuts along Z."""
    assert turned(edge(3), "G18", rotation(1, angle)).direction == direction


@pytest.mark.parametrize(
    ("angle", "holder", "clearance"),
    [(20, 75, 60), (-20, 115, 20), (100, 85, 50), (90, 95, 40), (46, 49, 86)],
)
def test_angles_take_up_what_directions_leave(angle: float, holder: float, clearance: float) -> None:
    data = turned(edge(3), "G18", rotation(1, angle))
    assert (data.holder_deg, data.clearance_deg) == pytest.approx((holder, clearance))


def test_angles_that_contradict_the_position_stay() -> None:
    data = turned(edge(8), "G18", rotation(1, 45))
    assert (data.position, data.direction, data.holder_deg, data.clearance_deg) == (4, 1, 95.0, 40.0)


@pytest.mark.parametrize(("angle", "position"), [(45, 5), (46, 6), (-46, 8), (134, 6), (136, 7)])
def test_positions_of_other_tools_go_round_in_quarters(angle: float, position: int) -> None:
    assert turned(edge(5, kind=120.0), "G17", rotation(2, angle)).position == position


@pytest.mark.parametrize(
    ("angle", "seen"), [(90, False), (89.5, False), (-90.5, False), (88.5, True), (0, True)]
)
def test_an_edge_square_on_the_plane_is_not_seen(angle: float, seen: bool) -> None:
    assert is_seen("G18", rotation(2, angle)) is seen


def test_an_edge_seen_from_behind_keeps_its_angles() -> None:
    data = turned(edge(3), "G18", rotation(2, 180))
    assert (data.position, data.direction, data.is_inverted) == (2, 3, True)
    assert (data.holder_deg, data.clearance_deg) == pytest.approx((95, 40))


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
