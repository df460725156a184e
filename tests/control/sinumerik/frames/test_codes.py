"""Programmable frames in runs."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import moves, run


def machine(*lines: str) -> dict[str, float]:
    return run(*lines).final["machine"]


def test_solid_angles_of_two_axes_give_a_rotation() -> None:
    """The image of the unit vectors is orthonormal and right-handed, and X stays in the Z/X plane."""
    x, y, z = (machine("ROTS X20 Y35", f"G0 {axis}1") for axis in "XYZ")
    axes = [[v[name] for name in "XYZ"] for v in (x, y, z)]
    for i in range(3):
        for j in range(3):
            product = sum(a * b for a, b in zip(axes[i], axes[j], strict=True))
            assert product == pytest.approx(float(i == j), abs=1e-6)
    assert axes[0][1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_one_solid_angle_is_a_rotation_about_its_axis(axis: str) -> None:
    assert machine(f"ROTS {axis}25", "G0 X1 Y2 Z3") == pytest.approx(machine(f"ROT {axis}25", "G0 X1 Y2 Z3"))


def test_a_chain_in_the_program_equals_the_chain_of_frame_functions() -> None:
    lines = ("TRANS X5 Y6", "AROT Z30", "ASCALE X2", "AMIRROR Y0", "ATRANS X1", "G0 X7 Y8 Z9")
    whole = "$P_PFRAME=CTRANS(X,5,Y,6):CROT(Z,30):CSCALE(X,2):CMIRROR(Y):CTRANS(X,1)"
    assert machine(*lines) == pytest.approx(machine(whole, "G0 X7 Y8 Z9"))


def test_a_frame_change_does_not_move_the_machine() -> None:
    result = run("G0 X10 Y20 Z30", "TRANS X1 Y2 Z3", "AROT X10 Y20 Z30", "R1=$AA_IM[X] R2=$AA_IM[Y]")
    assert len(moves(result)) == 1
    assert (result.variables["R1"], result.variables["R2"]) == pytest.approx((10, 20))


def test_returning_to_a_point_through_a_frame_gives_no_row() -> None:
    result = run("G0 X10 Y20", "ROT Z33", "TRANS", "G0 X10 Y20")
    assert len(moves(result)) == 1
