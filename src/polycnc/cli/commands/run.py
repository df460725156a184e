"""`polycnc run`: runs a program and prints what happened."""

from __future__ import annotations

import re

from polycnc.cli import options
from polycnc.cli.console import fail, show, standard_input
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.progress import WaitingForRun
from polycnc.deferred.contexts import ExitStack
from polycnc.deferred.modules import is_installed
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import IO, TYPE_CHECKING, Annotated, Any
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.toolpath.events import Print

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.motion.explain import TimeAccount
    from polycnc.motion.sampling.samples import Sampler
    from polycnc.session import Result, Session
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display
    from polycnc.toolpath.usage import Usage

commands = Commands()
#: Suffixes of trace files; `toolpath.export` has a writer for each.
TRACES = (".jsonl", ".csv", ".parquet")
#: Suffixes of sample files; `motion.sample_file` has a writer for each.
SAMPLES = (".parquet", ".csv")
#: Units of a sampling period, in seconds; the shortest period.
_UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1.0, "": 1.0}
_SHORTEST_S = 1e-6
_PERIOD = regex(r"(\d+\.?\d*|\.\d+)(us|ms|s|)", re.ASCII)


@commands.command("help.run", runs="file")
def run(
    file: Annotated[str, Argument("help.run.file", metavar="FILE")],
    trace: Annotated[Path | None, Option("help.run.trace", metavar="OUT.jsonl|csv|parquet")] = None,
    sample: Annotated[
        tuple[str, Path] | None, Option("help.run.sample", metavar="PERIOD OUT.parquet|csv")
    ] = None,
    state: Annotated[Path | None, Option("help.run.state", metavar="OUT.json")] = None,
    print_to: Annotated[Path | None, Option("help.run.print", "--print", metavar="FILE")] = None,
    no_time: Annotated[bool, Option("help.run.no-time", "--no-time")] = False,
    explain_time: Annotated[bool, Option("help.run.explain-time", "--explain-time")] = False,
    memory: options.Memory = None,
    *,
    opening: options.Opening,
) -> int:
    """Run a program once, as the control would."""
    from polycnc.cli.report import Happenings, as_text
    from polycnc.messages.files import refuse_inputs

    if trace is not None and trace.suffix.lower() not in TRACES:
        return fail(text("run.suffix", file=trace, known=listed(TRACES)), 2)
    period = period_s(sample[0]) if sample is not None else 0.0
    if sample is not None and not is_installed("numpy"):
        return fail(text("run.no-samples"), 2)
    if sample is not None and (period is None or sample[1].suffix.lower() not in SAMPLES):
        return fail(text("run.sample", period=sample[0], file=sample[1], known=listed(SAMPLES)), 2)
    asked = [name for name, it in (("--explain-time", explain_time), ("--sample", sample is not None)) if it]
    if no_time and asked:
        return fail(text("run.needs-time", options=listed(asked)), 2)
    is_stdin = file == "-"
    outputs = [trace, sample[1] if sample is not None else None, state, print_to]
    refuse_inputs(outputs, opening.inputs(file, *([memory] if memory else [])))
    if any(outputs):
        from polycnc.cli.output import refuse_twice

        refuse_twice(outputs)
    source = standard_input() if is_stdin else file
    session = opening.session(source, keep=False, timed=not no_time, memory=memory)
    happenings = Happenings(session.result.display)
    session.consumers.append(happenings.take)
    usage = None if no_time else _usage_of(session)
    with ExitStack() as files:
        files.callback(session.channel.retained.close)
        if print_to is not None:
            session.consumers.append(_Prints(_whole(files, print_to, "w"), session.result.display).take)
        traced = trace and _trace_to(trace, session, files)
        sampler = _sample_to(sample[1], period or 0.0, session, files) if sample else None
        account = session.explain_time() if explain_time else None
        with WaitingForRun(session, sampler):
            result = session.run()
            if result.timed:
                result.plan  # noqa: B018 - planning to the end gives the last samples, and takes its time
            if sampler is not None:
                sampler.close()
        if traced:
            traced(result)
        refuse_inputs(outputs, result.files)
    if state is not None:
        _write_state(state, result, usage)
    show(as_text(result, happenings, "<stdin>" if is_stdin else file, usage))
    _say_more(account, result, session)
    return 0 if result.ok else 1


def _say_more(account: TimeAccount | None, result: Result, session: Session) -> None:
    """Which limits held for how long, where that is asked for; what of the setup had no effect."""
    from polycnc.cli.report import explained
    from polycnc.cli.told import tell_unheeded

    if account is not None:
        show(explained(account, result.plan.times, result.control.id))
    tell_unheeded(session.channel.control, session.channel.setup.parameters)


def _usage_of(session: Session) -> Usage:
    """What a run will have used when it has ended."""
    from polycnc.toolpath.usage import Usage

    usage = Usage(session.result.display)
    session.consumers.append(usage.take)
    return usage


def _whole(files: ExitStack, path: Path, mode: str) -> IO[Any]:
    from polycnc.cli.output import whole_file

    return files.enter_context(whole_file(path, mode))


def _trace_to(path: Path, session: Session, files: ExitStack) -> Callable[[Result], None]:
    """Write the trace while the program runs; gives what ends it.

    Rows of further channels stand behind those of the first one, in JSON lines alone: their axes are other ones.
    """
    from polycnc.toolpath.export import WRITERS, JsonLines

    mode, writer_of = WRITERS[path.suffix.lower()]
    result = session.result
    writer = writer_of(_whole(files, path, mode), result.display, result.metadata)
    files.callback(writer.close)
    session.consumers.append(writer.take)

    def end(result: Result) -> None:
        if isinstance(writer, JsonLines):
            writer.add(result.rows_of_other_channels)

    return end


def period_s(written: str) -> float | None:
    """Seconds of a period as `1ms`, `0.5 s` or `250us`; None where it is none."""
    match = _PERIOD.fullmatch(written.strip().lower().replace(" ", ""))
    seconds = float(match[1]) * _UNITS[match[2]] if match else 0.0
    return seconds if seconds >= _SHORTEST_S else None


def _sample_to(path: Path, period: float, session: Session, files: ExitStack) -> Sampler:
    """Sample the motion while it is planned."""
    from polycnc.motion.sampling.sample_file import SAMPLE_WRITERS

    mode, writer_of = SAMPLE_WRITERS[path.suffix.lower()]
    result = session.result
    writer = writer_of(
        _whole(files, path, mode), result.toolpath.axes, result.toolpath.programs, result.metadata
    )
    files.callback(writer.close)
    return session.sample(period, writer.take)


def _write_state(path: Path, result: Result, usage: Usage | None) -> None:
    from polycnc.cli.output import write_whole
    from polycnc.cli.report import as_state

    write_whole(path, as_state(result, usage))


class _Prints:
    """Writes what the program prints, one line each."""

    def __init__(self, stream: IO[str], display: Display) -> None:
        self._stream = stream
        self._display = display

    def take(self, chunk: Chunk) -> None:
        for event in chunk.events:
            if isinstance(event, Print):
                self._stream.write(f"{event.text}\n")
