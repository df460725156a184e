"""How far a command is: rate and time left on a terminal, nothing in a pipe."""

from __future__ import annotations

import io
import sys
from typing import TYPE_CHECKING

from polycnc.cli import progress
from polycnc.cli.progress import Waiting, WaitingForRun
from polycnc.session import open_session

if TYPE_CHECKING:
    import pytest


class Terminal(io.StringIO):
    """Standard error where somebody looks at it."""

    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    seen = Terminal()
    monkeypatch.setattr(sys, "stderr", seen)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    return seen


def test_long_work_tells_rate_and_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    times = iter((0.0, 2.0, 4.0))
    monkeypatch.setattr(progress, "monotonic", lambda: next(times))
    with Waiting("part.nc", 1000, "lines") as waiting:
        waiting.reach(100)
        waiting.reach(100)
        assert waiting._bar is not None
        waiting._bar[0].refresh()
    assert "part.nc" in seen.getvalue()
    assert "25 lines/s, 0:36 left" in seen.getvalue()


def test_what_is_done_within_a_second_shows_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    with Waiting("part.nc", 1000, "lines") as waiting:
        waiting.reach(999)
    assert seen.getvalue() == ""


def test_a_pipe_gets_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    pipe = io.StringIO()
    monkeypatch.setattr(sys, "stderr", pipe)
    monkeypatch.setattr(progress, "PATIENCE_S", 0.0)
    with Waiting("part.nc", 1000, "lines") as waiting:
        waiting.reach(999)
    assert pipe.getvalue() == ""


def test_a_run_is_as_far_as_its_main_program(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal(monkeypatch)
    monkeypatch.setattr(progress, "PATIENCE_S", 0.0)
    text = "O1\nG91 G1 F100.\n" + "X1.\n" * 70_000 + "M30\n"
    session = open_session(text, control="fanuc-m", keep=False)
    with WaitingForRun(session) as waiting:
        assert session.run(waiting).ok
        assert waiting._bar is not None
        (task,) = waiting._bar[0].tasks
    assert task.total == 70_003
    assert 60_000 < task.completed < 70_003
