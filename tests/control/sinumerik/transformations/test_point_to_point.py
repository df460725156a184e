"""Ways and times under PTP."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State
from tests.control.sinumerik.support import run
from tests.mainrun.support import power_on


@pytest.mark.parametrize("place", [(10, 20), (30, 20), (7, 1), (-3, 8)])
def test_half_a_turn_goes_forward_wherever_it_begins(place: tuple[int, int]) -> None:
    x, y = place
    result = run("G0 X40", "TRANSMIT", "PTPG0", f"G0 X{x} Y{y}", f"X{-x} Y{-y}", machine="lathe-c-transmit")
    *_, before, after = [row["machine"]["C"] for row in result.rows if "machine" in row]
    assert after - before == pytest.approx(180.0)


def test_digits_of_the_transformation_are_no_way() -> None:
    lines = ("T1 D1 F1000", "TRAORI", "G1 X10 Y0 Z0 B45 C0", "PTP", "G1 X10 B-45 C180")
    setup = {"tools": {1: {"length": 100}}}
    planned = run(*lines, machine="mill5-bc-head", **setup).plan
    # 180 and 90 degrees at 1000 degrees a minute.
    assert planned.row_s[-1] > 60.0 * (180.0**2 + 90.0**2) ** 0.5 / 1000.0
    virtual = power_on("\n".join((*lines, "M30")), "sinumerik-840d", machine="mill5-bc-head", setup=setup)
    virtual.cycle_start()
    assert virtual.run_until(lambda control: control.active_block.line == 5, limit_s=100.0)
    virtual.step(1.0)
    assert virtual.state is State.RUNNING
    assert 0.0 < virtual.positions.machine["C"] < 30.0
