"""Signals that follow from the state of a control: where its axes stand, what its program asks for. The magazine."""

from __future__ import annotations

from functools import partial
from math import inf
from typing import TYPE_CHECKING

from polycnc.control.tool_change import WINDOW, change_points

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

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
    """Whether each axis stands at its first reference point, or beyond it."""
    channel = operation.machine.channels[0]
    states: dict[str, Callable[[], bool]] = {}
    for index, name in enumerate(channel.axes):
        states[f"{name}_AT_REFERENCE"] = partial(stands_at, operation, index, 1)
        states[f"{name}_BEYOND_REFERENCE"] = partial(_stands_beyond, operation, index)
    return states


def machine_states(operation: Operation) -> States:
    """States that the tables of a machining centre ask for."""
    names = operation.machine.channels[0].axes
    z = names.index("Z") if "Z" in names else None
    return {
        "Z_AT_CHANGE_POINT": lambda: (
            z is None
            or any(stands_at(operation, z, n) for n in change_points(operation.runs.first.channel, z))
        ),
        "SPINDLE_COMMANDED": lambda: operation.program_spindle != 0,
        "T_NOT_IN_MAGAZINE": lambda: _is_not_in_magazine(
            operation.machine, operation.runs.first.machinery.next_tool
        ),
        "HAS_AXIS_A": lambda: "A" in names,
        **{switch.upper(): partial(_is_switched, operation, switch) for switch in SWITCHES},
    }


def _is_switched(operation: Operation, switch: str) -> bool:
    return bool(getattr(operation.switches.panel, switch))


def stands_at(operation: Operation, axis: int, number: int) -> bool:
    """Whether an axis stands at one of its reference points."""
    return abs(operation.runs.first.machine_position[axis] - _reference(operation, axis, number)) <= WINDOW


def _stands_beyond(operation: Operation, axis: int) -> bool:
    """Past its reference point at the end of its travel; an axis without limits can return from anywhere."""
    ends = operation.runs.first.channel.axis_data[axis].limit_plus < inf
    return ends and operation.runs.first.machine_position[axis] > _reference(operation, axis, 1) + WINDOW


def _reference(operation: Operation, axis: int, number: int) -> float:
    return operation.control.reference_point(operation.runs.first.channel, axis, number)


def _is_not_in_magazine(machine: Machine, tool: int | str) -> bool:
    return isinstance(tool, int) and not 0 <= tool <= machine.magazine.places


def turn_magazine(signals: SignalImage, machine: Machine, name: str, value: float) -> None:
    """The magazine turns by a pocket when a rule of the machine says so, or goes to pocket 1."""
    if not value or (name not in STEPS and name != TO_POCKET_1):
        return
    at = signals[POCKET] or 1.0
    signals[POCKET] = (at - 1 + STEPS[name]) % machine.magazine.places + 1 if name in STEPS else 1.0
