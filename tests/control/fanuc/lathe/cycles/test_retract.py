"""Retract of thread cutting cycles on the lathe: 1466 and 1611#0 CFR (II.4.1.2)."""

from __future__ import annotations

import pytest

from tests.control.fanuc.lathe.support import run

PROGRAM = "G97 S500 M3\nG0 X40. Z5.\nG92 X30. Z-20. F2.\nM30"


def seconds(**parameters: int) -> float:
    result = run(
        PROGRAM, parameters={f"{name[1:5]}{name[5:].replace('_', '#')}": v for name, v in parameters.items()}
    )
    assert not result.alarms
    return result.time


def test_the_retract_takes_the_time_of_its_own_speed() -> None:
    # 5 mm at 1 mm/s and at 0.5 mm/s; the other motions stay at rapid traverse.
    assert seconds(p1466=30) - seconds(p1466=60) == pytest.approx(5.0, abs=0.01)
    assert seconds(p1466=60) - seconds() == pytest.approx(4.9, abs=0.15)


def test_the_retract_runs_at_rapid_traverse_by_parameter() -> None:
    assert seconds(p1466=60, p1611_0=1) == pytest.approx(seconds())


def test_the_retract_is_never_faster_than_rapid_traverse() -> None:
    assert seconds(p1466=10_000_000) == pytest.approx(seconds(), abs=0.02)
