"""Checks of long programs in a process of their own: neither the control nor a page waits for them.

The process is `python -m polycnc.panel.checking`: a job comes in, what was found goes out. Where what it reads from is
closed before, nobody waits for it any more.
"""

from __future__ import annotations

import _thread
import os
import pickle
import sys
from contextlib import suppress
from subprocess import DEVNULL, PIPE, Popen
from threading import Thread
from time import monotonic

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun.reading.forecast import Forecast

if TYPE_CHECKING:
    from polycnc.mainrun.reading.forecast import Job
    from polycnc.messages import Alarm

#: A check ends after so long, s, wherever it has come to.
LONGEST_S = 60.0
#: How far the process stands back behind the control, where the system knows of that.
_NICENESS = 10


@dataclass(frozen=True, slots=True)
class Found:
    """What a check has found.

    Attributes:
        program: Name of the program.
        alarms: Its alarms.
        to_the_end: The program was gone through to its end, or to an alarm.
    """

    program: str
    alarms: tuple[Alarm, ...]
    to_the_end: bool


class FarCheck:
    """A check that goes on elsewhere.

    Args:
        job: What is checked.

    Attributes:
        is_over: Nothing more comes.
        found: What it has found; None while it goes on, and where it could not be made.
    """

    def __init__(self, job: Job) -> None:
        self.is_over = False
        self.found: Found | None = None
        self._process = Popen(
            [sys.executable, "-m", "polycnc.panel.checking"], stdin=PIPE, stdout=PIPE, stderr=DEVNULL
        )
        # The thread waits for the process, and for nothing else: what it reads and writes is its own.
        Thread(target=self._ask, args=(job,), daemon=True).start()

    def _ask(self, job: Job) -> None:
        try:
            with suppress(OSError), self._process as process:  # that may have ended before it has read all
                process.stdin.write(pickle.dumps(job))  # type: ignore[union-attr]
                process.stdin.flush()  # type: ignore[union-attr]  # and is not closed
                answer = process.stdout.read()  # type: ignore[union-attr]
                if process.wait() == 0:
                    self.found = Found(*pickle.loads(answer))
        finally:
            self.is_over = True

    def give_up(self) -> None:
        """Nobody wants to know any more."""
        self._process.kill()


def look(job: Job, seconds: float = LONGEST_S) -> Found:
    """Go through a program, for so long at most."""
    forecast, end = Forecast(job), monotonic() + seconds
    while forecast.go_on():
        if monotonic() > end:
            break
    complete = forecast.is_over and not forecast.has_reached_limit
    return Found(forecast.main.name, forecast.alarms, complete)


def main() -> None:
    """The process: one job, one answer."""
    with suppress(AttributeError, OSError):
        os.nice(_NICENESS)
    job = pickle.load(sys.stdin.buffer)
    _thread.start_new_thread(_end_with_control, ())
    found = look(job)
    sys.stdout.buffer.write(pickle.dumps((found.program, found.alarms, found.to_the_end)))


def _end_with_control() -> None:
    """In a thread of the process: whoever has killed the control cannot end it."""
    os.read(sys.stdin.fileno(), 1)  # nothing comes but the end
    os._exit(1)


if __name__ == "__main__":
    main()
