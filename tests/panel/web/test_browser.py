"""Journeys through the page in headless Chromium; skipped where none is installed."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import pytest

from tests.panel.web.browser import CHROMIUM, browser
from tests.panel.web.test_server import address, free_port

if TYPE_CHECKING:
    from pathlib import Path

pytest.importorskip("nicegui")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
__all__ = ["address"]
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
