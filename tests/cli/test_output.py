from __future__ import annotations

import gc
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.cli import output
from polycnc.cli.output import whole_file, write_whole
from tests.cli.console import BAD, GOOD

if TYPE_CHECKING:
    from types import FrameType

    from tests.cli.console import Console


def test_a_file_appears_only_when_it_is_complete(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    with whole_file(path) as stream:
        stream.write("one\n")
        assert not path.exists()
    assert path.read_bytes() == b"one\n"


def interrupted(path: Path) -> None:
    with whole_file(path) as stream:
        stream.write("new")
        raise KeyboardInterrupt


def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    path.write_text("old", encoding="utf-8")
    with pytest.raises(KeyboardInterrupt):
        interrupted(path)
    assert path.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # files that nobody has closed
@pytest.mark.parametrize("unnamed", [True, False])
def test_an_interrupt_at_any_moment_leaves_the_old_file_or_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, unnamed: bool
) -> None:
    """Between any two steps of Python, for systems that have files without a name and others."""
    if not unnamed:
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    path = tmp_path / "out.txt"
    left = 0

    def interrupt(frame: FrameType, event: str, _: object) -> Any:
        nonlocal left
        if frame.f_code.co_filename != output.__file__:
            return None
        frame.f_trace_opcodes = True
        if event == "opcode":
            left -= 1
            if left == 0:
                raise KeyboardInterrupt
        return interrupt

    def interrupted_behind(steps: int) -> bool:
        nonlocal left
        left = steps
        path.write_text("old", encoding="utf-8")
        before = sys.gettrace()
        sys.settrace(interrupt)
        try:
            write_whole(path, "new")
        except KeyboardInterrupt:
            return True
        finally:
            sys.settrace(before)
        return False

    steps = 1
    found = set()
    while interrupted_behind(steps):
        steps += 1
        found.add(path.read_text(encoding="utf-8"))
        assert list(tmp_path.iterdir()) == [path], steps
    gc.collect()  # here, where nobody minds files that are closed by that
    assert found == {"old", "new"}
    assert steps > 100


@pytest.mark.parametrize("unnamed", [True, False])
def test_a_name_may_be_as_long_as_the_system_allows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, unnamed: bool
) -> None:
    if not unnamed:
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    names = ["孔" * 84, "o" * 250]
    for name in names:
        write_whole(tmp_path / name, "text")
    assert sorted(each.name for each in tmp_path.iterdir()) == sorted(names)


def test_a_new_file_may_be_read_by_whom_the_umask_allows(tmp_path: Path) -> None:
    (tmp_path / "plain").touch()
    write_whole(tmp_path / "out.txt", "text")
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("plain", "out.txt")}
    assert len(modes) == 1


def test_a_link_keeps_pointing_to_the_file_that_is_renewed(tmp_path: Path) -> None:
    target, link = tmp_path / "target.txt", tmp_path / "link.txt"
    target.touch()
    link.symlink_to(target)
    write_whole(link, "text")
    assert link.is_symlink()
    assert target.read_text(encoding="utf-8") == "text"


def test_a_device_is_written_as_it_is(tmp_path: Path) -> None:
    null = tmp_path / "null"
    null.symlink_to("/dev/null")
    write_whole(null, "text")
    assert null.exists()
    assert [path.name for path in tmp_path.iterdir()] == ["null"]


def test_a_missing_folder_is_named_as_the_user_wrote_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pathlib import Path

    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError) as caught:
        write_whole(Path("missing/out.txt"), "text")
    assert caught.value.filename == "missing/out.txt"


