"""The tool memory and the tool in the spindle: T, M6, D, tool lengths by plane, TOFFL, TOFF, TOFFR.

Source: job planning 7.1 (tool parameters), 7.3 (assignment of lengths); Fundamentals (T, D, TOFFL, TOFFR).
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State, retained
from polycnc.compensation.tips import tip_direction
from polycnc.control.sinumerik.data.machine_data import MachineData
from polycnc.control.sinumerik.tools.edges import (
    DP_BASE_LENGTH,
    DP_LENGTH,
    DP_RADIUS,
    DP_TIP,
    DP_TYPE,
    DP_WEAR_LENGTH,
    DP_WEAR_RADIUS,
    Edge,
)
from polycnc.control.sinumerik.tools.lengths import (
    AGAINST_TOOL,
    OTHER_LENGTHS,
    TURNING_LENGTHS,
    Rules,
    along_axes,
    direction_of,
)
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.geometry.planes import PLANES
from polycnc.geometry.vectors import axis_vector, minus, times
from polycnc.machine.kinematics import turn_between
from polycnc.memory.encoding import encoded
from polycnc.memory.retained import TOOLS
from polycnc.messages import AlarmError

with loaded_when_called():
    from polycnc.control.sinumerik.tools import cutting_data

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.tools.cutting_data import CuttingData
    from polycnc.deferred.typing import Self
    from polycnc.geometry.frames import Frame, Vector
    from polycnc.machine.setup.values import Tool as SetupTool

DEFAULT_TYPE = 120.0
#: The tool that has all edges where D numbers do not depend on the tool (MD18102).
FLAT = 1
#: Bit 6 of MD20110: a reset keeps the offsets of the tool.
KEEPS_EDGE = 1 << 6


@encoded("tool")
@dataclass(slots=True)
class Tool:
    """One tool: its name ($TC_TP2) and its edges by D number."""

    number: int
    name: str = ""
    edges: dict[int, Edge] = field(default_factory=dict)
    values: dict[str, float] = field(default_factory=dict)


@dataclass(slots=True)
class Tools(State, lifetime=Lifetime.POWER):
    """All tools, and what is active.

    Attributes:
        tools: By T number.
        is_flat: D numbers do not depend on the tool: all edges lie with tool 1 (MD18102).
        active: T number in the spindle, 0 for none.
        selected: T number that the next M6 loads (MD22550 = 1).
        edge_number: D number, 0 for no offsets.
        next_edge: D number programmed for the selected tool before it is loaded, or None.
        lengths: Offsets along X, Y, Z of the active edge, mm.
        apart: What of them a head does not turn: wear in a system of its own (`Lengths.fixed`), mm.
        added_lengths: TOFFL for L1, L2, L3, mm.
        added_on_axes: TOFF along X, Y, Z, mm.
        added_radius: TOFFR, mm.
        additive: DL, 0 for none.
        rules: How the edge was evaluated when it was selected; None until somebody asks for its lengths.
        carrier: How an orientable tool carrier or head turns and shifts the lengths; None where there is none.
        cut_turns: Edge position and its companions turn with the carrier (CUTMOD).
        overlay: Online offsets along X, Y, Z, as the tool is turned, mm.
        used: Numbers of the tools that came into the spindle since pieces were counted last (SETPIECE).
    """

    tools: dict[int, Tool] = retained(TOOLS)
    is_flat: bool = False
    active: int = 0
    selected: int = 0
    edge_number: int = 0
    next_edge: int | None = None
    lengths: Vector = (0.0, 0.0, 0.0)
    apart: Vector = (0.0, 0.0, 0.0)
    added_lengths: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    added_on_axes: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    added_radius: float = 0.0
    additive: int = 0
    rules: Rules | None = None
    carrier: Frame | None = None
    cut_turns: bool = False
    overlay: Vector = (0.0, 0.0, 0.0)
    used: set[int] = field(default_factory=set)

    @classmethod
    def first(cls, channel: Channel) -> Self:
        """No tool in the spindle; in the memory is what is retained, else what the setup says."""
        tools = super().first(channel)
        if not tools.tools and channel.states.get(cls) is None:  # a program may have taken all tools out
            tools.tools.update(tools_of_setup(channel.setup.tools))
        if MachineData.of(channel).integer("$MN_MM_TYPE_OF_CUTTING_EDGE") == 1:
            tools.is_flat = True
            flat = tools.new_tool(FLAT).edges
            for number, tool in tools.tools.items():
                if number != FLAT and tool.edges:
                    flat.setdefault(number, tool.edges[min(tool.edges)])
        return tools

    def end(self, channel: Channel, lifetime: Lifetime) -> None:
        """After a reset the tool stays in the spindle; bit 6 of MD20110 keeps its offsets, else MD20130 says which."""
        super().end(channel, lifetime)
        data = MachineData.of(channel)
        if lifetime is Lifetime.RESET and data.integer("$MC_RESET_MODE_MASK") & (1 | KEEPS_EDGE) == 1:
            edge = data.integer("$MC_CUTTING_EDGE_RESET_VALUE")
            self.select_edge(edge if edge in self.edges else 0)

    @property
    def edge(self) -> Edge | None:
        """The active edge, None without tool or with D0."""
        return self.edges.get(self.edge_number)

    @property
    def edges(self) -> dict[int, Edge]:
        """The edges that D can choose from."""
        tool = self.tools.get(FLAT if self.is_flat else self.active)
        return tool.edges if tool else {}

    @property
    def radius(self) -> float:
        """Radius that compensation applies, mm."""
        edge, inverts = self.edge, self.rules is not None and self.rules.inverts_wear
        return (edge.radius(self.additive, inverts=inverts) if edge else 0.0) + self.added_radius

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
        elif self.is_flat and wanted == int(wanted):
            return Tool(int(wanted))
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
        if number:
            self.used.add(number)
        self._forget_additions()
        if self.is_flat:
            self.next_edge = None
            return
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
        if number != 0 and self.active == 0 and not self.is_flat:
            raise AlarmError("17180", edge=number)
        edges = self.edges
        if number != 0 and (number not in edges or not edges[number].is_valid):
            raise AlarmError("17181", tool=self.active, edge=number)
        self.edge_number = number
        self._forget_additions()

    def _forget_additions(self) -> None:
        self.added_lengths = [0.0, 0.0, 0.0]
        self.added_on_axes = [0.0, 0.0, 0.0]
        self.added_radius = 0.0
        self.additive = 0
        self.rules = None

    def assign_lengths(self, plane: str) -> None:
        """Work out the offsets along X, Y, Z for a plane."""
        edge, carrier = self.edge, self.carrier or IDENTITY
        offsets, fixed = self.added_on_axes, (0.0, 0.0, 0.0)
        if edge is not None:
            found = along_axes(edge, self.rules or Rules(), plane, self.additive, self.added_lengths)
            offsets, fixed = [a + b for a, b in zip(found.turning, offsets, strict=True)], found.fixed
        turned = carrier.apply(*offsets)
        parts = (turned, fixed, self._to_tip(plane), carrier.direct(*self.overlay))
        x, y, z = (sum(values) for values in zip(*parts, strict=True))
        self.lengths = (x, y, z)
        is_apart = self.rules is not None and self.rules.system in AGAINST_TOOL
        self.apart = fixed if is_apart else (0.0, 0.0, 0.0)

    def cutting_data(self, plane: str) -> CuttingData | None:
        """Edge position and its companions as the tool stands now; None without an edge."""
        edge = self.edge
        return None if edge is None else self._turned_data(edge, plane) or cutting_data.unchanged(edge)

    def _turned_data(self, edge: Edge, plane: str) -> CuttingData | None:
        """The same of an edge that the carrier turns (CUTMOD); None where it does not, or away from the plane."""
        plane = self._cutting_plane(plane)
        if self.carrier is None or not self.cut_turns or not cutting_data.is_seen(plane, self.carrier):
            return None
        return cutting_data.turned(edge, plane, self.carrier)

    def own_direction(self, plane: str) -> Vector | None:
        """Direction along the tool that its edge has ($TC_DPV), no carrier turning it; None for that of the plane."""
        edge = self.edge
        return None if edge is None else direction_of(edge, self.rules or Rules(), plane)

    def direction(self, plane: str) -> Vector:
        """Direction along the tool, away from its tip, as a carrier turns it."""
        across = self.own_direction(plane) or axis_vector(PLANES[plane][2])
        return across if self.carrier is None else self.carrier.direct(*across)

    def stance(self, plane: str) -> Frame | None:
        """How the tool is turned against the plane, by its edge and by a carrier; None where it is not."""
        own = self.own_direction(plane)
        if own is None:
            return self.carrier
        u, _, w = PLANES[plane]
        lean = turn_between(axis_vector(w), own, axis_vector(u))
        return lean if self.carrier is None else self.carrier @ lean

    def tip(self, plane: str) -> Vector:
        """From the nose centre to the programmed tip along X, Y, Z, in units of the radius; zero for milling tools."""
        edge, carrier = self.edge, self.carrier
        if edge is None or not edge.is_turning:
            return (0.0, 0.0, 0.0)
        data = self._turned_data(edge, plane)
        position = edge.values[DP_TIP] if data is None else data.position
        tip = cutting_data.in_space(plane, tip_direction(int(position)))
        return tip if carrier is None or data is not None else carrier.direct(*tip)

    def _to_tip(self, plane: str) -> Vector:
        """From the programmed tip as the carrier turns it to that of the edge position which follows from it, mm."""
        edge, carrier = self.edge, self.carrier
        data = None if edge is None or not edge.is_turning else self._turned_data(edge, plane)
        if edge is None or carrier is None or data is None:
            return (0.0, 0.0, 0.0)
        plane = self._cutting_plane(plane)
        before = cutting_data.in_space(plane, tip_direction(int(edge.values[DP_TIP])))
        after = cutting_data.in_space(plane, tip_direction(int(data.position)))
        return times(minus(carrier.direct(*before), after), self.radius)

    def _cutting_plane(self, plane: str) -> str:
        return cutting_data.plane_of(self.rules.constant if self.rules else 0, plane)

    def new_tool(self, number: int) -> Tool:
        """The tool of a number, made if it is not there."""
        return self.tools.setdefault(number, Tool(number))

    def new_edge(self, tool: int, edge: int) -> Edge:
        """The edge of a tool, both made if they are not there."""
        return self.new_tool(tool).edges.setdefault(edge, Edge())


def tools_of_setup(given: Mapping[int | str, SetupTool]) -> dict[int, Tool]:
    """The tools that a setup describes: by T number, or by name where the key is no number."""
    tools: dict[int, Tool] = {}
    free = 1 + max((key for key in given if isinstance(key, int)), default=0)
    for key, data in given.items():
        tool = Tool(key, data.name) if isinstance(key, int) else Tool(free, data.name or key)
        free += isinstance(key, str)
        tool.edges = {1: _edge(data), **{number: _edge(edge) for number, edge in data.edges.items()}}
        tools[tool.number] = tool
    return tools


def setup_of_tools(tools: Mapping[int, Tool]) -> dict[int, dict[str, object]]:
    """Tools as a setup describes them, by T number; those without an edge are not there."""
    found: dict[int, dict[str, object]] = {}
    for number, tool in tools.items():
        described = {d: _setup_of_edge(edge) for d, edge in tool.edges.items()}
        if described:
            name: dict[str, object] = {"name": tool.name} if tool.name else {}
            further = {d: edge for d, edge in described.items() if d != 1}
            found[number] = {**name, **described.get(1, {}), **({"edges": further} if further else {})}
    return found


def _setup_of_edge(edge: Edge) -> dict[str, object]:
    """An edge by length 1 to 3 along the axes that `_edge` takes them from."""
    v = edge.values
    axes = TURNING_LENGTHS[18] if edge.is_turning else OTHER_LENGTHS[17]
    parts = {"": DP_LENGTH, "wear": DP_WEAR_LENGTH, "geom2": DP_BASE_LENGTH}
    lengths = {
        part: {"xyz"[axis]: v[first + i] for i, axis in enumerate(axes)} for part, first in parts.items()
    }
    return {
        "type": edge.type,
        "tip": int(v[DP_TIP]),
        "radius": v[DP_RADIUS],
        **lengths[""],
        "wear": {**lengths["wear"], "radius": v[DP_WEAR_RADIUS]},
        "geom2": lengths["geom2"],
    }


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
