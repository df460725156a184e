"""The tool memory and the tool in the spindle: T, M6, D, tool lengths by plane, TOFFL, TOFF, TOFFR.

Source: job planning 7.1 (tool parameters), 7.3 (assignment of lengths); Fundamentals (T, D, TOFFL, TOFFR).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from polycnc.messages import AlarmError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.machine.setup.values import Tool as SetupTool

#: Parameters of a cutting edge: $TC_DP1 … $TC_DP25.
PARAMETERS = 25
DP_TYPE, DP_TIP, DP_LENGTH, DP_RADIUS = 1, 2, 3, 6
DP_WEAR_LENGTH, DP_WEAR_RADIUS, DP_BASE_LENGTH = 12, 15, 21
DEFAULT_TYPE = 120.0
#: Types from 400 to 599 are turning and grinding tools.
TURNING_TYPES = range(400, 600)

#: Geometry axis (0 X, 1 Y, 2 Z) of lengths L1, L2, L3 (job planning 7.3, SD42940); a minus sign is a value of
#: its own.
TURNING_LENGTHS = {
    17: (1, 0, 2),
    18: (0, 2, 1),
    19: (2, 1, 0),
    -17: (0, 1, 2),
    -18: (2, 0, 1),
    -19: (1, 2, 0),
}
OTHER_LENGTHS = {17: (2, 1, 0), 18: (1, 0, 2), 19: (0, 2, 1), -17: (2, 0, 1), -18: (1, 2, 0), -19: (0, 1, 2)}


@dataclass(slots=True)
class Edge:
    """One cutting edge.

    Attributes:
        values: `values[n]` is `$TC_DPn`.
        teeth: Number of teeth, `$TC_DPNT`.
        cutting_edge: `$TC_DPCE`, 0 while it equals the D number.
        is_valid: False after DZERO.
        additive: Additive offsets, wear (`$TC_SCPn`) and setup (`$TC_ECPn`) added up, by kind and number n.
    """

    values: list[float] = field(default_factory=lambda: [0.0] * (PARAMETERS + 1))
    teeth: float = 0.0
    cutting_edge: int = 0
    is_valid: bool = True
    additive: dict[tuple[str, int], float] = field(default_factory=dict)

    @property
    def is_turning(self) -> bool:
        """Whether lengths and radius are those of a turning or grinding tool."""
        return int(self.values[DP_TYPE]) in TURNING_TYPES

    @property
    def radius(self) -> float:
        """Radius with wear, mm."""
        return self.values[DP_RADIUS] + self.values[DP_WEAR_RADIUS]

    @property
    def lengths(self) -> Vector:
        """L1, L2, L3 with wear and base, mm."""
        v = self.values
        l1, l2, l3 = (v[DP_LENGTH + i] + v[DP_WEAR_LENGTH + i] + v[DP_BASE_LENGTH + i] for i in range(3))
        return (l1, l2, l3)


@dataclass(slots=True)
class Tool:
    """One tool: its name ($TC_TP2) and its edges by D number."""

    number: int
    name: str = ""
    edges: dict[int, Edge] = field(default_factory=dict)
    values: dict[str, float] = field(default_factory=dict)


@dataclass(slots=True)
class Tools:
    """All tools, and what is active.

    Attributes:
        tools: By T number.
        active: T number in the spindle, 0 for none.
        selected: T number that the next M6 loads (MD22550 = 1).
        edge_number: D number, 0 for no offsets.
        next_edge: D number programmed for the selected tool before it is loaded, or None.
        lengths: Offsets along X, Y, Z of the active edge, mm.
        added_lengths: TOFFL for L1, L2, L3, mm.
        added_on_axes: TOFF along X, Y, Z, mm.
        added_radius: TOFFR, mm.
        additive: DL, 0 for none.
        carrier: How an orientable tool carrier or head turns and shifts the lengths; None where there is none.
    """

    tools: dict[int, Tool] = field(default_factory=dict)
    active: int = 0
    selected: int = 0
    edge_number: int = 0
    next_edge: int | None = None
    lengths: Vector = (0.0, 0.0, 0.0)
    added_lengths: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    added_on_axes: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    added_radius: float = 0.0
    additive: int = 0
    carrier: Frame | None = None

    @property
    def edge(self) -> Edge | None:
        """The active edge, None without tool or with D0."""
        tool = self.tools.get(self.active)
        return tool.edges.get(self.edge_number) if tool else None

    @property
    def radius(self) -> float:
        """Radius that compensation applies, mm."""
        edge = self.edge
        return (edge.radius + self._additive(edge, DP_RADIUS) if edge else 0.0) + self.added_radius

    @property
    def name(self) -> str:
        """Name of the tool in the spindle."""
        tool = self.tools.get(self.active)
        return tool.name if tool else ""

    def find(self, wanted: float | str) -> Tool:
        """The tool of a T number or a name.

        Raises:
            AlarmError: 17190 if there is no such tool.
        """
        if isinstance(wanted, str):
            for tool in self.tools.values():
                if tool.name.upper() == wanted.upper():
                    return tool
            if wanted.isdigit() and int(wanted) in self.tools:
                return self.tools[int(wanted)]
        elif wanted == int(wanted) and int(wanted) in self.tools:
            return self.tools[int(wanted)]
        raise AlarmError("17190", tool=wanted if isinstance(wanted, str) else f"{wanted:g}")

    def stand_in(self, wanted: int | str) -> None:
        """The tool that is in the spindle at power-on, without offsets; 0 for none.

        Raises:
            AlarmError: 17190 if there is no such tool.
        """
        self.active = self.selected = self.find(wanted).number if wanted else 0

    def load(self, number: int, data: MachineData) -> None:
        """Put a tool into the spindle; MD20270 says which edge then holds."""
        default = data.integer("$MC_CUTTING_EDGE_DEFAULT")
        self.active = number
        self._forget_additions()
        if number == 0:
            self.edge_number = 0
        elif self.next_edge is not None:
            self.select_edge(self.next_edge)
        elif default >= 0:
            self.edge_number = default if default in self.tools[number].edges else 0
        self.next_edge = None

    def select_edge(self, number: int) -> None:
        """D: the edge of the active tool.

        Raises:
            AlarmError: 17181 if the active tool has no such edge, 17180 if there is no tool.
        """
        if number != 0 and self.active == 0:
            raise AlarmError("17180", edge=number)
        edges = self.tools[self.active].edges if self.active else {}
        if number != 0 and (number not in edges or not edges[number].is_valid):
            raise AlarmError("17181", tool=self.active, edge=number)
        self.edge_number = number
        self._forget_additions()

    def _forget_additions(self) -> None:
        self.added_lengths = [0.0, 0.0, 0.0]
        self.added_on_axes = [0.0, 0.0, 0.0]
        self.added_radius = 0.0
        self.additive = 0

    def assign_lengths(self, plane: str, data: MachineData) -> None:
        """Work out the offsets along X, Y, Z for the plane and the setting data."""
        edge = self.edge
        offsets = list(self.added_on_axes)
        if edge is not None:
            turning = edge.is_turning or data.integer("$SC_TOOL_LENGTH_TYPE") == 2
            table = TURNING_LENGTHS if turning else OTHER_LENGTHS
            constant = data.integer("$SC_TOOL_LENGTH_CONST")
            key = constant or int(plane[1:])
            axes = table.get(key, table[18 if turning else 17])
            for axis, length, added in zip(axes, edge.lengths, self.added_lengths, strict=True):
                offsets[axis] += length + added
            for i, axis in enumerate(axes):
                offsets[axis] += self._additive(edge, DP_LENGTH + i)
        x, y, z = offsets
        self.lengths = (x, y, z) if self.carrier is None else self.carrier.apply(x, y, z)

    def _additive(self, edge: Edge, parameter: int) -> float:
        """What DL adds to a parameter: offset x, parameter y have the number 10x + y in their names."""
        if not self.additive:
            return 0.0
        number = 10 * self.additive + parameter
        return sum(edge.additive.get((kind, number), 0.0) for kind in ("SCP", "ECP"))

    def new_tool(self, number: int) -> Tool:
        """The tool of a number, made if it is not there."""
        return self.tools.setdefault(number, Tool(number))

    def new_edge(self, tool: int, edge: int) -> Edge:
        """The edge of a tool, both made if they are not there."""
        return self.new_tool(tool).edges.setdefault(edge, Edge())


def tools_of_setup(given: Mapping[int | str, SetupTool]) -> Tools:
    """The tool memory that a setup describes: by T number, or by name where the key is no number."""
    tools = Tools()
    free = 1 + max((key for key in given if isinstance(key, int)), default=0)
    for key, data in given.items():
        tool = Tool(key, data.name) if isinstance(key, int) else Tool(free, data.name or key)
        free += isinstance(key, str)
        tool.edges = {1: _edge(data), **{number: _edge(edge) for number, edge in data.edges.items()}}
        tools.tools[tool.number] = tool
    return tools


def _edge(data: SetupTool) -> Edge:
    """An edge from tool data of a setup: L1 to L3 from x, y, z as in G17 or, turning tools, G18."""
    edge = Edge()
    v = edge.values
    v[DP_TYPE] = float(data.type or DEFAULT_TYPE)
    v[DP_TIP] = float(data.tip)
    v[DP_RADIUS], v[DP_WEAR_RADIUS] = data.radius, data.wear.radius
    axes = TURNING_LENGTHS[18] if edge.is_turning else OTHER_LENGTHS[17]
    for i, axis in enumerate(axes):
        v[DP_LENGTH + i] = (data.x, data.y, data.z)[axis]
        v[DP_WEAR_LENGTH + i] = (data.wear.x, data.wear.y, data.wear.z)[axis]
        v[DP_BASE_LENGTH + i] = (data.geom2.x, data.geom2.y, data.geom2.z)[axis]
    v[DP_LENGTH] += data.length
    v[DP_WEAR_LENGTH] += data.wear.length
    v[DP_BASE_LENGTH] += data.geom2.length
    return edge
