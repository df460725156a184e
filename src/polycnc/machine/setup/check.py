"""Whether a setup fits its machine: a mistyped axis would otherwise be an offset that nobody misses."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.machine.model import Machine
    from polycnc.machine.places import Key
    from polycnc.machine.setup.values import Setup, Tool


def foreign_axes(setup: Setup, machine: Machine) -> Iterator[tuple[Key, ...]]:
    """The key path of every axis that the setup gives a value and the machine does not have; a zero changes nothing."""
    known = axis_names(machine)
    for where, named in _positions(setup):
        yield from ((*where, axis) for axis, value in named.items() if value != 0.0 and axis not in known)


def axis_names(machine: Machine) -> set[str]:
    """Every name by which a setup may call an axis, in capitals."""
    names = {name for axis in machine.axes for name in (axis.name, *axis.aliases)}
    for channel in machine.channels:
        names |= {*channel.names, *channel.geometry, *channel.virtual}
    return {name.upper() for name in names}


def _positions(setup: Setup) -> Iterator[tuple[tuple[Key, ...], Mapping[str, float]]]:
    yield ("start",), setup.start
    for name, offsets in setup.work_offsets.items():
        yield ("work_offsets", name), offsets
    for number, tool in setup.tools.items():
        yield from _tool_positions(("tools", number), tool)
    switches = setup.switches
    yield ("switches", "skip_signal_at"), switches.skip_signal_at or {}
    yield ("switches", "measure_signal_at"), switches.measure_signal_at or {}


def _tool_positions(
    where: tuple[Key, ...], tool: Tool
) -> Iterator[tuple[tuple[Key, ...], Mapping[str, float]]]:
    yield (*where, "axes"), tool.axes
    yield (*where, "wear", "axes"), tool.wear.axes
    yield (*where, "geom2", "axes"), tool.geom2.axes
    for number, edge in tool.edges.items():
        yield from _tool_positions((*where, "edges", number), edge)
