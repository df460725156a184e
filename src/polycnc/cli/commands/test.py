"""`polycnc test`: programs against expectations."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from enum import StrEnum

from polycnc.cli import options
from polycnc.cli.console import coloured, note, say
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.progress import Waiting
from polycnc.deferred.typing import TYPE_CHECKING, Annotated

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from polycnc.cases.runner import Outcome
    from polycnc.cases.selection import Selection
    from polycnc.memory.file import FileStore

commands = Commands()


class Format(StrEnum):
    """How the outcomes are written to standard output."""

    TEXT = "text"
    JSON = "json"
    JUNIT = "junit"


@commands.command("help.test", runs="files")
def run_tests(
    files: Annotated[list[Path], Argument("help.test.files", metavar="CASE.yaml…")],
    words: Annotated[str, Option("help.test.k", "-k", metavar="TEXT")] = "",
    feature: Annotated[list[str] | None, Option("help.test.feature", metavar="ID")] = None,
    skip_feature: Annotated[list[str] | None, Option("help.test.skip-feature", metavar="ID")] = None,
    report: Annotated[Path | None, Option("help.test.report", metavar="OUT.json")] = None,
    form: Annotated[Format, Option("help.option.format", "--format")] = Format.TEXT,
    memory: Annotated[Path | None, Option("help.test.memory", metavar="FILE")] = None,
    _lang: options.Lang = None,
) -> int:
    """Run the cases of all files."""
    from polycnc.cases.selection import Selection
    from polycnc.messages.files import refuse_inputs

    refuse_inputs([report], [*files, *([memory] if memory else [])])
    selection = Selection(words, frozenset(feature or ()), frozenset(skip_feature or ()))
    outcomes: list[Outcome] = []
    unreadable = False
    paths = [Path(name) for name in options.expanded(map(str, files))]
    with _opened(memory) as store, Waiting("polycnc test", len(paths), "cases") as waiting:
        for files_done, path in enumerate(paths):
            for cases_done, outcome in _run_file(path, selection, store):
                waiting.reach(len(outcomes) + 1, (files_done + cases_done) / len(paths))
                if outcome is None:
                    unreadable = True
                    continue
                outcomes.append(outcome)
                unreadable |= not outcome.readable
                if form is Format.TEXT and outcome.status == "failed":
                    _tell(outcome)
    _write(outcomes, form, report)
    if unreadable:
        return 2
    return 1 if any(outcome.status == "failed" for outcome in outcomes) else 0


@contextmanager
def _opened(memory: Path | None) -> Iterator[FileStore | None]:
    """The memory that every case begins with; it is locked while they run."""
    if memory is None:
        yield None
        return
    from polycnc.memory.file import FileStore

    with FileStore(memory) as store:
        yield store


def _run_file(
    path: Path, selection: Selection, memory: FileStore | None
) -> Iterator[tuple[float, Outcome | None]]:
    """The outcomes of one file, None for one that cannot be read, and the share of its cases that are done."""
    from polycnc.cases.reading import UnreadableError, read_cases
    from polycnc.cases.runner import run_cases

    try:
        data = read_cases(path)
    except UnreadableError as error:
        note(f"polycnc: {error.text()}")
        yield 1.0, None
        return
    for count, outcome in enumerate(run_cases(data, selection, path.parent, memory), 1):
        yield count / len(data), outcome


def _tell(outcome: Outcome) -> None:
    from polycnc.cases.report import failure_line

    say(failure_line(outcome))
    sys.stdout.flush()


def _write(outcomes: Sequence[Outcome], form: Format, report: Path | None) -> None:
    from polycnc.cases.report import as_json, as_junit, summary
    from polycnc.cli.output import write_whole

    if report is not None:
        write_whole(report, as_json(outcomes))
    if form is Format.TEXT:
        failed = any(outcome.status == "failed" for outcome in outcomes)
        say(coloured(summary(outcomes), "red" if failed else "green"))
    else:
        say((as_json if form is Format.JSON else as_junit)(outcomes).rstrip("\n"))
