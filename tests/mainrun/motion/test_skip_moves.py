"""A skip move takes as long in the main run as it is planned, although the program waits for where it has ended."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State
from polycnc.session import open_session
from tests.mainrun.support import power_on, recorded


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill"])
@pytest.mark.parametrize("more", ["", "G1 X0 F3000.\n", "G31 Y20. F1000.\nG31 X0 Y0\n"])
def test_a_skip_move_takes_as_long_as_planned(control: str, more: str) -> None:
    assert_as_planned(
        f"O1\n{'G71' if control == 'syntec-mill' else 'G21'} G90\nG0 X10.\nG31 X50. F500.\n{more}M30\n",
        control,
    )


@pytest.mark.parametrize("on", ["G05 P10000", "G05.1 Q1 E0.02"])
def test_so_it_does_where_the_path_is_smoothed(on: str) -> None:
    off = "G05 P0" if "P" in on else "G05.1 Q0"
    assert_as_planned(f"O1\nG71 G90\n{on}\nG31 X50. F500.\nG31 X0\n{off}\nM30\n", "syntec-mill")


def assert_as_planned(text: str, control: str) -> None:
    """The main run of a program ends when the plan says."""
    planned = open_session(text.encode(), control=control, keep=False).run().plan.total_s
    virtual = power_on(text, control)
    records, begun = recorded(virtual), virtual.time
    virtual.cycle_start()
    assert virtual.run(limit_s=100.0) is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    assert end - begun == pytest.approx(planned, abs=1e-6)
