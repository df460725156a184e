"""G06.2: a curve is one motion, whatever it is cut into."""

from __future__ import annotations

import pytest

from polycnc.session import open_session

CURVE = """O1
G90 G17 {mode} G94 F3000.
G06.2 P4 K0. X0. Y0. R1.
K0. X10. Y20. R1.
K0. X20. Y20. R1.
K0. X30. Y0. R1.
K1.
K1.
K1.
K1.
G01 X40.
M30
"""


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_an_exact_stop_is_at_the_end_of_the_curve_alone(control: str) -> None:
    stopping, passing = (
        open_session(CURVE.format(mode=mode), control=control).run().time for mode in ("G61", "G64")
    )
    # A stop within the curve would take more; the one at its end stands for the averages of a rounded corner.
    assert abs(stopping - passing) < 0.1
