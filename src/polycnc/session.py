"""One program on one control and one machine, from the file to the result.

result = polycnc.run("part.nc", control="fanuc-m", setup={"work_offsets": {"G54": {"Z": -100}}})
result.alarms, result.time, result.moves.to_pandas()
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

from polycnc.channel.channel import DEFAULT_BLOCK_LIMIT, Channel
from polycnc.channel.group import ChannelGroup
from polycnc.channel.states.passes import Passes
from polycnc.channel.waits import Why
from polycnc.control.alarm_text import alarm_text
from polycnc.language.bulk.scanner import Bulk
from polycnc.machine.layout import axis_layout
from polycnc.messages import UserError
from polycnc.messages.catalogue import listed
from polycnc.toolpath import Toolpath
from polycnc.toolpath.events import Raised
from polycnc.toolpath.trace import Display

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    import pyarrow as pa

    from polycnc.channel.waits import Wait
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.machine.setup.values import Setup
    from polycnc.messages import Alarm
    from polycnc.motion.plan import Plan, ToolTimes
    from polycnc.motion.planner import Planner
    from polycnc.motion.sampling.samples import Sampler, Samples
    from polycnc.program import Program, ProgramStore
    from polycnc.toolpath.motion_settings import MotionSettings
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Record

#: A wait of this reason is a halt in single block mode.
_BLOCK_NUMBER = re.compile(r"\s*(?:/\d*\s*)?(N\d+)", re.IGNORECASE)


class SessionError(UserError):
    """A run cannot even begin: the caller asked for something that does not exist or cannot be decided."""


class Variables(Mapping[str, Any]):
    """The control's variables by the names that programs use, as they stood at the end of the program."""

    def __init__(self, control: Control, channel: Channel) -> None:
        self._control = control
        self._channel = channel

    def __getitem__(self, name: str) -> Any:
        """A variable: number, text, or None where it is vacant; `KeyError` where there is none."""
        return self._control.read_variable(self._channel, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._control.variable_names(self._channel))

    def __len__(self) -> int:
        return sum(1 for _ in self)


class Lead(TypedDict):
    """What the planner must know of the start.

    Attributes:
        start: Machine position, mm (radius) and degrees.
        tool: The tool in the spindle.
        settings: How the control leads the axes.
    """

    start: Sequence[float]
    tool: int | str
    settings: MotionSettings


@dataclass
class ChannelResult:
    """What a run gave of one channel.

    Attributes:
        channel: The channel in its last state.
        display: Turns rows of its toolpath into what the control shows.
        metadata: What a table says of the whole run.
    """

    channel: Channel
    display: Display
    metadata: Mapping[str, str]

    @property
    def number(self) -> int:
        """Number of the channel."""
        return self.channel.number

    @property
    def alarms(self) -> list[Alarm]:
        """Its own alarms, in order."""
        return [alarm for alarm in self.channel.alarms if alarm.channel == self.number]

    @property
    def toolpath(self) -> Toolpath:
        """The table itself, in internal units."""
        return self.channel.toolpath

    @cached_property
    def rows(self) -> list[Record]:
        """Moves and events in order, as the trace shows them."""
        return list(self.display.records())

    @cached_property
    def moves(self) -> pa.Table:
        """The rows as a pyarrow table, one column for each value; needs pyarrow."""
        from polycnc.toolpath.export import arrow_table

        return arrow_table(self.display, self.toolpath.chunks, dict(self.metadata))

    @cached_property
    def variables(self) -> Variables:
        """The control's variables at the end of the program, before its implicit reset."""
        return Variables(self.channel.control, self.channel)

    @property
    def final(self) -> dict[str, dict[str, float]]:
        """`work` and `machine` display at the end, before the implicit reset, as its own program has led the axes."""
        end, context = self.channel.row_position, self.channel.control.context(self.channel)
        return {"work": self.display.work(end, context), "machine": self.display.machine(end, context)}


