"""Speeds of rotary axes that move alone count degrees, in whatever unit a program is: F, and those of rapids."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.motion.explain import Cause
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session

#: Degrees, and seconds at 60 degrees a minute.
WAY = 90.0
WORD = "{unit} G90 G94\nG1 A90. F60.\nM30\n"
PROGRAMS = [
    ("fanuc-m", "G20", "O1\n" + WORD),
    ("fanuc-m", "G21", "O1\n" + WORD),
    ("meldas-m", "G20", "O1\n" + WORD),
    ("syntec-mill", "G70", WORD),
    ("sinumerik-840d", "G70", WORD),
    ("sinumerik-840d", "G700", WORD),
    ("sinumerik-840d", "G700", "{unit} G90 G94 FGROUP(X,Y,Z,A)\nG1 A90 F60\nM30\n"),
    ("sinumerik-840d", "G700", "{unit} G90 G94 OVR=50\nG1 A90 F120\nM30\n"),
    ("sinumerik-840d", "G700", "{unit} G90 G95 S100 M3\nG1 A90 F0.6\nM30\n"),
    ("sinumerik-840d", "G700", "{unit} G90 G94 SOFT\nG1 A90 F60\nM30\n"),
]


@pytest.mark.parametrize(("control", "unit", "text"), PROGRAMS)
def test_a_degree_a_second_takes_ninety_seconds(control: str, unit: str, text: str) -> None:
    given: list[Samples] = []
    session = open_session(text.format(unit=unit).encode(), control=control, machine="mill4", keep=False)
    sampler = session.sample(0.1, given.append)
    account = session.explain_time()
    result = session.run()
    assert result.plan.times.cutting_s == pytest.approx(WAY, abs=0.1)
    sampler.close()
    turned = np.concatenate([samples.velocity[:, 3] for samples in given])
    assert turned.max() == pytest.approx(1.0, rel=1e-6)
    assert account.parts[Cause.FEED].seconds == pytest.approx(WAY, abs=0.2)


def test_a_rapid_at_a_speed_of_its_own_counts_degrees() -> None:
    """SYNTEC G00 P1 F1=, where every axis runs a rapid alone (Pr411)."""
    session = open_session(
        b"G70 G90 G00 P1 A90. F1=60.\nM30\n",
        control="syntec-mill",
        machine="mill4",
        setup={"parameters": {"411": 1}},
        keep=False,
    )
    assert session.run().plan.times.rapid_s == pytest.approx(WAY, abs=0.1)


@pytest.mark.parametrize("unit", ["G700", "G710"])
def test_degrees_are_as_fast_for_an_acceleration_that_is_reduced_at_speed(unit: str) -> None:
    """DRIVE: 10 degrees a second lie far below the speed from which axes accelerate less (MD35220, MD35230)."""
    data = {"35220": 0.2, "35230": 0.9}
    setup = {"parameters": {f"{number}[{axis}]": value for axis in "XYZA" for number, value in data.items()}}
    session = open_session(
        f"{unit} DRIVE G94\nG1 A1 F600\nM30\n".encode(),
        control="sinumerik-840d",
        machine="mill4",
        setup=setup,
        keep=False,
    )
    assert session.run().plan.times.cutting_s == pytest.approx(0.125, abs=1e-3)


@pytest.mark.parametrize(
    ("control", "metric", "inches"),
    [("fanuc-m", "G21", "G20"), ("meldas-m", "G21", "G20"), ("syntec-mill", "G71", "G70")],
)
def test_a_corner_from_a_turn_into_a_slow_cut_takes_as_long_in_inches(
    control: str, metric: str, inches: str
) -> None:
    """A degree counts as an inch there: the axis accelerates by its degrees all the same; it took a second longer."""
    text = "{unit} G90 G64 G1 X{x} F{f}\nA4.8 F1000.\nX0 F{f}\nM30\n"
    seconds = [
        open_session(
            text.format(unit=unit, x=part, f=f"{4.0 * part:.1f}").encode(), control=control, machine="mill4"
        )
        .run()
        .plan.total_s
        for unit, part in ((metric, 25.4), (inches, 1.0))
    ]
    assert seconds[1] == pytest.approx(seconds[0], abs=0.3)
