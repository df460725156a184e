"""The memory of the lathe control: tool offsets of turning tools, shifts, and what cycles keep."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from polycnc.control.word_address.macro_b.parameter_input import set_parameter
from polycnc.control.word_address.macro_b.variables import MacroMemory
from polycnc.control.word_address.memory import ProgrammingFrames
from polycnc.geometry.frames import IDENTITY, Frame, scaling, translation

if TYPE_CHECKING:
    from polycnc.channel.interface import Zone
    from polycnc.control.fanuc.lathe.cycles.shape import Shape
    from polycnc.control.fanuc.lathe.family import LatheChannel
    from polycnc.control.fanuc.lathe.motion.drawing import OpenLine
    from polycnc.control.fanuc.lathe.parameters import LatheParameters
    from polycnc.control.parameters import Parameter
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.control.word_address.macro_b.variables import Registry
    from polycnc.machine.setup.values import Offsets, Tool


@dataclass(slots=True)
class TurningOffset:
    """One number of the offset memory; by axis name, mm, X as radius (0i-TF Plus II.5.1).

    Attributes:
        geometry: Geometry offset.
        wear: Wear offset; the common offset where geometry and wear are not separate (8136#6).
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


class TurningFrames(ProgrammingFrames):
    """The programming frame of a lathe: rotation or mirror first, then tool offsets that move the point."""

    def __init__(self, axes: int, geometry: tuple[int, int, int]) -> None:
        super().__init__()
        self.offset = [0.0] * axes
        self.turret = IDENTITY
        self._geometry = geometry

    def product(self) -> Frame:
        """The whole frame of the geometry axes."""
        x, y, z = (self.offset[i] if i >= 0 else 0.0 for i in self._geometry)
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
        shift = [0.0 if i in self._geometry else value for i, value in enumerate(self.offset)]
        return shift if any(shift) else None


class TurningMemory(MacroMemory):
    """State of a lathe control.

    Attributes:
        offsets: Tool offsets by number.
        offset_number_active: Number of the active offset, 0 for none; `geometry_number` the same for geometry.
        tool_shift: Part of the active offset that shifts the coordinate system, by axis; `geometry_shift` the
            part of it that is geometry.
        work_shift: Shift of all work coordinate systems (G10 P0, work shift screen).
        tool_word: T as it was written last, turret position and offset number in one.
        feed_code: G98 or G99 under which F was given.
        single_cycle: Modal words of G90, G92, G94.
        grinding: Modal words of grinding cycles.
        thread_depths: P and Q of the last thread of G76, mm.
        clamp: M code that clamps the C axis in drilling cycles, 0 for none.
        thread_step: Step of the last block that cut a thread.
        thread_lock: What a thread, or the way off it, keeps from the operator.
        thread_held: The feed hold that a setup presses in a thread has come.
        thread_retracts: A thread runs along an axis of G10.6.
        retract_axes: Axes on which G10.6 wants the tool to retract.
        plane: Plane code given last.
        open_line: Line of drawing dimensions that waits for the next block.
        rotation_angle: Angle of the last G68.1, degrees.
        increment_limits: Largest increment of axes (G91.1).
        balanced: Paths that cut together (G68 on a machine of several paths).
        zone: Forbidden zone of G22, or the barrier.
        programmed_zone: The zone that the words of the last G22 have stored.
        reading_shape: Blocks are read for their shape only: T, S, M do nothing.
        shape: What has been read of it.
    """

    parameters: LatheParameters

    def __init__(self, channel: LatheChannel, registry: Registry) -> None:
        super().__init__(channel, registry)
        count = len(channel.axes)
        self.frames: TurningFrames = TurningFrames(count, channel.coordinates.geometry)
        self.tool_shift = [0.0] * count
        self.geometry_shift = [0.0] * count
        self.work_shift = [0.0] * count
        self.common_offsets = self.parameters.NGW
        self.offsets: dict[int, TurningOffset] = {}
        for number, tool in channel.setup.tools.items():
            if isinstance(number, int) or str(number).isdigit():
                self.offsets[int(number)] = self._from_setup(channel, tool)
        self.tool_word = 0
        self.offset_active = 0
        self.geometry_active = 0
        self.feed_code = ""
        self.grinding: dict[str, float] = {}
        self.single_cycle: dict[Any, Any] = {}
        self.thread_depths: dict[str, float] = {}
        self.clamp = 0
        self.rotation_angle = 0.0
        self.open_line: OpenLine | None = None
        self.thread_step = -1
        self.thread_lock = ""
        self.thread_held = self.thread_retracts = False
        self.retract_axes: frozenset[int] = frozenset()
        self.plane = ""
        self.increment_limits: dict[int, float] = {}
        self.balanced: frozenset[int] = frozenset()
        self.zone: Zone | None = None
        self.programmed_zone: Zone | None = None
        self.reading_shape = False
        self.shape: Shape | None = None

    def from_setup(self, channel: WordAddressChannel, shown: list[float]) -> list[float]:
        """Offsets as radii, where the setup says diameters."""
        return [
            value / 2.0 if self.has_diameter(channel, axis) else value for axis, value in enumerate(shown)
        ]

    def has_diameter(self, channel: WordAddressChannel, axis: int) -> bool:
        """Whether an axis is one whose words are diameters (1006#3 DIA; as delivered: as the machine says)."""
        data = channel.axis_data[axis]
        chosen = self.parameters.of(channel.axes[axis]).DIA
        return (data.diameter if chosen is None else chosen) and not data.rotary

    def radius_of(self, axis: int, shown: float) -> float:
        """A value of the displays (diameter where the axis has one), mm, in internal units."""
        internal: float = self.channel.control.from_display(self.channel, axis, shown)
        return internal

    @property
    def y_offset_axis(self) -> int:
        """The axis that has the Y offset: Y, or any other by 5043 (II.5.1.6.1); -1 for none."""
        number = self.parameters.y_offset_axis
        return number - 1 if 1 <= number <= len(self.channel.axes) else self.channel.axis_index.get("Y", -1)

    def offset_of(self, axis: int, shown: float) -> float:
        """A tool offset of the screens, in mm: with 5004#1 ORC a radius value also where the axis has diameters."""
        return shown if self.parameters.ORC else self.radius_of(axis, shown)

    def _from_setup(self, channel: LatheChannel, tool: Tool) -> TurningOffset:
        def vector(values: Offsets | Tool) -> dict[str, float]:
            named = {"X": values.x, "Y": values.y, "Z": values.z, **values.axes}
            index = dict(channel.axis_index)
            if self.y_offset_axis >= 0:
                index["Y"] = self.y_offset_axis
            halved = (
                set()
                if self.parameters.ORC
                else {k for k, i in index.items() if self.has_diameter(channel, i)}
            )
            return {k: v / 2.0 if k in halved else v for k, v in named.items() if v}

        if self.common_offsets:
            return TurningOffset(wear=vector(tool), radius_wear=tool.radius, tip=tool.tip)
        return TurningOffset(
            vector(tool), vector(tool.wear), vector(tool.geom2), tool.radius, tool.wear.radius, tool.tip
        )

    def set_cycle_parameter(self, parameter: Parameter[float], value: float) -> None:
        """What the first block of a turning cycle says, a parameter from then on (II.4.2.1 to 4.2.7)."""
        if value != self.parameters.value(parameter):
            set_parameter(self.channel, parameter.key, value, keeps_plans=True)

    def turning_offset(self, number: int) -> TurningOffset:
        """An offset number; zero until it is set."""
        return self.offsets.setdefault(number, TurningOffset())
