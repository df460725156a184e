"""Short ways to run a virtual control in a test."""

from __future__ import annotations

from typing import Any

from polycnc.mainrun import Record, State, VirtualControl
from polycnc.mainrun.execution.execution import Execution

MILL = """O1
G90 G54 G0 X10. Y5.
M3 S1000
G1 X50. F3000
G2 X60. Y15. R10.
G1 Y40.
G3 X50. Y50. R10. F6000
G1 X0 M8
G1 X-5. Y60.
X-6. Y66. F12000
X-9. Y70.
G4 P100
G0 X0 Y0
M30
"""


def power_on(text: str = MILL, control: str = "fanuc-m", **more: Any) -> VirtualControl:
    """A virtual control with a program loaded."""
    virtual = VirtualControl(control, **more)
    virtual.load(text)
    return virtual


def hartford(
    text: str = MILL, control: str = "fanuc-m", machine: str = "hartford", **more: Any
) -> VirtualControl:
    """The same on a Hartford machining centre."""
    return power_on(text, control, machine=machine, **more)


def execution_of(virtual: VirtualControl) -> Execution:
    """What executes the program of the first channel."""
    return virtual._operation.runs.first.execution


def recorded(virtual: VirtualControl) -> list[Record]:
    """What happens from now on."""
    records: list[Record] = []
    virtual.listeners.append(records.append)
    return records


def run_through(virtual: VirtualControl, limit_s: float = 10_000.0) -> State:
    """Start, and start again at every stop, until the end or an alarm."""
    virtual.cycle_start()
    while virtual.run(limit_s=limit_s) is State.STOPPED:
        virtual.cycle_start()
    return virtual.state
