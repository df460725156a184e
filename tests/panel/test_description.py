"""What stands on the panels: everything that the manual names, in both languages, with conditions that can be read."""

from __future__ import annotations

import pytest

from polycnc.control.alarm_text import catalogue_of
from polycnc.control.registry import control
from polycnc.machine import load_machine
from polycnc.machine.rules import condition_of, signals_in
from polycnc.mainrun.reading.snapshot import PanelSwitches
from polycnc.panel import describe
from polycnc.panel.description import PANELS

AXES = ("X", "Y", "Z")
#: Controls whose panel the manual of the machining centres describes.
HARTFORD = ("fanuc-m", "meldas-m")
#: Keys of the manual's chapter on the panel; two of them only together with C8, which lists them.
KEYS = {
    *("B1", "B2", "B3", "B4", "C1", "C2", "C3", "C4", "C5", "C6", "C7", "C8", "A8"),
    *(f"D{number}" for number in range(1, 13)),
    *("START", "HOLD", "RESET", "EMERGENCY", "POWER_ON", "POWER_OFF", "UNCLAMP"),
    *("Z_LOCK", "MST_LOCK", "ABSOLUTE", "F100"),
}
WITH_C8 = {"B1", "B3", "B4", "C1", "C2", "C3", "C4", "C5", "C6", "C7", "D3", "D4"}
LAMPS = {
    *("E1", "E2", "E3"),
    *(f"E{number}" for number in range(7, 16)),
    *("ZNG", "AFL", "ABS", "OVC", "CYCLE_END"),
}


@pytest.mark.parametrize("control_id", HARTFORD)
def test_everything_that_the_manual_names_stands_on_the_panel(control_id: str) -> None:
    panel = describe(control_id, AXES)
    assert set(panel.keys) == KEYS
    assert set(panel.lamps) == LAMPS
    assert {key.id for key in panel.keys.values() if key.safety} == WITH_C8


@pytest.mark.parametrize("control_id", PANELS)
def test_every_part_has_a_name_in_both_languages(control_id: str) -> None:
    panel = describe(control_id, AXES)
    names = [lamp.name for lamp in (*panel.lights.values(), *panel.keys.values())]
    names += [switch.name for switch in panel.switches.values()] + [
        mode.name for mode in panel.modes.values()
    ]
    for name in names + [unit.name for unit in panel.mdi_units]:
        assert set(name) == {"en", "zh-TW"}
        assert all(name.values()), name


def test_the_mode_switches_have_the_positions_of_the_manual() -> None:
    shared = ["zero", "rapid", "jog", "handle", "mdi", "memory"]
    assert list(describe("fanuc-m", AXES).modes) == [*shared, "dnc", "edit"]
    assert list(describe("meldas-m", AXES).modes) == [*shared, "tape"]


def test_the_override_switches_have_the_steps_of_the_manual() -> None:
    switches = describe("fanuc-m", AXES).switches
    assert switches["feed"].positions == tuple(str(10 * step) for step in range(21))
    assert switches["spindle"].positions == tuple(str(10 * step) for step in range(5, 13))
    assert switches["rapid"].positions == ("F0", *(str(10 * step) for step in range(1, 11)))
    assert switches["handle_step"].values == (0.001, 0.01, 0.1)
    for switch in switches.values():
        assert len(switch.positions) == len(switch.values)
        assert switch.start in switch.positions


@pytest.mark.parametrize("control_id", PANELS)
def test_conditions_and_switches_of_the_panel_exist(control_id: str) -> None:
    panel = describe(control_id, AXES)
    for lamp in panel.lights.values():
        for condition in filter(None, (lamp.when, lamp.blinks)):
            condition_of(condition)
            assert signals_in(condition)
    for key in panel.keys.values():
        assert not key.switch or hasattr(PanelSwitches(), key.switch)
        assert set(key.modes) <= set(panel.modes)
        assert sum(map(bool, (key.switch, key.signal, key.command))) <= 1


@pytest.mark.parametrize("control_id", HARTFORD)
def test_the_alarms_of_lamp_e15_are_in_the_catalogue(control_id: str) -> None:
    codes = set(describe(control_id, AXES).lamps["E15"].codes)
    assert codes
    assert codes <= set(catalogue_of(control(control_id), load_machine("hartford")))


def test_reference_lamps_follow_the_axes_of_the_machine() -> None:
    lamps = describe("fanuc-m", ("X", "Y", "Z", "A", "C")).lamps
    assert {name for name in lamps if name in {"E1", "E2", "E3", "E4", "E5"}} == {
        "E1",
        "E2",
        "E3",
        "E4",
        "E5",
    }
    assert lamps["E5"].when.startswith("C_AT_REFERENCE")


def test_the_mdi_units_are_those_of_the_manual() -> None:
    assert [unit.inches for unit in describe("fanuc-m", AXES).mdi_units] == [10.4, 8.4]
    (meldas,) = describe("meldas-m", AXES).mdi_units
    assert {"MONITOR", "TOOL/PARAM", "RESET"} <= set(meldas.keys)
