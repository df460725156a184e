"""How far a command is, on standard error: for people who wait, never in a pipe."""

from __future__ import annotations

import sys
from time import monotonic
from typing import TYPE_CHECKING, Self

from polycnc.messages import text

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

    from polycnc.channel.channel import Channel
    from polycnc.session import Session

#: A command that takes longer than this shows how far it is, seconds.
PATIENCE_S = 1.0


class Waiting:
    """A bar with rate and time left; nothing where standard error is no terminal, or the work is done at once.

    Args:
        what: What is worked on.
        total: Number of its parts.
        unit: What the parts are: `lines`, `files` or `cases`.
    """

    def __init__(self, what: str, total: int, unit: str) -> None:
        self._what, self._total, self._unit = what, total, unit
        self._started = monotonic()
        self._is_seen = sys.stderr.isatty()
        self._bar: tuple[Progress, TaskID] | None = None

    def __enter__(self) -> Self:
        """Begin to count the time."""
        return self

    def __exit__(self, *_: object) -> None:
        """Take the bar away."""
        if self._bar is not None:
            self._bar[0].stop()

    def reach(self, done: int) -> None:
        """So many parts are done."""
        seconds = monotonic() - self._started
        if not self._is_seen or (self._bar is None and seconds < PATIENCE_S):
            return
        if self._bar is None:
            self._bar = self._begin()
        bar, task = self._bar
        bar.update(task, completed=done, speed=self._speed(done, seconds))

    def _begin(self) -> tuple[Progress, TaskID]:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

        columns = TextColumn("{task.description}"), BarColumn(), TaskProgressColumn()
        console = Console(stderr=True)
        bar = Progress(*columns, TextColumn("{task.fields[speed]}"), console=console, transient=True)
        task = bar.add_task(self._what, total=self._total, speed="")
        bar.start()
        return bar, task

    def _speed(self, done: int, seconds: float) -> str:
        """Rate and time left."""
        if done <= 0:
            return ""
        minutes, left = divmod(round(max(self._total - done, 0) * seconds / done), 60)
        rate = f"{done / max(seconds, 1e-9):,.0f}"
        return text(f"progress.{self._unit}", rate=rate, left=f"{minutes}:{left:02d}")


class WaitingForRun(Waiting):
    """A bar over the lines of the main program of a run; it is called with the channel now and then."""

    def __init__(self, session: Session) -> None:
        self._program = session.result.program
        super().__init__(self._program.name, len(self._program.lines), "lines")

    def __call__(self, channel: Channel) -> None:
        """Look how far the channel is."""
        if channel.stack:
            main = channel.stack[0]
            self.reach(main.code.line(main.current) - self._program.first_line)
