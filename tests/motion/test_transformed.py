"""Under a transformation the real axes keep their velocity and acceleration."""

from __future__ import annotations

import pytest

import polycnc
from polycnc.machine import load_machine
from polycnc.mainrun import State
from polycnc.motion.transformed import RealAxes
from polycnc.toolpath import Context, Kind, Toolpath
from tests.mainrun.support import power_on

POLAR = """O1
G98 G0 X60. Z5. C0
G12.1
G1 X2. F3000
C15.
X-2.
C-15.
X2. C1.
X20. C0
G3 X0 C20. R20.
G13.1
M30
"""
MACHINE = load_machine("lathe-c-transmit")


def test_the_real_axes_keep_their_velocity_near_the_centre() -> None:
    virtual = power_on(POLAR, "fanuc-0i-tf", machine="lathe-c-transmit")
    virtual.cycle_start()
    cycle, before, fastest = 0.004, virtual.machine_position, [0.0, 0.0, 0.0]
    while virtual.state is State.RUNNING:
        virtual.step()
        now = virtual.machine_position
        ways = [abs((b - a + 180.0) % 360.0 - 180.0) for a, b in zip(before, now, strict=True)]
        fastest = [max(f, way / cycle) for f, way in zip(fastest, ways, strict=True)]
        before = now
    assert virtual.state is State.READY
    for name, speed in zip(virtual.channel.axes, fastest, strict=True):
        axis = MACHINE.axis[name]
        assert speed <= max(axis.rapid, axis.max_feed) * 1.02, name


def test_a_plan_is_slow_where_the_rotary_axis_has_to_be_fast() -> None:
    result = polycnc.run(POLAR, control="fanuc-0i-tf", machine="lathe-c-transmit")
    near = next(i for i, row in enumerate(result.rows) if row.get("line") == 5)
    c = MACHINE.axis["C"]
    # 15 mm past the centre at 1 mm: C turns at v/r, r = 1 mm at the start.
    assert result.plan.row_s[near] > 15.0 / (c.max_feed * 3.1416 / 180.0)


def test_rows_without_a_transformation_have_no_cap() -> None:
    toolpath = Toolpath(("X", "Z", "C"))
    number = toolpath.context_number(Context())
    toolpath.append(Kind.FEED, 0, 1, number, 10.0, [10.0, 0.0, 90.0])
    real = RealAxes(tuple(MACHINE.axis[name] for name in "XZC"), (0, -1, 1), (0.0, 0.0, 0.0))
    assert real.caps(toolpath.chunk, toolpath.contexts) == {}


@pytest.mark.parametrize("radius", [5.0, 20.0])
def test_a_circle_around_the_centre_turns_the_rotary_axis_evenly(radius: float) -> None:
    """C turns by 180/(pi·r) degrees a millimetre: the cap is its velocity over that, X stands."""
    there, back = f"X{2 * radius} C0", f"X0 C{radius}"
    text = f"O1\nG98 G0 {there} Z5.\nG12.1\nG3 {back} R{radius} F30000\nG13.1\nM30\n"
    result = polycnc.run(text, control="fanuc-0i-tf", machine="lathe-c-transmit")
    assert not result.alarms
    arc = next(i for i, row in enumerate(result.rows) if row["type"] == "ccw")
    seconds = 90.0 / MACHINE.axis["C"].max_feed
    assert result.plan.row_s[arc] >= seconds * 0.98
