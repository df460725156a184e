"""The offset memory of the lathe: tool offsets by number, and the work shift (0i-TF Plus II.5.1)."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.memory.encoding import encoded
from polycnc.memory.retained import TOOL_OFFSETS, WORK_SHIFT

if TYPE_CHECKING:
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.deferred.typing import Self
    from polycnc.machine.setup.values import Offsets, Tool


@encoded("turning offset")
@dataclass(slots=True)
class TurningOffset:
    """One number of the offset memory; by axis name, mm, X as radius.

    Attributes:
        geometry: Geometry offset.
        wear: Wear offset; the common offset where geometry and wear are not separate (8136#6 NGW).
        second: Second geometry offset (II.5.1.4).
        radius: Nose radius by geometry; `radius_wear` by wear.
        tip: Imaginary tip number, one for geometry and wear.
    """

    geometry: dict[str, float] = field(default_factory=dict)
    wear: dict[str, float] = field(default_factory=dict)
    second: dict[str, float] = field(default_factory=dict)
    radius: float = 0.0
    radius_wear: float = 0.0
    tip: int = 0


@dataclass(slots=True)
class OffsetMemory(State, lifetime=Lifetime.RETAINED):
    """What the offset screens hold.

    Attributes:
        numbers: Tool offsets by number.
        shifts: The work shift, as `work`.
    """

    numbers: dict[int, TurningOffset] = retained(TOOL_OFFSETS)
    shifts: dict[str, list[float]] = retained(WORK_SHIFT)

    @classmethod
    def first(cls, channel: LatheChannel) -> Self:
        """What is retained, else what the setup says."""
        memory = super().first(channel)
        if not memory.numbers:
            for name, tool in channel.setup.tools.items():
                if isinstance(name, int) or name.isdigit():
                    memory.numbers[int(name)] = _from_setup(channel, tool)
        memory.shifts.setdefault("work", [0.0] * len(channel.axes))
        return memory

    @property
    def work_shift(self) -> list[float]:
        """Shift of all work coordinate systems (G10 P0, work shift screen), all axes, mm."""
        return self.shifts["work"]

    @property
    def has_second(self) -> bool:
        """Whether any number has a second geometry."""
        return any(any(offset.second.values()) for offset in self.numbers.values())

    def at(self, number: int) -> TurningOffset:
        """An offset number; zero until it is set."""
        return self.numbers.setdefault(number, TurningOffset())


def y_offset_axis(channel: LatheChannel) -> int:
    """The axis that has the Y offset: Y, or any other by 5043 (II.5.1.6.1); -1 for none."""
    number = channel.memory.parameters.y_offset_axis
    return number - 1 if 1 <= number <= len(channel.axes) else channel.axis_index.get("Y", -1)


def _from_setup(channel: LatheChannel, tool: Tool) -> TurningOffset:
    """An offset as the screens show it; with 5004#1 ORC a radius value also where the axis has diameters."""
    memory = channel.memory
    index = dict(channel.axis_index)
    if y_offset_axis(channel) >= 0:
        index["Y"] = y_offset_axis(channel)
    halved = frozenset[str]()
    if not memory.parameters.ORC:
        halved = frozenset(name for name, i in index.items() if memory.has_diameter(channel, i))

    def vector(values: Offsets | Tool) -> dict[str, float]:
        named = {"X": values.x, "Y": values.y, "Z": values.z, **values.axes}
        return {name: v / 2.0 if name in halved else v for name, v in named.items() if v}

    if memory.parameters.NGW:
        return TurningOffset(wear=vector(tool), radius_wear=tool.radius, tip=tool.tip)
    return TurningOffset(
        vector(tool), vector(tool.wear), vector(tool.geom2), tool.radius, tool.wear.radius, tool.tip
    )
