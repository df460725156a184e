"""Journeys through the page in headless Chromium; skipped where none is installed."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

from tests.panel.web.browser import CHROMIUM, browser
from tests.panel.web.test_server import address, free_port

pytest.importorskip("nicegui")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
__all__ = ["address"]
#: The npm package axe-core, in the folder that AXE names or in that of the project; None where it is in neither.
_PLACES = (Path(os.environ.get("AXE", ".")), Path(__file__).parents[3])
AXE = next(
    (file for place in _PLACES if (file := place / "node_modules" / "axe-core" / "axe.min.js").is_file()),
    None,
)
#: Texts of keys that do not fit into them.
_CUT = """[...document.querySelectorAll('button.k')]
  .filter(key => key.scrollWidth > key.clientWidth + 1 || key.scrollHeight > key.clientHeight + 1)
  .map(key => key.innerText)"""
#: Nothing of the page lies outside of the window.
_FITS = "document.documentElement.scrollHeight <= innerHeight && document.documentElement.scrollWidth <= innerWidth"
_SCREEN = "document.querySelector('.crt-body').innerText"


def test_a_program_is_run_edited_and_shown_in_both_languages(address: str, tmp_path: Path) -> None:
    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile", free_port()) as page:
            await page.press("Cycle start (SW4)")
            await page.until(f"{_SCREEN}.includes('5.000')")
            assert await page.evaluate(_FITS)
            assert await page.evaluate(_CUT) == []
            await page.press("PROG")
            await page.press("✎")
            await page.until("!!document.querySelector('.editor .cm-content .nc-code')")
            await page.press("Save")
            await page.until("document.querySelector('.editor-said').innerText.includes('O0007')")
            await page.press("Close")
            await page.until("!document.querySelector('.editor')")
            await page.press("中")
            await page.until(f"{_SCREEN}.includes('程式')")
            assert await page.evaluate(_FITS)

    asyncio.run(journey())


def test_the_picture_has_the_path_and_the_trail(address: str, tmp_path: Path) -> None:
    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile", free_port()) as page:
            await page.press("CSTM/GR")
            await page.until("Number(document.querySelector('.picture')?.dataset.points) > 1")
            await page.press("Top")
            await page.press("Feed")
            await page.until("document.querySelector('.picture button.chosen').innerText === 'Feed'")
            if await page.evaluate("!document.querySelector('.picture p')"):  # the browser has WebGL
                shown = "document.querySelector('.picture canvas')"
                assert await page.evaluate(f"{shown}.clientWidth > 300 && {shown}.clientHeight > 150")
            await page.press("POS")
            await page.until("getComputedStyle(document.querySelector('.picture')).display === 'none'")

    asyncio.run(journey())


@pytest.mark.skipif(AXE is None, reason="axe-core is not installed")
def test_axe_finds_nothing_serious(address: str, tmp_path: Path) -> None:
    assert AXE is not None
    rules = "{runOnly: ['wcag2a', 'wcag2aa', 'best-practice']}"
    found = f"""axe.run(document, {rules}).then(result => result.violations
      .filter(each => ['serious', 'critical'].includes(each.impact)).map(each => each.id + ' ' + each.nodes[0].html))"""

    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile", free_port()) as page:
            await page.until("!!document.querySelector('.crt-body td')")
            await page.evaluate(AXE.read_text(encoding="utf-8") + ";0")
            assert await page.evaluate(found) == []
            for key in ("☀", "CSTM/GR", "中", "☑"):
                await page.press(key)
                await asyncio.sleep(1.0)
                wrong = await page.evaluate(found)
                assert wrong == [], f"{key}: {wrong}"

    asyncio.run(journey())
