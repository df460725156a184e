"""The operator panel: how often positions arrive, how soon a lamp follows its key, what a million blocks cost.

Needs the extra `panel`; what is measured in a browser needs Chromium too. Where no graphics card is, Chromium draws
with the processor: pictures in a second are then those of the computer, not of three.js.
"""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from math import sin
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any, Self

from benchmarks.measure import Figure, best_of, rate, skipped
from polycnc.mainrun import VirtualControl
from polycnc.panel.screens.screen import Screen

#: Lines of 0.2 mm at 6 m/min: the worst case of the main run. `LONG` blocks are a long program.
LINES, LONG = 20_000, 1_000_000
LOOKS_S, TIMES = 5.0, 15
#: Ticks of the server in a second, and pages that look, behind every second one.
TICKS_HZ, PAGES = 50, 3
UPDATES_HZ, LAMP_S, SEARCH_S, PICTURES_HZ = 20.0, 0.1, 0.2, 20.0
_MEASURED_UPDATES = """new Promise(done => { let n = 0;
  new MutationObserver(() => n += 1).observe(document.querySelector('.crt-body'),
    {childList: true, subtree: true, characterData: true});
  setTimeout(() => done(n / %s), 1000 * %s); })"""
_PRESSED = """new Promise(done => { const key = [...document.querySelectorAll('button.k')].find(
    each => each.innerText.trim() === 'Optional stop'), was = key.classList.contains('lit'), began = performance.now();
  new MutationObserver((_, self) => { if (key.classList.contains('lit') !== was) { self.disconnect();
    done((performance.now() - began) / 1000); } }).observe(key, {attributes: true});
  key.click(); })"""
_PICTURE = "getElement(Number(document.querySelector('.picture').id.slice(1)))"


def lines_of(count: int) -> str:
    """A program of short lines, there and back over waves."""
    rows = (
        f"X{0.2 * (i % 400 if i // 400 % 2 == 0 else 400 - i % 400):.3f} Y{i * 1e-4:.4f} Z{2 * sin(0.05 * i):.3f}\n"
        for i in range(count)
    )
    return "O1\nG90 G0 X0 Y0\nG1 F6000\n" + "".join(rows) + "M30\n"


def long_program() -> Iterator[Figure]:
    """A million blocks opened, scrolled and searched on the screen."""
    text = lines_of(LONG)
    control = VirtualControl("fanuc-m")
    began = perf_counter()
    control.load(text)
    screen = Screen(control)
    screen.press("PROG")
    screen.view("en")
    yield Figure("a million blocks opened", f"{perf_counter() - began:.2f} s", None)

    def turn() -> None:
        screen.press("PAGE_DOWN")
        screen.view("en")

    scroll = best_of(turn)
    yield Figure("a page of them turned", f"{1e3 * scroll:.2f} ms", None)

    def search() -> None:
        screen.program_row = 0
        screen.find("M30", 1)

    found = best_of(search)
    yield Figure(
        "a text searched through all of them",
        f"{1e3 * found:.0f} ms, limit {1e3 * SEARCH_S:g}",
        SEARCH_S / found,
    )


def processor() -> Iterator[Figure]:
    """What the server needs for a second of short lines in real time while three pages look, without the network."""
    from polycnc.panel.web.desk import Desk
    from polycnc.panel.web.markup import cells_of, of_view

    desk = Desk(VirtualControl("fanuc-m"))
    desk.control.load(lines_of(LINES))
    desk.press("START")
    desk.control.step(1.0)
    began = process_time()
    for tick in range(2 * TICKS_HZ):
        desk.control.step(1.0 / TICKS_HZ)
        desk.course.note(desk.control.snapshot)
        desk.screen.follow()
        desk.follow()
        for _ in range(PAGES if tick % 2 == 0 else 0):
            look = desk.look("en")
            of_view(look.view, empty=True)
            cells_of(look.view)
    needs = (process_time() - began) / 2
    yield Figure("processor for 0.2 mm lines, three pages", f"{needs:.2f} s a second, limit 1", 1.0 / needs)


