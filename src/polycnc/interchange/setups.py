"""A memory as a setup, and a setup into a memory.

A setup says work offsets, tools, variables and parameters by name, each for itself: what it names counts from then on,
all else stays. It says no rotations of frames and no programs; what else it may say (start, switches) is of a run.
"""

from __future__ import annotations

from polycnc.control.fanuc.lathe.tools import files as lathe_files
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.parameters import known_parameters
from polycnc.control.word_address.macro_b.parameter_input import set_parameter
from polycnc.control.word_address.memory import ParameterTable, ToolOffsets
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.interchange.errors import ReadingError
from polycnc.interchange.power_on import channel_on
from polycnc.machine.setup import edit
from polycnc.machine.setup.file import load_setup
from polycnc.memory.retained import InMemoryStore
from polycnc.messages import AlarmError, text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from polycnc.channel.channel import Channel
    from polycnc.machine.setup.values import ParameterKey, Setup
    from polycnc.memory.retained import RetainedStore

#: What a setup may say that no memory holds.
_OF_A_RUN = ("start", "spindle_tool", "channels", "switches")
_SINUMERIK, _SYNTEC, _LATHE = "sinumerik-840d", "syntec-mill", "fanuc-0i-tf"


# ---- writing ---------------------------------------------------------------------------------------------------


def text_of(channel: Channel, machine: str | Path | None) -> str:
    """A setup with everything that a setup can say of a memory."""
    document: dict[object, object] = {"machine": str(machine)} if machine else {}
    parts = _of_sinumerik(channel) if channel.control.id == _SINUMERIK else _of_word_address(channel)
    document.update((name, values) for name, values in parts.items() if values)
    return edit.document_text(document, "setup.yaml") if document else ""


def _of_word_address(channel: Channel) -> dict[str, dict[Any, Any]]:
    if channel.control.id == _LATHE:
        numbers, systems = OffsetMemory.of(channel).numbers, channel.memory.work_offsets
        taken = lathe_files.Taken(0, frozenset(numbers), frozenset(systems))
        found = lathe_files.as_setup(channel, taken)
    else:
        found = {
            "work_offsets": {
                name: dict(zip(channel.axes, values, strict=True))
                for name, values in channel.memory.work_offsets.items()
            },
            "tools": {
                number: {
                    "length": offset.length,
                    "radius": offset.radius,
                    "tip": offset.tip,
                    "wear": {"length": offset.length_wear, "radius": offset.radius_wear},
                }
                for number, offset in sorted(ToolOffsets.of(channel).numbers.items())
            },
        }
    changed: Mapping[ParameterKey, Any] = ParameterTable.of(channel).changed
    parameters = {_name_of(key): value for key, value in changed.items()}
    return {**found, "variables": _variables(channel), "parameters": {**parameters, **_written(channel)}}


def _variables(channel: Channel) -> dict[str, object]:
    if channel.control.id != _SYNTEC:
        return {f"#{n}": value for n, value in sorted(channel.memory.kept.items()) if value is not None}
    from polycnc.control.syntec.macros.variables import GlobalState

    state = GlobalState.of(channel)
    return {
        **{f"@{n}": value for n, value in sorted(state.values.items())},
        **{f"R{n}": value for n, value in sorted(state.registers.items())},
    }


def _written(channel: Channel) -> dict[str, int]:
    """User parameters that macros of SYNTEC have written."""
    if channel.control.id != _SYNTEC:
        return {}
    from polycnc.control.syntec.macros.machine_parameters import WrittenParameters

    return {str(number): value for number, value in WrittenParameters.of(channel).values.items()}


def _name_of(key: ParameterKey) -> str:
    bit = "" if key.bit is None else f"#{key.bit}"
    element = "" if key.element is None else f"[{str(key.element).strip('()').replace(' ', '')}]"
    return f"{key.id}{bit}{element}" + (f" {key.axis}" if key.axis else "")


def _of_sinumerik(channel: Channel) -> dict[str, dict[Any, Any]]:
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.frames.memory import ZERO_OFFSETS
    from polycnc.control.sinumerik.tools.memory import setup_of_tools
    from polycnc.language.sinumerik.names.frame import NEUTRAL

    memory, data = channel.memory, MachineData.of(channel)
    settable = memory.frames.settable
    frames = {name: settable[n - 1] for name, n in ZERO_OFFSETS.items() if n <= len(settable)}
    changed = {**data.changed_everywhere, **data.changed}
    return {
        "work_offsets": {
            name: {axis: frame.component(axis, "TR") for axis in channel.axes}
            for name, frame in frames.items()
            if frame != NEUTRAL
        },
        "tools": setup_of_tools(memory.tools.tools),
        "variables": {f"R{n}": value for n, value in enumerate(memory.language.r) if value},
        "parameters": {
            name + (f"[{','.join(map(str, indices))}]" if indices else ""): value
            for (name, indices), value in changed.items()
            if value is not None
        },
    }