@dataclass
class Result:
    """What a run gave. What is said without a channel is of the first one; `channels` has each.

    Attributes:
        program: The main program.
        control: The control.
        machine: The machine that it moved.
        channel: The (first) channel in its last state.
        display: Turns rows of the toolpath into what the control shows.
        alarms: In order.
        lead: What the planner must know of the start.
        planner: Has planned the chunks that are no longer held; None where all are, or none is planned.
        timed: Whether there is a cycle time.
        stops: Where the run halted in single block mode, as N words.
    """

    program: Program
    control: Control
    machine: Machine
    channel: Channel
    display: Display
    lead: Lead
    planner: Planner | None = None
    timed: bool = True
    stops: list[str] = field(default_factory=list)
    _channels: dict[int, ChannelResult] = field(default_factory=dict, repr=False)

    @property
    def alarms(self) -> list[Alarm]:
        """Every alarm, in order."""
        return self.channel.alarms

    @property
    def ok(self) -> bool:
        """Whether the program ran to its end without an alarm."""
        return not self.channel.alarms

    @property
    def repeats(self) -> int:
        """Passes of a main program after which every further one would be like the last; 0 where it has an end."""
        passes = self.channel.passes
        return passes.count if passes is not None and passes.repeat else 0

    @property
    def toolpath(self) -> Toolpath:
        """The table itself, in internal units."""
        return self.channel.toolpath

    @property
    def channels(self) -> dict[int, ChannelResult]:
        """Every channel that has run, by number."""
        group = self.channel.group
        others = [other for other in group.channels if other.memory is not None] if group is not None else []
        for channel in (self.channel, *others):
            if channel.number not in self._channels:
                layout = axis_layout(self.machine, channel.number)
                display = self.display if channel is self.channel else Display(channel.toolpath, layout)
                self._channels[channel.number] = ChannelResult(channel, display, self.metadata)
        return self._channels

    @property
    def rows(self) -> list[Record]:
        """Moves and events in order, as the trace shows them."""
        return self.channels[self.channel.number].rows

    @property
    def rows_of_other_channels(self) -> Iterator[Record]:
        """As `rows`, of every further channel that has run; each row names its `channel`."""
        for number, channel in self.channels.items():
            if number != self.channel.number:
                for record in channel.display.records():
                    yield {"channel": number, **record}

    @property
    def moves(self) -> pa.Table:
        """The rows as a pyarrow table, one column for each value; needs pyarrow."""
        return self.channels[self.channel.number].moves

    @property
    def metadata(self) -> dict[str, str]:
        """What a table says of the whole run."""
        return {"control": self.control.id, "machine": self.machine.id, "program": self.program.name}

    @cached_property
    def plan(self) -> Plan:
        """The planned cycle time, in total and by tool; `ValueError` where the run was not `timed`."""
        if not self.timed:
            raise ValueError("the motion of this run was dropped and not planned")
        if self.planner is not None:
            return self.planner.finish()
        from polycnc.motion.plan import plan

        return plan(self.toolpath, self.machine, **self.lead)

    @property
    def time(self) -> float:
        """Cycle time in seconds."""
        return self.plan.total_s

    @property
    def tools(self) -> tuple[ToolTimes, ...]:
        """The tools in the order of their first use, with their times."""
        return self.plan.tools

    @property
    def variables(self) -> Variables:
        """The control's variables at the end of the program, before its implicit reset."""
        return self.channels[self.channel.number].variables

    @property
    def final(self) -> dict[str, dict[str, float]]:
        """`work` and `machine` display at the end of the program, before its implicit reset."""
        first, group = self.channel, self.channel.group
        channels = self.channels
        shown = channels[first.number].final
        own = dict(zip(first.axes, (axis.name for axis in first.axis_data), strict=True))
        for number, result in channels.items():
            # An axis that another channel has moved last stands where that one shows it.
            for axis, name in zip(result.channel.axis_data, result.channel.axes, strict=True):
                is_elsewhere = number != first.number and own.get(name, axis.name) == axis.name
                if is_elsewhere and group is not None and group.moved_by[axis.name] == number:
                    elsewhere = result.final
                    for system in shown:
                        shown[system][name] = elsewhere[system][name]
        return shown

    def alarm_text(self, alarm: Alarm, lang: str | None = None) -> str:
        """The control's own text of an alarm, with the hint on this very case if there is one."""
        return alarm_text(self.control, alarm, lang)

    def program_of(self, alarm: Alarm) -> Program | None:
        """The program in which an alarm arose."""
        return self._program(alarm.program)

    def file_of(self, name: str) -> str:
        """The file of a program that ran, by the program's name; empty where it came as a text."""
        program = self._program(name)
        return program.path if program is not None else ""

    def _program(self, name: str) -> Program | None:
        group = self.channel.group
        channels = group.channels if group is not None else [self.channel]
        return next((each for channel in channels for each in channel.programs if each.name == name), None)


