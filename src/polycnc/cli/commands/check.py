"""`polycnc check`: diagnostics, one a line."""

from __future__ import annotations

import _thread
import gc
import os
import signal
import sys
from contextlib import ExitStack, contextmanager, nullcontext
from enum import StrEnum
from functools import partial
from itertools import chain

from polycnc.cli import diagnostics, options
from polycnc.cli.console import note, show, standard_input
from polycnc.cli.declaration import Argument, Commands, Option, Path
from polycnc.cli.progress import alone
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import UserError, text
from polycnc.messages.catalogue import language, listed, set_language

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from multiprocessing.process import BaseProcess

commands = Commands()
STDIN = "-"
#: So many files are worth a process of their own.
SHARED = 16
#: What ends the command, with its workers.
_INTERRUPTS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
#: So many files are named where a line tells of all.
NAMED = 3


class Format(StrEnum):
    """How the findings are written."""

    TEXT = "text"
    JSON = "json"
    SARIF = "sarif"
    GITHUB = "github"
    JUNIT = "junit"


@commands.command("help.check", runs="files")
def check(
    files: Annotated[list[str], Argument("help.check.files", metavar="FILE…")],
    form: Annotated[Format, Option("help.option.format", "--format")] = Format.TEXT,
    output: options.Output = None,
    exit_zero: Annotated[bool, Option("help.check.exit-zero", "--exit-zero")] = False,
    stdin_filename: Annotated[str, Option("help.check.stdin-filename", metavar="NAME")] = "<stdin>",
    *,
    opening: options.Opening,
) -> int:
    """Run each program without keeping its motion, and tell what alarmed."""
    from polycnc.cli.output import refuse_programs
    from polycnc.messages.files import refuse_inputs

    files = options.expanded(files)
    refuse_inputs([output], opening.inputs(*files))
    refuse_programs(output)
    names = [stdin_filename if file == STDIN else file for file in files]
    checked = _all_checked(list(zip(files, names, strict=True)), opening)
    found = [diagnostic for each in checked for diagnostic in each.found]
    unreadable = any(diagnostic.unreadable for diagnostic in found)
    failed = any(diagnostic.severity == "error" for diagnostic in found)
    status = 2 if unreadable else int(failed and not exit_zero)
    if form is Format.TEXT:
        _tell_guesses({name: each.guessed for name, each in zip(names, checked, strict=True)})
    _write(found, names, form, status, output)
    return status


@dataclass(frozen=True, slots=True)
class _Checked:
    """What was found in a file, and the control that its text has named where the user has not."""

    found: list[diagnostics.Diagnostic]
    guessed: str = ""


def _all_checked(files: list[tuple[str, str]], opening: options.Opening) -> list[_Checked]:
    """What was found in each file, many of them on all cores."""
    from polycnc.cli.progress import Waiting

    if len(files) == 1:
        return [_checked(*files[0], opening, is_watched=True)]
    found: list[_Checked] = []
    with Waiting("polycnc check", len(files), "files") as waiting, ExitStack() as workers:
        run = partial(_one_checked, opening)
        is_shared = len(files) >= SHARED and all(file != STDIN for file, _ in files)
        for each in _shared(run, files, workers) if is_shared else map(run, files):
            found.append(each)
            waiting.reach(len(found))
    return found


