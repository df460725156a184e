"""Signals that follow from the state of a control: where its axes stand, what its program asks for. The magazine."""

from __future__ import annotations

from functools import partial
from math import inf
from typing import TYPE_CHECKING

from polycnc.control.tool_change import WINDOW, stands_at_reference, z_stands_at_change_point

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.machine.model import Machine
    from polycnc.mainrun.execution.operation import Operation
    from polycnc.mainrun.signals.image import SignalImage

    States = Mapping[str, Callable[[], bool]]

#: Panel switches, which are signals by their names in capitals.
SWITCHES = (
    "single_block", "optional_stop", "block_skip", "dry_run", "machine_lock", "z_lock", "mst_lock",
)  # fmt: skip
#: The pocket at the change point, counted from 1, and what turns the magazine.
POCKET = "MAGAZINE_POCKET"
STEPS = {"MAGAZINE_STEP_CW": 1, "MAGAZINE_STEP_CCW": -1}
TO_POCKET_1 = "MAGAZINE_TO_POCKET_1"


def axis_states(operation: Operation) -> States:
    """Whether each axis of a channel that a control has in any case stands at its reference point, or beyond it."""
    channel = operation.runs.first.channel
    states: dict[str, Callable[[], bool]] = {}
    for axis, name in enumerate(channel.axes):
        states[f"{name}_AT_REFERENCE"] = partial(stands_at_reference, channel, axis)
        states[f"{name}_BEYOND_REFERENCE"] = partial(_stands_beyond, channel, axis)
    return states


def machine_states(operation: Operation) -> States:
    """States that the tables of a machining centre ask for."""
    run = operation.runs.first
    return {
        "Z_AT_CHANGE_POINT": partial(z_stands_at_change_point, run.channel),
        "SPINDLE_COMMANDED": lambda: operation.program_spindle != 0,
        "T_NOT_IN_MAGAZINE": lambda: _is_not_in_magazine(operation.machine, run.machinery.next_tool),
        "HAS_AXIS_A": lambda: "A" in run.channel.axes,
        **{switch.upper(): partial(_is_switched, operation, switch) for switch in SWITCHES},
    }


def _is_switched(operation: Operation, switch: str) -> bool:
    return bool(getattr(operation.switches.panel, switch))


def _stands_beyond(channel: Channel, axis: int) -> bool:
    """Past its reference point at the end of its travel; an axis without limits can return from anywhere."""
    ends = channel.axis_data[axis].limit_plus < inf
    reference: float = channel.control.reference_point(channel, axis, 1)
    return ends and channel.actual.machine[axis] > reference + WINDOW


def _is_not_in_magazine(machine: Machine, tool: int | str) -> bool:
    return isinstance(tool, int) and not 0 <= tool <= machine.magazine.places


def turn_magazine(signals: SignalImage, machine: Machine, name: str, value: float) -> None:
    """The magazine turns by a pocket when a rule of the machine says so, or goes to pocket 1."""
    if not value or (name not in STEPS and name != TO_POCKET_1):
        return
    at = signals[POCKET] or 1.0
    signals[POCKET] = (at - 1 + STEPS[name]) % machine.magazine.places + 1 if name in STEPS else 1.0
