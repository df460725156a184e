"""The memory of a word-address control during a run: offsets, tools, spindle, what modal words left behind."""

from __future__ import annotations

from math import copysign

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar
from polycnc.geometry.frames import IDENTITY, Frame
from polycnc.memory.encoding import encoded
from polycnc.memory.retained import PARAMETERS, TOOL_OFFSETS, WORK_OFFSETS

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.control.word_address.family import WordAddressChannel
    from polycnc.deferred.typing import Self
    from polycnc.machine.setup.values import ParameterKey, Tool, Value

#: Name of the offset that is added to every work coordinate system.
EXTERNAL = "EXT"


@encoded("tool offset")
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
        offsets = super().first(channel)
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


@dataclass(slots=True)
class ProgrammingFrames(State, lifetime=Lifetime.RESET):
    """The parts of a channel's programming frame: scaling or mirror, then rotation."""

    scale: Frame = IDENTITY
    mirror: Frame = IDENTITY
    mirrored: dict[int, float] = field(default_factory=dict)
    rotation: Frame = IDENTITY

    @property
    def shift(self) -> list[float] | None:
        """Shift of axes beside the geometry, before the display; None for none."""
        return None

    def product(self) -> Frame:
        """The whole frame."""
        frame = self.rotation @ self.mirror @ self.scale
        return IDENTITY if frame.is_identity else frame

    @property
    def directions(self) -> Frame:
        """How directions are turned and mirrored; factors leave them, but that those below zero mirror."""
        if self.product() is IDENTITY:
            return IDENTITY
        x, y, z = (copysign(1.0, self.scale.m[i][i]) for i in range(3))
        return self.rotation @ self.mirror @ Frame(((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)))


@dataclass(slots=True)
class SpindleCommand(State, lifetime=Lifetime.POWER):
    """What programs have commanded of the spindle; a reset leaves it to the machine.

    Attributes:
        speed: S, rpm or m/min.
        direction: 1 for M03, -1 for M04, 0 for M05.
        limit_rpm: Highest speed under constant surface speed, 0 for none.
    """

    speed: float = 0.0
    direction: int = 0
    limit_rpm: float = 0.0


@dataclass(slots=True)
class SentCodes(State, lifetime=Lifetime.POWER):
    """The last codes that have gone to the machine.

    Attributes:
        m: The M code; 0 for none.
    """

    m: int = 0


@dataclass(slots=True)
class LoadedTool(State, lifetime=Lifetime.POWER):
    """The tool in the spindle by its number, and the one that is selected as the next; 0 for none."""

    number: int = 0
    next: int = 0


class Memory:
    """What features share of a control's state, beside modal codes and positions.

    Attributes:
        channel: The channel.
        work_offsets: Zero of each work coordinate system in machine coordinates, by name (`EXT`, `G54` …).
        tool: Tool in the spindle, and the one that is selected.
        spindle: What programs have commanded of the spindle.
        frames: The parts of the programming frame.
        machine_refuses_moves: Whether the machine's controller may refuse moves.
        basic_geometry: Axes X, Y, Z, whatever parallel ones a plane has chosen.
    """

    frames_class: ClassVar[type[ProgrammingFrames]] = ProgrammingFrames

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
        self.tool = LoadedTool.of(channel)
        self.spindle = SpindleCommand.of(channel)
        self.frames = self.frames_class.of(channel)
        self.machine_refuses_moves = bool(channel.machine.plc(channel.control.id).moves)
        self.basic_geometry = channel.coordinates.geometry
        self._count = count

    def from_setup(self, _channel: WordAddressChannel, shown: list[float]) -> list[float]:
        """Offsets of all axes as the control keeps them, from what its displays show."""
        return shown

    @property
    def kept_at_reset(self) -> tuple[type[State], ...]:
        """States that a reset leaves as they are, by a parameter of the control."""
        return ()

    def forget_commons(self) -> None:
        """The RESET key: variables that end with it, where the control has any."""

    def forget_locals(self) -> None:
        """A reset: the local variables are those of the main program, as they begin, where there are any."""

    def work_offset(self, name: str) -> list[float]:
        """The offset of a work coordinate system; zero until it is set."""
        return self.work_offsets.setdefault(name, [0.0] * self._count)

    def is_kept(self, _name: str) -> bool:
        """Whether a variable, as a user names it, has its value from an earlier power-on: the setup leaves it alone."""
        return False

    def variable_names(self) -> list[str]:
        """Names of all variables that hold something; a control without variables has none."""
        return []

    def offset_number(self, number: int) -> ToolOffset:
        """An offset number; zero until it is set."""
        return ToolOffsets.of(self.channel).at(number)
