"""The entry point: has the words read, and turns what can go wrong into one line and an exit status."""

from __future__ import annotations

import _thread
import math
import os
import sys
from time import monotonic

from polycnc.cli import plain
from polycnc.cli.console import fail, note
from polycnc.cli.progress import watched
from polycnc.cli.usage import language_of, translated
from polycnc.deferred.contexts import contextmanager
from polycnc.deferred.typing import IO, TYPE_CHECKING, Any, NoReturn
from polycnc.messages import text
from polycnc.messages.catalogue import set_language
from polycnc.messages.errors import place_of_failure
from polycnc.messages.files import reason_with_file

if TYPE_CHECKING:
    import signal
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from sys import UnraisableHookArgs
else:
    import _signal as signal  # what the library's own module makes enumerations of, at every start

BAD_USE, INTERRUPTED = 2, 130
#: So long, in seconds, one interrupt is enough: a busy machine may take seconds to clean up, and from one of several
#: signals to the next.
AGAIN_S = 5.0
#: With this variable of the environment a mistake of polycnc shows all of its way.
TRACEBACK = "POLYCNC_TRACEBACK"
#: Libraries that polycnc can do without, and the extra that brings each.
EXTRAS = {"numpy": "tables", "pyarrow": "tables", "resvg_py": "png", "nicegui": "panel", "fastapi": "panel"}


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave the process with its exit status.

    0: fine; 1: the program alarmed, or a check or a case failed; 2: wrong usage or unreadable input;
    130: interrupted.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    with _interrupts(is_last=arguments is None) as ignore:
        try:
            status = _run(words)
            sys.stdout.flush()
        except OSError:  # whoever reads our output has gone, or its terminal
            status = BAD_USE
        except SystemExit:  # the answer of the panel's server where its address is taken
            status = BAD_USE
        except KeyboardInterrupt:
            ignore()
            status = INTERRUPTED
            note(f"polycnc: {text('cli.interrupted')}")
        for stream in (sys.stdout, sys.stderr):
            _give_up(stream)
    sys.exit(status)


def _give_up(stream: IO[str]) -> None:
    """What a stream does not take goes nowhere: Python would complain once more, and change the status."""
    try:
        stream.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@contextmanager
def _interrupts(*, is_last: bool) -> Iterator[Callable[[], None]]:
    """Who is told to end takes half-written files and other processes away first, however often it is told.

    What tells it again within `AGAIN_S` would break that; later it may be what gets it out of a way that hangs.

    Args:
        is_last: The process ends behind this: what is ignored stays so.

    Yields:
        What is called when it ends already: signals are ignored then.
    """
    ends = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    # Who has been told to outlive the terminal (nohup) does.
    handlers = {each: signal.getsignal(each) for each in ends}
    before = {each: handler for each, handler in handlers.items() if handler not in (signal.SIG_IGN, None)}
    heard, numbers, lost_before = [-math.inf], [0], sys.unraisablehook

    def interrupt(number: int, _frame: object) -> None:
        if monotonic() > heard[0] + AGAIN_S:
            heard[0], numbers[0] = monotonic(), number
            raise KeyboardInterrupt

    def lost(what: UnraisableHookArgs) -> None:
        """Python drops what is raised while it frees an object: an interrupt comes once more, behind that."""
        if issubclass(what.exc_type, KeyboardInterrupt) and numbers[0]:
            heard[0] = -math.inf
            _thread.start_new_thread(_thread.interrupt_main, (numbers[0],))  # type: ignore[arg-type]  # a number
        else:
            lost_before(what)

    def answer(answers: Mapping[int, Any]) -> None:
        for number, handler in answers.items():
            signal.signal(number, handler)

    def ignore() -> None:
        if is_last:
            before.update(dict.fromkeys(before, signal.SIG_IGN))
        answer(dict.fromkeys(before, signal.SIG_IGN))

    try:
        answer(dict.fromkeys(before, interrupt))
        sys.unraisablehook = lost
    except ValueError:  # only the main thread may answer signals
        before = {}
    try:
        yield ignore
    finally:
        answer(before)
        if sys.unraisablehook is lost:
            sys.unraisablehook = lost_before


def _run(words: list[str]) -> int:
    try:
        set_language(language_of(words))
        if "POLYCNC_KERNELS" in os.environ:
            _say_if_unknown()
        asked = plain.read(words)
        with watched(" ".join(["polycnc", *words[:1]])):
            status = asked() if asked is not None else _run_by_click(words)
            sys.stdout.flush()
    except Exception as error:  # noqa: BLE001 - `_told` says what it was
        if isinstance(
            error.__cause__, KeyboardInterrupt
        ):  # Python 3.11 hides one that comes while a class is made
            raise error.__cause__ from None
        return fail(_told(error), BAD_USE)
    return status if isinstance(status, int) else 0


def _say_if_unknown() -> None:
    """A note where the environment chooses kernels that there are not: nobody shall think that plain ones run."""
    from polycnc.kernels.native import CHOICE, PLAIN

    if os.environ[CHOICE] not in ("", PLAIN):
        note(f"polycnc: {text('cli.kernels.unknown', name=CHOICE, value=os.environ[CHOICE], known=PLAIN)}")


def _run_by_click(words: list[str]) -> object:
    from polycnc.cli import clicks

    return clicks.run(words)


def _told(error: Exception) -> str:
    """What the user did wrong, in one line; what is no user's mistake says where polycnc has failed."""
    message = getattr(error, "text", None) or getattr(error, "format_message", None)
    if callable(message):
        told = translated(" ".join(str(message()).split()))
        context = getattr(error, "ctx", None)
        return text("cli.usage", message=told, command=context.command_path) if context is not None else told
    if isinstance(error, OSError) and not isinstance(error, BrokenPipeError):
        return reason_with_file(error)
    if isinstance(error, ModuleNotFoundError) and error.name in EXTRAS:
        return text("cli.extra", library=error.name, extra=EXTRAS[error.name])
    if isinstance(error, MemoryError):
        return text("cli.memory")
    if isinstance(error, BrokenPipeError) or os.environ.get(TRACEBACK):
        raise error
    return text(
        "cli.internal",
        error=f"{type(error).__name__}: {error}",
        where=place_of_failure(error),
        variable=TRACEBACK,
    )
