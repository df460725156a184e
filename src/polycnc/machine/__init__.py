"""Machines as data: axes with limits, spindles, magazine, kinematics; and the setup a run starts from.

A machine file: `schema` says what may stand in it (`tables`: the same as types), `load` turns it into a
`Machine` (`model`), `check` asks whether all of it fits together, `render` makes a file again; `places` and
`errors` say where a mistake stands, `documents` reads YAML and TOML.
`kinematics` leads from rotary axes to the tool, `layout` is what displays
must know, `rules` and `plc` are the machine's own controller, `builder` is what a builder has made of it; `text` is a
text in both languages. `setup/` is what a run starts from.
"""

from polycnc.machine.errors import FileError, MachineFileError, SetupError
from polycnc.machine.load import builtin_ids, load_machine
from polycnc.machine.model import (
    Axis,
    Channel,
    GFunction,
    Joint,
    Machine,
    Magazine,
    MFunction,
    Solid,
    Spindle,
)
from polycnc.machine.setup.file import load_setup, parse_setup
from polycnc.machine.setup.values import (
    Interrupt,
    Offsets,
    ParameterKey,
    Parameters,
    ProbeEdge,
    Setup,
    Switches,
    Tool,
)

__all__ = [
    "Axis",
    "Channel",
    "FileError",
    "GFunction",
    "Interrupt",
    "Joint",
    "MFunction",
    "Machine",
    "MachineFileError",
    "Magazine",
    "Offsets",
    "ParameterKey",
    "Parameters",
    "ProbeEdge",
    "Setup",
    "SetupError",
    "Solid",
    "Spindle",
    "Switches",
    "Tool",
    "builtin_ids",
    "load_machine",
    "load_setup",
    "parse_setup",
]
