"""What must fit together in a machine as a whole, beyond the keys of one file."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.machine.rules import ConditionError, condition_of, signals_in
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from polycnc.machine.model import Machine
    from polycnc.machine.schema import Mistake
    from polycnc.machine.tables import BuilderData, MachineData

_BOX_SIZES = 3
#: M codes that stop, end, call and return: no program stands for them on any control.
NEVER_CALL = frozenset({0, 1, 2, 30, 98, 99})
#: What says how a code acts on the machine; one that calls a program does not go out to it.
_BESIDE_CALLS = ("seconds", "timing", "takes", "does")
#: What a solid may move with beside an axis.
_CHAIN_ENDS = ("base", "tool", "work")


def gaps(data: MachineData) -> Iterator[Mistake]:
    """What keeps the merged data of a file from being a machine at all."""
    channels = data.get("channel", {})
    for number, channel in channels.items():
        if "axes" not in channel:
            yield ("channel", number), "missing-key", {"where": f"channel.{number}.axes"}
    names = {name for channel in channels.values() for name in channel.get("axes", ())}
    if not channels:
        yield ("channel",), "no-axes", {}
    elif all(int(number) != 1 for number in channels):
        yield ("channel",), "no-first-channel", {}
    for name in data.get("axis", {}):
        if name not in names:
            yield ("axis", name), "axis-unused", {"axis": name}
    for index, joint in enumerate(data.get("joint", ())):
        if joint["axis"] not in names:
            yield ("joint", index, "axis"), "axis-unused", {"axis": joint["axis"]}
        if not any(joint["direction"]):
            yield ("joint", index, "direction"), "no-direction", {"axis": joint["axis"]}
    if not any(data.get("tool_direction", (1.0,))):
        yield ("tool_direction",), "no-tool-direction", {}
    yield from conditions(data)
    yield from functions(data)
    yield from _moves(data)
    for index, solid in enumerate(data.get("solid", ())):
        if solid["shape"] == "box" and len(solid["size"]) != _BOX_SIZES:
            yield (
                ("solid", index, "size"),
                "wrong-length",
                {"where": f"solid.{index}.size", "detail": _BOX_SIZES},
            )


def functions(data: BuilderData) -> Iterator[Mistake]:
    """M and G codes that call a program, and say what only codes can that call none."""
    for number, function in data.get("m_function", {}).items():
        if "calls" in function:
            path = ("m_function", number)
            yield from _beside_calls(path, function)
            if int(number) in NEVER_CALL:
                yield (*path, "calls"), "code-of-the-control", {"code": f"M{int(number)}"}
    for number, g_function in data.get("g_function", {}).items():
        if "calls" in g_function:
            yield from _beside_calls(("g_function", number), g_function)


def _beside_calls(path: tuple[str, str], function: Mapping[str, object]) -> Iterator[Mistake]:
    for key in _BESIDE_CALLS:
        if key in function:
            yield (*path, key), "beside-calls", {"where": ".".join((*path, key))}


def _moves(data: MachineData) -> Iterator[Mistake]:
    """Moves of axes that are not there are never refused."""
    channels = data.get("channel", {}).values()
    axes = {axis for channel in channels for axis in (*channel.get("axes", ()), *channel.get("names", ()))}
    for kind in ("alarm", "message"):
        rows = data.get("alarm", ()) if kind == "alarm" else data.get("message", ())
        for number, row in enumerate(rows):
            for signal in sorted(signals_in(row["when"])):
                word, _, axis = signal.partition("_")
                if word in ("MOVE", "HOME") and axis not in axes and axis != "FIFTH_AXIS":
                    yield (kind, number, "when"), "unknown-axis", {"axis": axis}


def contradictions(machine: Machine) -> Iterator[Mistake]:
    """Everything in a machine that contradicts itself: key path, message id and arguments."""
    yield from _windows(machine)
    yield from _channels(machine)
    yield from _axes(machine)
    yield from _references(machine)
    yield from _spindles(machine)


def _windows(machine: Machine) -> Iterator[Mistake]:
    """Axes that settle come through the coarse window before they are within the fine one."""
    if machine.settle_coarse_s > machine.settle_fine_s:
        yield (
            ("settle_coarse_s",),
            "windows-crossed",
            {"coarse": machine.settle_coarse_s, "fine": machine.settle_fine_s},
        )


def _channels(machine: Machine) -> Iterator[Mistake]:
    spindles = {spindle.number for spindle in machine.spindles}
    for channel in machine.channels:
        path = ("channel", channel.number)
        if len(channel.names) != len(channel.axes):
            yield (
                (*path, "names"),
                "names-do-not-match",
                {"axes": len(channel.axes), "names": len(channel.names)},
            )
        for key, names in (("axes", channel.axes), ("names", channel.names)):
            if len(set(names)) < len(names):
                yield (*path, key), "named-twice", {"names": listed(names)}
        for name, axis in channel.geometry.items():
            if axis not in channel.axes:
                yield (*path, "geometry", name), "unknown-axis", {"axis": axis}
            elif name in channel.virtual:
                yield (*path, "virtual"), "virtual-is-real", {"axis": name}
        for number in channel.spindles:
            if number not in spindles:
                yield (*path, "spindles"), "unknown-spindle", {"spindle": number}


def _axes(machine: Machine) -> Iterator[Mistake]:
    for axis in machine.axes:
        path = ("axis", axis.name)
        if axis.limit_minus >= axis.limit_plus:
            yield (
                (*path, "limit_minus"),
                "limits-crossed",
                {"minus": axis.limit_minus, "plus": axis.limit_plus},
            )
        if axis.modulo and not axis.rotary:
            yield (*path, "modulo"), "only-rotary", {"axis": axis.name}
        if axis.diameter and axis.rotary:
            yield (*path, "diameter"), "only-linear", {"axis": axis.name}
        if axis.parallel_to and axis.parallel_to not in machine.axis:
            yield (*path, "parallel_to"), "unknown-axis", {"axis": axis.parallel_to}
        for point in axis.reference_points:
            if axis.limit_minus < axis.limit_plus and axis.overtravel(point):
                yield (
                    (*path, "reference_points"),
                    "reference-beyond-limit",
                    {"axis": axis.name, "position": point},
                )


def _references(machine: Machine) -> Iterator[Mistake]:
    for number, solid in enumerate(machine.solids):
        if solid.moves_with not in _CHAIN_ENDS and solid.moves_with not in machine.axis:
            yield ("solid", number, "moves_with"), "unknown-axis", {"axis": solid.moves_with}
    if machine.magazine.retracts and not machine.magazine.change_at:
        yield ("magazine", "retracts"), "retracts-nowhere", {}
    for name in machine.magazine.change_at:
        if name not in machine.axis:
            yield ("magazine", "change_at", name), "unknown-axis", {"axis": name}


def _spindles(machine: Machine) -> Iterator[Mistake]:
    for spindle in machine.spindles:
        path = ("spindle", spindle.number)
        if spindle.min_rpm > spindle.max_rpm:
            yield (*path, "min_rpm"), "speeds-crossed", {"min": spindle.min_rpm, "max": spindle.max_rpm}
        if spindle.axis and spindle.axis not in machine.axis:
            yield (*path, "axis"), "unknown-axis", {"axis": spindle.axis}


def conditions(data: BuilderData) -> Iterator[Mistake]:
    """Texts of rules, alarms and messages that are no conditions."""
    tables = {
        "rule": data.get("rule", ()),
        "alarm": data.get("alarm", ()),
        "message": data.get("message", ()),
    }
    for kind, rows in tables.items():
        for number, row in enumerate(rows):
            try:
                condition_of(row["when"])
            except ConditionError as error:
                where = {"when": row["when"], "character": error.at + 1}
                yield (kind, number, "when"), "no-condition", where
