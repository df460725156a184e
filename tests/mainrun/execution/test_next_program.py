"""Where a program begins behind one that a transformation or a coupling has led."""

from __future__ import annotations

import pytest

from tests.mainrun.support import power_on

POLAR = "G1 F1000 X20\nTRANSMIT\nX20 Y0\nX20 Y20\nM30\n"


@pytest.mark.parametrize(
    ("machine", "text", "leading", "following"),
    [
        ("lathe-c-transmit", POLAR, "X", "C"),
        ("mill6-uvw", "TRAILON(U,XX,2)\nG1 XX=40 F1000\nM30\n", "XX", "U"),
    ],
)
def test_a_reset_in_its_midst_leaves_the_axes(machine: str, text: str, leading: str, following: str) -> None:
    control = power_on(text, "sinumerik-840d", machine=machine)
    control.cycle_start()
    control.step(2.0)
    control.reset()
    control.step(1.0)
    before = control.positions.real
    assert before[following] > 1.0
    control.load(f"G91 G1 {leading}=3 F1000\nM30\n")
    control.cycle_start()
    control.run()
    after = control.positions.real
    assert after[following] == pytest.approx(before[following])
    assert after[leading] == pytest.approx(before[leading] + 3.0)


def test_a_jog_in_between_is_kept() -> None:
    control = power_on(POLAR, "sinumerik-840d", machine="lathe-c-transmit")
    control.cycle_start()
    control.run()
    control.select_mode("jog")
    control.jog("X", 1)
    control.step(0.3)
    control.stop_jog()
    control.step(1.0)
    before = control.positions.real
    control.select_mode("auto")
    control.load("G91 G1 Z3 F1000\nM30\n")
    control.cycle_start()
    control.run()
    assert control.positions.real == pytest.approx({**before, "Z": before["Z"] + 3.0})
