"""Spindles that follow others."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

import polycnc

CONTROL, MACHINE = "sinumerik-840d", {"machine": "mill3-two-spindles"}


def speed(text: str) -> float:
    result = polycnc.run(text + "\nR1=$AA_S[2]\nM30\n", control=CONTROL, setup=MACHINE)
    assert not result.alarms
    value = result.variables["R1"]
    assert isinstance(value, float)
    return value


@given(
    st.integers(0, 2000),
    st.integers(-5, 5).filter(bool),
    st.integers(1, 5),
    st.integers(0, 2000),
    st.booleans(),
)
def test_a_following_spindle_turns_by_the_ratio_and_its_difference(
    leading: int, numerator: int, denominator: int, own: int, forward: bool
) -> None:
    program = (
        f'M3 S{leading}\nCOUPDEF(S2,S1,{numerator},{denominator},"NOC")\nCOUPON(S2,S1)\n'
        f"M2={3 if forward else 4} S2={own}"
    )
    expected = leading * numerator / denominator + (own if forward else -own)
    assert speed(program) == pytest.approx(expected, abs=1e-9)


def test_the_leading_spindle_goes_no_faster_than_the_following_one_can() -> None:
    assert speed('M3 S15000\nCOUPDEF(S2,S1,2,1,"NOC")\nCOUPON(S2,S1)') <= 15000.0


def test_a_reset_opens_the_coupling_and_keeps_its_definition() -> None:
    control = polycnc.VirtualControl(CONTROL, setup=MACHINE)
    control.load('M3 S500\nCOUPDEF(S2,S1,1,2,"NOC")\nCOUPON(S2,S1)\nM30\n')
    control.cycle_start()
    control.run()
    assert control.read_variable("$AA_COUP_ACT[S2]") == 0
    control.load("COUPON(S2,S1)\nR1=$AA_COUP_ACT[S2]\nM0\nM30\n")
    control.cycle_start()
    control.run()
    assert not control.alarms
    assert control.read_variable("R1") == 4
