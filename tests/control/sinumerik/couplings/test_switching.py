from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run


@pytest.mark.parametrize(
    "lines",
    [
        ("TRAILON(Y,X)", "WHEN TRUE DO POS[X]=5"),
        ("TRAILON(Y,X)", "WHEN TRUE DO MOV[Y]=1"),
        ("WHEN $AA_IM[X]>9 DO POS[X]=5", "TRAILON(Y,X)"),
        ("ID=1 DO $AC_PARAM[1]=1", "TRAILON(Y,X)", "POSA[Y]=5"),
    ],
)
def test_leading_and_following_axes_are_moved_on_the_path_alone(lines: tuple[str, ...]) -> None:
    assert codes(run(*lines, "G1 Z5 F1000")) == [("PC0001", len(lines))]


def test_other_axes_may_be_moved_beside_it() -> None:
    assert codes(run("TRAILON(Y,X)", "WHEN TRUE DO POS[Z]=5", "G1 X5 F1000")) == []
