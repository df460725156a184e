"""Faults stop every machine, with its own alarm or with that of the fault, in both languages."""

from __future__ import annotations

from itertools import product

import pytest

from polycnc.control.registry import ids
from polycnc.machine.load import load_machine
from polycnc.mainrun import CommandRefused, State, VirtualControl
from polycnc.mainrun.equipment import equipment
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.teaching.faults import faults, inject, with_faults

SINUMERIK = "G1 X100 F600\nM30\n"
PROGRAM = "O1\nG1 X100. F600\nM30\n"


def control_of(control: str, machine: str | None = None) -> VirtualControl:
    known, built, start = equipment(control, machine, None)
    made = VirtualControl(known, machine=with_faults(built, known.id), setup=start)
    made.load(SINUMERIK if control == "sinumerik-840d" else PROGRAM)
    return made


@pytest.mark.parametrize(("control", "fault"), list(product(ids(), faults())))
def test_every_fault_stops_a_running_program_until_it_is_mended_and_reset(control: str, fault: str) -> None:
    virtual = control_of(control)
    virtual.cycle_start()
    virtual.step(0.5)
    inject(virtual, fault)
    virtual.run()
    assert faults()[fault].is_in(virtual)
    (alarm,) = virtual.alarms
    assert alarm.code.endswith(faults()[fault].code)
    assert len({virtual.alarm_text(alarm, lang) for lang in LANGUAGES}) == 2
    if fault != "door":  # which refuses the start only
        virtual.reset()
        assert virtual.alarms != ()
    inject(virtual, fault, on=False)
    virtual.reset()
    virtual.run()
    assert virtual.alarms == ()
    virtual.cycle_start()
    assert virtual.run() is State.READY


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
def test_a_machine_with_alarms_of_its_own_keeps_them(control: str) -> None:
    machine = load_machine("hartford")
    assert {row.code for row in with_faults(machine, control).alarms} <= {"9001", "9004", "9005", "9007"}
    virtual = control_of(control, "hartford")
    inject(virtual, "air")
    (alarm,) = virtual.alarms
    assert not alarm.code.endswith("9002")


def test_a_fault_that_nobody_knows_is_refused() -> None:
    with pytest.raises(CommandRefused):
        inject(control_of("fanuc-m"), "nothing")
