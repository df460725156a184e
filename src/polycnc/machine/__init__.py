"""Machines as data: axes with limits, spindles, magazine, kinematics; and the setup a run starts from.

`load` turns a machine file into a `Machine`, `render` turns a machine into a file; `setup` is what a run
starts from and `setup_file` reads it. `model` and `setup` know nothing about files.
"""

from polycnc.machine.errors import FileError, MachineFileError, SetupError
from polycnc.machine.load import builtin_ids, load_machine
from polycnc.machine.model import Axis, Channel, Joint, Machine, Magazine, MFunction, Solid, Spindle
from polycnc.machine.setup import (
    Interrupt,
    Offsets,
    ParameterKey,
    Parameters,
    ProbeEdge,
    Setup,
    Switches,
    Tool,
)
from polycnc.machine.setup_file import load_setup, parse_setup

__all__ = [
    "Axis",
    "Channel",
    "FileError",
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
