"""What a run starts from, as plain frozen values: the `setup` of a case, or the file of `--setup`.

Values are as the user writes them, in the units of the control's screens (a lathe's X offset in diameter, for
example): only the control knows what they mean.
"""

from __future__ import annotations

import re

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.deferred.typing import Self
    from polycnc.geometry.surfaces import Surface

Value = float | int | str | bool | None | tuple["Value", ...]
_PARAMETER = regex(
    r"""\s*(?:(?:PR|MD|SD|NO\.)?\s*(?P<number>\d+) | (?P<name>\$?[A-Z_][A-Z_0-9]*))
        \s*(?:\#\s*(?P<bit>\d+))?
        \s*(?:\[\s*(?P<inside>[^\]]*)\])?
        \s*(?P<axis>[A-Z][A-Z0-9]*)?\s*$""",
    re.VERBOSE,
)


class ParameterKey(NamedTuple):
    """A machine parameter or machine data, taken apart: `1006#3 X` is (1006, 3, None, "X")."""

    id: int | str
    bit: int | None = None
    element: tuple[int, ...] | int | None = None
    axis: str | None = None


def parameter_key(text: str | int) -> ParameterKey:
    """Take a parameter's name apart. Names, axes and prefixes do not mind case.

    Raises:
        ValueError: This is not the name of a parameter.
    """
    match = _PARAMETER.match(str(text).upper())
    if match is None:
        raise ValueError(text)
    bit = int(match["bit"]) if match["bit"] else None
    indices: list[int] = []
    axis = match["axis"]
    for part in re.split(r"\s*,\s*", match["inside"].strip()) if match["inside"] is not None else ():
        if part.isdigit():
            indices.append(int(part))
        elif part.isidentifier() and axis is None:
            axis = part
        else:
            raise ValueError(text)
    index = None if not indices else indices[0] if len(indices) == 1 else tuple(indices)
    return ParameterKey(int(match["number"]) if match["number"] else match["name"], bit, index, axis)


class Parameters:
    """Machine parameters of a setup, by structured key. What the setup does not name is not here."""

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[ParameterKey, Value] | None = None) -> None:
        self._values = dict(values or {})

    def __len__(self) -> int:
        return len(self._values)

    def __iter__(self) -> Iterator[ParameterKey]:
        return iter(self._values)

    def __eq__(self, other: object) -> bool:
        return self._values == other._values if isinstance(other, Parameters) else NotImplemented

    def __hash__(self) -> int:
        return hash(frozenset(self._values))

    def __repr__(self) -> str:
        return f"Parameters({self._values!r})"

    def items(self) -> Iterator[tuple[ParameterKey, Value]]:
        """All keys with their values."""
        return iter(self._values.items())

    def having(self, key: ParameterKey, value: Value) -> Self:
        """The same parameters, but for one."""
        return type(self)({**self._values, key: value})

    def get(
        self,
        number: int | str,
        axis: str | None = None,
        default: Value = None,
        *,
        index: tuple[int, ...] | int | None = None,
    ) -> Value:
        """The value of a parameter: that of the axis, else that for all axes, else the default.

        With an index, an element of a list counts where the element itself is not named. Names are capitals.
        """
        values = self._values
        for name in (axis, None) if axis else (None,):
            key = ParameterKey(number, None, index, name)
            if key in values:
                return values[key]
            whole = values.get(ParameterKey(number, None, None, name)) if index is not None else None
            if isinstance(whole, tuple) and isinstance(index, int) and index < len(whole):
                return whole[index]
        return default

    def bit(self, number: int | str, bit: int, axis: str | None = None, default: int = 0) -> int:
        """A bit of a parameter, 0 or 1: the bit itself, else the bit of the whole value, else the default."""
        values = self._values
        for name in (axis, None) if axis else (None,):
            value = values.get(ParameterKey(number, bit, None, name))
            if value is not None:
                return int(bool(value))
            whole = values.get(ParameterKey(number, None, None, name))
            if isinstance(whole, int):
                return whole >> bit & 1
        return default

    def number(
        self, number: int | str, axis: str | None = None, default: float = 0.0, *, index: int | None = None
    ) -> float:
        """As `get`, for parameters that are numbers: text and lists count as not given."""
        value = self.get(number, axis, default, index=index)
        return float(value) if isinstance(value, int | float) else default


