"""A channel of any control can be led by a transformation: its rows know it, and the displays show the axes."""

from __future__ import annotations

import pytest

from polycnc.transformation.kinematic.inclined import InclinedAxis
from tests.support import run

INCLINED = InclinedAxis(0, 2, 60.0, (0, 1, 2))


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m", "syntec-mill", "sinumerik-840d"])
def test_rows_lead_the_axes_through_the_transformation(control: str) -> None:
    channel = run("G1 X10. F100\nM30\n", control, machine="mill3")
    c = channel.coordinates
    c.transform(INCLINED)
    assert c.machine == pytest.approx([10.0, 0.0, 0.0])
    assert c.position == pytest.approx([5.0, 0.0, 10.0 * 0.75**0.5])
    context = channel.control.context(channel)
    assert context.transformation is INCLINED
    assert channel.toolpath.to_machine([5.0, 0.0, 0.0], context, c.geometry) == pytest.approx(
        [10.0, 0.0, -5.0 * 3.0**0.5]
    )
