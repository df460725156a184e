"""The pole of polar planes, by the polar interpolation of FANUC: sides and standing are the stage's own."""

from __future__ import annotations

import pytest

from polycnc.channel.moves.pole import standing
from polycnc.transformation.chain import Chain
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.seated import Seated
from tests.support import run

PLANE = PolarPlane(0, 2, (0, 2, 1))
START = "O1\nG98 G0 X80. C0\nG12.1\nG1 F1000. "


def ends(text: str) -> list[float]:
    """Where the rotary axis is behind the program."""
    return run(f"{START}{text}\nG13.1\nM30\n", "fanuc-0i-tf", machine="lathe-c").coordinates.machine


def test_the_side_of_a_plane_is_found_within_chains_and_seats() -> None:
    sided = PolarPlane(0, 2, (0, 2, 1), side=-1.0, pole_deg=30.0)
    inclined = InclinedAxis(0, 1, 20.0, (0, 2, 1))
    assert standing(PLANE, -1.0, 30.0) == sided
    assert standing(Seated(Chain((PLANE, inclined))), -1.0, 30.0) == Seated(Chain((sided, inclined)))
    assert standing(inclined, -1.0, 30.0) is inclined


@pytest.mark.parametrize(
    ("blocks", "angle"),
    [
        ("X40. C20.\nX0 C0", 26.565051),
        ("X40. C20.\nX0 C0\nZ-5.", 26.565051),
        ("X40. C0\nG3 X0 C0 I-20. J0", 90.0),
    ],
)
def test_the_rotary_axis_stays_where_the_path_has_come_from(blocks: str, angle: float) -> None:
    assert ends(blocks)[2] == pytest.approx(angle, abs=1e-4)


def test_a_path_that_begins_in_the_pole_begins_where_the_axis_stands() -> None:
    channel = run("O1\nG98 G0 X0 C30.\nG12.1\nG13.1\nM30\n", "fanuc-0i-tf", machine="lathe-c")
    assert channel.coordinates.machine[2] == pytest.approx(30.0)


def test_the_linear_axis_of_g12_1_keeps_its_side() -> None:
    assert ends("X40. C20.\nX-40. C-20.")[0] > 0.0
