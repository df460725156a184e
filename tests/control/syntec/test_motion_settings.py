"""Parameters of SYNTEC that bound the speeds."""

from __future__ import annotations

import pytest

from polycnc.session import run

TEXT = "G90 G94 G01 X600. F12000\nG00 X0.\nM30\n"


def seconds(**parameters: int) -> float:
    given = {number[2:]: value for number, value in parameters.items()}
    return run(TEXT, control="syntec-mill", setup={"parameters": given}).time


def test_pr405_bounds_a_cut_along_the_path_and_pr621_its_axes() -> None:
    free = seconds()
    assert seconds(Pr405=6000) - free == pytest.approx(3.0, abs=0.2)
    assert seconds(Pr621=3000) - free == pytest.approx(9.0, abs=0.2)
    assert seconds(Pr622=3000) == free  # an axis that stands


def test_pr461_bounds_the_rapid_traverse_of_an_axis() -> None:
    assert seconds(Pr461=6000) - seconds(Pr461=12000) == pytest.approx(3.0, abs=0.2)