def _shared(
    run: Callable[[tuple[str, str]], _Checked], files: list[tuple[str, str]], workers: ExitStack
) -> Iterable[_Checked]:
    """The same on all cores, in the order of the files."""
    count = min(_cores(), len(files) // SHARED)
    if count == 1:
        return map(run, files)
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import active_children, get_context

    first = run(files[0])  # with it everything is loaded that the workers need
    gc.freeze()  # so that no worker looks through it again
    try:
        context = get_context("fork" if sys.platform == "linux" else "spawn")
        begin = partial(_begin_worker, language())
        pool = ProcessPoolExecutor(count, mp_context=context, initializer=begin)
    except (
        ImportError,
        NotImplementedError,
        OSError,
    ):  # a system that shares no locks, or has no place for them
        return chain((first,), map(run, files[1:]))
    workers.enter_context(pool)
    others = active_children()
    workers.push(lambda error, *_: _kill_where(error, others))
    with alone(), _no_interrupt():  # no thread writes, loads or holds anything while the process is copied
        return chain((first,), _told_if_killed(pool.map(run, files[1:], chunksize=SHARED)))


def _told_if_killed(found: Iterable[_Checked]) -> Iterator[_Checked]:
    """The same. Raises `UserError` where a worker has been killed."""
    from concurrent.futures import BrokenExecutor

    try:
        yield from found
    except BrokenExecutor as error:
        raise UserError("check.killed") from error


@contextmanager
def _no_interrupt() -> Iterator[None]:
    """Workers that begin are not interrupted before they have said who ends them (`_begin_worker`)."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _INTERRUPTS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin_worker(chosen: str) -> None:
    """In a worker: who interrupts the command ends it, and it says nothing of its own."""
    for each in _INTERRUPTS:
        signal.signal(each, signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _INTERRUPTS)
    _thread.start_new_thread(_end_with_command, ())
    set_language(chosen)


def _end_with_command() -> None:
    """In a thread of a worker: where the command is killed, nobody is left who ends the worker."""
    from multiprocessing import parent_process

    command = parent_process()
    if command is not None:
        command.join()
        os._exit(1)


def _kill_where(error: type[BaseException] | None, others: list[BaseProcess]) -> None:
    """End the workers where nobody waits for what they find: each has files before it that may take minutes."""
    from multiprocessing import active_children

    if error is not None:
        for each in active_children():
            if each not in others:
                each.kill()


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1


def _one_checked(opening: options.Opening, file: tuple[str, str]) -> _Checked:
    return _checked(*file, opening)


def _checked(file: str, name: str, opening: options.Opening, *, is_watched: bool = False) -> _Checked:
    """Run one program. Whatever goes wrong with it is a finding of its own: the other files are still checked."""
    from polycnc.cli.progress import WaitingForRun

    try:
        source: bytes | Path = standard_input() if file == STDIN else Path(file)
        session = opening.session(source, name=name, keep=False, timed=False)
        with WaitingForRun(session) if is_watched else nullcontext():
            result = session.run()
        found = diagnostics.diagnostics_of(result, name)
    except (UserError, OSError) as error:
        return _Checked([diagnostics.unreadable(name, error)])
    except Exception as error:  # noqa: BLE001 - a mistake of polycnc in one file must not hide the others
        return _Checked([diagnostics.internal(name, error)])
    return _Checked(found, "" if opening.control else result.control.id)


def _tell_guesses(guesses: dict[str, str]) -> None:
    """One line for each control that polycnc has told from the text of programs."""
    for control in sorted(set(filter(None, guesses.values()))):
        files = [name for name, guessed in guesses.items() if guessed == control]
        named = listed(files[:NAMED]) + (" …" if len(files) > NAMED else "")
        note(f"polycnc: {text('check.guessed', control=control, count=len(files), files=named)}")


def _write(
    found: list[diagnostics.Diagnostic], names: list[str], form: Format, status: int, output: Path | None
) -> None:
    from polycnc.cli import formats
    from polycnc.cli.output import write_whole

    content = {
        Format.TEXT: lambda: formats.as_text([d for d in found if not d.unreadable]),
        Format.JSON: lambda: formats.as_json(found),
        Format.SARIF: lambda: _sarif(found, status),
        Format.GITHUB: lambda: formats.as_github(found),
        Format.JUNIT: lambda: formats.as_junit(found, names),
    }[form]()
    if form is Format.TEXT:
        for diagnostic in found:
            if diagnostic.unreadable:
                note(f"polycnc: {diagnostic.message}")
    if output is not None:
        write_whole(output, content)
    else:
        show(content)


def _sarif(found: list[diagnostics.Diagnostic], status: int) -> str:
    from polycnc.cli.sarif import as_sarif

    return as_sarif(found, status)