def test_a_file_that_is_renewed_keeps_its_mode(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    path.touch()
    path.chmod(0o640)
    write_whole(path, "text")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


KILLED = """
import os, signal, sys
from pathlib import Path
from polycnc.cli import output
from polycnc.cli.output import whole_file
number = int(sys.argv[2])
if number != signal.SIGKILL:  # `nohup` hands on an ignored signal
    signal.signal(number, signal.SIG_DFL)
with whole_file(Path(sys.argv[1])) as stream:
    stream.write("half")
    stream.flush()
    os.kill(os.getpid(), number)
"""


@pytest.mark.skipif(not hasattr(os, "O_TMPFILE"), reason="files without a name are Linux's")
@pytest.mark.parametrize("name", ["SIGKILL", "SIGHUP", "SIGTERM"])
def test_nothing_is_left_of_a_process_that_is_killed(tmp_path: Path, name: str) -> None:
    path = tmp_path / "out.txt"
    path.write_text("old", encoding="utf-8")
    number = str(int(getattr(signal, name)))
    subprocess.run([sys.executable, "-c", KILLED, str(path), number], check=False)
    assert [each.name for each in tmp_path.iterdir()] == ["out.txt"]
    assert path.read_text(encoding="utf-8") == "old"


@pytest.fixture
def inputs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """A program with a subprogram, another one, a setup, a machine and a case, and what stands in them."""
    texts = {
        "a.nc": GOOD.replace("M30", "M98 P7\nM30"), "O0007.nc": "O0007\nM99\n", "b.nc": BAD,
        "s.yaml": "start: {X: 0}\n", "m.toml": 'base = "mill3"\n', "cases/c.yaml": "[]\n", "plot.svg": GOOD,
    }  # fmt: skip
    (tmp_path / "cases").mkdir()
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return texts


@pytest.mark.parametrize(
    "words",
    [
        "run a.nc --print a.nc", "run a.nc --state a.nc", "run a.nc --setup s.yaml --state s.yaml",
        "run a.nc --machine m.toml --print m.toml", "run a.nc --print O0007.nc", "run a.nc --state ./../LINK/a.nc",
        "check -o a.nc a.nc", "check -o a.nc b.nc", "check b.nc --setup s.yaml -o s.yaml",
        "test cases/c.yaml --report cases/c.yaml",
        "plot plot.svg -o plot.svg", "features --from cases -o cases/c.yaml",
        "data export programs a.nc b.nc -o b.nc",
        "data import a.nc --setup a.nc --folder . --overwrite",
    ],
)  # fmt: skip
def test_no_output_replaces_an_input(console: Console, inputs: dict[str, str], words: str) -> None:
    Path("../LINK").symlink_to(Path.cwd())
    control = [] if words.startswith(("test", "features", "data")) else ["--control", "fanuc-m"]
    said = console(*words.split(), *control)
    assert {name: Path(name).read_text(encoding="utf-8") for name in inputs} == inputs, said
    if not words.startswith("data import"):
        assert said.status == 2
        assert "not overwritten" in said.err
    Path("../LINK").unlink()


def test_a_full_disk_is_told_with_the_file(console: Console, tmp_path: Path) -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("no such device")
    console.file("a.nc", GOOD)
    (tmp_path / "full.jsonl").symlink_to(full)
    said = console("run", "a.nc", "--control", "fanuc-m", "--trace", str(tmp_path / "full.jsonl"))
    assert said.status == 2
    assert said.err == f"polycnc: {tmp_path / 'full.jsonl'}: the disk is full\n"


def test_two_outputs_are_two_files(console: Console, inputs: dict[str, str]) -> None:
    assert inputs
    said = console("run", "a.nc", "--control", "fanuc-m", "--trace", "x.csv", "--state", "./x.csv")
    assert said.status == 2
    assert "x.csv is named for two outputs" in said.err
    assert not Path("x.csv").exists()
    devices = ("--print", os.devnull, "--state", os.devnull)
    assert console("run", "b.nc", "--control", "fanuc-m", *devices).status == 1


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
@pytest.mark.parametrize("name", ["loop", "loop/out.json"])
def test_links_that_lead_in_a_circle_are_told(console: Console, inputs: dict[str, str], name: str) -> None:
    assert inputs
    Path("loop").symlink_to("loop")
    said = console("run", "a.nc", "--control", "fanuc-m", "--state", name)
    assert (said.status, said.err) == (2, f"polycnc: {name}: the links lead in a circle\n")
    with pytest.raises(OSError, match="loop"):
        write_whole(Path(name), "new")
    assert Path("loop").is_symlink()
