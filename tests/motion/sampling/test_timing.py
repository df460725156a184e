"""What comes some time after a place on a planned row."""

from __future__ import annotations

import pytest

from polycnc.motion.sampling.timing import later_on_row
from polycnc.session import Session, open_session

LINE = "G90\nG01 X100. F6000\nM30\n"


@pytest.fixture
def session() -> Session:
    made = open_session(LINE, control="syntec-mill")
    made.run()
    return made


def test_a_time_on_a_line_is_a_way_at_its_feed(session: Session) -> None:
    share, left = later_on_row(session.channel, 0, [0.0, 0.0, 0.0], 0.4, 0.2)
    assert share == pytest.approx(0.6, abs=1e-3)
    assert left == 0.0


def test_the_time_from_the_start_of_a_row_has_its_start_up(session: Session) -> None:
    share, _ = later_on_row(session.channel, 0, [0.0, 0.0, 0.0], 0.0, 0.5)
    assert share is not None
    assert 0.4 < share < 0.5


def test_what_a_row_leaves_of_a_time_is_given_back(session: Session) -> None:
    share, left = later_on_row(session.channel, 0, [0.0, 0.0, 0.0], 0.9, 3.0)
    assert share is None
    assert 2.5 < left < 2.95


def test_two_times_behind_each_other_are_one(session: Session) -> None:
    start = [0.0, 0.0, 0.0]
    half, _ = later_on_row(session.channel, 0, start, 0.2, 0.3)
    assert half is not None
    whole, _ = later_on_row(session.channel, 0, start, half, 0.1)
    assert whole == pytest.approx(later_on_row(session.channel, 0, start, 0.2, 0.4)[0], abs=1e-3)
