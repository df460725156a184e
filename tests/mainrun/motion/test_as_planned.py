"""The main run is where the samples are, on programs whose way or corners its own rules could take otherwise."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded

PERIOD = 0.004
SPIRALS = [
    "G21 G90 G61\nG1 X20. F1000\nG3.1 X0 Y5. I-20. J0\nM30\n",
    "G21 G90 G64\nG1 X5. F1000\nG3.1 X0 Y50. Z8. I-5. J0\nG1 Y60.\nM30\n",
]
#: The rotary axis turns fast on a way of half a millimetre: no law leads from one into the next row.
TURNS = "G1 X1.723 Y-7.118 Z6.415 A=DC(63.933) F6000\nG1 X2.037 Y-7.276 Z6.123 A=IC(52)\n"
ARC = "G2 X10.6218 Y-35.4401 I4.54472 J-14.00514 F500\n"
LEFT = "G1 X10.6 Y-35.6 A=IC(200)\n"


def sampled(text: str, control: str, machine: str) -> Samples:
    """The samples of a program."""
    given: list[Samples] = []
    session = open_session(text.encode(), control=control, machine=machine, keep=False)
    sampler = session.sample(PERIOD, given.append)
    assert session.run().plan.total_s > 0.0
    sampler.close()
    return Samples(*(np.concatenate(column) for column in zip(*given, strict=True)))


@pytest.mark.parametrize("text", SPIRALS)
def test_a_spiral_is_run_as_its_way_grows(text: str) -> None:
    virtual = power_on(text, "meldas-m")
    virtual.cycle_start()
    for place in sampled(text, "meldas-m", "mill3").position:
        assert virtual.machine_position == pytest.approx(place, abs=1e-5)
        virtual.step(PERIOD)


@pytest.mark.parametrize("corners", ["G64", "G642", "G641 ADIS=0.05"])
@pytest.mark.parametrize("blocks", [TURNS + ARC, ARC + LEFT, TURNS + ARC + LEFT + ARC])
def test_the_axes_rest_where_no_law_leads_on_around_one_line(corners: str, blocks: str) -> None:
    text = f"G71 G90 SOFT {corners}\n{blocks.replace('I4.54472 J-14.00514', 'CR=40')}M30\n"
    virtual = power_on(text, "sinumerik-840d", machine="mill4")
    records, planned = recorded(virtual), sampled(text, "sinumerik-840d", "mill4").time[-1]
    virtual.cycle_start()
    assert virtual.run() is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    assert end == pytest.approx(planned, abs=2.0 * PERIOD)
