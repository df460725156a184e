"""A panel with a program, and what stands on it."""

from __future__ import annotations

from typing import Any

from polycnc.mainrun import State, VirtualControl
from polycnc.panel import Light, Panel

RUN = "O1\nM3 S1000\nG1 X100. F6000\nG0 X0\nM30\n"
CONTROLS = ("fanuc-m", "meldas-m")


def panel_of(text: str = RUN, control: str = "fanuc-m", machine: str = "hartford", **more: Any) -> Panel:
    virtual = VirtualControl(control, machine=machine, **more)
    virtual.load(text)
    return Panel(virtual)


def codes(panel: Panel) -> list[str]:
    return [alarm.code for alarm in panel.control.alarms]


def state_of(panel: Panel) -> State:
    return panel.control.state


def sounds(panel: Panel) -> bool:
    return panel.buzzer


def lit(panel: Panel) -> set[str]:
    return {name for name, light in panel.lamps().items() if light is Light.ON}
