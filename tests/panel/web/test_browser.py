"""Journeys through the page in headless Chromium; skipped where none is installed."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

from tests.panel.web.browser import CHROMIUM, browser
from tests.panel.web.test_server import address

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
#: A line of 20,000 points with two kinds, made coarser: how many points are left, how far one that is left out is from
#: the chord in its place at most, whether ends of kinds are still there, and what is drawn at rest.
_COARSE = """(() => { const found = document.querySelector('.picture').id.slice(1);
  const line = getElement(Number(found)).held.path, count = 20000, points = new Float32Array(5 * count);
  for (let i = 0; i < count; i++) points.set([50 * Math.cos(i / 500), 50 * Math.sin(i / 500), i / 1000, 600,
    i % 5000 < 100 ? 0 : 1], 5 * i);
  line.add(0, points); line.coarse = null;
  const shown = line.show(0.05), index = line.coarse.index, kept = new Set(index.subarray(0, shown));
  let worst = 0;
  for (let k = 1; k < shown; k++) for (let i = index[k - 1] + 1; i < index[k]; i++) {
    const [a, b, c] = [index[k - 1], index[k], i].map(n => points.subarray(5 * n, 5 * n + 3));
    const chord = [0, 1, 2].map(n => b[n] - a[n]), way = [0, 1, 2].map(n => c[n] - a[n]);
    const long = chord.reduce((s, v) => s + v * v, 0), part = chord.reduce((s, v, n) => s + v * way[n], 0) / long;
    worst = Math.max(worst, Math.hypot(...way.map((v, n) => v - part * chord[n])));
  }
  const ends = [99, 4999, 5099, 19999].every(i => kept.has(i)), rough = line.rough.visible && !line.mesh.visible;
  return {shown, worst, ends, rough, rest: line.show(0), exact: line.mesh.visible && !line.rough.visible};
})()"""
#: Three quick clicks on the keys of the languages.
_THREE_CLICKS = """for (const said of ['EN', '中', 'EN'])
  [...document.querySelectorAll('button.k')].find(key => key.innerText.trim() === said).click()"""
_SCREEN = "document.querySelector('.crt-body').innerText"


def test_a_program_is_run_edited_and_shown_in_both_languages(address: str, tmp_path: Path) -> None:
    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile") as page:
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
            await page.evaluate(_THREE_CLICKS)
            await page.until(f"{_SCREEN}.includes('PROGRAM') && document.documentElement.lang === 'en'")

    asyncio.run(journey())


def test_the_picture_has_the_path_and_the_trail(address: str, tmp_path: Path) -> None:
    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile") as page:
            await page.press("CSTM/GR")
            await page.until("Number(document.querySelector('.picture')?.dataset.points) > 1")
            await page.press("Top")
            await page.press("Feed")
            await page.until("document.querySelector('.picture button.chosen').innerText === 'Feed'")
            if await page.evaluate("!document.querySelector('.picture p')"):  # the browser has WebGL
                shown = "document.querySelector('.picture canvas')"
                assert await page.evaluate(f"{shown}.clientWidth > 300 && {shown}.clientHeight > 150")
                coarse = await page.evaluate(_COARSE)
                assert coarse["shown"] < 2000
                assert 0.0 < coarse["worst"] <= 0.1
                assert coarse["ends"]
                assert coarse["rough"]
                assert (coarse["rest"], coarse["exact"]) == (20000, True)
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
        async with browser(f"http://{address}/", tmp_path / "profile") as page:
            await page.until("!!document.querySelector('.crt-body td')")
            await page.evaluate(AXE.read_text(encoding="utf-8") + ";0")
            assert await page.evaluate(found) == []
            for key in ("☀", "CSTM/GR", "中", "☑"):
                await page.press(key)
                await asyncio.sleep(1.0)
                wrong = await page.evaluate(found)
                assert wrong == [], f"{key}: {wrong}"

    asyncio.run(journey())
