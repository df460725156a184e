"""The command line: one module for each command, imported when it is called.

`app` finds the command (`alarms`, `check`, `data`, `features`, `machines`, `parameters`, `plot`, `run`, `test`);
`options` are those that they share, `usage` is the language of help and refusals. `diagnostics` says what a run found,
`formats` and `sarif` how that is written, `report` what `run` tells; `console` and `output` write.
"""

from polycnc.cli.app import main

__all__ = ["main"]
