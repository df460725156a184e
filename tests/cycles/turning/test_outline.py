from __future__ import annotations

import pytest

from polycnc.cycles.turning import outline
from polycnc.cycles.turning.contour import points
from polycnc.cycles.turning.stock_removal import Removal, remove
from tests.cycles.turning.test_contour import lines

STEPS = lines((0.0, 20.0), (-20.0, 20.0), (-20.0, 25.0), (-40.0, 25.0))


def corners(contour: list) -> list:  # type: ignore[type-arg]
    return [contour[0].edge.start, *(piece.edge.end for piece in contour)]


def test_a_contour_is_led_on_to_front_and_top_of_its_blank() -> None:
    led = outline.walled(outline.from_front(STEPS, 2.0), -40.0, 30.0, -1.0)
    assert corners(led) == [(2.0, 20.0), *corners(STEPS), (-40.0, 30.0)]


def test_a_contour_goes_on_to_the_wall_unless_it_ends_with_one() -> None:
    assert corners(outline.walled(STEPS, -40.5, 30.0, -1.0))[-2:] == [(-40.5, 25.0), (-40.5, 30.0)]
    ends_with_wall = lines((0.0, 20.0), (-20.0, 20.0), (-20.0, 25.0))
    assert corners(outline.walled(ends_with_wall, -20.5, 30.0, -1.0))[-2:] == [(-20.0, 25.0), (-20.0, 30.0)]


def test_a_contour_ends_at_the_wall_and_does_not_come_down_to_the_top() -> None:
    assert corners(outline.walled(STEPS, -30.0, 30.0, -1.0))[-2:] == [(-30.0, 25.0), (-30.0, 30.0)]
    assert corners(outline.walled(STEPS, -40.0, 24.0, -1.0)) == corners(STEPS)


def test_a_contour_that_begins_in_front_of_its_blank_is_not_led_on() -> None:
    assert corners(outline.from_front(STEPS, -1.0)) == corners(STEPS)


def test_limits_cut_a_contour() -> None:
    assert corners(outline.not_beyond(STEPS, -30.0, -1.0))[-1] == (-30.0, 25.0)
    assert corners(outline.not_beyond(STEPS, -20.0, -1.0)) == [(0.0, 20.0), (-20.0, 20.0)]
    assert corners(outline.not_deeper(STEPS, 22.0, -1.0)) == [
        (0.0, 22.0),
        (-20.0, 22.0),
        (-20.0, 25.0),
        (-40.0, 25.0),
    ]


@pytest.mark.parametrize(("axis", "direction", "far"), [(0, 1.0, 0.0), (0, -1.0, -40.0), (1, 1.0, 25.0)])
def test_the_farthest_point(axis: int, direction: float, far: float) -> None:
    assert outline.farthest(STEPS, axis, direction) == far


def test_cuts_begin_in_front_of_the_stock_and_leave_out_air() -> None:
    """The stock steps up from 22 to 28 at -10: the cut at 26 begins there, none lies above 28."""
    part = outline.walled(outline.from_front(STEPS, 2.0), -40.0, 30.0, -1.0)
    stock = lines((2.0, 20.0), (2.0, 22.0), (-10.0, 22.0), (-10.0, 28.0), (-45.0, 28.0))
    cuts = [cut.stroke for cut in remove(part, Removal(2.0, 1.0, -1.0), stock)]
    levels = {
        cut.end[1]: cut.end[0]
        for cut in cuts
        if cut.kind.name == "RAPID" and cut.end[1] in (28.0, 26.0, 20.0)
    }
    assert levels == {26.0: -9.0, 20.0: 3.0}


def test_there_is_a_cut_at_every_edge() -> None:
    part = outline.walled(outline.from_front(STEPS, 2.0), -40.0, 31.0, -1.0)
    straight = {
        cut.stroke.end[1] for cut in remove(part, Removal(4.0, 1.0, -1.0, at_edges=True)) if cut.is_straight
    }
    assert straight == {28.0, 25.0, 22.5, 20.0}
    assert all(len(points(piece.edge)) == 2 for piece in part)


def test_a_contour_is_led_over_its_reliefs() -> None:
    shaft = lines((0.0, 20.0), (-5.0, 20.0), (-8.0, 15.0), (-10.0, 15.0), (-18.0, 25.0), (-20.0, 22.0))
    bridged = corners(outline.without_reliefs(shaft, -1.0))
    assert bridged == [(0.0, 20.0), (-5.0, 20.0), (-14.0, 20.0), (-18.0, 25.0), (-20.0, 25.0)]
    bore = lines((0.0, 30.0), (-5.0, 35.0), (-10.0, 25.0))
    assert corners(outline.without_reliefs(bore, 1.0)) == [(0.0, 30.0), (-7.5, 30.0), (-10.0, 25.0)]
