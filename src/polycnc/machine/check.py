"""What must fit together in a machine as a whole, beyond the keys of one file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.machine.rules import ConditionError
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.machine.model import Machine
    from polycnc.machine.schema import Mistake
    from polycnc.machine.tables import MachineData

_BOX_SIZES = 3
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
    for name in data.get("axis", {}):
        if name not in names:
            yield ("axis", name), "axis-unused", {"axis": name}
    for index, joint in enumerate(data.get("joint", ())):
        if joint["axis"] not in names:
            yield ("joint", index, "axis"), "axis-unused", {"axis": joint["axis"]}
        if not any(joint["direction"]):
            yield ("joint", index, "direction"), "no-direction", {"axis": joint["axis"]}
    for index, solid in enumerate(data.get("solid", ())):
        if solid["shape"] == "box" and len(solid["size"]) != _BOX_SIZES:
            yield (
                ("solid", index, "size"),
                "wrong-length",
                {"where": f"solid.{index}.size", "detail": _BOX_SIZES},
            )


def contradictions(machine: Machine) -> Iterator[Mistake]:
    """Everything in a machine that contradicts itself: key path, message id and arguments."""
    yield from _windows(machine)
    yield from _channels(machine)
    yield from _axes(machine)
    yield from _references(machine)
    yield from _spindles(machine)
    yield from _rules(machine)


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


def _rules(machine: Machine) -> Iterator[Mistake]:
    for number, rule in enumerate(machine.rules):
        try:
            rule.condition  # noqa: B018 - it is read when it is first asked for
        except ConditionError as error:
            yield ("rule", number, "when"), "no-condition", {"when": rule.when, "character": error.at + 1}
