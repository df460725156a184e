"""One module for each command, imported when it is called; each declares what it offers as `commands`.

`run`, `check`, `test`, `plot`, `features`, `machines`, `alarms`, `data`, `memory`, `parameters`, `panel`.
"""

from __future__ import annotations

import sys
from time import monotonic

from polycnc.cli.console import note
from polycnc.deferred.modules import import_module
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import text

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.cli.declaration import Command, Commands

#: In the order of the page of help.
COMMANDS = (
    "run",
    "check",
    "test",
    "plot",
    "features",
    "machines",
    "alarms",
    "data",
    "memory",
    "parameters",
    "panel",
)
#: Who waits as long as this for a command that runs programs is told what makes it slow, seconds.
SLOW_S = 2.0


def commands_of(name: str) -> Commands:
    """What the module of this name offers."""
    offered: Commands = import_module(f"polycnc.cli.commands.{name}").commands
    return offered


def call(command: Command, given: Mapping[str, object]) -> int | None:
    """Call a command with these values by the names of its parameters."""
    began = monotonic()
    status = command(given)
    if command.runs in given and monotonic() - began >= SLOW_S:
        sys.stdout.flush()
        _say_if_plain()
    return status


def _say_if_plain() -> None:
    """A note where this installation has no compiled kernels, and nobody has chosen so."""
    from polycnc.kernels.native import Lack
    from polycnc.language.bulk.compiled import LIBRARY as READING
    from polycnc.motion.compiled import LIBRARY as PLANNING

    lack = READING.lack or PLANNING.lack
    if lack in (Lack.MISSING, Lack.STALE):
        note(f"polycnc: {text(f'cli.kernels.{lack}')}")
