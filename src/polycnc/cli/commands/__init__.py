"""One module for each command, imported when it is called; each declares what it offers as `commands`.

`run`, `check`, `test`, `plot`, `features`, `machines`, `alarms`, `data`, `memory`, `parameters`, `panel`.
"""

from __future__ import annotations

from polycnc.deferred.modules import import_module
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.cli.declaration import Commands

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


def commands_of(name: str) -> Commands:
    """What the module of this name offers."""
    offered: Commands = import_module(f"polycnc.cli.commands.{name}").commands
    return offered
