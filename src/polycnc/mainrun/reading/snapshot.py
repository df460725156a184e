"""What a panel or a factory system reads: values that belong to one moment, and never change."""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.machine.kinematics import Kinematics
    from polycnc.mainrun.commands.states import Mode, State
    from polycnc.messages import Alarm


@dataclass(frozen=True, slots=True)
class Positions:
    """Positions by axis, as the control's displays show them.

    Attributes:
        work: In the active work coordinate system, in the program's unit; diameters where the axis shows them.
        machine: Of the machine, mm and degrees; the display, which runs on under machine lock.
        to_go: What is left of the move in execution, as `work`.
        real: Where the axes of the machine are; differs from `machine` only under machine lock.
    """

    work: Mapping[str, float]
    machine: Mapping[str, float]
    to_go: Mapping[str, float]
    real: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class ActiveBlock:
    """The block in execution: program, line in its file, and text."""

    program: str = ""
    line: int = 0
    text: str = ""


@dataclass(frozen=True, slots=True)
class SpindleState:
    """The spindle: programmed speed and the one that turns, rpm; direction 1, -1, or 0 at rest."""

    number: int = 1
    programmed_rpm: float = 0.0
    rpm: float = 0.0
    direction: int = 0


@dataclass(frozen=True, slots=True)
class ToolState:
    """Tool in the spindle, and the one that stands by (number or name); 0 for none."""

    tool: int = 0
    name: str = ""
    next_tool: int | str = 0


@dataclass(frozen=True, slots=True)
class Overrides:
    """Overrides, 1 for 100 %."""

    feed: float = 1.0
    rapid: float = 1.0
    spindle: float = 1.0


@dataclass(frozen=True, slots=True)
class PanelSwitches:
    """Switches of the panel.

    Attributes:
        single_block: Empty for off, else the kind: `SBL1` (the only one on most controls), `SBL2`, `SBL3`.
        optional_stop: M01 stops.
        block_skip: True for plain `/`, or the levels that are on, as the control writes them.
        dry_run: Feed moves run at the speed of the jog switch.
        machine_lock: The axes stand; the display runs on.
        z_lock: The same for the tool axis alone.
        mst_lock: M, S and T go to no machine; stops and program ends act.
        drf: The handwheel shifts axes beside the program (SINUMERIK's DRF).
    """

    single_block: str = ""
    optional_stop: bool = False
    block_skip: bool | tuple[int, ...] = False
    dry_run: bool = False
    machine_lock: bool = False
    z_lock: bool = False
    mst_lock: bool = False
    drf: bool = False


@dataclass(frozen=True, slots=True)
class ChannelSnapshot:
    """One channel at one moment.

    Attributes:
        number: Number of the channel.
        runs: A program of the channel is under way, halted or not.
        waits: It waits for another channel.
        halt: Why its program stands (`M00`, `single-block` …), or empty.
        positions: Positions of its axes.
        feed: Path speed now, mm/min.
        block: The block in execution.
        modal: Active code of every modal group.
        spindle: The spindle.
        tool: The tool.
        messages: Texts that its program has put out.
        program: Name of the program that is loaded in it; empty for none.
        parts: How often a program that an operator has started in it has come to its end.
        point: Where its tool is: X, Y and Z in the system of the work offset, mm (radius).
        mechanism: The rotary joints of the machine, with the tool as it stands with them at zero; None before a start.
    """

    number: int
    runs: bool
    waits: bool
    halt: str
    positions: Positions
    feed: float
    block: ActiveBlock
    modal: Mapping[str, str]
    spindle: SpindleState
    tool: ToolState
    messages: tuple[str, ...] = ()
    program: str = ""
    parts: int = 0
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mechanism: Kinematics | None = None


@dataclass(frozen=True, slots=True)
class Snapshot:
    """The control at one moment.

    Attributes:
        time: Simulated time since power-on, s.
        mode: Operating mode.
        state: What the control is doing.
        halt: Why the program stands (`M00`, `M01`, `single-block` …), or empty.
        positions: Positions of all axes.
        feed: Path speed now, mm/min.
        program: Name of the loaded program.
        block: The block in execution.
        modal: Active code of every modal group.
        spindle: The spindle.
        tool: The tool.
        overrides: Overrides.
        switches: Panel switches.
        signals: The signal image.
        alarms: Alarms that wait for reset.
        messages: Texts that the program has put out.
        parts: How often a program has come to its end.
        channels: Every channel that has been spoken of, by number; what stands above is of the first.
        notices: Numbers of the messages from the machine's controller.
        waiting: What a program that runs stands for: `function` (an auxiliary function), `dwell`; empty for neither.
        interruption: The line of the loaded program at which it was given up, or that called what was; 0 for none.
        interrupted: Where a search for the point of interruption goes: the block of the loaded program in execution, or
            at which it was given up, as program and line of each level from the main program on; empty for none.
    """

    time: float
    mode: Mode
    state: State
    halt: str
    positions: Positions
    feed: float
    program: str
    block: ActiveBlock
    modal: Mapping[str, str]
    spindle: SpindleState
    tool: ToolState
    overrides: Overrides
    switches: PanelSwitches
    signals: Mapping[str, float]
    alarms: tuple[Alarm, ...] = ()
    messages: tuple[str, ...] = ()
    parts: int = 0
    channels: Mapping[int, ChannelSnapshot] = field(default_factory=dict)
    notices: tuple[str, ...] = ()
    waiting: str = ""
    interruption: int = 0
    interrupted: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True, slots=True)
class Record:
    """Something that happened: what the trace of a virtual control is made of.

    `what` is `mode`, `state`, `block`, `event` of the program (`m`, `s`, `t` …), `signal`, `override`.
    """

    time: float
    what: str
    data: Mapping[str, object] = field(default_factory=dict)
