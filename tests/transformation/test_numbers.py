from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from polycnc.transformation import numbers

values = st.lists(st.floats(-1e4, 1e4), min_size=1, max_size=8)


@given(values)
def test_functions_of_a_column_have_the_bits_of_those_of_its_numbers(column: list[float]) -> None:
    many = np.array(column)
    assert numbers.sine(many).tolist() == [math.sin(one) for one in column]
    assert numbers.cosine(many).tolist() == [math.cos(one) for one in column]
    assert numbers.angle_deg(many, many[::-1]).tolist() == [
        math.degrees(math.atan2(y, x)) for y, x in zip(column, column[::-1], strict=True)
    ]
    assert numbers.distance(many, many[::-1]).tolist() == [
        math.hypot(x, y) for x, y in zip(column, column[::-1], strict=True)
    ]
    cosines, sines = numbers.cosine_and_sine_deg(many)
    assert list(zip(cosines.tolist(), sines.tolist(), strict=True)) == [
        numbers.cosine_and_sine_deg(one) for one in column
    ]


def test_quarter_turns_are_exact() -> None:
    assert numbers.cosine_and_sine_deg(-270.0) == (0.0, 1.0)


def test_a_single_point_loads_no_numpy() -> None:
    code = (
        "import sys\n"
        "from polycnc.transformation.kinematic.polar import PolarPlane\n"
        "from polycnc.transformation.rows import machine_rows\n"
        "plane = PolarPlane(0, 1, (0, 1, 2))\n"
        "plane.jacobian(plane.to_work(plane.to_machine([1.0, 2.0, 3.0])))\n"
        "assert 'numpy' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
