"""How far a command is, on standard error: for people who wait, never in a pipe.

A thread looks at the work of a command now and then, so that the work itself pays nothing for it and is never asked. It
begins where somebody watches, and what is done within a second shows nothing.
"""

from __future__ import annotations

import _thread  # a fraction of what `threading` costs at every start
import os
import sys
from time import monotonic

from polycnc.deferred.contexts import contextmanager, suppress
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING, ClassVar, Never, Protocol, Self, TypeVar
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from tqdm import tqdm

    from polycnc.motion.sampling.samples import Sampler
    from polycnc.session import Session

Part = TypeVar("Part")
#: A command that takes longer than this shows how far it is; how often somebody looks at it; seconds.
PATIENCE_S, LOOK_S = 1.0, 0.2
#: A program that has come to no further line for this part of the time so far is in a loop or a subprogram; but not
#: sooner and not later than so many seconds.
STANDS_PART, STANDS_S, STANDS_MOST_S = 0.25, 0.5, 5.0
#: Of a terminal that does not say how large it is.
_COLUMNS, _ROWS = 80, 24
#: A rate is told where so many seconds have been seen of it, and no longer than so many seconds without a change.
SEEN_S, STILL_S = 0.5, 1.0


class Reached(NamedTuple):
    """How far a work is.

    Attributes:
        unit: What is counted: `blocks`, `files`, `cases`, `rows`, `points`, `samples` or `seconds` (of machining).
        done: How many are done.
        share: The part of the work that is done, 0 to 1; None where nobody can know.
    """

    unit: str
    done: float
    share: float | None


class Work(Protocol):
    """What a command is at."""

    what: str

    def reached(self, now: float) -> Reached | None:
        """How far it is at a time of the clock; None where only time tells. Another thread asks."""


class _Command:
    """A command that says nothing of what it is at."""

    def __init__(self, what: str) -> None:
        self.what = what

    def reached(self, now: float) -> Reached | None:  # noqa: ARG002 - of `Work`
        return None


class Watch:
    """Shows the work that was begun last, and takes the bar away where something is written.

    Args:
        what: The command.
    """

    #: The watch of the running command; None where nobody looks.
    of_command: ClassVar[Watch | None] = None

    def __init__(self, what: str) -> None:
        self.works: list[Work] = [_Command(what)]
        self.lock = _thread.RLock()
        self._started = monotonic()
        self._over, self._left, self._is_seen = _thread.allocate_lock(), _thread.allocate_lock(), False
        self._bar: tqdm[Never] | None = None
        self._pace: tuple[Work, _Pace] | None = None

    def begin(self) -> None:
        """Look from now on."""
        self._over.acquire()
        self._left.acquire()
        self._is_seen = True
        _thread.start_new_thread(self._look_on, ())

    def end(self) -> None:
        """Take the bar away, for good."""
        with self.lock:
            self._look_away()
            self.works.clear()

    @contextmanager
    def alone(self) -> Iterator[None]:
        """While this lasts nobody looks, and there is no thread that does."""
        with self.lock:
            was_seen = self._look_away()
        if was_seen:
            with self._left:
                pass
        try:
            yield
        finally:
            if was_seen:
                self.begin()

    def _look_away(self) -> bool:
        """Take the bar away and have the thread leave; only under the lock. Whether there is one."""
        self.hide()
        was_seen, self._is_seen = self._is_seen, False
        if was_seen:
            self._over.release()
        return was_seen

    def hide(self) -> None:
        """Take the bar away until the next look; only under the lock."""
        bar, self._bar = self._bar, None
        if bar is not None:
            with suppress(OSError):  # the terminal has been closed
                bar.close()

    def _look_on(self) -> None:
        while not self._over.acquire(timeout=LOOK_S):
            with self.lock, suppress(OSError):  # as above
                if self.works:
                    self.look(self.works[-1], monotonic())
        self._over.release()
        self._left.release()

    def look(self, work: Work, now: float) -> None:
        """Look at a work, and show how far it is if it takes long."""
        reached = work.reached(now)
        if self._pace is None or self._pace[0] is not work:
            self._pace = work, _Pace(self._started if len(self.works) == 1 else now)
        told = self._pace[1].told(reached, now)
        if now - self._started < PATIENCE_S:
            return
        if self._bar is None:
            self._bar = _bar(self.lock)
        share = reached.share if reached is not None else None
        _draw(self._bar, work.what, share, told)


