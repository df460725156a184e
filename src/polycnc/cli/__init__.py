"""The command line: one module for each command in `commands/`, imported when it is called.

`app` finds the command; `options` are those that they share, `usage` is the language of help and refusals.
`diagnostics` says what a run found, `formats` and `sarif` how that is written, `report` what `run` tells, `told`
what of a setup has no effect; `console` and `output` write, `progress` tells those who wait how far a command is.
"""

from __future__ import annotations

import atexit
import gc
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["main"]
#: Behind so many new objects Python looks for circles of them. What is loaded and compiled stays to the end, so that
#: it would find nothing, many times before the first block.
_NEW_OBJECTS = 200_000


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and leave the process with its exit status (`polycnc.cli.app.main`).

    Whoever interrupts it while its parts are still being loaded gets the same answer as later.
    """
    gc.set_threshold(_NEW_OBJECTS)
    atexit.register(gc.freeze)  # what is left goes with the process
    try:
        from polycnc.cli.app import main as run
    except KeyboardInterrupt:
        raise SystemExit(130) from None
    run(arguments)
