"""Grinding wheels: speed of the circumference (GWPSON), monitoring of size and speed (TMON), `$TC_TPG1` to `$TC_TPG9`.

What the monitoring finds goes to the machine's controller, bits 3 and 6 of DB31 and following, DBB83; nothing stops.
The spindle's override is the machine's own and does not count here.

Source: Fundamentals (GWPSON, GWPSOF), job planning 13.1.
"""

from __future__ import annotations

from math import inf, pi

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.errors import not_supported
from polycnc.control.sinumerik.tables import MINUTE, MM_PER_M
from polycnc.control.sinumerik.tools.edges import DP_LENGTH, DP_RADIUS, GRINDING_TYPES
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath.events import SignalWrite

with loaded_when_called():
    from polycnc.control.sinumerik.block import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.control.sinumerik.block.arguments import Arguments
    from polycnc.control.sinumerik.family import SinumerikChannel
    from polycnc.control.sinumerik.feed.spindles import Spindle
    from polycnc.control.sinumerik.tools.edges import Edge
    from polycnc.control.sinumerik.tools.memory import Tool

(SPINDLE, CHAIN, LEAST_RADIUS, LEAST_WIDTH, WIDTH, MOST_RPM, MOST_SPEED, ANGLE, RADIUS_PARAMETER) = (
    f"$TC_TPG{number}" for number in range(1, 10)
)
#: Data of a wheel that are whole numbers.
WHOLE = frozenset((SPINDLE, CHAIN, RADIUS_PARAMETER))
#: Bits of DBB83 in the data block of a spindle.
SIZE_BIT, SPEED_BIT = 3, 6
AUTOMATIC = "$MC_TOOL_GRIND_AUTO_TMON"
#: Edges of the two sides of a wheel.
SIDES = {1: 2, 2: 1}


@dataclass(slots=True)
class Wheels(State, lifetime=Lifetime.POWER):
    """The wheels that are monitored.

    Attributes:
        monitored: Tool by the number of its spindle, which has one monitoring at a time.
        signals: What the machine's controller was told last.
    """

    monitored: dict[int, int] = field(default_factory=dict)
    signals: dict[str, bool] = field(default_factory=dict)


# ---- size of a wheel


def _tool(channel: SinumerikChannel, name: str, args: Arguments) -> Tool:
    """The wheel that a call names, or the active tool; 17190 for none, 14020 where it is no wheel."""
    tools = channel.memory.tools
    number = arguments.whole(args[0]) if args and args[0] is not None else tools.active
    if number not in tools.tools:
        raise AlarmError("17190", tool=number)
    found = tools.tools[number]
    if not any(edge.type in GRINDING_TYPES for edge in found.edges.values()):
        raise AlarmError("14020", text=f"{name}({number})")
    return found


def _edge(channel: SinumerikChannel, tool: Tool) -> Edge:
    """Its active edge, or its first."""
    tools = channel.memory.tools
    active = tools.edge if tool.number == tools.active else None
    return active or tool.edges[min(tool.edges)]


def radius(channel: SinumerikChannel, tool: Tool) -> float:
    """Radius of a wheel with its wear, mm: the parameter that $TC_TPG9 names, else $TC_DP6.

    PC0001 for an inclined wheel whose radius is told by a length.
    """
    edge, parameter = _edge(channel, tool), int(tool.values.get(RADIUS_PARAMETER, 0.0)) or DP_RADIUS
    if parameter == DP_RADIUS:
        added = channel.memory.tools.added_radius if tool.number == channel.memory.tools.active else 0.0
        return edge.radius() + added
    if parameter not in range(DP_LENGTH, DP_RADIUS):
        raise AlarmError("12560", text=RADIUS_PARAMETER)
    if tool.values.get(ANGLE, 0.0):
        raise not_supported(f"{ANGLE} {RADIUS_PARAMETER}")
    return edge.values[parameter] + edge.wear(parameter)


def chain_sides(tool: Tool, edge: int, parameter: int) -> None:
    """A parameter of one side of a wheel has changed: the other one has it too, where its bit of $TC_TPG2 is set."""
    other = tool.edges.get(SIDES.get(edge, 0))
    if other is not None and int(tool.values.get(CHAIN, 0.0)) >> (parameter - 1) & 1:
        other.values[parameter] = tool.edges[edge].values[parameter]


# ---- speed of the circumference


