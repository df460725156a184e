"""The main run: a simulated clock moves the axes, with the operating modes of a control.

`VirtualControl` is what a panel and a factory interface use.

    commands/      what an operator may ask for, programs, block search
    preparation/   the channel runs ahead: look-ahead buffer
    execution/     what is prepared is carried out in time
    motion/        the axes between two events
    axes/          what moves an axis beside its program
    signals/       the machine's own controller
    reading/       what is read
    control        `VirtualControl`, made of all these
    continuation   a calculation that goes on in time
    status         mode, state, alarms, and the trace
    equipment      control, machine, setup
    errors         refusals
"""

from polycnc.mainrun.commands.states import Command, Mode, State
from polycnc.mainrun.control import VirtualControl
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.reading.snapshot import Positions, Record, Snapshot

__all__ = ["Command", "CommandRefused", "Mode", "Positions", "Record", "Snapshot", "State", "VirtualControl"]
