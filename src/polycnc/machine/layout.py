"""What displays must know of a channel's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.toolpath.trace import AxisLayout

if TYPE_CHECKING:
    from polycnc.machine.model import Machine


def axis_layout(machine: Machine, channel: int) -> AxisLayout:
    """Geometry, rotary and modulo axes among the columns of a channel."""
    axes = [machine.axis[name] for name in machine.channel(channel).axes]
    return AxisLayout(
        geometry=machine.geometry_indices(channel),
        rotary=frozenset(i for i, axis in enumerate(axes) if axis.rotary),
        modulo=frozenset(i for i, axis in enumerate(axes) if axis.modulo),
    )
