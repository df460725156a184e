"""What `polycnc run` tells after a run: a report for people, a state file for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polycnc.cli.console import coloured
from polycnc.cli.diagnostics import diagnostics_of
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.toolpath.events import Message, Print, Stop

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.motion.plan import Times
    from polycnc.session import Result
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record

#: A program may say much; the report shows so many messages and stops, the trace shows all.
MOST_HAPPENINGS = 50
_SHOWN = frozenset((Message.type, Stop.type, Print.type))
_SHARES = ("cutting_s", "rapid_s", "dwell_s", "tool_change_s", "spindle_s", "auxiliary_s")


class Happenings:
    """Collects the messages, prints and stops of a run."""

    def __init__(self, display: Display) -> None:
        self._display = display
        self.records: list[Record] = []
        self.more = 0

    def take(self, chunk: Chunk) -> None:
        """Look through a chunk."""
        if not any(event.type in _SHOWN for event in chunk.events):
            return
        found = [
            record
            for record in self._display.records_of(chunk)
            # A message without text only takes the last one away.
            if record["type"] in _SHOWN and record.get("text") != ""
        ]
        room = MOST_HAPPENINGS - len(self.records)
        self.records += found[:room]
        self.more += len(found[room:])


def as_text(result: Result, happenings: Happenings, file: str) -> str:
    """The report."""
    return "".join(f"{line}\n" for line in _lines(result, happenings, file))


def _lines(result: Result, happenings: Happenings, file: str) -> Iterator[str]:
    program = result.program.name
    yield text("run.head", program=program, control=result.control.id, machine=result.machine.id)
    for diagnostic in diagnostics_of(result, file):
        yield coloured(str(diagnostic), "red" if diagnostic.severity == "error" else "yellow")
    if result.ok:
        yield coloured(text("run.no-alarm"), "green")
    for record in happenings.records:
        told = record.get("text", record.get("code", ""))
        yield text(f"run.{record['type']}", line=record["line"], text=told)
    if happenings.more:
        yield text("run.more", count=happenings.more)
    if result.repeats:
        yield text("run.repeats", count=result.repeats)
    if not result.timed:
        return
    times = result.plan.times
    yield text("run.time", time=clock(result.time), shares=_shares(times) or "-")
    yield text("run.travel", cutting=f"{times.cutting_mm:,.1f}", rapid=f"{times.rapid_mm:,.1f}")
    if result.plan.rows_without_feed:
        yield text("run.without-feed", count=result.plan.rows_without_feed)
    if result.plan.rows_without_spindle:
        yield text("run.without-spindle", count=result.plan.rows_without_spindle)
    yield from _tools(result)


def _shares(times: Times) -> str:
    """What the time went into; what took none is left out."""
    parts: Iterable[tuple[str, float]] = ((name, getattr(times, name)) for name in _SHARES)
    return listed(f"{text(f'run.{name}')} {clock(seconds)}" for name, seconds in parts if seconds >= 0.05)


def _tools(result: Result) -> Iterator[str]:
    used = [tool for tool in result.tools if tool.tool or tool.name]
    if used:
        yield text("run.tools")
    names = [tool.name or f"T{tool.tool}" for tool in used]
    width = max(map(len, names), default=0)
    for name, tool in zip(names, used, strict=True):
        way = f"{tool.times.cutting_mm:,.1f}"
        yield text("run.tool", tool=f"{name:{width}}", time=clock(tool.times.total_s), cutting=way)


def clock(seconds: float) -> str:
    """A duration as `h:mm:ss.s`, or `m:ss.s` below an hour."""
    tenths = round(seconds * 10)
    minutes, tenths = divmod(tenths, 600)
    hours, minutes = divmod(minutes, 60)
    tail = f"{tenths // 10:02d}.{tenths % 10}"
    return f"{hours}:{minutes:02d}:{tail}" if hours else f"{minutes}:{tail}"


def as_state(result: Result) -> str:
    """The state at the end of the run as JSON: positions, modal codes, variables, alarms, times."""
    import json

    state: dict[str, object] = {
        **result.metadata,
        "alarms": [
            {
                "code": alarm.code,
                "program": alarm.program,
                "line": alarm.line,
                "column": alarm.column,
                "text": result.alarm_text(alarm),
            }
            for alarm in result.alarms
        ],
        "final": result.final,
        "modes": dict(result.channel.mode.codes),
        "variables": dict(result.variables),
    }
    if result.timed:
        tools = [{"tool": tool.name or tool.tool, "time_s": tool.times.total_s} for tool in result.tools]
        state |= {"time_s": result.time, "tools": tools}
    return json.dumps(state, ensure_ascii=False, indent=1, default=str) + "\n"
