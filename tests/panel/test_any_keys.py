"""Whatever is pressed, the screens of the word-address controls answer: with a page, or with what they refuse."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pytest

from polycnc.mainrun import State

from .bench import Bench

if TYPE_CHECKING:
    from pathlib import Path

TYPED = ["1.5", "X2.", "A.TXT", "P.NC", "-3", "Y", "1;2;3", "5240", "N5", "1+2*3"]
EDITING = [
    "SHIFT",
    "CAN",
    "INPUT",
    "INSERT",
    "ALTER",
    "DELETE",
    "MENU",
    "RETURN",
    "PAGE_UP",
    "PAGE_DOWN",
    "RESET",
]


def pressed(bench: Bench, random: Random) -> None:
    """One thing that a hand could do."""
    kind = random.random()
    family = bench.screen.family
    if kind < 0.4:
        bench.screen.press(
            random.choice([*family.keys, *family.dual, *EDITING, "UP", "DOWN", "LEFT", "RIGHT"])
        )
    elif kind < 0.75:
        bench.screen.soft(random.randrange(7))
    elif kind < 0.85:
        bench.screen.type(random.choice(TYPED))
    elif kind < 0.9:
        bench.turn("mode", random.choice([*bench.panel.description.modes]))
    elif kind < 0.95:
        bench.press("C8", random.choice([*bench.panel.description.keys, "X+", "Z-"]))
        bench.release()
    else:
        bench.passes(0.3)


@pytest.mark.parametrize("lang", ["en", "zh-TW"])
@pytest.mark.parametrize(
    ("control", "machine"), [("fanuc-m", "hartford"), ("meldas-m", "hartford"), ("fanuc-0i-tf", "lathe-yab")]
)
def test_any_keys_end_in_a_page(control: str, machine: str, lang: str, tmp_path: Path) -> None:
    (tmp_path / "A.TXT").write_text("%\nG10 P01 Y1. ;\n%\n")
    (tmp_path / "P.NC").write_text("%\nO5\nG0X1.\nM30\n%\n")
    program = "O1\nN5 G0 X1.\nM0\nM30\n"
    bench = Bench(control, lang, program, card=tmp_path, machine=machine)
    random = Random(f"{control} {lang}")
    for _ in range(500):
        pressed(bench, random)
        assert bench.view.title
        if bench.state() is State.OFF:
            bench.press("POWER_ON")
            bench.control.run()
