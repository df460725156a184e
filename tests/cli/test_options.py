from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.cli.console import Console

OPENING = [
    "--control",
    "--machine",
    "--setup",
    "--search",
    "--encoding",
    "--block-limit",
    "--no-bulk",
    "--lang",
]


@pytest.mark.parametrize("command", ["run", "check", "plot"])
def test_every_command_that_runs_a_program_opens_it_with_the_same_options(
    command: str, console: Console
) -> None:
    shown = console(command, "--help").out
    places = [shown.find(f"\n  {option} ") for option in OPENING]
    assert -1 not in places
    assert places == sorted(places)
