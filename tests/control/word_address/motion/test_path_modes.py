"""Codes beside the path: exact stop in a block."""

from __future__ import annotations

import pytest

import polycnc


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "fanuc-0i-tf"])
def test_g09_stops_at_the_end_of_its_own_block_only(control: str) -> None:
    before = "G98\n" if control == "fanuc-0i-tf" else "G90 G94\n"

    def time(first: str, second: str) -> float:
        program = f"{before}G1 Z-10. F3000.\n{first} Z-20.\n{second} Z-30.\nZ-40.\nM30\n"
        result = polycnc.run(program, control=control)
        assert result.ok
        return result.time

    through, stopped = time("", ""), time("G9", "")
    assert stopped > through + 0.01
    assert time("G9", "G9") > stopped + 0.01
    assert time("G61", "G64") == pytest.approx(stopped)