class Session:
    """A program that is ready to run on a control and a machine.

    Args:
        control: The control.
        machine: The machine.
        setup: Offsets, tools, parameters, switches that the run starts from.
        store: Where the control finds subprograms.
        program: The main program.
        block_limit: The run ends with the control's alarm after so many blocks.
        keep: Keep the whole toolpath; without it, each chunk is planned, consumed and dropped.
        timed: Plan chunks before they are dropped; without it, there is no cycle time.
        bulk: Scan plain blocks of long programs in bulk: faster, with the same result.

    Attributes:
        consumers: Called with each chunk of the toolpath, in order, while the program runs.
        result: What `run` gives.
    """

    def __init__(
        self,
        control: Control,
        machine: Machine,
        setup: Setup,
        store: ProgramStore,
        program: Program,
        *,
        block_limit: int = DEFAULT_BLOCK_LIMIT,
        keep: bool = True,
        timed: bool = True,
        bulk: bool = True,
    ) -> None:
        self.consumers: list[Callable[[Chunk], object]] = []
        toolpath = Toolpath(machine.channel_axes(1), on_full=self._take)
        self.channel = Channel(
            control, machine, setup, store, block_limit=block_limit, toolpath=toolpath,
            bulk=Bulk() if bulk else None,
        )  # fmt: skip
        self._keep = keep
        self.channel.share_after = _share_after
        self.channel.passes = Passes()
        self.group = ChannelGroup(self.channel)
        display = Display(toolpath, axis_layout(machine, 1), self._event_text)
        lead: Lead = {
            "start": self.channel.coordinates.machine,
            "tool": setup.spindle_tool,
            "settings": control.motion_settings(self.channel),
        }
        self.result = Result(program, control, machine, self.channel, display, lead)
        self.result.timed = keep or timed
        if self.result.timed and not keep:
            from polycnc.motion.planner import Planner

            self.result.planner = Planner(toolpath, machine, keep_rows=False, **self.result.lead)

    def run(self, progress: Callable[[Channel], None] | None = None) -> Result:
        """Run to the end of the program or to an alarm. Programmed stops are recorded and started again.

        Args:
            progress: Called now and then in a long run.
        """
        for wait in self.group.run(self.result.program):
            if wait.reason is Why.SINGLE_BLOCK:
                self.result.stops.extend([*self.channel.inner_halts, self._halt(wait)])
                self.channel.inner_halts.clear()
            elif progress is not None:
                progress(self.channel)
        for consume in self.consumers:
            consume(self.channel.toolpath.chunk)
        return self.result

    def sample(self, period_s: float, give: Callable[[Samples], None]) -> Sampler:
        """Have the motion sampled while it is planned (`keep=False`). Needs NumPy.

        When the result is planned to its end (`result.plan`), `close` of what this returns gives the last samples.
        """
        from polycnc.motion.sampling.samples import Sampler

        result = self.result
        if result.planner is None:
            raise ValueError("only a session that keeps no toolpath is planned while it runs")
        settings = result.lead["settings"]
        sampler = Sampler(result.toolpath, result.machine, result.planner, settings, period_s, give)
        self.consumers.append(sampler.take)
        return sampler

    def _take(self, chunk: Chunk) -> bool:
        for consume in self.consumers:
            consume(chunk)
        if self.result.planner is not None:
            self.result.planner.take(chunk)
        return not self._keep

    def _event_text(self, raised: Raised) -> str:
        """The text of an alarm of the toolpath."""
        same = (
            alarm for alarm in self.channel.alarms if (alarm.code, alarm.line) == (raised.code, raised.line)
        )
        return next((self.result.alarm_text(alarm) for alarm in same), "")

    def _halt(self, wait: Wait) -> str:
        """The N word of the block at which the run has halted, or its line."""
        if wait.code:
            return wait.code
        level = self.channel.level
        return block_number(level.code.program, level.code.line(level.current))


def _share_after(channel: Channel, end: list[float], feed: float, seconds: float) -> float | None:
    from polycnc.motion.sampling.timing import share_after

    return share_after(channel, end, feed, seconds)


def block_number(program: Program, line: int) -> str:
    """The N word at the start of a line, or the line's number where it has none."""
    index = line - program.first_line
    match = _BLOCK_NUMBER.match(program.lines[index]) if 0 <= index < len(program.lines) else None
    return match[1].upper() if match else str(line)


# ---- preparing a run ---------------------------------------------------------------------------------------


