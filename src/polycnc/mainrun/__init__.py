"""The main run: a simulated clock moves the axes, with the operating modes of a control.

`VirtualControl` is what a panel and a factory interface use.
"""

from polycnc.mainrun.control import VirtualControl
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.snapshot import Positions, Record, Snapshot
from polycnc.mainrun.states import Command, Mode, State

__all__ = ["Command", "CommandRefused", "Mode", "Positions", "Record", "Snapshot", "State", "VirtualControl"]
