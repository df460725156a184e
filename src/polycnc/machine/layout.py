"""What displays must know of a channel's axes."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.machine.model import Machine


@dataclass(frozen=True, slots=True)
class AxisLayout:
    """What the displays must know of a channel's axes.

    Attributes:
        geometry: For X, Y, Z of the geometry the index of the channel axis, or -1.
        rotary: Indices of rotary axes, in degrees whatever the unit of length.
        modulo: Indices of the rotary axes whose work display stays within one turn.
    """

    geometry: tuple[int, int, int] = (-1, -1, -1)
    rotary: frozenset[int] = frozenset()
    modulo: frozenset[int] = frozenset()


def axis_layout(machine: Machine, channel: int) -> AxisLayout:
    """Geometry, rotary and modulo axes among the columns of a channel."""
    axes = [machine.axis[name] for name in machine.channel(channel).axes]
    return AxisLayout(
        geometry=machine.geometry_indices(channel),
        rotary=frozenset(i for i, axis in enumerate(axes) if axis.rotary),
        modulo=frozenset(i for i, axis in enumerate(axes) if axis.modulo),
    )
