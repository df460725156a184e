"""How far a command is: rate and time left on a terminal, nothing in a pipe."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from tqdm.utils import disp_len

from polycnc.cli import progress
from polycnc.cli.commands import data, features, memory, plot
from polycnc.cli.console import say
from polycnc.cli.progress import Reached, Waiting, WaitingForRun, Watch, watched
from polycnc.messages.catalogue import set_language
from polycnc.session import open_session
from tests.cli.console import GOOD

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import ModuleType

    from tests.cli.console import Console


class Terminal(io.StringIO):
    """Standard error where somebody looks at it."""

    def isatty(self) -> bool:
        return True


@pytest.fixture(autouse=True)
def _nobody_looks_on() -> Iterator[None]:
    yield
    Watch.of_command = None
    set_language("en")


def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """Within the test: between its phases pytest takes standard error back."""
    seen = Terminal()
    monkeypatch.setattr(sys, "stderr", seen)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(progress, "monotonic", lambda: 0.0)
    return seen


def test_long_work_tells_rate_and_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    watch, waiting = Watch("polycnc check"), Waiting("part.nc", 1000, "files")
    waiting.reach(50)
    watch.look(waiting, 2.0)
    waiting.reach(100)
    watch.look(waiting, 4.0)
    watch.end()
    assert "part.nc" in seen.getvalue()
    assert "10%  25 files/s, 0:36 left" in seen.getvalue()


def test_the_rate_is_told_in_the_language_of_the_user(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    watch, waiting = Watch("polycnc check"), Waiting("part.nc", 1000, "files")
    waiting.reach(100)
    set_language("zh-TW")
    watch.look(waiting, 4.0)
    watch.end()
    assert "每秒 25 個檔案，剩餘 0:36" in seen.getvalue()


def test_what_is_done_within_a_second_shows_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    watch, waiting = Watch("polycnc check"), Waiting("part.nc", 1000, "files")
    waiting.reach(999)
    watch.look(waiting, 0.9)
    watch.end()
    assert seen.getvalue() == ""


def test_a_command_that_tells_nothing_shows_how_long_it_has_lasted(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    watch = Watch("polycnc data")
    watch.look(watch.works[-1], 72.0)
    watch.end()
    assert "polycnc data" in seen.getvalue()
    assert "1:12" in seen.getvalue()


def test_a_rate_that_nobody_sees_any_more_is_not_told(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    watch, waiting = Watch("polycnc check"), Waiting("part.nc", 1000, "files")
    waiting.reach(100)
    watch.look(waiting, 4.0)
    watch.look(waiting, 64.0)
    watch.end()
    assert seen.getvalue().split("10%")[-1].startswith("  1:04")


def test_a_pipe_gets_no_bar_and_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    pipe = io.StringIO()
    monkeypatch.setattr(sys, "stderr", pipe)
    monkeypatch.setattr(progress, "PATIENCE_S", 0.0)
    monkeypatch.setattr(Watch, "begin", lambda _: pytest.fail("somebody looks"))
    with watched("polycnc check"), Waiting("part.nc", 1000, "files") as waiting:
        assert Watch.of_command is None
        waiting.reach(999)
    assert pipe.getvalue() == ""


def test_a_result_is_written_where_it_belongs_and_the_bar_makes_room(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    seen = terminal(monkeypatch)
    watch = Watch.of_command = Watch("polycnc test")
    watch.look(Waiting("polycnc test", 10, "cases"), 2.0)
    say("FAILED")
    assert capsys.readouterr().out == "FAILED\n"
    drawn, taken_away, begin = seen.getvalue().split("\r")[-3:]
    assert drawn.startswith("polycnc test ")
    assert taken_away == " " * len(drawn)
    assert begin == ""
    watch.end()


def test_a_narrow_terminal_tells_the_time_left_and_as_much_of_the_name_as_fits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seen = terminal(monkeypatch)
    set_language("zh-TW")
    watch, waiting = Watch("polycnc check"), Waiting("加工程式一.nc", 1000, "files")
    waiting.reach(100)
    watch.look(waiting, 4.0)
    monkeypatch.setattr(progress, "_COLUMNS", 40)
    watch.look(waiting, 4.2)
    wide, narrow = seen.getvalue().split("\r")[-2:]
    assert wide.startswith("加工程式一.nc ")
    assert narrow.rstrip().endswith("  10%  每秒 24 個檔案，剩餘 0:38")
    assert narrow.startswith("加工 ")
    assert disp_len(narrow.rstrip()) == 39
    watch.end()


def test_a_terminal_that_says_it_has_no_columns_shows_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    monkeypatch.setattr(seen, "fileno", lambda: 2)
    monkeypatch.setattr("os.get_terminal_size", lambda *_: os.terminal_size((0, 0)))
    watch, waiting = Watch("polycnc check"), Waiting("加工程式.nc", 1000, "files")
    waiting.reach(100)
    watch.look(waiting, 4.0)
    watch.end()
    assert "加工程式.nc #" in seen.getvalue()
    assert "10%" in seen.getvalue()


def test_a_terminal_with_few_characters_gets_those_that_it_has(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal(monkeypatch)
    seen = io.TextIOWrapper(io.BytesIO(), encoding="latin-1", errors="strict")
    monkeypatch.setattr(sys, "stderr", seen)
    set_language("zh-TW")
    watch, waiting = Watch("polycnc check"), Waiting("程式.nc", 1000, "files")
    waiting.reach(500)
    watch.look(waiting, 4.0)
    watch.end()
    shown = seen.buffer.getvalue().decode("latin-1")
    assert "??.nc ####" in shown
    assert "  50%  ?? 125 ?????? 0:04" in shown


def test_a_terminal_that_cannot_take_a_bar_away_gets_none(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal(monkeypatch)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setattr(Watch, "begin", lambda _: pytest.fail("somebody looks"))
    with watched("polycnc check"):
        assert Watch.of_command is None


SHOWING = """
import sys, threading, time
from polycnc.cli import progress
sys.stderr.isatty = lambda: True
progress.PATIENCE_S = progress.LOOK_S = 0.02
with progress.watched("polycnc check"), progress.Waiting("part.nc", 4, "files") as waiting:
    waiting.reach(1)
    while progress.Watch.of_command._bar is None:
        time.sleep(0.01)
