"""`polycnc plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

from tests.cli.console import BAD, GOOD

if TYPE_CHECKING:
    from tests.cli.console import Console
FANUC = ("--control", "fanuc-m")


def test_a_drawing_is_svg(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("plot", "good.nc", *FANUC, "-o", "good.svg")
    assert (said.status, said.err) == (0, "")
    root = ElementTree.parse(console.folder / "good.svg").getroot()
    views = {group.get("id") for group in root.iter("{http://www.w3.org/2000/svg}g")} - {None}
    assert views == {"view-xy", "view-xz", "view-yz"}


def test_the_view_can_be_chosen(console: Console) -> None:
    console.file("good.nc", GOOD)
    console("plot", "good.nc", *FANUC, "-o", "good.svg", "--view", "xy")
    assert 'id="view-xz"' not in (console.folder / "good.svg").read_text(encoding="utf-8")


def test_a_program_that_alarms_is_drawn_up_to_the_alarm(console: Console) -> None:
    console.file("bad.nc", BAD)
    said = console("plot", "bad.nc", *FANUC, "-o", "bad.svg")
    assert said.status == 1
    assert "PS0010" in said.err
    assert (console.folder / "bad.svg").exists()


def test_a_picture_without_its_library_says_what_to_install(
    console: Console, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "resvg_py", None)
    console.file("good.nc", GOOD)
    said = console("plot", "good.nc", *FANUC, "-o", "good.png")
    assert said.status == 2
    assert "polycnc[png]" in said.err
    assert not (console.folder / "good.png").exists()


def test_a_picture_is_png(console: Console) -> None:
    pytest.importorskip("resvg_py")
    console.file("good.nc", GOOD)
    assert console("plot", "good.nc", *FANUC, "-o", "good.png").status == 0
    assert (console.folder / "good.png").read_bytes().startswith(b"\x89PNG")
