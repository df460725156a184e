"""Which way the rotary axis of TRANSMIT goes under PTP."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import run


@pytest.mark.parametrize("place", [(10, 20), (30, 20), (7, 1), (-3, 8)])
def test_half_a_turn_goes_forward_wherever_it_begins(place: tuple[int, int]) -> None:
    x, y = place
    result = run("G0 X40", "TRANSMIT", "PTPG0", f"G0 X{x} Y{y}", f"X{-x} Y{-y}", machine="lathe-c-transmit")
    *_, before, after = [row["machine"]["C"] for row in result.rows if "machine" in row]
    assert after - before == pytest.approx(180.0)