print([each.name for each in threading.enumerate()], "multiprocessing" in sys.modules)
"""


def test_a_bar_leaves_no_thread_and_nothing_on_the_terminal() -> None:
    done = subprocess.run(
        [sys.executable, "-c", SHOWING], capture_output=True, text=True, timeout=120, check=True,
        env={**os.environ, "TERM": "xterm"},
    )  # fmt: skip
    assert done.stdout == "['MainThread'] False\n"
    assert "part.nc" in done.stderr
    assert done.stderr.splitlines()[-1].strip() == ""


def test_the_work_that_was_begun_last_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = terminal(monkeypatch)
    assert seen.getvalue() == ""
    watch = Watch.of_command = Watch("polycnc run")
    with Waiting("part.nc", 10, "rows") as waiting:
        assert watch.works[-1] is waiting
    assert watch.works[-1].what == "polycnc run"
    progress.end()
    assert watch.works == []


def test_parts_are_counted_as_they_are_taken() -> None:
    waiting = Waiting("part.nc", 4, "rows")
    for part in waiting.each("abcd"):
        assert waiting.reached(0.0) == Reached("rows", "abcd".index(part), "abcd".index(part) / 4)


def test_parts_that_are_gone_through_in_several_turns_count_on() -> None:
    waiting: Any = Waiting("part.svg", 6, "points")
    seen = [waiting.reached(0.0).done for turn in ("abc", "def") for _ in waiting.each(turn)]
    assert seen[:3] == [0, 1, 2]
    assert seen[3] == 2
    assert seen[-1] >= 4


def counted_by(monkeypatch: pytest.MonkeyPatch, module: ModuleType) -> list[Any]:
    """What a command counts: number of parts, and what they are."""
    told: list[Any] = []

    class Counting(Waiting):
        def __init__(self, what: str, total: int | None, unit: str) -> None:
            super().__init__(what, total, unit)
            told.append(self)

    monkeypatch.setattr(module, "Waiting", Counting)
    return told


def test_a_drawing_counts_its_rows_and_then_its_points(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = counted_by(monkeypatch, plot)
    console.file("good.nc", GOOD)
    console("plot", "good.nc", "--control", "fanuc-m", "-o", "good.svg")
    assert [waiting.reached(0.0).unit for waiting in told] == ["rows", "points"]
    assert told[-1].reached(0.0).share > 0.9


def test_features_of_a_folder_are_counted_by_files(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    told = counted_by(monkeypatch, features)
    (console.folder / "cases").mkdir()
    for name in "abc":
        console.file(
            f"cases/{name}.yaml", "- {id: 1, feature: f, control: fanuc-m, program: M30, expect: {}}\n"
        )
    console("features", "--from", "cases")
    assert told[0].reached(0.0) == Reached("files", 2, 2 / 3)


TAPE = "%\n" + "".join(f"O{number:04d}\nG0 X1.\nM30\n" for number in range(1, 5)) + "%\n"


def test_programs_that_are_written_and_read_are_counted_by_files(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = [counted_by(monkeypatch, module) for module in (data, memory)]
    console.file("tape.nc", TAPE)
    console("data", "import", "tape.nc", "--control", "fanuc-m", "--folder", "out")
    console("data", "export", "programs", "tape.nc", "out/O0001.nc", "--control", "fanuc-m", "-o", "again.nc")
    console("memory", "new", "syntec.mem", "--control", "syntec-mill")
    console.file("one.nc", "G0 X1.\nM30\n")
    console.file("two.nc", "G0 X2.\nM30\n")
    console("memory", "import", "syntec.mem", "one.nc", "two.nc")
    console("memory", "export", "syntec.mem", "programs", "--folder", "programs")
    assert [[waiting.reached(0.0) for waiting in each] for each in told] == [
        [Reached("files", 3, 3 / 4), Reached("files", 1, 1 / 2)],
        [Reached("files", 1, 1 / 2)],
    ]


# ---- a run -----------------------------------------------------------------------------------------------------------


def run_of(lines: int) -> tuple[WaitingForRun, Any]:
    """What is told of a run of a program with so many lines, and its session: at line `at`, after `blocks`."""
    main = SimpleNamespace(code=SimpleNamespace(line=lambda index: index + 1), current=0)
    session: Any = SimpleNamespace(
        result=SimpleNamespace(
            program=SimpleNamespace(name="O1", first_line=1, lines=[""] * lines),
            planner=SimpleNamespace(unlaid=0),
        ),
        channel=SimpleNamespace(stack=[main], blocks=0),
        main_run=None,
    )
    return WaitingForRun(session), session


@pytest.fixture
def _at_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "monotonic", lambda: 0.0)


@pytest.mark.usefixtures("_at_zero")
def test_a_run_is_as_far_as_its_main_program() -> None:
    waiting, session = run_of(1000)
    for second in range(1, 9):
        session.channel.stack[0].current = session.channel.blocks = 100 * second
        assert waiting.reached(float(second)) == Reached("blocks", 100 * second, second / 10)


@pytest.mark.usefixtures("_at_zero")
def test_rows_that_the_planner_has_not_laid_out_are_not_done() -> None:
    waiting, session = run_of(1000)
    session.channel.stack[0].current = session.channel.blocks = 800
    for second in range(1, 9):
        session.result.planner.unlaid = 800 - 100 * second
        assert waiting.reached(float(second)) == Reached("blocks", 100 * second, second / 10)


@pytest.mark.usefixtures("_at_zero")
def test_in_a_loop_nobody_knows_the_time_left_until_lines_come_that_are_new() -> None:
    waiting, session = run_of(1000)
    main, reached = session.channel.stack[0], None
    for tenth in range(100):  # lines 100 to 109, again and again
        main.current, session.channel.blocks = 100 + tenth % 10, 1000 * tenth
        reached = waiting.reached(0.1 * tenth)
    assert reached == Reached("blocks", 99_000, None)
    main.current = 300
    assert waiting.reached(10.0) == Reached("blocks", 99_000, 0.3)


@pytest.mark.usefixtures("_at_zero")
def test_work_that_counts_as_a_whole_is_no_loop() -> None:
    """The planner takes a chunk: neither blocks nor lines go on meanwhile."""
    waiting, session = run_of(1000)
    session.channel.stack[0].current = session.channel.blocks = 500
    reached = [waiting.reached(0.2 * k) for k in range(5, 500)]
    assert reached[-1] == Reached("blocks", 500, 0.5)


@pytest.mark.usefixtures("_at_zero")
def test_a_run_by_the_clock_tells_seconds_of_machining() -> None:
    waiting, session = run_of(10)
    session.main_run, reached = SimpleNamespace(seconds=90.0), None
    for tenth in range(100):
        session.main_run.seconds = 30.0 * tenth
        reached = waiting.reached(0.1 * tenth)
    assert reached == Reached("seconds", 2970.0, None)


@pytest.mark.usefixtures("_at_zero")
def test_a_sampled_run_is_as_far_as_its_samples() -> None:
    session = open_session("O1\nG91 G1 F6000.\n" + "X1.\n" * 100 + "M30\n", control="fanuc-m", keep=False)
    sampler = session.sample(0.001, lambda _: None)
    waiting = WaitingForRun(session, sampler)
    result = session.run()
    result.plan  # noqa: B018 - gives the samples
    sampler.close()
    assert sampler.line == 102
    assert waiting.reached(0.0) == Reached("samples", sampler.count, 101 / 103)