def wheel_speed(on: bool) -> Callable[[SinumerikChannel, Arguments], None]:
    """GWPSON(T), GWPSOF(T): S is the speed of the wheel's circumference; of the active tool without a number."""

    def switch(channel: SinumerikChannel, args: Arguments) -> None:
        memory = channel.memory
        tools = memory.tools
        number = arguments.whole(args[0]) if args and args[0] is not None else tools.active
        if on and number != tools.active:
            raise not_supported(f"GWPSON({number})")
        tool = tools.tools.get(number)
        if on and (tool is None or radius(channel, tool) <= 0.0):
            raise AlarmError("10750")
        memory.spindles.get().has_wheel_speed = on

    return switch


def set_wheel_speed(channel: SinumerikChannel, spindle: Spindle, speed: float) -> None:
    """S in m/s: the revolutions that it takes, at most $TC_TPG6 rpm and $TC_TPG7 m/s where the tool names them."""
    tools = channel.memory.tools
    if tools.active not in tools.tools or (size := radius(channel, tools.tools[tools.active])) <= 0.0:
        raise AlarmError("10750")
    data = tools.tools[tools.active].values
    fastest = min(speed, data.get(MOST_SPEED, 0.0) or inf)
    revolutions = MINUTE * MM_PER_M * fastest / (2.0 * pi * size)
    spindle.speed = min(revolutions, data.get(MOST_RPM, 0.0) or inf)


# ---- monitoring


def switch_on(channel: SinumerikChannel, args: Arguments) -> None:
    """TMON(T): size and speed of a wheel are monitored, in place of another one on its spindle."""
    if len(args) > 1:
        raise AlarmError("14020", text="TMON")
    _monitor(channel, _tool(channel, "TMON", args))


def _monitor(channel: SinumerikChannel, tool: Tool) -> None:
    radius(channel, tool)
    number = int(tool.values.get(SPINDLE, 0.0)) or channel.memory.spindles.master
    channel.memory.spindles.get(number)
    Wheels.of(channel).monitored[number] = tool.number
    check(channel)


def switch_off(channel: SinumerikChannel, args: Arguments) -> None:
    """TMOF(T): the wheel is not monitored any more; TMOF(0): none is."""
    if len(args) > 1:
        raise AlarmError("14020", text="TMOF")
    wheels = Wheels.of(channel)
    if args and args[0] is not None and not arguments.whole(args[0]):
        wheels.monitored.clear()
    else:
        tool = _tool(channel, "TMOF", args)
        for number in [number for number, held in wheels.monitored.items() if held == tool.number]:
            del wheels.monitored[number]
    check(channel)


def selected(channel: SinumerikChannel) -> None:
    """A tool is selected: a wheel is monitored from here on, where MD20350 says so."""
    tools = channel.memory.tools
    edge = tools.edge
    if edge is not None and edge.is_grinding and channel.memory.data.integer(AUTOMATIC):
        _monitor(channel, tools.tools[tools.active])
    check(channel)


def check(channel: SinumerikChannel) -> None:
    """Size or speed of a wheel may have changed: the machine's controller is told what is new."""
    wheels, tools = Wheels.of(channel), channel.memory.tools.tools
    found = dict.fromkeys(wheels.signals, False)
    for number, name in wheels.monitored.items():
        if name in tools and tools[name].edges:
            size_fails, speed_fails = _faults(channel, tools[name], number)
            found[_signal(channel, number, SIZE_BIT)] = size_fails
            found[_signal(channel, number, SPEED_BIT)] = speed_fails
    for signal, fails in found.items():
        if fails != wheels.signals.get(signal, False):
            channel.event(SignalWrite(signal, float(fails)))
        wheels.signals[signal] = fails


def _faults(channel: SinumerikChannel, tool: Tool, number: int) -> tuple[bool, bool]:
    """Whether a wheel is too small, in radius or width, and whether it turns too fast."""
    size, data = radius(channel, tool), tool.values
    too_small = size < data.get(LEAST_RADIUS, 0.0) or data.get(WIDTH, 0.0) < data.get(LEAST_WIDTH, 0.0)
    limit = data.get(MOST_RPM, 0.0) or inf
    if size > 0.0 and data.get(MOST_SPEED, 0.0):
        limit = min(limit, data[MOST_SPEED] * MM_PER_M * MINUTE / (2.0 * pi * size))
    spindle = channel.memory.spindles.all[number]
    return too_small, spindle.speed > limit


def _signal(channel: SinumerikChannel, number: int, bit: int) -> str:
    """A signal of a spindle: its data block counts behind those of the axes, where it is none of them."""
    machine = channel.machine
    axis = machine.spindle[number].axis if number in machine.spindle else ""
    place = machine.axis_number(axis) if axis else len(machine.axes) + number
    return f"DB{30 + place}.DBX83.{bit}"


PROCEDURES = {
    "GWPSON": wheel_speed(on=True),
    "GWPSOF": wheel_speed(on=False),
    "TMON": switch_on,
    "TMOF": switch_off,
}
