"""The example of the documentation runs, and gives what it says."""

from __future__ import annotations

import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import polycnc
from polycnc.mainrun import Command, VirtualControl

PAGE = Path(__file__).parents[2] / "docs" / "virtual-control.md"


def test_the_example_prints_what_the_page_shows() -> None:
    code, shown = re.findall(r"```(?:python)?\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[:2]
    printed = StringIO()
    with redirect_stdout(printed):
        exec(compile(code, PAGE.name, "exec"), {})
    assert printed.getvalue() == shown


def test_every_command_is_told() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for command in set(Command) - {Command.MACHINE_LOCK}:
        assert f"`{command}(" in page, command


def test_the_class_is_handed_out_by_the_package() -> None:
    assert polycnc.VirtualControl is VirtualControl
