"""What `polycnc run` tells after a run: a report for people, a state file for programs."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING

from polycnc.cli.console import coloured
from polycnc.cli.diagnostics import diagnostics_of
from polycnc.deferred.functions import loaded_when_called
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.toolpath.events import Message, Print, Stop

with loaded_when_called():
    from polycnc.cli import formats

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from polycnc.motion.explain import Cause, TimeAccount
    from polycnc.motion.times import Times
    from polycnc.session import Result
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display, Record
    from polycnc.toolpath.usage import Extents, ToolUsage, Usage

#: A program may say much; the report shows so many messages and stops, the trace shows all.
MOST_HAPPENINGS = 50
#: So many speeds of a tool are named.
MOST_SPEEDS = 6
_SHOWN = frozenset((Message.type, Stop.type, Print.type))
_SHARES = ("cutting_s", "rapid_s", "dwell_s", "tool_change_s", "spindle_s", "auxiliary_s")

#: What took a smaller part of the time, in percent, is not told.
LEAST_SHARE = 0.05
#: Causes that name an axis where they know it.
_OF_AXES = ("curvature", "acceleration", "jerk", "corner-jerk", "rapid")
#: By the cause and the family of the control, the parameter that says it.
_SET_BY: Mapping[str, Mapping[str, str]] = {
    "path-feed": {"fanuc": "1422", "syntec": "Pr405"},
    "axis-feed": {"fanuc": "1430", "syntec": "Pr621–", "meldas": "#2002"},
    "corner-step": {"fanuc": "1783", "syntec": "Pr406"},
    "line-pull": {"fanuc": "1737"},
    "arc-pull": {"fanuc": "1735", "syntec": "Pr408"},
}


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


def as_text(result: Result, happenings: Happenings, file: str, usage: Usage | None = None) -> str:
    """The report."""
    return "".join(f"{line}\n" for line in _lines(result, happenings, file, usage))


def _lines(result: Result, happenings: Happenings, file: str, usage: Usage | None) -> Iterator[str]:
    program = result.program.name
    yield text("run.head", program=program, control=result.control.id, machine=result.machine.id)
    for diagnostic in diagnostics_of(result, file):
        head, *remedy = formats.lines_of(diagnostic)
        yield coloured(head, "red" if diagnostic.severity == "error" else "yellow")
        yield from remedy
    if result.ok:
        yield coloured(text("run.no-alarm"), "green")
    for record in happenings.records:
        told = record.get("text", record.get("code", ""))
        yield text(f"run.{record['type']}", line=record["line"], text=told)
    if happenings.more:
        yield text("run.more", count=happenings.more)
    if result.repeats:
        yield text("run.repeats", count=result.repeats)
    if result.main_run_s is not None:
        yield text("run.main-run", time=clock(result.main_run_s))
    if not result.timed:
        return
    times = result.plan.times
    yield text("run.time", time=clock(result.time), shares=_shares(times) or "-")
    yield text("run.travel", cutting=f"{times.cutting_mm:,.1f}", rapid=f"{times.rapid_mm:,.1f}")
    if result.plan.rows_without_feed:
        yield text("run.without-feed", count=result.plan.rows_without_feed)
    if result.plan.rows_without_spindle:
        yield text("run.without-spindle", count=result.plan.rows_without_spindle)
    yield from _tools(result, usage)
    if usage is not None:
        yield from _used(result, usage)


def explained(account: TimeAccount, times: Times, control: str) -> str:
    """Where the cycle time goes: by the limit that held, by what the axes waited for; what went on beside them."""
    whole = sum(part.way for part in account.parts.values()) or 1.0
    held = [
        (part.seconds, 100.0 * part.way / whole, _named_cause(cause, axis, control))
        for cause, parts in account.by_axis.items()
        for axis, part in parts.items()
    ]
    waits = ((name, getattr(times, name)) for name in _SHARES if name not in ("cutting_s", "rapid_s"))
    held += [(seconds, 0.0, text(f"run.{name}")) for name, seconds in waits]
    lines = [text("run.explained")]
    for seconds, way, what in sorted(held, reverse=True):
        share = 100.0 * seconds / (times.total_s or 1.0)
        if share >= LEAST_SHARE:
            key = "run.explained.held" if way > 0.0 else "run.explained.wait"
            told = {"share": f"{share:5.1f} %", "time": clock(seconds), "what": what, "way": f"{way:.1f}"}
            lines.append(text(key, **told))
    for name, seconds in account.hidden_s.items():
        if seconds > 0.0:
            lines.append(text(f"run.explained.beside.{name}", time=clock(seconds)))
    return "".join(f"{line}\n" for line in lines)


def _named_cause(cause: Cause, axis: str, control: str) -> str:
    """A cause in words, with the parameter that sets it; some causes are of an axis at times, and at times of none."""
    what = text(f"run.explained.{cause}{'' if axis or cause not in _OF_AXES else '.any'}", axis=axis)
    set_by = _SET_BY.get(cause, {}).get(control.partition("-")[0])
    return what if set_by is None else f"{what} ({set_by})"


def _shares(times: Times) -> str:
    """What the time went into; what took none is left out."""
    parts: Iterable[tuple[str, float]] = ((name, getattr(times, name)) for name in _SHARES)
    return listed(f"{text(f'run.{name}')} {clock(seconds)}" for name, seconds in parts if seconds >= 0.05)


def _tools(result: Result, usage: Usage | None) -> Iterator[str]:
    used = [tool for tool in result.tools if tool.tool or tool.name]
    if used:
        yield text("run.tools")
    names = [tool.name or f"T{tool.tool}" for tool in used]
    width = max(map(len, names), default=0)
    for name, tool in zip(names, used, strict=True):
        way = f"{tool.times.cutting_mm:,.1f}"
        cut = usage.tools.get(tool.name or tool.tool) if usage is not None else None
        speeds = "".join(f"  {part}" for part in _speeds(cut)) if cut is not None else ""
        yield text("run.tool", tool=f"{name:{width}}", time=clock(tool.times.total_s), cutting=way) + speeds
        if cut is not None:
            yield from (f"    {line}" for line in _reach(result, cut))


def _reach(result: Result, cut: ToolUsage) -> Iterator[str]:
    """How far the cuts of a tool reach; units are named where the program is not all in mm."""
    display, unit = result.display, _named(cut.units)
    yield text("run.work", unit=unit, extents=extents(display.names, cut.work))
    yield text("run.machine", unit=" (mm)" if unit else "", extents=extents(display.axes, cut.machine))


def _named(units: Collection[str]) -> str:
    """Units as ` (inch)`; nothing where all is in mm."""
    return "" if set(units) <= {"mm"} else f" ({', '.join(units)})"


def _speeds(cut: ToolUsage) -> Iterator[str]:
    """Speeds and feeds of a tool's cuts, as `S1200 1500`, `S200 m/min` and `F100–400 mm/min`."""
    surface = " ft/min" if _named(cut.units) else " m/min"
    for speeds, unit in ((cut.speeds, ""), (cut.surface_speeds, surface)):
        if speeds:
            values = [f"{speed:g}" for speed in speeds]
            shown = " ".join(values[:MOST_SPEEDS]) + (" …" if len(values) > MOST_SPEEDS else "")
            yield f"S{shown}{unit}"
    for unit, (least, most) in cut.feeds.items():
        yield f"F{least:g} {unit}" if least == most else f"F{least:g}–{most:g} {unit}"