class _Pace:
    """Rate and time left of one work, by what was seen since its rate was last another one."""

    def __init__(self, started: float) -> None:
        self._started = self._since = self._changed = started
        self._first, self._last = Reached("", 0.0, 0.0), 0.0

    def told(self, reached: Reached | None, now: float) -> str:
        """Rate and time left; without a share what is done; how long it has lasted where there is no rate."""
        lasted = _minutes(now - self._started)
        if reached is None:
            return lasted
        unit, count, share = reached
        if count != self._last:
            self._last, self._changed = count, now
        first = self._first
        if first.unit != unit or (first.share is None) != (share is None):
            # From the beginning on where that is all that has been seen.
            is_new = not first.unit and share is not None
            self._first = first = Reached(unit, 0.0, 0.0) if is_new else reached
            self._since = self._started if is_new else now
        seconds = now - self._since
        rate = (count - first.done) / max(seconds, 1e-9)
        is_steady = seconds >= SEEN_S and rate > 0.0 and now - self._changed < STILL_S + 0.1 * seconds
        said = text(f"progress.{unit}.rate", rate=_short(rate)) if is_steady else ""
        if share is None or first.share is None:
            done = _minutes(count) if unit == "seconds" else f"{count:,.0f}"
            return "  ".join(filter(None, (lasted, text(f"progress.{unit}", count=done), said)))
        if not is_steady:
            return lasted
        if share <= first.share:
            return said
        left = (1.0 - share) * seconds / (share - first.share)
        return text("progress.left", rate=said, left=_minutes(left))


def _minutes(seconds: float) -> str:
    minutes, left = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{left:02d}" if hours else f"{minutes}:{left:02d}"


def _short(rate: float) -> str:
    return f"{rate:,.0f}" if rate >= 10.0 else f"{rate:.1f}"


def _bar(lock: _thread.RLock) -> tqdm[Never]:
    """A bar that nothing is drawn of yet, which only this lock guards."""
    from tqdm import tqdm

    tqdm.monitor_interval = 0  # this thread looks itself
    tqdm.set_lock(lock)  # its own one is for processes, too
    # It would ask for the size of the terminal, and hide where that is said to be 0.
    return tqdm(total=1.0, leave=False, file=sys.stderr, ncols=_columns(), nrows=_ROWS, bar_format=" ")


def _draw(bar: tqdm[Never], what: str, share: float | None, told: str) -> None:
    """Draw what is worked on, a bar of the share where that is known, which takes the room that is left, and the rest.

    What is told has the first claim to a narrow terminal.
    """
    from tqdm.utils import disp_len, disp_trim

    meter, percent = ("", "") if share is None else ("{bar}", f" {100.0 * share:3.0f}%  ")
    told = percent + encodable(told, sys.stderr.encoding)
    bar.ncols, bar.n, bar.bar_format = _columns(), share or 0.0, f"{{desc}} {meter}{told}"
    room = max(bar.ncols - disp_len(told) - 2, 0)
    bar.set_description_str(disp_trim(encodable(what, sys.stderr.encoding), room))


def _columns() -> int:
    """Columns of the terminal without the last, behind which some begin a new line."""
    try:
        columns = os.get_terminal_size(sys.stderr.fileno()).columns
    except OSError:  # nobody knows
        columns = 0
    return max((columns or _COLUMNS) - 1, 1)


def encodable(line: str, encoding: str | None) -> str:
    """Characters that the terminal's encoding does not have are shown as `?`."""
    return line.encode(encoding or "utf-8", "replace").decode(encoding or "utf-8")


@contextmanager
def watched(what: str) -> Iterator[None]:
    """A command runs: it is shown how far it is where standard error is a terminal that can take a bar away."""
    if not sys.stderr.isatty() or os.environ.get("TERM") == "dumb":
        yield
        return
    watch = Watch.of_command = Watch(what)
    watch.begin()
    try:
        yield
    finally:
        Watch.of_command = None
        watch.end()


