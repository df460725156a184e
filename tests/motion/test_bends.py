"""On bends of corners and on arcs under BRISK axes keep their acceleration, by the differences of sampled positions.

What a transformation or `ACC` leaves the axes they have for the bend and for changes of speed together.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from polycnc.motion.limits import channel_axes
from polycnc.session import open_session

if TYPE_CHECKING:
    from polycnc.motion.sampling.samples import Samples

PERIOD, SLACK = 0.001, 1.001
CORNERS = ("G641 ADIS=0.5", "G642", "G64")
TOOL = {"tools": {1: {"length": 50.0}}}
POLAR = "T1 D1\nG0 X60 Z5\nTRANSMIT\n"
CYLINDER = "G19 T1 D1\nG0 X60 Z0\nTRACYL(40)\nG1 X20 Y0 Z-5 F3000\n"
WHEEL = (
    "G1 X10.801 Z2.969 F500\nX12.636 Z6.634 F12000\nG3 X12.365 Z7.544 CR=0.8472 F1500\nX12.047 Z7.536 CR=0.1934\n"
    "G1 X8 Z2.4"
)
SHAFT = (
    "G3 X15.9 Z-5.9 CR=8.66 F500\nG1 X16.287 Z-25.697\nX6.47 Z-28.938 F3000\nX4.506 Z-25.028\nX5.302 Z-25.942"
)
FACE = (
    "G1 X6 Y3 F12000\nX6.108 Y4.52 F1500\nX6.128 Y6.506 F30000\nG3 X-2.253 Y-2.079 CR=11.6667\n"
    "G1 X-1.603 Y-0.344 F1500\nG3 X-1.337 Y0.038 CR=1.684"
)
GROOVE = (
    "Y5.273 Z-10.197 F300\nY0.479 Z-9.751 F4000\nY2.177 Z-13.919 F1500\nG2 Y6.583 Z-7.241 CR=5 F9000\nG1 Y20"
)


def most(text: str, machine: str, left: dict[str, float] | None = None) -> dict[str, float]:
    """Highest acceleration of each axis as a part of what it has, of which `left` is left to some of them."""
    given: list[Samples] = []
    program = f"{text}\nM30\n".encode()
    session = open_session(program, control="sinumerik-840d", machine=machine, setup=TOOL, keep=False)
    sampler = session.sample(PERIOD, given.append)
    result = session.run()
    assert not result.alarms, result.alarms
    assert result.plan.total_s > 0.0
    sampler.close()
    ways, found = np.diff(np.concatenate([own.position for own in given]), axis=0), {}
    for i, axis in enumerate(channel_axes(result.machine, 1, result.machine.channels[0].names)):
        assert axis is not None
        way = (ways[:, i] + 180.0) % 360.0 - 180.0 if axis.rotary else ways[:, i]
        own = (left or {}).get(axis.name, 1.0) * axis.acceleration
        found[axis.name] = float(np.abs(np.diff(way)).max()) / (own * PERIOD**2)
    return found


@pytest.mark.parametrize(
    ("machine", "text"),
    [
        ("grinder-mu-mz", f"G641 ADIS=0.76\nG18 TRAANG(45)\nG0 X10 Z0\n{WHEEL}"),
        ("grinder-mu-mz", f"G641 ADIS=0.231\nG18 TRAANG(45)\nG0 X10 Z0\n{SHAFT}"),
        ("lathe-c-transmit", f"G641 ADIS=0.5\n{CYLINDER}{GROOVE}"),
        ("lathe-c-transmit", f"G642\n{CYLINDER}{GROOVE}"),
        ("lathe-c-transmit", f"G64\n{CYLINDER}{GROOVE}"),
        ("lathe-c-transmit", f"G641 ADIS=1.5\n{POLAR}{FACE}"),
    ],
)
def test_on_the_bend_of_a_corner_bend_and_speed_share_what_is_left_to_the_axes(
    machine: str, text: str
) -> None:
    """Each of both had all of it: the axes exceeded their acceleration by up to 70 %."""
    found = most(f"BRISK {text}\nTRAFOOF", machine)
    assert max(found.values()) <= SLACK, found


@pytest.mark.parametrize(
    "rows",
    [
        "G60 X1 Y1 F4000\nG2 X0.001 Y-1 CR=2.8888\nG1 X-1 Y1 F12000\nX1 Y1\nG2 X1 Y-0.034 CR=1.1092",
        "G64 X-2 Y1.5 F6000\nG3 X-1.5 Y-2 CR=2.9\nX1 Y-1.2 CR=1.9",
    ],
)
def test_beside_the_centre_an_arc_leaves_the_rotary_axis_its_acceleration(rows: str) -> None:
    """The columns have hardly any of theirs there: the rotary axis had 2.3 times its own."""
    found = most(f"BRISK\n{POLAR}G1 X3 Y1 F2000\n{rows}\nTRAFOOF", "lathe-c-transmit")
    assert max(found.values()) <= SLACK, found


def test_a_bend_reaches_no_farther_towards_the_centre_than_what_it_is_bounded_by() -> None:
    """With 4.6 mm to round the corner the path is bent up to where the rotary axis leaves the columns far less."""
    rows = "G1 X-5.3 Y-4.133 F12000\nX3.004 Y-6.09 F6000\nX-5.032 Y-0.952\nX-1.915 Y0.396 F30000"
    found = most(f"BRISK G641 ADIS=4.59\n{POLAR}G1 X-8.8 Y-4.7 F3000\n{rows}\nTRAFOOF", "lathe-c-transmit")
    assert max(found.values()) <= SLACK, found


@pytest.mark.parametrize("corners", [*CORNERS, "G60"])
@pytest.mark.parametrize(
    "rows",
    [
        "G1 X0.1 Y10 F12000\nX2 Y28\nX2.1 Y40\nX20 Y37\nX30 Y60",
        "G1 X1 Y10 F12000\nG3 X20 Y20 CR=14\nG2 X32 Y20 CR=7\nX40 Y50 CR=40\nG1 X60",
        "G1 X5 F9000\nASPLINE X10 Y4\nX16 Y3\nX20 Y-3\nX28 Y0\nG1 X40",
    ],
)
def test_axes_keep_what_acc_leaves_them(rows: str, corners: str) -> None:
    """At corners an axis had up to five times that, and 1.4 times where it changes its speed along an arc."""
    found = most(f"BRISK {corners}\nACC[X]=20\nG0 X0 Y0\n{rows}", "mill3", {"X": 0.2})
    assert max(found.values()) <= SLACK, found


@pytest.mark.parametrize("corners", ["G642", "G64"])
def test_under_soft_a_spline_keeps_what_acc_leaves_an_axis(corners: str) -> None:
    """An axis that a chord hardly moves is moved by the curve: it had twice what it may."""
    rows = "ASPLINE X10 Y4\nX16 Y4.1\nX20 Y-3\nX20.1 Y-8\nX15 Y-9\nG1 X0"
    found = most(f"SOFT {corners}\nACC[X]=10\nG0 X0 Y0\nG1 X5 F9000\n{rows}", "mill3", {"X": 0.1})
    assert max(found.values()) <= SLACK, found


def test_an_arc_that_acc_slows_down_is_as_fast_as_its_axes_can() -> None:
    """Both axes together hold the speed `√(a·r)` of the worst direction, and reach it within their parts of a."""
    text = "BRISK G60\nACC[X]=25\nACC[Y]=25\nG0 X0 Y0\nG1 X1 F30000\nG3 X1 Y0 I0 J60"
    found = most(text, "mill3", {"X": 0.25, "Y": 0.25})
    assert found["X"] == pytest.approx(1.0, rel=0.02)
    assert found["Y"] == pytest.approx(1.0, rel=0.02)
