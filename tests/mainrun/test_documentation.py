"""The example of the documentation runs, and gives what it says."""

from __future__ import annotations

import polycnc
from polycnc.mainrun import Command, VirtualControl
from tests.pages import example, page


def test_the_example_prints_what_the_page_shows() -> None:
    printed, shown = example("virtual-control.md")
    assert printed == shown


def test_every_command_is_told() -> None:
    told = page("virtual-control.md")
    for command in set(Command) - {Command.MACHINE_LOCK, Command.HANDWHEEL_OFFSET}:
        assert f"`{command}(" in told, command


def test_the_class_is_handed_out_by_the_package() -> None:
    assert polycnc.VirtualControl is VirtualControl
