"""Pictures of the panel for its documentation: `python -m tests.panel.web.shots docs/panel`.

Every family runs its example; a picture has the name of the control, of what it shows and of the language.
"""

from __future__ import annotations

import asyncio
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.panel.web.browser import browser
from tests.panel.web.test_server import free_port, status

EXAMPLES = Path(__file__).parents[3] / "examples"
#: What is shown of each control: name, keys that lead there, language; while its example runs.
SHOTS = {
    ("fanuc-m", "bracket"): (("position", "POS", "EN"), ("picture", "CSTM/GR", "EN"), ("program", "PROG", "中")),
    ("meldas-m", "plate"): (("position", "MONITOR", "EN"), ("tools", "TOOL/PARAM", "中")),
    ("fanuc-0i-tf", "shaft"): (("geometry", "OFS/SET", "中"), ("picture", "CSTM/GR", "EN")),
    ("sinumerik-840d", "cover"): (("machine", "MACHINE", "EN"), ("search", "MACHINE > Block search", "EN"),
                                  ("alarms", "ALARM", "中")),
    ("syntec-mill", "plate"): (("coordinates", "COOR", "中"), ("restart", "PROG > Restart", "EN")),
}  # fmt: skip
#: A fault comes over the wire.
_FAULT = """new Promise(done => { const wire = new WebSocket(`ws://${location.host}/api/%s`);
  wire.onopen = () => wire.send('{"do": "fault", "with": {"name": "tool"}}'); wire.onmessage = done; }).then(() => 0)"""
_LANGUAGES = {"EN": "en", "中": "zh-TW"}


async def shoot(control: str, example: str, folder: Path) -> None:
    """Take the pictures of a control."""
    file = next(EXAMPLES.glob(f"{control}-{example}.*c")) if control != "sinumerik-840d" else None
    file = file or EXAMPLES / f"{control}-{example}.mpf"
    setup = file.with_name(f"{file.stem}.setup.yaml")
    port = free_port()
    words = ["panel", str(file), "--control", control, "--no-open", "--port", str(port), "--speed", "2"]
    words += ["--setup", str(setup)] if setup.exists() else []
    server = subprocess.Popen([sys.executable, "-m", "polycnc", *words], stdout=subprocess.DEVNULL)
    try:
        while status(f"127.0.0.1:{port}") == 0:
            await asyncio.sleep(0.2)
        with TemporaryDirectory() as profile:
            async with browser(f"http://127.0.0.1:{port}/", Path(profile)) as page:
                await page.until("!!document.querySelector('.crt-body td')")
                await page.evaluate("document.querySelector('button.k.start').click()")
                await asyncio.sleep(6.0)
                for name, keys, lang in SHOTS[control, example]:
                    if name == "alarms":
                        await page.evaluate(_FAULT % control)
                    await page.press(lang)
                    await page.until(f"document.documentElement.lang === '{_LANGUAGES[lang]}'")
                    for key in keys.split(" > "):
                        await asyncio.sleep(1.0)
                        await page.press(key)
                    if name == "picture":
                        await page.until("Number(document.querySelector('.picture').dataset.points) > 50")
                    await asyncio.sleep(3.0)
                    await page.screenshot(folder / f"{control}-{name}-{_LANGUAGES[lang]}.png")
    finally:
        server.terminate()
        server.wait()


if __name__ == "__main__":
    for control, example in SHOTS:
        if not sys.argv[2:] or control in sys.argv[2:]:
            asyncio.run(shoot(control, example, Path(sys.argv[1])))
