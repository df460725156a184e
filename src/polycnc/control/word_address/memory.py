"""The memory of a word-address control during a run: offsets, tools, spindle, what modal words left behind."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.memory.retained import PARAMETERS, TOOL_OFFSETS, WORK_OFFSETS

if TYPE_CHECKING:
    from typing import Self

    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.machine.setup.values import ParameterKey, Tool, Value
    from polycnc.transformation.parallel import ParallelAxes

#: Name of the offset that is added to every work coordinate system.
EXTERNAL = "EXT"


@dataclass(slots=True)
class ToolOffset:
    """One number of the offset memory, mm: length and radius by geometry and wear, turning offsets by axis name."""

    length: float = 0.0
    length_wear: float = 0.0
    radius: float = 0.0
    radius_wear: float = 0.0
    tip: int = 0

    @classmethod
    def of(cls, tool: Tool) -> ToolOffset:
        """What a setup gives for a number."""
        return cls(tool.length, tool.wear.length, tool.radius, tool.wear.radius, int(tool.tip))

    @property
    def total_length(self) -> float:
        """Geometry and wear."""
        return self.length + self.length_wear

    @property
    def total_radius(self) -> float:
        """Geometry and wear."""
        return self.radius + self.radius_wear


@dataclass(slots=True)
class WorkOffsets(State, lifetime=Lifetime.RETAINED):
    """Zero of each work coordinate system in machine coordinates, by name (`EXT`, `G54` …)."""

    by_name: dict[str, list[float]] = retained(WORK_OFFSETS)


@dataclass(slots=True)
class ToolOffsets(State, lifetime=Lifetime.RETAINED):
    """Tool offsets by number, where length and radius are what a tool has."""

    numbers: dict[int, ToolOffset] = retained(TOOL_OFFSETS)

    @classmethod
    def first(cls, channel: WordAddressChannel) -> Self:
        """What is retained, else what the setup says."""
        offsets = super(ToolOffsets, cls).first(channel)
        if not offsets.numbers:
            tools = channel.setup.tools.items()
            offsets.numbers.update((int(number), ToolOffset.of(tool)) for number, tool in tools)
        return offsets

    def at(self, number: int) -> ToolOffset:
        """An offset number; zero until it is set."""
        return self.numbers.setdefault(number, ToolOffset())


@dataclass(slots=True)
class ParameterTable(State, lifetime=Lifetime.RETAINED):
    """Parameters that programs or operators have given other values than the setup."""

    changed: dict[ParameterKey, Value] = retained(PARAMETERS)

    def put_into(self, channel: Channel) -> None:
        """Power-on: what was changed counts, and not the setup."""
        for key, value in self.changed.items():
            channel.setup = replace(channel.setup, parameters=channel.setup.parameters.having(key, value))


class ProgrammingFrames:
    """The parts of a channel's programming frame: scaling or mirror, then rotation."""

    def __init__(self) -> None:
        self.scale = IDENTITY
        self.mirror = IDENTITY
        self.mirrored: dict[int, float] = {}
        self.rotation = IDENTITY

    def clear(self) -> None:
        """Nothing is scaled, mirrored or turned."""
        self.scale = self.mirror = self.rotation = IDENTITY
        self.mirrored = {}

    @property
    def shift(self) -> list[float] | None:
        """Shift of axes beside the geometry, before the display; None for none."""
        return None

    def product(self) -> Frame:
        """The whole frame."""
        frame = self.rotation @ self.mirror @ self.scale
        return IDENTITY if frame.is_identity else frame


class Memory:
    """What features share of a control's state, beside modal codes and positions.

    Attributes:
        channel: The channel.
        work_offsets: Zero of each work coordinate system in machine coordinates, by name (`EXT`, `G54` …).
        tool: Tool in the spindle; `next_tool` is selected.
        last_m: The last M code sent to the machine.
        machine_signals: What the program and the setup have told the machine; None where the main run asks it.
        waited: Seconds that the clocks which a program reads (#3001) have counted.
        basic_geometry: Axes X, Y, Z, whatever parallel ones a plane has chosen; `parallel` holds those.
    """

    def __init__(self, channel: WordAddressChannel) -> None:
        setup = channel.setup
        count = len(channel.axes)
        self.parameters = setup.parameters
        self.channel: WordAddressChannel = channel
        self.work_offsets = WorkOffsets.of(channel).by_name
        if not self.work_offsets:
            self.work_offsets[EXTERNAL] = [0.0] * count
            for name, values in setup.work_offsets.items():
                shown = [values.get(axis, 0.0) for axis in channel.axes]
                self.work_offsets[name] = self.from_setup(channel, shown)
        self.tool = 0
        self.next_tool = 0
        self.last_m = 0
        given = setup.switches.signals.items()
        self.machine_signals: dict[str, float] | None = {
            name: float(value) for name, value in given if isinstance(value, int | float)
        }
        self.waited = 0.0
        self.spindle_speed = 0.0
        self.spindle_direction = 0
        self.spindle_limit_rpm = 0.0
        self.skip_position: list[float] | None = None
        self.frames = ProgrammingFrames()
        self.basic_geometry = channel.coordinates.geometry
        self.parallel: ParallelAxes | None = None
        self._count = count

    def from_setup(self, _channel: WordAddressChannel, shown: list[float]) -> list[float]:
        """Offsets of all axes as the control keeps them, from what its displays show."""
        return shown

    def forget_locals(self) -> None:
        """A reset: the local variables are those of the main program, as they begin, where there are any."""

    def work_offset(self, name: str) -> list[float]:
        """The offset of a work coordinate system; zero until it is set."""
        return self.work_offsets.setdefault(name, [0.0] * self._count)

    def note_skip(self, position: list[float]) -> None:
        """A skip move has ended here (absolute display)."""
        self.skip_position = position

    def is_kept(self, _name: str) -> bool:
        """Whether a variable, as a user names it, has its value from an earlier power-on: the setup leaves it alone."""
        return False

    def variable_names(self) -> list[str]:
        """Names of all variables that hold something; a control without variables has none."""
        return []

    def offset_number(self, number: int) -> ToolOffset:
        """An offset number; zero until it is set."""
        return ToolOffsets.of(self.channel).at(number)
