"""Runs inputs one after the other, each within its limits, and writes a line of JSON about every failure.

`python -m tests.fuzz.worker SEED FIRST STEP COUNT`: COUNT inputs from number FIRST on, every STEP-th. Lines of standard
output are `{"at": number}` now and then, and `{"failed": number, "root": …, "what": …, "seconds": …}`. What hangs where
Python cannot interrupt it ends the process, with its stack on standard error.
"""

from __future__ import annotations

import faulthandler
import gc
import json
import resource
import signal
import sys
import tempfile
import traceback
from pathlib import Path
from time import monotonic
from types import FrameType
from typing import NoReturn

#: Of the processor, and on a machine that does other things as well.
TIME_S, PATIENCE_S = 10.0, 60.0
MEMORY_BYTES = 1 << 30
#: Modules that hand on what others have found; no root of a failure.
_HARMLESS = ("tests/fuzz", "lib/python")


class TooLong(BaseException):
    """The time of an input is over. No `Exception`: nobody may take it for a mistake of the program."""


def _too_long(_signal: int, _frame: FrameType | None) -> NoReturn:
    raise TooLong


def root_of(error: BaseException) -> str:
    """What a failure is known by: its kind and the innermost function of polycnc that it has passed."""
    kind = type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "/polycnc/" in frame.filename]
    if not own:
        last = frames[-1]
        return f"{kind} at {last.filename.rpartition('/')[2]}:{last.name}"
    # Where time or memory ends is chance: what has called it says more.
    inner = own[-1]
    return f"{kind} at {inner.filename.rpartition('/polycnc/')[2]}:{inner.name}"


def path_of(error: BaseException) -> str:
    """The last functions of polycnc that a failure has passed, outermost first."""
    own = [frame for frame in traceback.extract_tb(error.__traceback__) if "/polycnc/" in frame.filename]
    return " > ".join(f"{frame.filename.rpartition('/polycnc/')[2]}:{frame.lineno}" for frame in own[-6:])


def work(seed: int, first: int, step: int, count: int) -> None:
    """Run inputs and tell what failed."""
    from tests.fuzz import inputs

    limit_memory()
    signal.signal(signal.SIGPROF, _too_long)
    signal.signal(signal.SIGALRM, _too_long)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(first, first + step * count, step):
            _say(at=number)
            began = monotonic()
            faulthandler.dump_traceback_later(PATIENCE_S * 1.5, exit=True)
            _limit_time(TIME_S, PATIENCE_S)
            try:
                inputs.run(inputs.make(seed, number), folder)
            except KeyboardInterrupt:
                raise
            except BaseException as error:  # noqa: BLE001 - every failure is told, whatever it is
                _limit_time(0, 0)
                seconds = round(monotonic() - began, 2)
                what = " ".join(f"{type(error).__name__}: {error}".split())[:200]
                _say(failed=number, root=root_of(error), what=what, path=path_of(error), seconds=seconds)
                del error
                gc.collect()
            finally:
                _limit_time(0, 0)
                faulthandler.cancel_dump_traceback_later()


def _limit_time(processor_s: float, patience_s: float) -> None:
    """No more time than an input may take, 0 for any."""
    signal.setitimer(signal.ITIMER_PROF, processor_s)
    signal.setitimer(signal.ITIMER_REAL, patience_s)


def limit_memory() -> None:
    """No more memory than an input may take; what asks for more gets `MemoryError`."""
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY_BYTES, MEMORY_BYTES))


def _say(**what: object) -> None:
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    work(*map(int, sys.argv[1:5]))
