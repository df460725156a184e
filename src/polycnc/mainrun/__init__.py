"""The main run: a simulated clock moves the axes, with the operating modes of a control.

`VirtualControl` is what a panel and a factory interface use.

    commands      control (the operator's), byhand and manual (axes without a program), states (what is allowed when),
                  errors (refusals), equipment (control, machine, setup)
    preparation   ahead (the channel runs ahead), items (what it has prepared), search, programs
    execution     core (time passes), lane (one channel), automatic (from event to event), machinery (M, T, S)
    motion        laid (rows laid out by the planner), anew, speed, motion, geometry, follower (limited jerk), axis_move
    in between    stray (moved by hand while a program waits), shared_axes
    signals       signals, program_signals, machine_states, guard: the machine's own controller
    what is read  readings, snapshot, display
"""

from polycnc.mainrun.control import VirtualControl
from polycnc.mainrun.errors import CommandRefused
from polycnc.mainrun.snapshot import Positions, Record, Snapshot
from polycnc.mainrun.states import Command, Mode, State

__all__ = ["Command", "CommandRefused", "Mode", "Positions", "Record", "Snapshot", "State", "VirtualControl"]
