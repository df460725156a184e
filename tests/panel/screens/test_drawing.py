"""What a program draws into the picture: SETDRAW and DRAWHOLE of SYNTEC."""

from __future__ import annotations

from array import array
from itertools import product
from math import dist

import pytest

from polycnc.messages.catalogue import LANGUAGES
from polycnc.view.lines import FEED, KINDS, WIDTH, Lines
from polycnc.view.rows import CHORDS
from tests.panel.bench import Bench

PROGRAM = """%@MACRO
G00 X10. Y5.;
#1 := SETDRAW(255, 1, 4.);
DRAWHOLE();
#2 := SETDRAW(65280);
G01 X20. F1000;
@1 := #2;
M30;
"""


def points(lines: Lines) -> list[tuple[float, ...]]:
    found = array("f", lines.part(0, len(lines)))
    return [tuple(found[i : i + WIDTH]) for i in range(0, len(found), WIDTH)]


@pytest.mark.feature("synm.fn_draw", control="syntec-mill")
@pytest.mark.parametrize(("lang", "line"), list(product(LANGUAGES, ("path", "trail"))))
def test_colour_and_circle_of_a_program_stand_in_the_picture(lang: str, line: str) -> None:
    panel = Bench("syntec-mill", lang, PROGRAM)
    panel.keys("COOR")
    panel.soft("Back", "返回")
    panel.soft("Graph", "路徑")
    assert panel.screen.shows("graph")
    for _ in range(50):
        panel.course.go_on()
    panel.press("START")
    for _ in range(100):
        panel.control.step(0.04)
        panel.course.note(panel.control.snapshot)
    assert panel.control.parts == 1
    assert panel.control.read_variable("@1") == 255
    lines = panel.course.lines[line]
    red, green = lines.colour("#ff0000"), lines.colour("#00ff00")
    assert lines.tools[green] == "#00ff00"
    rim = [
        p
        for p in points(lines)
        if int(p[4]) // KINDS == red and dist(p[:2], (10.0, 5.0)) == pytest.approx(4.0, abs=1e-3)
    ]
    assert len(rim) == 2 * (CHORDS + 1)  # filled: every chord with a spoke
    cut = [p for p in points(lines) if int(p[4]) == FEED + KINDS * green]
    assert cut[-1][:3] == pytest.approx((20.0, 5.0, 0.0), abs=1e-3)


def test_what_a_program_draws_is_no_block_for_single_block() -> None:
    panel = Bench("syntec-mill", "en", PROGRAM)
    panel.control.set_switches(single_block=True)
    halts = 0
    while panel.control.parts == 0:
        panel.start()
        halts += 1
        assert halts < 9
    assert halts <= 4
