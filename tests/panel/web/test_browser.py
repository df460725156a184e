"""A journey through the page in headless Chromium; skipped where none is installed."""

from __future__ import annotations

import asyncio
import json
import shutil
import subprocess
import urllib.request
from time import monotonic
from typing import TYPE_CHECKING, Any

import pytest

from tests.panel.web.test_server import PATIENCE_S, address, free_port

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable
    from pathlib import Path

pytest.importorskip("nicegui")
BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = pytest.mark.skipif(BROWSER is None, reason="no Chromium is installed")
__all__ = ["address"]
#: A key of the page by what stands on it.
_KEY = "[...document.querySelectorAll('button.k')].find(key => key.innerText.trim() === {label})"
#: Texts of keys that do not fit into them.
_CUT = """[...document.querySelectorAll('button.k')]
  .filter(key => key.scrollWidth > key.clientWidth + 1 || key.scrollHeight > key.clientHeight + 1)
  .map(key => key.innerText)"""


async def browse(port: int, journey: Callable[[Callable[[str], Awaitable[Any]]], Awaitable[None]]) -> None:
    """Talk to the page of a browser; the journey gets a function that evaluates JavaScript."""
    from websockets.asyncio.client import connect

    until = monotonic() + PATIENCE_S
    pages: list[Any] = []
    while not pages and monotonic() < until:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json", timeout=5) as listed:
                pages = [each for each in json.load(listed) if each["type"] == "page"]
        except OSError:
            await asyncio.sleep(0.2)
    async with connect(pages[0]["webSocketDebuggerUrl"], max_size=None) as wire:
        number = 0

        async def evaluate(expression: str) -> Any:
            nonlocal number
            number += 1
            given = {"expression": expression, "returnByValue": True}
            await wire.send(json.dumps({"id": number, "method": "Runtime.evaluate", "params": given}))
            while (answer := json.loads(await wire.recv())).get("id") != number:
                pass
            return answer["result"]["result"].get("value")

        await journey(evaluate)


async def until_true(evaluate: Callable[[str], Awaitable[Any]], condition: str) -> None:
    end = monotonic() + PATIENCE_S
    while not await evaluate(condition):
        assert monotonic() < end, condition
        await asyncio.sleep(0.1)


def test_a_program_is_run_edited_and_shown_in_both_languages(address: str, tmp_path: Path) -> None:
    port = free_port()
    assert BROWSER is not None
    browser = subprocess.Popen(
        [BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,900",
         f"--remote-debugging-port={port}", f"--user-data-dir={tmp_path / 'profile'}", f"http://{address}/"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip

    async def journey(evaluate: Callable[[str], Awaitable[Any]]) -> None:
        async def press(label: str) -> None:
            key = _KEY.format(label=json.dumps(label))
            await until_true(evaluate, f"!!{key}")
            await evaluate(f"{key}.click()")

        screen = "document.querySelector('.crt-body').innerText"
        await press("Cycle start (SW4)")
        await until_true(evaluate, f"{screen}.includes('5.000')")
        assert await evaluate("document.documentElement.scrollHeight <= innerHeight")
        assert await evaluate(_CUT) == []
        await press("PROG")
        await press("✎")
        await until_true(evaluate, "!!document.querySelector('.editor .cm-content .nc-code')")
        await press("Save")
        await until_true(evaluate, "document.querySelector('.editor-said').innerText.includes('O0007')")
        await press("Close")
        await until_true(evaluate, "!document.querySelector('.editor')")
        await press("中")
        await until_true(evaluate, f"{screen}.includes('程式')")
        assert await evaluate("document.documentElement.scrollHeight <= innerHeight")

    try:
        asyncio.run(browse(port, journey))
    finally:
        browser.terminate()
        browser.wait(timeout=PATIENCE_S)