def _used(result: Result, usage: Usage) -> Iterator[str]:
    """What belongs to no tool: cuts without one, the machine's way, work offsets."""
    unnamed = usage.tools.get(0)
    if unnamed is not None:
        yield next(_reach(result, unnamed))
    if usage.machine.known:
        inch = any(_named(tool.units) for tool in usage.tools.values())
        reached = extents(result.display.axes, usage.machine)
        yield text("run.machine-travel", unit=" (mm)" if inch else "", extents=reached)
    if usage.offsets:
        yield text("run.offsets", offsets=listed(usage.offsets))


def extents(axes: Sequence[str], reached: Extents) -> str:
    """Extents of axes in one line; an axis that does not move has one position, one that no name shows none."""
    shown = []
    for axis, ends in _spans(axes, reached).items():
        low, high = (f"{round(end, 3) + 0.0:.3f}" for end in ends)  # no -0.000
        shown.append(f"{axis} {low}" if low == high else f"{axis} {low} … {high}")
    return "  ".join(shown)


def clock(seconds: float) -> str:
    """A duration as `h:mm:ss.s`, or `m:ss.s` below an hour."""
    tenths = round(seconds * 10)
    minutes, tenths = divmod(tenths, 600)
    hours, minutes = divmod(minutes, 60)
    tail = f"{tenths // 10:02d}.{tenths % 10}"
    return f"{hours}:{minutes:02d}:{tail}" if hours else f"{minutes}:{tail}"


def _spans(axes: Sequence[str], reached: Extents) -> dict[str, tuple[float, float]]:
    """Lowest and highest position by axis, where any is known."""
    spans = zip(axes, zip(reached.low, reached.high, strict=True), strict=True)
    return {axis: (low, high) for axis, (low, high) in spans if low <= high}


def as_state(result: Result, usage: Usage | None = None) -> str:
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
    if usage is not None:
        axes = result.display.axes
        state["work_offsets"] = list(usage.offsets)
        state["extents"] = {
            "machine": _spans(axes, usage.machine),
            "tools": [
                {
                    "tool": cut.tool,
                    "work": _spans(result.display.names, cut.work),
                    "machine": _spans(axes, cut.machine),
                    "speeds": list(cut.speeds),
                    "surface_speeds": list(cut.surface_speeds),
                    "feeds": cut.feeds,
                }
                for cut in usage.tools.values()
            ],
        }
    return json.dumps(_with_null(state), ensure_ascii=False, indent=1, default=str, allow_nan=False) + "\n"


def _with_null(value: object) -> object:
    """A value with null for numbers that JSON has none for."""
    if isinstance(value, float):
        return value if isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _with_null(element) for key, element in value.items()}
    return [_with_null(element) for element in value] if isinstance(value, list | tuple) else value
