"""The server as a user starts it: the page, the JSON interface, the memory, Ctrl-C."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from contextlib import closing, contextmanager
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

pytest.importorskip("nicegui")
#: A busy machine starts slowly.
PATIENCE_S = 60.0


def free_port() -> int:
    with closing(socket.socket()) as found:
        found.bind(("127.0.0.1", 0))
        port: int = found.getsockname()[1]
        return port


def environment() -> dict[str, str]:
    """What a server is started with: NiceGUI behaves otherwise where it believes that it is tested."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    return {**kept, "POLYCNC_LANG": "en"}


@contextmanager
def served(folder: Path, *words: str, ends: Sequence[str] = ("SIGINT",)) -> Iterator[str]:
    """The address of a server that is started in a folder, and ended by Ctrl-C, or by other signals."""
    # Where tests run in the background of a shell, Ctrl-C is ignored, and children would inherit that.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        process, address = started(folder, *words)
    finally:
        signal.signal(signal.SIGINT, before)
    with process:
        try:
            yield address
            for end in ends:
                process.send_signal(getattr(signal, end))
                sleep(0.01)
            told, errors = process.communicate(timeout=PATIENCE_S)
        finally:
            process.kill()
    assert process.returncode == 130
    assert address in told
    assert errors == "polycnc: interrupted\n"


def started(folder: Path, *words: str) -> tuple[subprocess.Popen[str], str]:
    """A server that answers, and its address."""
    said = "", ""
    for _ in range(5):
        port = free_port()
        command = [sys.executable, "-m", "polycnc", "panel", *words, "--no-open", "--port", str(port)]
        process = subprocess.Popen(
            [*command, "--speed", "100"], cwd=folder, env=environment(), text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip
        address = f"127.0.0.1:{port}"
        until = monotonic() + PATIENCE_S
        while process.poll() is None and monotonic() < until:
            if status(address):
                return process, address
            sleep(0.2)
        process.kill()
        said = process.communicate()
        assert "is in use" in said[1], said  # by another one, which has been faster
    raise AssertionError(said)


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """A server of a FANUC control with a program and a memory."""
    (tmp_path / "a.nc").write_text("O0007\n#500=4.\nG0 X5.\nM30\n", encoding="utf-8")
    with served(tmp_path, "a.nc", "--control", "fanuc-m", "--memory", "shop.db") as found:
        yield found


def status(address: str, **headers: str) -> int:
    """The status of the page; 0 while nobody answers."""
    try:
        with urllib.request.urlopen(
            urllib.request.Request(f"http://{address}/", headers=headers), timeout=20
        ) as page:
            return int(page.status)
    except urllib.error.HTTPError as error:
        return error.code
    except OSError:
        return 0


async def talk(address: str, *messages: object) -> list[object]:
    from websockets.asyncio.client import connect

    answers = []
    async with connect(f"ws://{address}/api/fanuc-m") as wire:
        for message in messages:
            await wire.send(json.dumps(message))
            answers.append(json.loads(await wire.recv()))
    return answers


def sheet_with(address: str, word: str) -> str:
    """The result sheet of an exercise once it has a word."""
    until, sheet = monotonic() + PATIENCE_S, ""
    while monotonic() < until and word not in sheet:
        (answer,) = asyncio.run(talk(address, {"do": "lesson"}))
        assert isinstance(answer, dict)
        sheet = answer["ok"]
    return sheet


def test_the_panel_is_served_and_answers(address: str, tmp_path: Path) -> None:
    assert status(address) == 200
    assert status(address, Origin="http://elsewhere.example") == 403
    started, _ = asyncio.run(talk(address, {"do": "cycle_start"}, {"do": "snapshot"}))
    assert started == {"ok": None}
    until, x = monotonic() + PATIENCE_S, 0.0
    while monotonic() < until and x != 5.0:
        (shown,) = asyncio.run(talk(address, {"do": "snapshot"}))
        assert isinstance(shown, dict)
        x = shown["ok"]["positions"]["work"]["X"]
    assert x == 5.0
    assert asyncio.run(talk(address, {"do": "read_variable", "with": {"name": "#500"}})) == [{"ok": 4.0}]
    assert asyncio.run(talk(address, {"do": "nothing"}))[0] != {"ok": None}
    assert (tmp_path / "shop.db").exists()


def test_an_address_is_tried_before_its_link_is_printed() -> None:
    from polycnc.messages import UserError
    from polycnc.panel.web.server import check_address

    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(UserError, match="is in use"):
            check_address("127.0.0.1", port)
    with pytest.raises(UserError, match="no address"):
        check_address("300.1.1.1", port)
    check_address("127.0.0.1", port)


@pytest.mark.skipif(sys.platform == "win32", reason="has other signals")
@pytest.mark.parametrize("names", [("SIGINT",) * 3, ("SIGTERM", "SIGINT"), ("SIGHUP", "SIGHUP")])
def test_further_interrupts_do_not_break_the_closing(tmp_path: Path, names: tuple[str, ...]) -> None:
    """Neither that of the server nor what is written behind it."""
    with served(tmp_path, "--control", "fanuc-m", "--record", "record", ends=names):
        pass
    assert (tmp_path / "record").read_text(encoding="utf-8").count("\n") == 1


def test_what_is_interrupted_depends_on_how_far_the_server_is() -> None:
    from polycnc.panel.web.interrupts import Interrupts

    done: list[str] = []
    interrupts = Interrupts(lambda: done.append("closed"))

    def come(*, often: int = 1) -> None:
        for _ in range(often):
            signal.raise_signal(signal.SIGINT)

    def serve() -> None:
        with interrupts:
            with pytest.raises(KeyboardInterrupt):
                come()
            come()  # right behind it
            interrupts.begin_to_serve()
            come()
            interrupts.end()
            come(often=2)
            done.append("written")

    def fail() -> None:
        with interrupts:
            interrupts.end()
            come()
            raise OSError("full")

    with pytest.raises(KeyboardInterrupt):
        serve()
    assert done == ["closed", "written"]
    with pytest.raises(OSError, match="full"):  # what could not be written is told
        fail()


@pytest.mark.parametrize("output", ["--sheet", "--record"])
def test_what_cannot_be_written_is_told_before_anybody_works(
    output: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    from polycnc.cli import main

    file = tmp_path / "missing" / "file"
    with socket.create_server(("127.0.0.1", 0)) as taken, pytest.raises(SystemExit):
        main(["panel", "--control", "fanuc-m", output, str(file), "--port", str(taken.getsockname()[1])])
    assert capsys.readouterr().err == f"polycnc: {file}: there is no such file or folder\n"
    assert not file.parent.exists()


def test_an_exercise_is_served_and_its_sheet_and_record_are_written(tmp_path: Path) -> None:
    exercises = Path(__file__).parents[3] / "examples" / "exercises.yaml"
    words = ["--exercise", f"{exercises}#low-air", "--sheet", "sheet.md", "--record", "session.jsonl"]
    with served(tmp_path, *words) as address:
        assert asyncio.run(talk(address, {"do": "press", "with": {"keys": ["START"]}})) == [{"ok": None}]
        assert "1051" in sheet_with(address, "1051")
    assert "2. [x]" in (tmp_path / "sheet.md").read_text(encoding="utf-8")
    recorded = (tmp_path / "session.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line).get("do") for line in recorded] == [None, "press"]
    with served(tmp_path, "--exercise", f"{exercises}#low-air", "--replay", "session.jsonl") as address:
        assert "1051" in sheet_with(address, "1051")
