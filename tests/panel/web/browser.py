"""A headless Chromium that looks at a page: it is talked to by its own protocol."""

from __future__ import annotations

import asyncio
import base64
import json
import shutil
import subprocess
import urllib.request
from contextlib import asynccontextmanager
from time import monotonic
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import AsyncIterator
    from pathlib import Path

#: The browser of the system; None where there is none.
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
#: A busy machine is slow.
PATIENCE_S = 60.0
_WORDS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
    "--disable-background-networking", "--disable-component-update", "--hide-scrollbars",
)  # fmt: skip
#: A key of the page by what stands on it.
_KEY = "[...document.querySelectorAll('button.k')].find(key => key.innerText.trim() === {label})"


class Browser:
    """A page that is open in a browser; made by `browser`."""

    def __init__(self, wire: Any) -> None:
        self._wire, self._number = wire, 0

    async def ask(self, method: str, **given: Any) -> Any:
        """Ask the browser something; gives its answer."""
        self._number += 1
        await self._wire.send(json.dumps({"id": self._number, "method": method, "params": given}))
        while (answer := json.loads(await self._wire.recv())).get("id") != self._number:
            pass
        return answer.get("result", answer)

    async def evaluate(self, expression: str) -> Any:
        """The value of an expression of JavaScript, which may be a promise."""
        answer = await self.ask(
            "Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True
        )
        assert "exceptionDetails" not in answer, answer
        assert "result" in answer, answer
        return answer["result"].get("value")

    async def until(self, condition: str) -> None:
        """Wait until an expression is true."""
        end = monotonic() + PATIENCE_S
        while not await self.evaluate(condition):
            assert monotonic() < end, condition
            await asyncio.sleep(0.1)

    async def press(self, label: str) -> None:
        """Press the key of the page on which something stands."""
        key = _KEY.format(label=json.dumps(label))
        await self.until(f"!!{key}")
        await self.evaluate(f"{key}.click()")

    async def sized(self, width: int, height: int) -> None:
        """Give the window a size."""
        await self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    async def goes_to(self, url: str) -> None:
        """Open another page."""
        await self.ask("Page.navigate", url=url)
        await self.until("document.readyState === 'complete'")

    async def screenshot(self, path: Path) -> None:
        """Write what is to be seen as PNG."""
        shot = await self.ask("Page.captureScreenshot", format="png")
        path.write_bytes(base64.b64decode(shot["data"]))


@asynccontextmanager
async def browser(url: str, profile: Path) -> AsyncIterator[Browser]:
    """A page in a new browser, which ends with the block.

    Args:
        url: The page.
        profile: Folder for what the browser keeps.
    """
    from websockets.asyncio.client import connect

    assert CHROMIUM is not None
    words = [CHROMIUM, *_WORDS, "--remote-debugging-port=0", f"--user-data-dir={profile}", url]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        async with connect(await _page(profile), max_size=None) as wire:
            opened = Browser(wire)
            await opened.sized(1280, 800)
            await opened.until("window.did_handshake === true")  # on a busy machine a page may come twice
            yield opened
    finally:
        process.terminate()
        process.wait(timeout=PATIENCE_S)


async def _page(profile: Path) -> str:
    """Where a page talks its protocol; the browser has chosen a port and written it down."""
    told = profile / "DevToolsActivePort"
    end = monotonic() + PATIENCE_S
    while monotonic() < end:
        try:
            port = int(told.read_text(encoding="ascii").split("\n")[0])
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json", timeout=PATIENCE_S) as listed:
                pages = [each for each in json.load(listed) if each["type"] == "page"]
            if pages:
                return str(pages[0]["webSocketDebuggerUrl"])
        except (OSError, ValueError):  # it has not yet
            pass
        await asyncio.sleep(0.2)
    raise AssertionError("the browser does not answer")
