"""The command line: one module for each command in `commands/`, imported when it is called.

`declaration` says what commands and options are, `options` has those that several share. `app` has the words read:
plain ones by `plain`, all others by Click, for which `clicks` makes its commands of the same declarations; `usage` is
the language of help and refusals, `completion` the script by which a shell completes words.
`diagnostics` says what a run found, `formats` and `sarif` how that is written, `report` what `run` tells, `told`
what of a setup has no effect; `console` and `output` write, `progress` tells those who wait how far a command is;
`freed` is about memory.
"""

from __future__ import annotations

import atexit
import gc
import os
import sys

from polycnc import finder

TYPE_CHECKING = False  # for type checkers true; what is loaded before the finder takes longer
if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.deferred.typing import NoReturn

__all__ = ["main"]
#: Behind so many new objects Python looks for circles of them. What is loaded and compiled stays to the end, so that
#: it would find nothing, many times before the first block.
_NEW_OBJECTS = 200_000
#: How many threads NumPy starts to multiply matrices with. No command does that, and each takes its time to wait.
_MATRIX_THREADS = "OPENBLAS_NUM_THREADS"


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave with its exit status (`polycnc.cli.app.main`).

    Without arguments of its own it is that of the process, which ends with it. Whoever interrupts it while its parts
    are still being loaded gets the same answer as later.
    """
    leaving = _Leaving()
    try:
        gc.set_threshold(_NEW_OBJECTS)
        if arguments is None:
            finder.install()
            _open_closed_streams()
            os.environ.setdefault(_MATRIX_THREADS, "1")
            atexit.register(leaving.end)  # as the first, so that it is called last
        from polycnc.cli.app import main as run

        run(arguments)
    except KeyboardInterrupt:
        leaving.status = 130
    except SystemExit as left:
        if isinstance(left.code, int):
            leaving.status = left.code
        raise
    raise SystemExit(leaving.status)


def _open_closed_streams() -> None:
    """A stream that whoever starts the process has closed (`2>&-`) takes all and gives nothing.

    Its number is taken, too, so that no output file gets it, to which something else may write.
    """
    for name, mode in ("stdin", "r"), ("stdout", "w"), ("stderr", "w"):
        if getattr(sys, name) is None:
            nothing = os.open(os.devnull, os.O_RDWR)
            setattr(sys, name, open(nothing, mode, encoding="utf-8", closefd=False))  # noqa: SIM115


class _Leaving:
    """Ends the process when everything has been closed: to free its objects one by one would take a tenth of a run."""

    status: int | None = None

    def end(self) -> None:
        """Leave all memory to the system, unless something has gone wrong that Python has to tell."""
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        except (OSError, ValueError):
            return
        if self.status is not None:
            os._exit(self.status)
