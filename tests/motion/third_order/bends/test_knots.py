"""Corners that are alone between two lines: bent in closed form, and never farther than the tolerance allows."""

from __future__ import annotations

from array import array
from copy import deepcopy
from random import Random

import pytest

from polycnc.motion.third_order.bend import legs
from polycnc.motion.third_order.bends.seams import Seams
from polycnc.motion.third_order.bends.turning import SHARE
from polycnc.motion.third_order.bends.within import is_sure, most_used
from polycnc.motion.third_order.parts import Room, bent_part
from tests.motion.third_order.programmed import Bounds
from tests.motion.third_order.programmed_paths import Drawn


def lines(seed: int, count: int) -> Drawn:
    """Lines of all lengths that turn by any angle, some with a rotary axis, each with its own tolerance."""
    random, drawn = Random(seed), Drawn()
    for _ in range(count):
        degrees = random.choice((0.0, 0.0, random.uniform(-5.0, 5.0)))
        bounds = Bounds(random.choice((0.002, 0.01, 0.05)), turn_tolerance=random.uniform(0.01, 0.5))
        drawn.line(random.uniform(0.05, 3.0), random.uniform(-2.0, 2.0), 0.0, degrees, bounds)
    return drawn


def rest_to_rest() -> array[float]:
    return array("d", bytes(8 * Seams.SIZE))


@pytest.mark.parametrize("seed", range(4))
def test_what_is_not_looked_at_keeps_to_the_tolerance(seed: int) -> None:
    room, sure, alone = Room(), 0, 0
    for leg in legs(lines(seed, 150).path.path):
        bent_part(leg, rest_to_rest(), room)
        spline, pieces = room.spline, spline_pieces(room, leg.way[-1])
        for k in range(pieces):
            if is_sure(spline, pieces, k):
                sure += 1
                assert most_used(leg, 4, spline, k, k + 1) < 1.0
            if spline.alone[k]:
                alone += 1
                # by less where both lines have not one tolerance, or rotary axes move, too
                assert most_used(leg, 4, spline, k, k + 1) <= SHARE + 1e-6
    assert alone > 40
    assert sure > 2 * alone


def test_a_zigzag_uses_all_of_its_share_at_every_corner() -> None:
    drawn, room = Drawn(), Room()
    for k in range(20):
        drawn.line(2.0, 1.5 if k % 2 else -1.5, 0.0, 0.0, Bounds(0.01))
    path = drawn.path.path
    bent_part(path, rest_to_rest(), room)
    pieces = spline_pieces(room, path.way[-1])
    alone = [k for k in range(pieces) if room.spline.alone[k]]
    # the first and the last one have but one knot between them and a rest
    assert [round(room.spline.way[k], 9) for k in alone] == [2.0 * k for k in range(2, 19)]
    for k in alone:
        assert most_used(path, 4, room.spline, k, k + 1) == pytest.approx(SHARE, rel=1e-9)


def spline_pieces(room: Room, length: float) -> int:
    """Pieces of the spline that lies in a room."""
    return next(k for k, way in enumerate(room.spline.way) if way >= length - 1e-12)


def test_a_room_that_was_used_before_changes_nothing() -> None:
    room = Room()
    for seed, count in ((1, 300), (2, 20), (3, 80)):
        for leg in legs(lines(seed, count).path.path):
            other = deepcopy(leg)
            assert bent_part(leg, rest_to_rest(), room) == bent_part(other, rest_to_rest(), Room())
