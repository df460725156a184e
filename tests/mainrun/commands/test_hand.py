"""The handwheel beside a program (DRF)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import CommandRefused, VirtualControl
from tests.mainrun.commands.test_any_key import LIMITS, limited
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from pathlib import Path


def test_a_handwheel_shifts_axes_beside_a_program_on_sinumerik_alone() -> None:
    with pytest.raises(CommandRefused):
        power_on().set_switches(drf=True)
    virtual = VirtualControl("sinumerik-840d")
    virtual.set_switches(drf=True)
    virtual.handle("X", 1000)
    virtual.run()
    assert virtual.positions.machine["X"] == pytest.approx(1.0)
    assert virtual.positions.work["X"] == 0.0


def test_a_shift_by_the_handwheel_stays_within_the_travel(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(limited("mill3"), encoding="utf-8")
    virtual = VirtualControl("sinumerik-840d", machine=file)
    virtual.set_switches(drf=True)
    virtual.handle("X", 1_000_000)
    virtual.run()
    assert virtual.positions.machine["X"] == pytest.approx(LIMITS[1])
    virtual.handle("X", -1000)
    virtual.load("G90 G1 X1 F600\nX1.5\nM30\n")
    virtual.cycle_start()
    virtual.run()
    assert [alarm.code for alarm in virtual.alarms] == ["10720"]
    assert virtual.positions.machine["X"] == pytest.approx(LIMITS[1])


@pytest.mark.parametrize("how", ["jog", "increment", "handle", "line"])
@pytest.mark.parametrize(
    ("control_id", "parameters"),
    [("sinumerik-840d", {"36110[X]": 20.0}), ("fanuc-0i-tf", {"1320 X": 40.0})],
)
def test_an_axis_by_hand_stops_at_its_software_limit(
    control_id: str, parameters: dict[str, float], how: str
) -> None:
    control = VirtualControl(control_id, setup={"parameters": parameters})
    control.select_mode("jog" if how == "line" else how)
    if how == "line":
        control.signals["JOG_WCS"] = 1.0
    if how in ("jog", "line"):
        control.jog("X", 1, rapid=True)
    else:
        (control.increment if how == "increment" else control.handle)("X", 10, 10.0)
    control.run(limit_s=20.0)
    limit = next(iter(parameters.values()))
    assert control.positions.machine["X"] == pytest.approx(limit)
    control.stop_jog("X")
    control.select_mode("reference")
    control.home("X")
    control.run()
    assert control.positions.machine["X"] == pytest.approx(0.0)
