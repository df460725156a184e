"""Operating modes and states of a control, and which commands each allows: the state machine as a table."""

from __future__ import annotations

from enum import StrEnum


class Mode(StrEnum):
    """What the mode switch says."""

    AUTO = "auto"
    MDI = "mdi"
    JOG = "jog"
    INCREMENT = "increment"
    HANDLE = "handle"
    REFERENCE = "reference"
    TAPE = "tape"
    """A program is run as it comes from outside."""
    EDIT = "edit"
    """Programs are written; nothing runs."""
    TEACH = "teach"


class State(StrEnum):
    """What the control is doing."""

    READY = "ready"
    """Nothing runs; a cycle start begins from the top."""
    RUNNING = "running"
    """A program is executed."""
    HOLD = "hold"
    """Feed hold, or the mode was switched: the axes brake or stand, the program waits for cycle start."""
    STOPPED = "stopped"
    """The program stands at a programmed stop or in single block; it waits for cycle start."""
    BRAKING = "braking"
    """Reset, alarm or emergency stop: the axes come to rest, then the program is given up."""
    ALARM = "alarm"
    """An alarm waits for reset."""
    EMERGENCY = "emergency"
    """The emergency stop is pressed."""
    OFF = "off"
    """The power is off."""


class Command(StrEnum):
    """What an operator, or a factory system, can ask for."""

    LOAD = "load"
    CYCLE_START = "cycle_start"
    FEED_HOLD = "feed_hold"
    MDI = "mdi"
    JOG = "jog"
    INCREMENT = "increment"
    HANDLE = "handle"
    HANDWHEEL_OFFSET = "handwheel_offset"
    HOME = "home"
    PRESET = "preset"
    TEACH = "teach"
    SELECT_MODE = "select_mode"
    BLOCK_SEARCH = "block_search"
    MACHINE_LOCK = "machine_lock"
    RESET = "reset"


PROGRAM_MODES = frozenset((Mode.AUTO, Mode.MDI, Mode.TAPE))
EVERY_MODE = frozenset(Mode)
AT_REST = frozenset((State.READY, State.HOLD, State.STOPPED))
#: A command is allowed in these modes while the control is in one of these states. Emergency stop, overrides and
#: the other switches are allowed always.
ALLOWED: dict[Command, tuple[frozenset[Mode], frozenset[State]]] = {
    Command.LOAD: (EVERY_MODE, frozenset((State.READY,))),
    Command.CYCLE_START: (PROGRAM_MODES, AT_REST),
    Command.FEED_HOLD: (PROGRAM_MODES, frozenset((State.RUNNING, State.HOLD, State.STOPPED))),
    Command.MDI: (frozenset((Mode.MDI,)), frozenset((State.READY, State.STOPPED))),
    Command.JOG: (frozenset((Mode.JOG, Mode.TEACH)), AT_REST),
    Command.INCREMENT: (frozenset((Mode.INCREMENT, Mode.TEACH)), AT_REST),
    Command.HANDLE: (frozenset((Mode.HANDLE, Mode.TEACH)), AT_REST),
    Command.HANDWHEEL_OFFSET: (PROGRAM_MODES, frozenset((*AT_REST, State.RUNNING))),
    Command.HOME: (frozenset((Mode.REFERENCE,)), AT_REST),
    Command.PRESET: (frozenset((Mode.JOG,)), frozenset((State.READY,))),
    Command.TEACH: (frozenset((Mode.TEACH,)), frozenset((State.READY,))),
    Command.SELECT_MODE: (EVERY_MODE, frozenset((*AT_REST, State.RUNNING, State.ALARM))),
    Command.BLOCK_SEARCH: (frozenset((Mode.AUTO,)), frozenset((State.READY,))),
    Command.MACHINE_LOCK: (EVERY_MODE, frozenset((State.READY,))),
    Command.RESET: (EVERY_MODE, frozenset(State)),
}


def is_allowed(command: Command, mode: Mode, state: State) -> bool:
    """Whether a command may be given now."""
    modes, states = ALLOWED[command]
    return mode in modes and state in states
