"""Every page of every family, in both languages, fits into its screen at 1280 by 800."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING

import pytest

from polycnc.control.registry import ids
from polycnc.mainrun import VirtualControl
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel.web.desk import Desk
from polycnc.panel.web.markup import of_view
from tests.panel.web.browser import CHROMIUM, browser
from tests.panel.web.test_server import served

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytest.importorskip("nicegui")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
PROGRAM = "".join(f"N{10 * i} G1 X{i}. F1000\n" for i in range(1, 60)) + "M30\n"
#: How far the windows of a page reach below and beside the place that they have, pixels.
_BEYOND = """(() => {
  const body = document.querySelector('.crt-body'), copy = body.cloneNode(false);
  copy.innerHTML = %s;
  body.style.display = 'none';
  body.after(copy);
  const windows = copy.querySelector('.windows'), right = windows.getBoundingClientRect().right;
  const beside = [...copy.querySelectorAll('.window')].map(each => each.getBoundingClientRect().right - right);
  const beyond = [windows.scrollHeight - windows.clientHeight, Math.max(0, ...beside)];
  copy.remove();
  body.style.display = '';
  return beyond;
})()"""


@pytest.fixture
def server(tmp_path: Path) -> Iterator[str]:
    """A server of all controls, each under its own address."""
    words = [word for control in ids() for word in ("--control", control)]
    with served(tmp_path, *words) as found:
        yield found


def pages_of(control: str) -> Iterator[tuple[str, str]]:
    """Every page of a control that runs a program and has an alarm: its name, and its markup in each language."""
    virtual = VirtualControl(control)
    virtual.load(PROGRAM)
    desk = Desk(virtual)
    desk.press("START")
    virtual.step(1.0)
    virtual.signals["OVERTRAVEL"] = 1.0
    for name in desk.screen.family.pages:
        desk.screen.show(name)
        for lang in LANGUAGES:
            yield f"{name} {lang}", of_view(desk.screen.view(lang))


def test_every_page_fits_into_its_screen(server: str, tmp_path: Path) -> None:
    async def journey() -> list[str]:
        beyond = []
        async with browser(f"http://{server}/", tmp_path / "profile") as page:
            assert await page.evaluate("document.querySelectorAll('a').length") == len(ids())
            for control in ids():
                await page.goes_to(f"http://{server}/{control}")
                await page.until("window.did_handshake === true && !!document.querySelector('.crt-body td')")
                for name, markup in pages_of(control):
                    below, beside = await page.evaluate(_BEYOND % json.dumps(markup))
                    if below > 0 or beside > 1:
                        beyond.append(f"{control} {name}: {below} below, {beside} beside")
        return beyond

    assert asyncio.run(journey()) == []
