"""F of a cut that moves rotary axes alone counts degrees, in whatever unit a program is."""

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
