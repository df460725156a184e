"""The direction along moves, and where a coupled axis stands for it."""

from __future__ import annotations

from dataclasses import replace
from math import inf

import pytest

from polycnc.channel.moves.path import Move
from polycnc.control.sinumerik.tangential.coupling import Coupling, course
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.toolpath import Kind

GEOMETRY = (0, 1, 2)
COUPLING = Coupling(
    column=3, leading=(0, 1), factor=1.0, offset=90.0, lifts=False, lift_deg=5.0, lift_feed=100.0, lift_radius=0.0,
    leads_speed=False, smoothing_mm=0.0, tolerance_deg=inf, velocity=100.0, acceleration=400.0, at=0.0,
)  # fmt: skip


def line(*end: float) -> Move:
    return Move(Kind.FEED, [0.0, 0.0, 0.0, 0.0], [*end, 0.0])


def test_course_of_lines_and_arcs() -> None:
    straight = course(line(10.0, 10.0, 5.0), GEOMETRY, (0, 1), IDENTITY)
    assert straight is not None
    assert straight.angles == pytest.approx((45.0, 45.0))
    assert course(line(0.0, 0.0, 5.0), GEOMETRY, (0, 1), IDENTITY) is None
    arc = replace(line(0.0, 0.0, 0.0), kind=Kind.CW, center=(10.0, 0.0, 0.0), turns=1.0)
    turned = course(arc, GEOMETRY, (0, 1), IDENTITY)
    assert turned is not None
    assert turned.parts == (0.0, 1.0)
    assert turned.angles[1] - turned.angles[0] == pytest.approx(-720.0)


def test_a_tilted_arc_turns_unevenly() -> None:
    tilted = Frame(((1.0, 0.0, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 1.0)))
    arc = replace(line(20.0, 0.0, 0.0), kind=Kind.CCW, center=(10.0, 0.0, 0.0))
    turned = course(arc, GEOMETRY, (0, 1), tilted)
    assert turned is not None
    assert len(turned.parts) > 2
    assert turned.turned(0.5) == pytest.approx(90.0)
    assert turned.turned(0.25) < 45.0 - 5.0 or turned.turned(0.25) > 45.0 + 5.0


def test_the_axis_turns_the_short_way_at_corners() -> None:
    coupling = replace(COUPLING)
    assert coupling.meet(0.0) == pytest.approx(90.0)
    coupling.at = 90.0
    assert coupling.meet(-90.0) == pytest.approx(0.0)
    coupling.at = 0.0
    assert coupling.meet(179.0) == pytest.approx(-91.0)


@pytest.mark.parametrize(
    ("area", "place"), [((-inf, inf), 270.0), ((0.0, 180.0), 90.0), ((0.0, 100.0), 90.0)]
)
def test_reversal_in_a_working_area(area: tuple[float, float], place: float) -> None:
    coupling = replace(COUPLING, range=area)
    coupling.at = coupling.meet(0.0)
    assert coupling.meet(180.0) == pytest.approx(place)


def test_seconds_of_a_turn() -> None:
    assert COUPLING.seconds_for(4.0) == pytest.approx(0.2)
    assert COUPLING.seconds_for(-90.0) == pytest.approx(0.9 + 0.25)
    assert replace(COUPLING, acceleration=0.0).seconds_for(50.0) == pytest.approx(0.5)


def test_a_jump_is_made_up_within_its_share() -> None:
    coupling = replace(COUPLING, at=10.0, direction=0.0, added=20.0)
    places = coupling.follow(None, 40.0, 0.25, (0.125, 0.25, 1.0))
    assert places == pytest.approx([10.0 + 20.0 + 2.5, 10.0 + 40.0 + 5.0, 70.0])
    assert coupling.at == places[-1]
