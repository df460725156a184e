"""`polycnc run`: runs a program and prints what happened."""

from __future__ import annotations

import re
import sys
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import IO, TYPE_CHECKING, Annotated, Any

import typer

from polycnc.cli import options
from polycnc.cli.console import fail, show
from polycnc.messages import text
from polycnc.messages.catalogue import listed
from polycnc.toolpath.events import Print

if TYPE_CHECKING:
    from collections.abc import Callable

    from rich.progress import Progress, TaskID

    from polycnc.channel.channel import Channel
    from polycnc.session import Result, Session
    from polycnc.toolpath.table import Chunk
    from polycnc.toolpath.trace import Display

app = typer.Typer(add_completion=False, rich_markup_mode=None)
#: A run that takes longer than this shows how far it is, seconds.
PATIENCE_S = 0.7
#: Suffixes of trace files; `toolpath.export` has a writer for each.
TRACES = (".jsonl", ".csv", ".parquet")
#: Suffixes of sample files; `motion.sample_file` has a writer for each.
SAMPLES = (".parquet", ".csv")
#: Units of a sampling period, in seconds; the shortest period.
_UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1.0, "": 1.0}
_SHORTEST_S = 1e-6
_PERIOD = re.compile(r"(\d+\.?\d*|\.\d+)(us|ms|s|)", re.ASCII)


@app.command(help=text("help.run"))
@options.with_opening
def run(
    file: Annotated[str, typer.Argument(metavar="FILE", help=text("help.run.file"))],
    trace: Annotated[
        Path | None, typer.Option(metavar="OUT.jsonl|csv|parquet", help=text("help.run.trace"))
    ] = None,
    sample: Annotated[
        tuple[str, Path] | None, typer.Option(metavar="PERIOD OUT.parquet|csv", help=text("help.run.sample"))
    ] = None,
    state: Annotated[Path | None, typer.Option(metavar="OUT.json", help=text("help.run.state"))] = None,
    print_to: Annotated[
        Path | None, typer.Option("--print", metavar="FILE", help=text("help.run.print"))
    ] = None,
    no_time: Annotated[bool, typer.Option("--no-time", help=text("help.run.no-time"))] = False,
    *,
    opening: options.Opening,
) -> int:
    """Run a program once, as the control would."""
    from polycnc.cli.report import Happenings, as_text

    if trace is not None and trace.suffix.lower() not in TRACES:
        return fail(text("run.suffix", file=trace, known=listed(TRACES)), 2)
    period = period_s(sample[0]) if sample is not None else 0.0
    if sample is not None and find_spec("pyarrow") is None:
        return fail(text("run.no-samples"), 2)
    if sample is not None and (period is None or sample[1].suffix.lower() not in SAMPLES):
        return fail(text("run.sample", period=sample[0], file=sample[1], known=listed(SAMPLES)), 2)
    is_stdin = file == "-"
    source = sys.stdin.buffer.read() if is_stdin else Path(file)
    session = opening.session(source, keep=False, timed=not no_time or sample is not None)
    happenings = Happenings(session.result.display)
    session.consumers.append(happenings.take)
    with ExitStack() as files:
        if print_to is not None:
            session.consumers.append(_Prints(_whole(files, print_to, "w"), session.result.display).take)
        traced = trace and _trace_to(trace, session, files)
        sampled = sample and _sample_to(sample[1], period or 0.0, session, files)
        progress = files.enter_context(_Progress(session))
        result = session.run(progress)
        if traced:
            traced(result)
        if sampled:
            sampled(result)
    if state is not None:
        _write_state(state, result)
    show(as_text(result, happenings, "<stdin>" if is_stdin else file))
    return 0 if result.ok else 1


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


def _sample_to(path: Path, period: float, session: Session, files: ExitStack) -> Callable[[Result], None]:
    """Sample the motion while it is planned; gives what ends it."""
    from polycnc.motion.sampling.sample_file import SAMPLE_WRITERS

    mode, writer_of = SAMPLE_WRITERS[path.suffix.lower()]
    result = session.result
    writer = writer_of(
        _whole(files, path, mode), result.toolpath.axes, result.toolpath.programs, result.metadata
    )
    files.callback(writer.close)
    sampler = session.sample(period, writer.take)

    def end(result: Result) -> None:
        result.plan  # noqa: B018 - planning to the end gives the last samples
        sampler.close()

    return end


def _write_state(path: Path, result: Result) -> None:
    from polycnc.cli.output import write_whole
    from polycnc.cli.report import as_state

    write_whole(path, as_state(result))


class _Prints:
    """Writes what the program prints, one line each."""

    def __init__(self, stream: IO[str], display: Display) -> None:
        self._stream = stream
        self._display = display

    def take(self, chunk: Chunk) -> None:
        for event in chunk.events:
            if isinstance(event, Print):
                self._stream.write(f"{event.text}\n")


class _Progress:
    """A bar on standard error, for people who wait: only on a terminal, only in a long run."""

    def __init__(self, session: Session) -> None:
        self._program = session.result.program
        self._bar: tuple[Progress, TaskID] | None = None
        self._started = 0.0

    def __enter__(self) -> Callable[[Channel], None] | None:
        from time import monotonic

        self._started = monotonic()
        return self._update if sys.stderr.isatty() else None

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar[0].stop()

    def _update(self, channel: Channel) -> None:
        from time import monotonic

        if self._bar is None and monotonic() - self._started < PATIENCE_S:
            return
        if self._bar is None:
            from rich.console import Console
            from rich.progress import Progress

            bar = Progress(console=Console(stderr=True), transient=True)
            self._bar = bar, bar.add_task(self._program.name, total=len(self._program.lines))
            bar.start()
        if channel.stack:
            main = channel.stack[0]
            bar, task = self._bar
            bar.update(task, completed=main.code.line(main.current) - self._program.first_line)
