"""The axes behind the interpolator."""

from __future__ import annotations

import numpy as np
import pytest

from polycnc.mainrun import State
from polycnc.motion.sampling.samples import Samples
from polycnc.session import open_session
from tests.mainrun.support import power_on

PERIOD = 0.004
CORNERS = "G1 X10. Y0. F3000.\nX14. Y6.\nG2 X24. Y16. R10.\nG1 X24. Y17.\nX23. Y18.\nM30\n"


@pytest.mark.parametrize(
    ("control", "head"), [("fanuc-m", "G21 G90 G64\n"), ("syntec-mill", "G71 G90 G64\n")]
)
def test_the_main_run_has_the_axes_where_the_samples_have_them(control: str, head: str) -> None:
    given: list[Samples] = []
    session = open_session((head + CORNERS).encode(), control=control, keep=False)
    sampler = session.sample(PERIOD, given.append)
    session.run()
    assert session.result.plan.total_s > 0.5
    sampler.close()
    planned = np.concatenate([samples.position for samples in given])
    virtual, k = power_on(head + CORNERS, control), 0
    virtual.cycle_start()
    while virtual.state is State.RUNNING:
        assert virtual.machine_position == pytest.approx(planned[k].tolist(), abs=1e-5)
        virtual.step(PERIOD)
        k += 1
    assert k >= len(planned) - 1