@dataclass(frozen=True, slots=True)
class Offsets:
    """One set of offsets of a tool; `axes` are those along further axes, by name."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    length: float = 0.0
    radius: float = 0.0
    axes: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Tool:
    """One tool, one offset number, or one further edge of a tool.

    Attributes:
        length: Length of a milling tool.
        radius: Cutter or nose radius.
        x: Geometry of a turning tool along X, as the control's page shows it; `y`, `z` likewise.
        tip: Imaginary tip number or edge position, 0 to 9.
        type: Tool type of the control; None where the setup does not say.
        name: What SINUMERIK programs call it.
        wear: Wear offsets.
        geom2: Second geometry offsets.
        edges: Further cutting edges by D number, from 2.
        axes: Geometry along further axes (4th and 5th axis offsets of a lathe), by name.
    """

    length: float = 0.0
    radius: float = 0.0
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    tip: int = 0
    type: int | None = None
    name: str = ""
    wear: Offsets = Offsets()
    geom2: Offsets = Offsets()
    edges: Mapping[int, Tool] = field(default_factory=dict)
    axes: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ProbeEdge:
    """A probe switches when `axis` reaches the work position `at`."""

    axis: str
    at: float
    rising: bool = True


@dataclass(frozen=True, slots=True)
class SkipInput:
    """When an input comes that ends a move: at a work position, a time after its start, a surface; the first counts."""

    at: Mapping[str, float]
    after_s: float | None
    surfaces: tuple[Surface, ...]


@dataclass(frozen=True, slots=True)
class Interrupt:
    """Interrupt input `input` comes at a work position while a line of `program` (else the main one) runs."""

    input: int
    line: int
    at: Mapping[str, float]
    program: str = ""


@dataclass(frozen=True, slots=True)
class Switches:
    """Switches and inputs of the machine panel and the machine.

    Attributes:
        single_block: Empty for off, or `SBL1`, `SBL2`, `SBL3`.
        optional_stop: M01 stops.
        block_skip: False, True for plain `/`, or the levels that are on, as the control writes them.
        mode: Operating mode, in small letters.
        skip_signal_at: Work position where the skip input comes.
        skip_signal_after: Seconds after the start of a skip move at which the skip input comes.
        skip_surfaces: Surfaces in machine coordinates at whose touch the skip input comes.
        measure_signal_at: Work position where the measuring input of G36/G37 comes.
        probe: Switching points of each probe, in the order in which they act, each once.
        interrupts: Interrupt inputs.
        signals_at: PLC signals that come at a work position, by the control's name.
        plc: PLC signals from the start.
        thread_chamfer: Chamfering input of a lathe; None where the setup does not say.
        signals: Every other signal by its name.
    """

    single_block: str = ""
    optional_stop: bool = False
    block_skip: bool | tuple[int, ...] = False
    mode: str = "memory"
    skip_signal_at: Mapping[str, float] = field(default_factory=dict)
    skip_signal_after: float | None = None
    skip_surfaces: tuple[Surface, ...] = ()
    measure_signal_at: Mapping[str, float] = field(default_factory=dict)
    probe: Mapping[int, tuple[ProbeEdge, ...]] = field(default_factory=dict)
    interrupts: tuple[Interrupt, ...] = ()
    signals_at: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    plc: Mapping[str, Value] = field(default_factory=dict)
    thread_chamfer: bool | None = None
    signals: Mapping[str, Value] = field(default_factory=dict)

    @property
    def skip_input(self) -> SkipInput:
        """When the skip input comes."""
        return SkipInput(self.skip_signal_at, self.skip_signal_after, self.skip_surfaces)

    def block_skip_mask(self, plain: int) -> int:
        """The levels as a bit mask: bit n is level n as the control writes it, plain `/` is level `plain`."""
        if isinstance(self.block_skip, bool):
            return 1 << plain if self.block_skip else 0
        return sum(1 << level for level in set(self.block_skip))


@dataclass(frozen=True, slots=True)
class Setup:
    """Everything that a run starts from and that differs from the defaults.

    Attributes:
        machine: Built-in id or file; empty for the control's default machine.
        start: Machine position of axes at the start; the others stand at machine zero.
        work_offsets: Offsets by name in capitals (`G54`, `EXT`, `G54.1 P1`, `G505`), each by axis.
        tools: Tools by tool or offset number, or by name.
        spindle_tool: Number or name of the tool in the spindle at the start, by the channel that it works in.
        variables: Start values by the name that the control's programs use.
        parameters: Machine parameters and machine data.
        channels: Axes of each channel; empty for those of the machine.
        switches: Panel switches and inputs.
    """

    machine: str = ""
    start: Mapping[str, float] = field(default_factory=dict)
    work_offsets: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    tools: Mapping[int | str, Tool] = field(default_factory=dict)
    spindle_tool: Mapping[int, int | str] = field(default_factory=dict)
    variables: Mapping[str, Value] = field(default_factory=dict)
    parameters: Parameters = field(default_factory=Parameters)
    channels: Mapping[int, tuple[str, ...]] = field(default_factory=dict)
    switches: Switches = field(default_factory=Switches)

    @property
    def tool_name(self) -> str:
        """A tool that is called by a name, empty where all are numbers."""
        called = (tool for tool in (*self.tools, *self.spindle_tool.values()) if isinstance(tool, str))
        return next(called, "")

    def tool_at_start(self, channel: int) -> int | str:
        """Number or name of the tool in a channel's spindle at the start; 0 for none."""
        return self.spindle_tool.get(channel, 0)
