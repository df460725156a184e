"""What a run gave: rows, times, variables, alarms; of each channel, and of all."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from polycnc.deferred.modules import import_module, is_installed
from polycnc.deferred.records import dataclass, field
from polycnc.machine.layout import axis_layout
from polycnc.messages import AlarmError, text
from polycnc.messages.catalogue import language, listed
from polycnc.session.errors import SessionError
from polycnc.toolpath.trace import Display

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import TypedDict

    import pyarrow as pa

    from polycnc.channel.channel import Channel
    from polycnc.control.interface import Control
    from polycnc.machine.model import Machine
    from polycnc.messages import Alarm, Catalogue
    from polycnc.motion.planner import Planner
    from polycnc.motion.times import Plan, ToolTimes
    from polycnc.program import Program
    from polycnc.session.record import RunRecord
    from polycnc.toolpath import Toolpath
    from polycnc.toolpath.motion_settings import MotionSettings
    from polycnc.toolpath.trace import Record
    from polycnc.toolpath.usage import Usage


class Variables(Mapping[str, Any]):
    """The control's variables by the names that programs use, as they stood at the end of the program."""

    def __init__(self, control: Control, channel: Channel) -> None:
        self._control = control
        self._channel = channel

    def __getitem__(self, name: str) -> Any:
        """A variable: number, text, or None where it is vacant; `KeyError` where there is none."""
        try:
            return self._control.read_variable(self._channel, name)
        except (AlarmError, AttributeError, TypeError, ValueError, IndexError):
            raise KeyError(name) from None  # what is no name of a variable has no value either

    def __iter__(self) -> Iterator[str]:
        if self._channel.memory is None:  # an alarm of the setup came before there was any
            return iter(())
        return iter(self._control.variable_names(self._channel))

    def __len__(self) -> int:
        return sum(1 for _ in self)


if TYPE_CHECKING:

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
        catalogue: The texts of alarms.
    """

    channel: Channel
    display: Display
    metadata: Mapping[str, str]
    catalogue: Catalogue

    @property
    def number(self) -> int:
        """Number of the channel."""
        return self.channel.number

    @property
    def alarms(self) -> list[Alarm]:
        """Its own alarms with their texts, in order."""
        own = (alarm for alarm in self.channel.alarms if alarm.channel == self.number)
        return [alarm.told_by(self.catalogue) for alarm in own]

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
        """The rows as a pyarrow table, one column for each value.

        Raises:
            SessionError: pyarrow is not installed.
        """
        from polycnc.toolpath.export import arrow_table

        _need("pyarrow")
        return arrow_table(self.display, self.toolpath.chunks, dict(self.metadata))

    @cached_property
    def variables(self) -> Variables:
        """The control's variables at the end of the program, before its implicit reset."""
        return Variables(self.channel.control, self.channel)

    @property
    def final(self) -> dict[str, dict[str, float]]:
        """`work` and `machine` display at the end, before the implicit reset, as its own program has led the axes."""
        end, context = self.channel.row_position, self.channel.context
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
        main_run_s: Seconds by the clock, from the first block on that needed it; None where none did.
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
    main_run_s: float | None = None
    _channels: dict[int, ChannelResult] = field(default_factory=dict, repr=False)

    def __repr__(self) -> str:
        told = listed(alarm.code for alarm in self.alarms) or "no alarm"
        return f"<Result of {self.program.name} on {self.control.id}, {self.machine.id}: {told}>"

    def _repr_html_(self) -> str:
        """The report as a notebook shows it."""
        from polycnc.session.notebook import as_html

        head = text("run.head", program=self.program.name, control=self.control.id, machine=self.machine.id)
        return as_html(head, self.alarms, self.time if self.timed else None, self.tools if self.timed else ())

    def __reduce__(self) -> tuple[Callable[[RunRecord], RunRecord], tuple[RunRecord]]:
        """A copy for another process is the record of the run: a control that has run cannot be sent."""
        return _itself, (self.record,)

    @property
    def record(self) -> RunRecord:
        """The run as plain values."""
        from polycnc.session.record import RunRecord

        return RunRecord(
            self.control.id, self.machine.id, self.program.name, self.alarms, list(self.rows), self.final,
            {name: value for name, value in self.variables.items() if value is not None}, list(self.stops),
            self.time if self.timed else None, self.tools if self.timed else (), self.repeats,
        )  # fmt: skip

    def to_pandas(self) -> object:
        """`moves` as a pandas table; SessionError where pandas is not installed."""
        _need("pandas")
        return self.moves.to_pandas()

    def to_polars(self) -> object:
        """`moves` as a polars table; SessionError where polars is not installed."""
        _need("polars")
        made: object = import_module("polars").from_arrow(self.moves)
        return made

    @property
    def alarms(self) -> list[Alarm]:
        """Every alarm with its texts, in order."""
        return [alarm.told_by(self.catalogue) for alarm in self.channel.alarms]

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
                display = (
                    self.display
                    if channel is self.channel
                    else Display(channel.toolpath, layout, names=self.control.display_names)
                )
                self._channels[channel.number] = ChannelResult(
                    channel, display, self.metadata, self.catalogue
                )
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

    @cached_property
    def moves(self) -> pa.Table:
        """The rows as a pyarrow table, one column for each value, with start, duration, length and feed as executed.

        Raises:
            SessionError: pyarrow is not installed.
        """
        from polycnc.toolpath.export import with_times

        table = self.channels[self.channel.number].moves
        return with_times(table, self.plan, self.display) if self.timed and self.planner is None else table

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

    @cached_property
    def usage(self) -> Usage:
        """What the program has used: extents by tool and of the machine, speeds, feeds, work offsets."""
        from polycnc.toolpath.usage import Usage

        used = Usage(self.display)
        for chunk in self.toolpath.chunks:
            used.take(chunk)
        return used

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
        """The text of an alarm, with the hint on this very case if there is one."""
        return alarm.told_by(self.catalogue).text_in(lang or language())

    @cached_property
    def catalogue(self) -> Catalogue:
        """The texts of all alarms of this control and this machine."""
        from polycnc.control.alarm_text import catalogue_of

        return catalogue_of(self.control, self.machine)

    @property
    def files(self) -> list[str]:
        """The files of all programs that ran."""
        group = self.channel.group
        channels = group.channels if group is not None else [self.channel]
        return [each.path for channel in channels for each in channel.programs if each.path]

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


def _itself(record: RunRecord) -> RunRecord:
    return record


def _need(library: str) -> None:
    """A table can only be made where its library is installed."""
    if not is_installed(library):
        raise SessionError("session.no-library", library=library)