def end() -> None:
    """The command goes on without an end: nobody waits for one."""
    if Watch.of_command is not None:
        Watch.of_command.end()


@contextmanager
def alone() -> Iterator[None]:
    """The process has no thread of its own that looks: it is copied, and copies have the locks of a thread only."""
    watch = Watch.of_command
    if watch is None:
        yield
        return
    with watch.alone():
        yield


@contextmanager
def away() -> Iterator[None]:
    """Something else is written to the terminal, or typed: without the bar."""
    watch = Watch.of_command
    if watch is None:
        yield
        return
    with watch.lock:
        watch.hide()
        yield


class Waiting:
    """Work whose parts are counted.

    Args:
        what: What is worked on.
        total: Number of its parts; None where nobody can know.
        unit: What the parts are: see `Reached`.
    """

    def __init__(self, what: str, total: int | None, unit: str) -> None:
        self.what = what
        self._total, self._unit = total, unit
        self._done, self._share = 0.0, None if total is None else 0.0

    def __enter__(self) -> Self:
        """It begins."""
        if Watch.of_command is not None:
            Watch.of_command.works.append(self)
        return self

    def __exit__(self, *_: object) -> None:
        """It is done."""
        if Watch.of_command is not None and self in Watch.of_command.works:
            Watch.of_command.works.remove(self)

    def reach(self, done: float, share: float | None = None) -> None:
        """So many parts are done, and this share where parts do not tell it."""
        self._done = done
        if self._total is not None:
            self._share = min(done / max(self._total, 1), 1.0) if share is None else share

    def each(self, parts: Iterable[Part]) -> Iterator[Part]:
        """The parts, which are counted; further ones on top of those before."""
        for done, part in enumerate(parts, round(self._done)):
            self.reach(done)
            yield part

    def reached(self, now: float) -> Reached | None:  # noqa: ARG002 - of `Work`
        """How far it is."""
        return Reached(self._unit, self._done, self._share)


class WaitingForRun(Waiting):
    """A run: blocks, by the clock seconds of machining, or samples; the share by the lines of the main program.

    Lines tell the share only while the program comes to lines where it has not been. In a loop, and as long as a
    subprogram runs, nobody can know how long that will last.
    """

    def __init__(self, session: Session, sampler: Sampler | None = None) -> None:
        program = session.result.program
        super().__init__(program.name, None, "blocks")
        self._session, self._sampler = session, sampler
        self._first, self._lines = program.first_line, max(len(program.lines), 1)
        self._began = self._came = self._counted_at = monotonic()
        self._farthest = self._count = -1.0

    def reached(self, now: float) -> Reached | None:
        """How far it is."""
        line, (unit, count) = self._line(), self._counted()
        if line > self._farthest:
            self._farthest, self._came = line, now
        if count != self._count:
            self._count, self._counted_at = count, now
        elif now - self._counted_at > STILL_S:  # it works at what is counted as a whole, such as planning
            self._came += min(LOOK_S, now - self._came)
        patience = min(max(STANDS_PART * (now - self._began), STANDS_S), STANDS_MOST_S)
        is_known = self._farthest >= 0.0 and now - self._came < patience
        return Reached(unit, count, min(self._farthest / self._lines, 1.0) if is_known else None)

    def _line(self) -> float:
        """The line of the main program, from 0; less where there is none."""
        if self._sampler is not None:
            return self._sampler.line - self._first
        for main in self._session.channel.stack[:1]:
            line: int = main.code.line(main.current)
            return max(line - self._first - self._unplanned, 0)
        return self._farthest

    @property
    def _unplanned(self) -> int:
        """Rows that the planner has got and not laid out yet: about as many lines, and blocks."""
        planner = self._session.result.planner
        return 0 if planner is None else planner.unlaid

    def _counted(self) -> tuple[str, float]:
        if self._sampler is not None:
            return "samples", self._sampler.count
        main_run = self._session.main_run
        if main_run is not None:
            return "seconds", main_run.seconds
        return "blocks", max(self._session.channel.blocks - self._unplanned, 0)
