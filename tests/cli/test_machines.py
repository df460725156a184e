"""`polycnc machines`."""

from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING

from polycnc.machine import builtin_ids
from tests.cli.console import GOOD

if TYPE_CHECKING:
    from tests.cli.console import Console
FANUC = ("--control", "fanuc-m")


def test_the_built_in_machines_are_listed_one_a_line(console: Console) -> None:
    said = console("machines")
    assert [line.split()[0] for line in said.out.splitlines()] == list(builtin_ids())


def test_a_machine_is_shown_as_a_file_that_can_be_used(console: Console) -> None:
    shown = console("machines", "show", "mill3").out
    assert tomllib.loads(shown)["axis"]["X"]["kind"] == "linear"
    console.file("copy.toml", shown)
    console.file("good.nc", GOOD)
    assert console("run", "good.nc", *FANUC, "--machine", "copy.toml").status == 0
