from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
import tomllib
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING

import pytest

from polycnc import __version__
from polycnc.cli import app, commands
from polycnc.cli.app import main
from polycnc.cli.commands import COMMANDS
from polycnc.language.bulk.compiled import LIBRARY as READING
from polycnc.motion.compiled import LIBRARY as PLANNING
from tests.cli.console import BAD, GOOD

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.cli.console import Console

#: A busy machine takes its time, seconds.
PATIENCE_S = 50.0
FOREVER = "O1\nN1 #100=#100+1\nGOTO 1\n"
MANY = "O1\nWHILE [#100 LT 200000] DO1\n#100=#100+1\nG0 X[#100/10]\nEND1\nM30\n"


def test_without_a_command_the_help_is_shown_and_the_status_tells_wrong_use(console: Console) -> None:
    said = console()
    assert said.status == 2
    assert "run" in said.out


def test_the_version_is_told(console: Console) -> None:
    assert console("--version").out == f"polycnc {__version__}\n"


def test_it_is_that_of_the_project() -> None:
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["project"]["version"] == __version__


def test_a_thread_may_call_it_though_it_cannot_answer_signals() -> None:
    statuses = []

    def run() -> None:
        try:
            main(["--version"])
        except SystemExit as left:
            statuses.append(left.code)

    thread = Thread(target=run)
    thread.start()
    thread.join()
    assert statuses == [0]


@pytest.mark.parametrize(
    "words", [("run",), ("check",), ("plot", "-o", "good.svg")], ids=lambda words: words[0]
)
@pytest.mark.parametrize("lack", ["missing", "stale", "chosen"])
def test_who_waits_for_plain_kernels_is_told_so(
    console: Console, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], lack: str
) -> None:
    console.file("good.nc", GOOD)
    program = ("good.nc", "--control", "fanuc-m")
    monkeypatch.setitem(vars(READING), "lack", None)
    monkeypatch.setitem(vars(PLANNING), "lack", lack)
    assert "kernels" not in console(*words, *program).err
    monkeypatch.setattr(commands, "SLOW_S", 0.0)
    assert console(*words, *program).err.count("kernels") == (lack != "chosen")


@pytest.mark.parametrize(
    "words",
    [(), ("--version",), *((command, "--help") for command in COMMANDS), ("machines",), ("features",)],
    ids=" ".join,
)
def test_who_runs_no_program_is_told_nothing_of_kernels(
    console: Console, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]
) -> None:
    for library in (READING, PLANNING):
        monkeypatch.setitem(vars(library), "lack", "missing")
    monkeypatch.setattr(commands, "SLOW_S", 0.0)
    assert "kernels" not in console(*words).err


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_help(console: Console, command: str) -> None:
    said = console(command, "--help")
    assert said.status == 0
    assert "--lang" in said.out


@pytest.mark.parametrize("words", [(), ("run",), ("check",)])
def test_h_shows_the_same_help(console: Console, words: tuple[str, ...]) -> None:
    assert console(*words, "-h").out == console(*words, "--help").out
    assert console(*words, "-h", "--lang", "zh-TW").out == console(*words, "--help", "--lang", "zh-TW").out


def test_help_comes_in_chinese_too(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "utf-8"}  # others have no such characters
    words = ("run", "--help", "--lang", "zh-TW")
    process = _polycnc(*words, cwd=tmp_path, stdout=subprocess.PIPE, env=environment)
    out, _ = process.communicate(timeout=PATIENCE_S)
    assert "加工程式" in out.decode()


@pytest.mark.parametrize(
    "words",
    [
        ("run", "--nonsense", "x.nc"),
        ("runn", "x.nc"),
        ("run",),
        ("run", "x.nc", "--block-limit", "0"),
        ("run", "x.nc", "--lang", "de"),
        ("check", "x.nc", "--format", "xml"),
        ("run", "missing.nc", "--control", "fanuc-m"),
        ("run", ".", "--control", "fanuc-m"),
        ("run", "good.nc", "--control", "heidenhain"),
        ("run", "good.nc"),
        ("run", "good.nc", "--control", "fanuc-m", "--machine", "nothing"),
        ("run", "good.nc", "--control", "fanuc-m", "--setup", "missing.yaml"),
        ("run", "good.nc", "--control", "fanuc-m", "--search", "missing"),
        ("run", "good.nc", "--control", "fanuc-m", "--encoding", "klingon"),
        ("run", "good.nc", "--control", "fanuc-m", "--trace", "out.xml"),
        ("run", "good.nc", "--control", "fanuc-m", "--trace", "missing/out.csv"),
        ("run", "good.nc", "--control", "fanuc-m", "--state", "missing/out.json"),
        ("plot", "good.nc", "--control", "fanuc-m", "-o", "x.gif"),
        ("test", "missing.yaml"),
        ("machines", "show", "nothing"),
        ("alarms",),
        ("alarms", "99999", "--control", "fanuc-m"),
        ("features", "--from", "missing"),
    ],
)
def test_wrong_use_gets_one_clear_line_and_status_2(console: Console, words: tuple[str, ...]) -> None:
    console.file("good.nc", GOOD)
    said = console(*words)
    assert said.status == 2
    assert len(said.err.splitlines()) == 1
    assert said.err.startswith("polycnc: ")


