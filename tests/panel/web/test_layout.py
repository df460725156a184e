"""How the page of every family lies on screens and tablets, and how Tab goes through it; in headless Chromium."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import pytest

from polycnc.panel.description import PANELS
from tests.panel.web.browser import CHROMIUM, browser
from tests.panel.web.test_server import served

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.panel.web.browser import Browser

pytest.importorskip("nicegui")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
#: Screens, and tablets held either way.
SIZES = ((1280, 800), (1920, 1080), (1024, 768), (768, 1024))
#: Smallest key that a finger hits, pixels.
FINGER = 40
_READY = "!!document.querySelector('.crt-body td') && !!document.querySelector('.lamps')"
_OVERFLOW = (
    "[document.documentElement.scrollWidth - innerWidth, document.documentElement.scrollHeight - innerHeight]"
)
#: Texts of keys that do not fit into them, or keys that lie outside of the page.
_CUT = """[...document.querySelectorAll('button.k, select.dial')]
  .filter(key => key.offsetParent !== null).filter(key => {
    const box = key.getBoundingClientRect();
    return key.scrollWidth > key.clientWidth + 1 || key.scrollHeight > key.clientHeight + 1
      || box.left < -1 || box.right > innerWidth + 1;
  }).map(key => key.innerText)"""
_SMALL = """[...document.querySelectorAll('button.k, select.dial')].filter(key => key.offsetParent !== null)
  .filter(key => key.offsetHeight < %d).map(key => key.innerText + ' ' + key.offsetHeight)"""
#: Keys that lie one upon another.
_COVERED = """[...document.querySelectorAll('button.k')].filter(key => key.offsetParent !== null).filter(key => {
    const box = key.getBoundingClientRect(), x = box.left + box.width / 2, y = box.top + box.height / 2;
    const there = document.elementFromPoint(x, y);
    return y < innerHeight && !key.contains(there) && !there?.closest('.commands');
  }).map(key => key.innerText)"""
#: What can be reached by Tab, with its number in reading order: halves, then groups, then rows, then from the left.
_ORDER = """(() => {
  const all = [...document.querySelectorAll('button, select, input, a[href], [tabindex]')]
    .filter(each => each.offsetParent !== null && each.tabIndex >= 0 && !each.disabled);
  all.forEach((each, place) => { each.dataset.place = place; });
  const wrong = [];
  for (let at = 1; at < all.length; at++) {
    const one = all[at - 1], two = all[at];
    if (one.parentElement !== two.parentElement) continue;
    const a = one.getBoundingClientRect(), b = two.getBoundingClientRect();
    const same = Math.abs(a.top - b.top) < 0.5 * Math.min(a.height, b.height);
    if (same ? b.left < a.left : b.top < a.top) wrong.push(one.innerText + ' > ' + two.innerText);
  }
  return [all.length, all.filter(each => each.tabIndex > 0).length, wrong];
})()"""
_FOCUS = "Number(document.activeElement?.dataset?.place ?? -1)"
#: Where each half, group and row begins: their order on the screen must be that of Tab.
_GROUPS = """(() => {
  const halves = [...document.querySelectorAll('.desk > .half')];
  const isThere = each => each.offsetParent !== null && each.querySelector('button, select');
  const groups = halves.map(half => [...half.children].filter(isThere)
    .map(each => each.getBoundingClientRect().top));
  return [halves.map(half => half.getBoundingClientRect()).map(box => [box.left, box.top]), groups];
})()"""


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A server with every control."""
    words = [word for control in PANELS for word in ("--control", control)]
    with served(tmp_path_factory.mktemp("layout"), *words) as found:
        yield found


async def faults(page: Browser, control: str, width: int, height: int) -> list[str]:
    """What stays wrong with the page at this size."""
    await page.sized(width, height)
    await page.until(f"innerWidth === {width} && innerHeight === {height}")
    found: list[str] = []
    for _ in range(30):  # the page is laid out anew a moment later
        found = await look(page, f"{control} {width} × {height}", width, height)
        if not found:
            break
        await asyncio.sleep(0.1)
    return found


async def look(page: Browser, where: str, width: int, height: int) -> list[str]:
    """What is wrong with the page now."""
    wide, high = await page.evaluate(_OVERFLOW)
    found = [f"{where}: {wide} pixels too wide"] if wide > 0 else []
    if width >= 1280 and high > 0:
        found.append(f"{where}: {high} pixels too high")
    found += [f"{where}: {key!r} is cut" for key in await page.evaluate(_CUT)]
    found += [f"{where}: {key!r} is too small" for key in await page.evaluate(_SMALL % FINGER)]
    found += [f"{where}: {key!r} is covered" for key in await page.evaluate(_COVERED)]
    for _ in range(2):  # at the top, and as far down as it goes
        start = "document.querySelector('.commands').getBoundingClientRect()"
        top, bottom = await page.evaluate(f"[{start}.top, {start}.bottom]")
        if width > 1000 and not 0 <= top < bottom <= height + 1:
            found.append(f"{where}: cycle start and emergency stop are out of sight")
        await page.evaluate("scrollTo(0, document.documentElement.scrollHeight), 0")
    await page.evaluate("scrollTo(0, 0), 0")
    crt = await page.evaluate("document.querySelector('.crt').getBoundingClientRect().height")
    return found + ([f"{where}: the screen is {crt} pixels high"] if crt < 370 else [])


@pytest.mark.parametrize("lang", ["EN", "中"])
def test_the_page_of_every_family_fits_into_screens_and_tablets(
    address: str, tmp_path: Path, lang: str
) -> None:
    found: list[str] = []

    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile") as page:
            for control in PANELS:
                await page.goes_to(f"http://{address}/{control}")
                await page.until(_READY)
                await page.press(lang)
                await page.until(f"document.documentElement.lang === '{'en' if lang == 'EN' else 'zh-TW'}'")
                await page.until(_READY)
                for width, height in SIZES:
                    found.extend(await faults(page, control, width, height))

    asyncio.run(journey())
    assert not found, "\n".join(found)


def test_tab_goes_through_the_page_in_reading_order(address: str, tmp_path: Path) -> None:
    async def journey() -> None:
        async with browser(f"http://{address}/", tmp_path / "profile") as page:
            for control in PANELS:
                await page.goes_to(f"http://{address}/{control}")
                await page.until(_READY)
                count, ahead, wrong = await page.evaluate(_ORDER)
                assert (ahead, wrong) == (0, []), control
                assert count > 50
                (left, right), groups = await page.evaluate(_GROUPS)
                assert left[0] < right[0]
                assert all(tops == sorted(tops) for tops in groups), control
                await page.evaluate("document.activeElement?.blur(), 0")
                visited = []
                for _ in range(count):
                    for kind in ("rawKeyDown", "keyUp"):
                        await page.ask(
                            "Input.dispatchKeyEvent",
                            type=kind,
                            key="Tab",
                            code="Tab",
                            windowsVirtualKeyCode=9,
                        )
                    visited.append(await page.evaluate(_FOCUS))
                places = [place for place in visited if place >= 0]
                assert places == list(range(count)), control

    asyncio.run(journey())
