"""The memory of the lathe control: its programming frames and what parameters say of its axes."""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, lasting
from polycnc.control.word_address.macro_b.variables import MacroMemory
from polycnc.control.word_address.memory import ProgrammingFrames
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.geometry.frames import IDENTITY, Frame, scaling, translation

with loaded_when_called():
    from polycnc.control.word_address.macro_b import parameter_input

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.fanuc.lathe.parameters import LatheParameters
    from polycnc.control.parameters import Parameter
    from polycnc.control.word_address.family import WordAddressChannel


@dataclass(slots=True)
class TurningFrames(ProgrammingFrames):
    """The programming frame of a lathe: rotation or mirror first, then tool offsets that move the point.

    Attributes:
        turret: X of the opposite turret, mirrored (G68).
        offset: Offsets of all axes that move the point; a parameter says whether a reset ends them.
        geometry: Columns of the geometry axes.
        conversions: How many 3-D conversions act within each other (G68.1 with I J K).
    """

    turret: Frame = IDENTITY
    offset: list[float] = lasting(Lifetime.POWER, factory=list)
    geometry: tuple[int, int, int] = lasting(Lifetime.POWER, (-1, -1, -1))
    conversions: int = 0

    @classmethod
    def first(cls, channel: Channel) -> TurningFrames:
        """Nothing moves the point."""
        return cls(offset=[0.0] * len(channel.axes), geometry=channel.coordinates.geometry)

    def product(self) -> Frame:
        """The whole frame of the geometry axes."""
        x, y, z = (self.offset[i] if i >= 0 else 0.0 for i in self.geometry)
        frame = self.turret @ translation(x, y, z) @ super().product()
        return IDENTITY if frame.is_identity else frame

    def set_turret(self, distance: float | None) -> None:
        """X of the opposite turret, mirrored at this distance (mm, radius); None for the own turret."""
        self.turret = (
            IDENTITY if distance is None else translation(distance, 0.0, 0.0) @ scaling(-1.0, 1.0, 1.0)
        )

    @property
    def rotates(self) -> bool:
        """Whether a rotation or a mirror is active."""
        return bool(self.mirrored) or not self.rotation.is_identity

    @property
    def shift(self) -> list[float] | None:
        """The offset of axes beside the geometry; None where there is none."""
        shift = [0.0 if i in self.geometry else value for i, value in enumerate(self.offset)]
        return shift if any(shift) else None


def has_diameter(channel: WordAddressChannel, parameters: LatheParameters, axis: int) -> bool:
    """Whether an axis is one whose words are diameters (1006#3 DIA; as delivered: as the machine says)."""
    data = channel.axis_data[axis]
    chosen = parameters.of(channel.axes[axis]).DIA
    return (data.diameter if chosen is None else chosen) and not data.rotary


class TurningMemory(MacroMemory):
    """State of a lathe control that no single feature owns."""

    channel: LatheChannel
    parameters: LatheParameters
    frames: TurningFrames
    frames_class: ClassVar[type[ProgrammingFrames]] = TurningFrames

    def from_setup(self, channel: WordAddressChannel, shown: list[float]) -> list[float]:
        """Offsets as radii, where the setup says diameters."""
        return [
            value / 2.0 if self.has_diameter(channel, axis) else value for axis, value in enumerate(shown)
        ]

    def has_diameter(self, channel: WordAddressChannel, axis: int) -> bool:
        """Whether an axis is one whose words are diameters."""
        return has_diameter(channel, self.parameters, axis)

    def radius_of(self, axis: int, shown: float) -> float:
        """A value of the displays (diameter where the axis has one), mm, in internal units."""
        internal: float = self.channel.control.from_display(self.channel, axis, shown)
        return internal

    def set_cycle_parameter(self, parameter: Parameter[float], value: float) -> None:
        """What the first block of a turning cycle says, a parameter from then on (II.4.2.1 to 4.2.7)."""
        if value != self.parameters.value(parameter):
            parameter_input.set_parameter(self.channel, parameter.key, value, keeps_plans=True)
