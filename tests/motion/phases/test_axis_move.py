"""One axis on its own way to rest."""

from __future__ import annotations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from polycnc.geometry.tolerances import NO_WAY
from polycnc.motion.phases.axis_move import axis_move

PLACES = st.floats(-1000.0, 1000.0)
SPEEDS = st.floats(-300.0, 300.0)


@given(PLACES, SPEEDS, PLACES, st.floats(0.1, 400.0), st.floats(10.0, 5000.0))
def test_an_axis_rests_at_its_target_however_it_moves_now(
    position: float, velocity: float, target: float, speed: float, pull: float
) -> None:
    move = axis_move(position, velocity, target, speed, pull, 5.0)
    assert move.after(move.end) == (target, 0.0)
    place = position + sum(phase.way for phase in move.phases)
    assert place == pytest.approx(target, abs=1e-6)
    before = velocity
    for phase in move.phases:
        assert phase.speed == pytest.approx(before, abs=1e-3)
        assert abs(phase.pull) <= pull * (1.0 + 1e-6)
        before = phase.speed + phase.pull * phase.seconds
    assert before == pytest.approx(0.0, abs=1e-3)


@given(PLACES, SPEEDS, st.floats(10.0, 5000.0))
def test_without_speed_it_brakes_where_it_is(position: float, velocity: float, pull: float) -> None:
    assume(velocity * velocity / (2.0 * pull) > 10.0 * NO_WAY)  # a shorter way counts as none
    move = axis_move(position, velocity, position + 500.0, 0.0, pull, 0.0)
    assert abs(move.target - position) == pytest.approx(
        velocity * velocity / (2.0 * pull), rel=1e-3, abs=1e-9
    )
    assert move.end == pytest.approx(abs(velocity) / pull, rel=1e-3)


def test_an_axis_at_its_target_does_not_move() -> None:
    assert axis_move(3.0, 0.0, 3.0, 10.0, 100.0, 1.0).end == 1.0