# ---- reading ---------------------------------------------------------------------------------------------------


def take(memory: RetainedStore, control: str, machine: str | Path | None, path: Path) -> list[str]:
    """Take a setup over.

    Returns:
        What of it does not belong to a memory, in the active language.

    Raises:
        FileError: It is no setup (file, line, reason).
        ReadingError: It names a variable or a parameter that the control does not have.
    """
    setup = load_setup(path)
    channel = channel_on(memory, control, machine)
    fresh = channel_on(InMemoryStore(), control, machine, setup=path)
    if control == _SINUMERIK:
        _into_sinumerik(channel, fresh, setup, path)
    else:
        _into_word_address(channel, fresh, setup, path)
    for name, value in setup.variables.items():
        try:
            channel.control.write_variable(channel, name, list(value) if isinstance(value, tuple) else value)
        except (KeyError, ValueError, TypeError, IndexError, AlarmError):
            raise _refused(path, name, text("setup.no-variable", name=name)) from None
    besides = [name for name in _OF_A_RUN if getattr(setup, name) != getattr(type(setup)(), name)]
    return [text("memory.of-a-run", file=path, parts=listed(besides))] if besides else []


def _into_word_address(channel: Channel, fresh: Channel, setup: Setup, path: Path) -> None:
    for name in setup.work_offsets:
        channel.memory.work_offsets[name] = fresh.memory.work_offset(name)
    numbers, given = _offsets_of(channel), _offsets_of(fresh)
    numbers.update((int(number), given[int(number)]) for number in setup.tools)
    known = {number for each in known_parameters(channel.control) for number in each.ids}
    for key, value in setup.parameters.items():
        if _is_written(channel, key):
            from polycnc.control.syntec.macros.machine_parameters import WrittenParameters

            WrittenParameters.of(channel).values[int(key.id)] = int(float(str(value)))
        elif key.id not in known or not isinstance(value, int | float):
            raise _refused(
                path, str(key.id), text("parameters.unknown", control=channel.control.id, number=key.id)
            )
        else:
            set_parameter(channel, key, value)


def _offsets_of(channel: Channel) -> dict[int, Any]:
    lathe = channel.control.id == _LATHE
    return OffsetMemory.of(channel).numbers if lathe else ToolOffsets.of(channel).numbers


def _is_written(channel: Channel, key: ParameterKey) -> bool:
    if channel.control.id != _SYNTEC or not isinstance(key.id, int):
        return False
    from polycnc.control.syntec.macros.machine_parameters import is_user_parameter

    return is_user_parameter(key.id)


def _into_sinumerik(channel: Channel, fresh: Channel, setup: Setup, path: Path) -> None:
    from polycnc.control.sinumerik.data.machine_data import MachineData
    from polycnc.control.sinumerik.frames.memory import ZERO_OFFSETS

    frames, given = channel.memory.frames, fresh.memory.frames
    for name in setup.work_offsets:
        if 0 < ZERO_OFFSETS.get(name, 0) <= len(frames.settable):
            frames.settable[ZERO_OFFSETS[name] - 1] = given.settable[ZERO_OFFSETS[name] - 1]
        else:
            raise _refused(path, name, text("memory.no-offset", name=name))
    tools = fresh.memory.tools.tools
    named = {tool.name.upper(): number for number, tool in tools.items()}
    for key, tool in setup.tools.items():
        number = key if isinstance(key, int) else named[(tool.name or key).upper()]
        channel.memory.tools.tools[number] = tools[number]
    data = MachineData.of(channel)
    for (name, indices), value in MachineData.of(fresh).preset.items():
        data.write(name, indices, value)


def _refused(path: Path, wanted: str, reason: str) -> ReadingError:
    """A refusal with the place where the file names what is wrong."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        column = line.upper().find(wanted.upper())
        if column >= 0:
            return ReadingError(path, number, column + 1, reason)
    return ReadingError(path, 1, 1, reason)