def open_session(
    source: str | bytes | Path,
    *,
    name: str = "",
    control: str | None = None,
    machine: str | Path | None = None,
    setup: Mapping[str, object] | str | Path | None = None,
    search: Sequence[str | Path] = (),
    encoding: str | None = None,
    files: Mapping[str, str] | None = None,
    folder: Path | None = None,
    block_limit: int = DEFAULT_BLOCK_LIMIT,
    keep: bool = True,
    timed: bool = True,
    bulk: bool = True,
) -> Session:
    """Find everything that a run needs: program, control, machine, setup.

    Args:
        source: A file, or the program itself: `bytes`, or a `str` that holds a line end.
        name: Name of a program that is no file.
        control: Control id; guessed from the program where it is certain.
        machine: Built-in machine or machine file; the setup's, or else the control's usual one.
        setup: What a case writes under `setup`, or a YAML or TOML file with that.
        search: Folders in which calls look for subprograms beside that of the program.
        encoding: Encoding of program files; detected where it is not told.
        files: Further programs as texts, by name.
        folder: Where a machine file that `setup` names is looked up, if `setup` is no file.
        block_limit: See `Session`.
        keep: See `Session`.
        timed: See `Session`.
        bulk: See `Session`.

    Raises:
        SessionError: The control is unknown, or cannot be told from the program.
        ProgramFileError: A program file cannot be read.
        FileError: The machine or the setup is wrong.
    """
    from polycnc.program import Form, ProgramStore, decode

    content = decode(source, encoding).text if isinstance(source, bytes) else source
    is_text = isinstance(source, bytes) or (isinstance(source, str) and "\n" in source)
    chosen = _control(control) if control else _guess(content, name, is_text=is_text, encoding=encoding)
    form = chosen.form
    store = ProgramStore(search=search, form=form, encoding=encoding)
    if is_text:
        program = store.add_text(_MAIN_PROGRAM if form is Form.SINUMERIK else "MAIN", str(content))
    else:
        program = store.add_file(content)
    for key, text_of_file in (files or {}).items():
        store.add_text(key, text_of_file)
    built, start = _machine_and_setup(machine, setup, folder, chosen.default_machine)
    if start.tool_name and not chosen.tools_have_names:
        raise SessionError("session.tool-name", tool=start.tool_name, control=chosen.id)
    return Session(
        chosen, built, start, store, program, block_limit=block_limit, keep=keep, timed=timed, bulk=bulk
    )


#: Where a SINUMERIK program lies that comes as a text.
_MAIN_PROGRAM = "/_N_WKS_DIR/_N_TEST_WPD/_N_MAIN_MPF"


def _machine_and_setup(
    machine: str | Path | None,
    setup: Mapping[str, object] | str | Path | None,
    folder: Path | None,
    default: str,
) -> tuple[Machine, Setup]:
    """The machine of the call, else that of the setup, else the default; and the setup itself."""
    from polycnc.machine import load_machine
    from polycnc.machine.setup.file import check_axes, load_setup, parse_setup

    if setup is None or isinstance(setup, Mapping):
        start = parse_setup(setup)
    else:
        start = load_setup(setup)
        folder = Path(setup).parent
    chosen = machine or _beside(folder, start.machine) or default
    built = load_machine(chosen)
    if start.channels:
        try:
            built = built.with_channels(start.channels)
        except KeyError as error:
            raise SessionError("session.channel-axis", axis=error.args[0], machine=built.id) from None
    check_axes(start, built, "" if setup is None or isinstance(setup, Mapping) else setup)
    return built, start


def _beside(folder: Path | None, machine: str) -> str:
    """A machine file is looked up from the folder of the file that names it."""
    return str(folder / machine) if folder is not None and machine.endswith(".toml") else machine


def _control(control_id: str) -> Control:
    from polycnc.control import registry

    if control_id not in registry.ids():
        raise SessionError("session.control-unknown", control=control_id, known=listed(registry.ids()))
    return registry.control(control_id)


def _guess(content: str | Path, name: str, *, is_text: bool, encoding: str | None) -> Control:
    """The control that a program is certainly written for."""
    from polycnc.control import registry
    from polycnc.program import guess_control, load_programs, split_programs
    from polycnc.program.split import Source
    from polycnc.program.text import split_lines

    if is_text:
        programs = split_programs(split_lines(str(content)), Source(name or "MAIN"))
    else:
        programs = load_programs(str(content), encoding)
    guess = guess_control(programs, name)
    if guess.control is not None:
        return _control(guess.control)
    known = listed(registry.ids())
    shown = name or (programs[0].name if is_text else str(content))
    if guess.reasons:
        reasons = "; ".join(reason.text() for reason in guess.reasons)
        raise SessionError("session.control-doubtful", program=shown, known=known, reasons=reasons)
    raise SessionError("session.control-open", program=shown, known=known)


def run(
    source: str | bytes | Path,
    *,
    control: str | None = None,
    machine: str | Path | None = None,
    setup: Mapping[str, object] | str | Path | None = None,
    search: Sequence[str | Path] = (),
    encoding: str | None = None,
    block_limit: int = DEFAULT_BLOCK_LIMIT,
    print_to: str | Path | None = None,
    bulk: bool = True,
) -> Result:
    """Run a program and give what came of it.

    `print_to` is a file for what the program prints (DPRNT and the like); the other arguments, and what is
    raised, are those of `open_session`.
    """
    session = open_session(
        source, control=control, machine=machine, setup=setup, search=search, encoding=encoding,
        block_limit=block_limit, bulk=bulk,
    )  # fmt: skip
    result = session.run()
    if print_to is not None:
        printed = (f"{row['text']}\n" for row in result.rows if row["type"] == "print")
        Path(print_to).write_text("".join(printed), encoding="utf-8")
    return result
