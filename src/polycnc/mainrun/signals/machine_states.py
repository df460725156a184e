"""Signals that follow from the state of a control: where its axes stand, what its program asks for. The magazine."""

from __future__ import annotations

from functools import partial
from math import inf

from polycnc.control.tool_change import WINDOW, stands_at_reference, z_stands_at_change_point
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from polycnc.channel.channel import Channel
    from polycnc.machine.model import Machine
    from polycnc.mainrun.commands.settings import Switches
    from polycnc.mainrun.execution.channel_run import ChannelRun
    from polycnc.mainrun.signals.image import SignalImage

    States = dict[str, Callable[[], bool]]

#: Panel switches, which are signals by their names in capitals.
SWITCHES = (
    "single_block", "optional_stop", "block_skip", "dry_run", "machine_lock", "z_lock", "mst_lock",
)  # fmt: skip
#: The pocket at the change point, counted from 1, and what turns the magazine.
POCKET = "MAGAZINE_POCKET"
STEPS = {"MAGAZINE_STEP_CW": 1, "MAGAZINE_STEP_CCW": -1}
TO_POCKET_1 = "MAGAZINE_TO_POCKET_1"


def axis_names(channel: Channel) -> tuple[str, ...]:
    """What signals call the axes of a channel: as it does, or as the machine does where one name means several axes."""
    machine = channel.machine
    means: dict[str, set[str]] = {}
    for each in machine.channels:
        for name, axis in zip(each.names, each.axes, strict=True):
            means.setdefault(name, set()).add(axis)
    own = machine.channel(channel.number)
    return tuple(
        name if len(means.get(name, ())) < 2 else axis for name, axis in zip(own.names, own.axes, strict=True)
    )


def axis_states(channel: Channel) -> States:
    """Whether each axis of a channel stands at its reference point, or beyond it."""
    states: dict[str, Callable[[], bool]] = {}
    for axis, name in enumerate(axis_names(channel)):
        states[f"{name}_AT_REFERENCE"] = partial(stands_at_reference, channel, axis)
        states[f"{name}_BEYOND_REFERENCE"] = partial(_stands_beyond, channel, axis)
    return states


def machine_states(
    first: Channel, runs: Iterable[ChannelRun], switches: Switches, program_spindle: Callable[[], int]
) -> States:
    """States that the tables of a machining centre ask for.

    Args:
        first: The channel that a control has in any case: it changes the tools.
        runs: All channels, as they are each time one asks.
        switches: What the operator has set.
        program_spindle: Direction in which a program that waits wants to find the spindle turning.
    """
    return {
        "Z_AT_CHANGE_POINT": partial(z_stands_at_change_point, first),
        "SPINDLE_COMMANDED": lambda: program_spindle() != 0,
        "T_NOT_IN_MAGAZINE": lambda: any(
            _is_not_in_magazine(run.channel.machine, run.machinery.next_tool) for run in runs
        ),
        "HAS_AXIS_A": lambda: any("A" in run.channel.axes for run in runs),
        **{switch.upper(): partial(_is_switched, switches, switch) for switch in SWITCHES},
    }


def _is_switched(switches: Switches, switch: str) -> bool:
    return bool(getattr(switches.panel, switch))


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
