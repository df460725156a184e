"""Dwells that a signal ends (SYNTEC G04 Q)."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State
from tests.mainrun.support import power_on


@pytest.mark.parametrize(("signal", "seconds"), [("C105", 1.0), ("C106", 3.0)])
def test_a_signal_ends_the_dwell_that_names_it(signal: str, seconds: float) -> None:
    virtual = power_on("G04 X3. Q105\nM30\n", "syntec-mill")
    virtual.cycle_start()
    virtual.step(1.0)
    virtual.signals[signal] = 1.0
    assert virtual.run() is State.READY
    assert virtual.time == pytest.approx(seconds, abs=0.02)


def test_a_signal_that_is_on_lets_no_dwell_begin() -> None:
    virtual = power_on("G04 X3. Q105\nM30\n", "syntec-mill")
    virtual.signals["C105"] = 1.0
    virtual.cycle_start()
    assert virtual.run() is State.READY
    assert virtual.time == pytest.approx(0.0, abs=0.02)