def test_the_environment_chooses_the_language(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("POLYCNC_LANG", "zh_TW.UTF-8")
    assert "找不到" in console("run", "missing.nc", "--control", "fanuc-m").err


def test_a_choice_of_kernels_that_there_is_not_is_told(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    for value, said in (("Python", "POLYCNC_KERNELS=Python"), ("python", ""), ("", "")):
        monkeypatch.setenv("POLYCNC_KERNELS", value)
        assert console("--version").err.partition(" chooses")[0].removeprefix("polycnc: ") == said


def test_a_file_that_may_not_be_read_is_told(console: Console) -> None:
    path = console.file("secret.nc", GOOD)
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("this user may read everything")
    assert console("run", path, "--control", "fanuc-m").status == 2


def _polycnc(*words: str, cwd: Path, **options: object) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "polycnc", *words]
    before = signal.getsignal(signal.SIGINT)
    # Who started the tests in the background may have told them, and what they start, to ignore Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return subprocess.Popen(command, cwd=cwd, stderr=subprocess.PIPE, **options)  # type: ignore[call-overload, no-any-return]
    finally:
        signal.signal(signal.SIGINT, before)


def test_ctrl_c_ends_a_long_run_with_one_line_and_leaves_no_half_written_file(tmp_path: Path) -> None:
    (tmp_path / "long.nc").write_text(FOREVER, encoding="utf-8")
    words = ("run", "long.nc", "--control", "fanuc-m", "--trace", "out.jsonl")
    process = _polycnc(*words, cwd=tmp_path, stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + PATIENCE_S
    while not _is_writing(process.pid, tmp_path) and time.monotonic() < deadline:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130
    assert len(err.splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["long.nc"]


#: Ctrl-C comes while a module is looked for.
INTERRUPTED_AT = """
import runpy, sys

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == {name!r}:
            raise KeyboardInterrupt

sys.meta_path.insert(0, Finder())
runpy.run_module("polycnc", run_name="__main__", alter_sys=True)
"""


@pytest.mark.parametrize("name", ["polycnc.cli", "polycnc.cli.app", "polycnc.cli.plain"])
def test_ctrl_c_while_it_is_loaded_is_no_traceback(tmp_path: Path, name: str) -> None:
    command = [sys.executable, "-c", INTERRUPTED_AT.format(name=name)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=PATIENCE_S, check=False)
    assert (done.returncode, done.stderr) == (130, b"")


def test_ctrl_c_that_becomes_another_error_is_one(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    """As Python 3.11 makes of one that comes while it defines a class."""

    def fails(*_: object, **__: object) -> None:
        raise RuntimeError from KeyboardInterrupt()

    monkeypatch.setattr("polycnc.cli.options.Opening.session", fails)
    said = console("run", "a.nc")
    assert (said.status, said.err) == (130, "polycnc: interrupted\n")


def test_a_further_interrupt_acts_only_where_the_first_one_hangs(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(app, "monotonic", lambda: now[0])
    with app._interrupts(is_last=False):
        for seconds, acts in ((0.0, True), (0.01, False), (4.9, False), (0.2, True), (0.01, False)):
            now[0] += seconds
            with pytest.raises(KeyboardInterrupt) if acts else nullcontext():
                signal.raise_signal(signal.SIGINT)


def test_who_calls_it_has_its_own_answers_to_signals_again(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupts(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr("polycnc.cli.options.Opening.session", interrupts)
    assert console("run", "a.nc").status == 130
    assert signal.getsignal(signal.SIGINT) is before


FREEING = """
import os, signal, sys, time
from polycnc.cli import main
from polycnc.cli.commands import check
class Part:
    def __del__(self):
        os.kill(os.getpid(), signal.{name})
        time.sleep(0)
def checked(*_, **__):
    Part()
    end = time.monotonic() + 20.0
    while time.monotonic() < end:
        pass
    return check._Checked([])
check._checked = checked
sys.argv[1:] = ["check", "--control", "fanuc-m", "a.nc"]
main()
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.skipif(sys.platform == "win32", reason="has other signals")
def test_an_interrupt_that_comes_while_an_object_is_freed_is_not_lost(tmp_path: Path, name: str) -> None:
    command = [sys.executable, "-c", FREEING.format(name=name)]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE_S, check=False
    )
    assert (done.returncode, done.stderr) == (130, "polycnc: interrupted\n")


def test_a_reader_that_goes_away_ends_the_output_quietly(tmp_path: Path) -> None:
    process = _polycnc("machines", cwd=tmp_path, stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.close()
    _, err = process.communicate(timeout=PATIENCE_S)
    assert err == b""
    assert process.returncode == 2


def test_an_alarm_is_status_1_and_its_line_can_be_clicked(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("run", "bad.nc", "--control", "fanuc-m")
    assert said.status == 1
    assert "bad.nc:3:" in said.out
    assert "PS0010" in said.out


def _is_writing(process: int, folder: Path) -> bool:
    """Whether a process has an output file open: one beside its target, or one that has no name yet."""
    if list(folder.glob(".out.jsonl.*")):
        return True
    opened = Path(f"/proc/{process}/fd")
    with suppress(OSError):  # no such system, or a file has just been closed
        return any(each.readlink().parent == folder.resolve() for each in opened.iterdir())
    return False


def test_a_run_that_is_told_to_end_leaves_no_half_written_file(tmp_path: Path) -> None:
    program = tmp_path / "loop.nc"
    program.write_text("O1\nG91\nN1 G0 X1.\nX-1.\nGOTO 1\n", encoding="utf-8")
    words = [
        sys.executable,
        "-m",
        "polycnc",
        "run",
        str(program),
        "--control",
        "fanuc-m",
        "--trace",
        "out.jsonl",
    ]
    with subprocess.Popen(words, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as run:
        end = time.monotonic() + PATIENCE_S
        while not _is_writing(run.pid, tmp_path):
            assert run.poll() is None
            assert time.monotonic() < end
            time.sleep(0.05)
        run.terminate()
        assert run.stderr is not None
        told = run.stderr.read()
    assert run.returncode == 130
    assert told == "polycnc: interrupted\n"
    assert [path.name for path in tmp_path.iterdir()] == ["loop.nc"]


def test_the_list_of_alarms_shows_no_placeholders(console: Console) -> None:
    assert "{" not in console("alarms", "--control", "fanuc-m").out


def test_a_mistake_of_polycnc_is_one_line_and_no_alarm(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise ZeroDivisionError("of our own")

    monkeypatch.setattr("polycnc.cli.options.Opening.session", fails)
    said = console("run", "a.nc")
    assert said.status == 2
    assert said.err.startswith("polycnc: a mistake of polycnc itself: ZeroDivisionError: of our own (")
    assert said.err.count("\n") == 1
    monkeypatch.setenv("POLYCNC_TRACEBACK", "1")
    with pytest.raises(ZeroDivisionError):
        console("run", "a.nc")


LEAVING = """
import atexit, sys, threading
sys.argv[1:] = {words!r}
threading.Thread(target=lambda: (threading.main_thread().join(), print("thread"))).start()
from polycnc.cli import app, main
before = app.main
def late(words):
    atexit.register(print, "function")
    before(words)
app.main = late
main()
"""


@pytest.mark.parametrize(("words", "status"), [(["--version"], 0), ([], 2)])
def test_a_process_ends_with_its_status_behind_threads_and_what_waits_for_its_end(
    tmp_path: Path, words: list[str], status: int
) -> None:
    command = [sys.executable, "-c", LEAVING.format(words=words)]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=PATIENCE_S, check=False
    )
    assert done.returncode == status
    assert done.stdout.splitlines()[-2:] == ["thread", "function"]
    assert done.stderr == ""


def test_a_mistake_that_shows_its_way_ends_the_process_as_python_does(tmp_path: Path) -> None:
    code = "from polycnc.cli import app, main\ndef fails(words): raise ValueError('here')\napp.main = fails\nmain()"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == "ValueError: here"


@pytest.mark.parametrize("closed", ["2>&-", ">&-", "<&- >&- 2>&-"])
@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
def test_a_closed_stream_takes_all(tmp_path: Path, closed: str) -> None:
    (tmp_path / "a.nc").write_text(GOOD, encoding="utf-8")
    command = f"{sys.executable} -m polycnc run a.nc --control fanuc-m --state a.json {closed}"
    run = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert (tmp_path / "a.json").read_text(encoding="utf-8").startswith("{")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device")
@pytest.mark.parametrize(
    ("words", "closed", "status"),
    [
        ("run bad.nc --control fanuc-m", "2>/dev/full", 1),
        ("run bad.nc --control fanuc-m", ">/dev/full 2>&1", 2),
        ("run missing.nc --control fanuc-m", "2>/dev/full", 2),
        ("run missing.nc --control fanuc-m", ">/dev/full 2>&1", 2),
        ("plot bad.nc --control fanuc-m -o bad.svg", "2>/dev/full", 1),
        ("nonsense", "2>/dev/full", 2),
        ("features", "2>/dev/full", 0),
    ],
)
def test_where_nobody_can_be_told_the_status_is_the_same(
    tmp_path: Path, words: str, closed: str, status: int
) -> None:
    (tmp_path / "bad.nc").write_text(BAD, encoding="utf-8")
    command = f"{sys.executable} -m polycnc {words} {closed}"
    # Buffered as for a user: Python complains at its end of what is still to be written then.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    run = subprocess.run(
        command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=False, env=environment
    )
    assert (run.returncode, run.stderr) == (status, "")


#: Runs what it is given on a terminal of its own, closes that when a bar is shown, and ends with the status. A process
#: that is copied has no other threads, which the tests may have.
CLOSING = """
import os, pty, sys
from contextlib import suppress
process, terminal = pty.fork()
if not process:
    os.environ.pop("PYTHONUNBUFFERED", None)  # as for a user
    os.execve(sys.executable, [sys.executable, "-m", "polycnc", *sys.argv[1:]], {**os.environ, "TERM": "xterm"})
with suppress(OSError):
    while b"0:0" not in os.read(terminal, 1 << 16):
        pass
os.close(terminal)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="has other terminals")
@pytest.mark.parametrize("words", ["run 1.nc --trace out.jsonl", "check many", "plot 1.nc -o out.svg"])
def test_a_terminal_that_is_closed_interrupts(tmp_path: Path, words: str) -> None:
    many = [f"{number}.nc" for number in range(40)]
    for name in many:
        (tmp_path / name).write_text(GOOD if name == "0.nc" else FOREVER, encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    command = [sys.executable, "-c", CLOSING, *words.replace("many", " ".join(many)).split()]
    limit = "--control", "fanuc-m", "--block-limit", "1000000000"
    done = subprocess.run([*command, *limit], cwd=tmp_path, timeout=PATIENCE_S, check=False)
    assert done.returncode == 130
    assert sorted(tmp_path.iterdir()) == before


#: A check whose workers take longer for a file than any test waits.
CHECKING = """
import os, sys, time
from polycnc.cli import main
from polycnc.cli.commands import check
check._cores = lambda: 2
def seldom(opening, file):
    if file[0] != "0.nc":
        os.write(1, b"%d\\n" % os.getpid())  # at once, whatever others write
        time.sleep(600)
    return check._Checked([])
check._one_checked = seldom
ends = check._kill_where
again = [int(number) for number in sys.argv[1:]]
def interrupted(*words):
    for number in again:
        os.kill(os.getpid(), number)  # once more, while it ends its workers
    ends(*words)
check._kill_where = interrupted
sys.argv[1:] = ["check", "--control", "fanuc-m", *(f"{each}.nc" for each in range(40))]
main()
"""


@contextmanager
def _checking(folder: Path, *again: int) -> Iterator[tuple[subprocess.Popen[bytes], int]]:
    """Such a check, and one of its workers; what it sends itself when it ends them."""
    command = [sys.executable, "-c", CHECKING, *map(str, map(int, again))]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "start_new_session": True}
    with subprocess.Popen(command, cwd=folder, **pipes) as process:  # type: ignore[call-overload]
        try:
            yield process, int(process.stdout.readline())
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.skipif(sys.platform == "win32", reason="has other signals")
def test_whoever_interrupts_a_check_ends_its_workers_at_once(tmp_path: Path, name: str) -> None:
    number = getattr(signal, name)
    with _checking(tmp_path, number) as (process, _):
        for _ in range(3):  # of a terminal every process of the group gets them
            with suppress(ProcessLookupError):
                os.killpg(process.pid, number)
        _, err = process.communicate(timeout=PATIENCE_S)  # also where the workers have closed their ends
        assert err == b"polycnc: interrupted\n"
        assert process.returncode == 130


@pytest.mark.skipif(sys.platform == "win32", reason="has other signals")
def test_workers_of_a_check_that_is_killed_end(tmp_path: Path) -> None:
    with _checking(tmp_path) as (process, _):
        process.kill()
        process.communicate(timeout=PATIENCE_S)  # until the workers have closed their ends


@pytest.mark.skipif(sys.platform == "win32", reason="has other signals")
def test_a_worker_that_is_killed_ends_the_check_with_one_line(tmp_path: Path) -> None:
    with _checking(tmp_path) as (process, worker):
        os.kill(worker, signal.SIGKILL)
        _, err = process.communicate(timeout=PATIENCE_S)
        assert err.startswith(b"polycnc: one of the processes of this check has been killed;")
        assert err.count(b"\n") == 1
        assert process.returncode == 2
