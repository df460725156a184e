"""Tool lengths with wear: which part of it turns with the tool, and with which sign."""

from __future__ import annotations

import pytest

from polycnc.control.sinumerik.tools.edges import DP_LENGTH, DP_TIP, DP_TYPE, DP_WEAR_LENGTH, Edge
from polycnc.control.sinumerik.tools.lengths import Lengths, Rules, along_axes
from polycnc.geometry.frames import rotation

NOTHING = (0.0, 0.0, 0.0)


def edge(type_: float = 120, tip: float = 0) -> Edge:
    found = Edge()
    found.values[DP_TYPE], found.values[DP_TIP] = type_, tip
    found.values[DP_LENGTH : DP_LENGTH + 3] = [100.0, 10.0, 1.0]
    found.values[DP_WEAR_LENGTH : DP_WEAR_LENGTH + 3] = [0.5, 0.25, 0.125]
    return found


def lengths(of: Edge, rules: Rules, plane: str = "G17") -> Lengths:
    return along_axes(of, rules, plane, 0, NOTHING)


def test_wear_is_a_part_of_the_length_unless_setting_data_put_it_elsewhere() -> None:
    assert lengths(edge(), Rules()) == ((1.125, 10.25, 100.5), NOTHING)
    assert lengths(edge(), Rules(system="TOWMCS")) == ((1.125, 10.25, 100.5), NOTHING)
    assert lengths(edge(), Rules(system="TOWMCS", apart=1)) == ((1, 10, 100), (0.125, 0.25, 0.5))


def test_wear_in_the_holder_turns_with_it_and_wear_in_the_work_with_the_frame() -> None:
    assert lengths(edge(), Rules(system="TOWTCS", apart=1)).fixed == NOTHING
    turned = lengths(edge(), Rules(system="TOWWCS", apart=1, work=rotation(1, 90)))
    assert turned.fixed == pytest.approx((0.5, 0.25, -0.125))


def test_wear_in_a_system_of_its_own_keeps_the_axes_of_the_selection() -> None:
    rules = Rules(plane="G17", system="TOWMCS", apart=1)
    assert lengths(edge(), rules, "G18") == ((10, 100, 1), (0.125, 0.25, 0.5))


def test_edge_positions_do_not_turn_the_sign_of_wear_in_a_system_of_its_own() -> None:
    rules = Rules(plane="G18", sign_by_tip=True)
    assert lengths(edge(500, 3), rules, "G18").turning == (99.5, 0.875 + 0.25, 9.75)
    assert lengths(edge(500, 3), rules._replace(system="TOWBCS", apart=1), "G18").fixed == (0.5, 0.125, 0.25)


def test_a_mirror_turns_lengths_and_wear_by_setting_data_of_their_own() -> None:
    rules = Rules(mirrored=(False, False, True))
    assert lengths(edge(), rules._replace(mirrors_lengths=True)).turning[2] == -99.5
    assert lengths(edge(), rules._replace(mirrors_wear=True)).turning[2] == 99.5
    apart = rules._replace(mirrors_wear=True, system="TOWWCS", apart=1)
    assert lengths(edge(), apart).fixed[2] == 0.5
    assert lengths(edge(), apart._replace(system="TOWMCS")).fixed[2] == -0.5


def test_temperature_turns_with_the_tool() -> None:
    assert lengths(edge(), Rules(temperature=(1.0, 2.0, 3.0))).turning == (2.125, 12.25, 103.5)