def page() -> Iterator[Figure]:
    """The page in a browser while short lines run in real time, and its picture."""
    try:
        import nicegui  # noqa: F401 - the extra `panel`
        from tests.panel.web.browser import CHROMIUM
    except ImportError:
        yield skipped("the panel", "the extra panel is not installed")
        return
    if CHROMIUM is None:
        yield skipped("the panel in a browser", "no Chromium is installed")
        return
    with TemporaryDirectory() as folder:
        measured = asyncio.run(_measure(Path(folder)))
    yield rate("updates of the page while 0.2 mm lines run", measured["updates"], UPDATES_HZ, "Hz")
    yield Figure(
        "from a key to its lamp",
        f"{1e3 * measured['lamp']:.0f} ms, limit {1e3 * LAMP_S:g}",
        LAMP_S / measured["lamp"],
    )
    yield Figure(
        "simulated seconds in a second, three looking", f"{measured['pace']:.3f}", measured["pace"] / 0.98
    )
    yield Figure("three looking see the same", f"{measured['same']:.0%} of looks", measured["same"])
    points, turned = f"{measured['points']:,.0f} points", measured["pictures"]
    yield rate(f"a picture of {points} while it turns", turned, PICTURES_HZ, "Hz")
    yield Figure("of them drawn while it turns", f"{measured['segments']:,.0f}", None)
    yield Figure(f"all {points} drawn, as when it rests", f"{1.0 / measured['exact']:.2f} s", None)
    yield Figure("the page's own thread for a picture of all", f"{measured['script']:.2f} ms", None)


async def _measure(folder: Path) -> dict[str, float]:
    from tests.panel.web.browser import browser

    found: dict[str, float] = {}
    async with (
        _Server(folder, lines_of(LINES)) as server,
        browser(server.url, folder / "a") as seen,
    ):
        await seen.press("Safety key")
        await seen.press("Cycle start (SW4)")
        await asyncio.sleep(1.0)
        found["updates"] = await seen.evaluate(_MEASURED_UPDATES % (LOOKS_S, LOOKS_S))
        found["lamp"] = median([await seen.evaluate(_PRESSED) for _ in range(TIMES)])
        found |= await _three(server)
    async with (
        _Server(folder, lines_of(LONG)) as server,
        browser(server.url, folder / "b") as seen,
    ):
        await seen.press("CSTM/GR")
        await seen.until(f"{_PICTURE}.points >= {LONG}")
        found["points"] = await seen.evaluate(f"{_PICTURE}.points")
        turned = await seen.evaluate(f"{_PICTURE}.pace(3)")
        still = await seen.evaluate(f"{_PICTURE}.pace(3, false)")
        found |= {"pictures": turned["pictures"], "segments": turned["segments"]}
        found |= {"exact": still["pictures"], "script": still["script"]}
    return found


async def _three(server: _Server) -> dict[str, float]:
    """Three clients look at once: whether they see the same, and how fast simulated time passes."""
    from websockets.asyncio.client import connect

    async with connect(server.wire) as one, connect(server.wire) as two, connect(server.wire) as three:

        async def look() -> list[Any]:
            for wire in (one, two, three):
                await wire.send('{"do": "snapshot"}')
            return [json.loads(await wire.recv())["ok"] for wire in (one, two, three)]

        began, (first, *_) = perf_counter(), await look()
        same = looks = 0
        while perf_counter() - began < LOOKS_S:
            shown = await look()
            looks += 1
            same += all(each["time"] - shown[0]["time"] <= 0.05 for each in shown)
            await asyncio.sleep(0.02)
        passed, (last, *_) = perf_counter() - began, await look()
    return {"same": same / looks, "pace": (last["time"] - first["time"]) / passed}


class _Server:
    """A server of a FANUC control with a program, in a process of its own."""

    def __init__(self, folder: Path, program: str) -> None:
        from tests.panel.web.test_server import free_port

        self._file, port = folder / "lines.nc", free_port()
        self._file.write_text(program, encoding="utf-8")
        self._address = f"127.0.0.1:{port}"
        self.url, self.wire = f"http://{self._address}/", f"ws://{self._address}/api/fanuc-m"
        self._command = [sys.executable, "-m", "polycnc", "panel", str(self._file), "--control", "fanuc-m"]
        self._command += ["--no-open", "--port", str(port)]

    async def __aenter__(self) -> Self:
        from tests.panel.web.test_server import status

        self._process = subprocess.Popen(self._command, stdout=subprocess.DEVNULL, env=dict(os.environ))
        while status(self._address) == 0:
            await asyncio.sleep(0.2)
        return self

    async def __aexit__(self, *_: object) -> None:
        self._process.terminate()
        self._process.wait()


if __name__ == "__main__":
    for benchmark in (long_program, processor, page):
        for figure in benchmark():
            print(f"{figure.name}: {figure.said}", flush=True)
