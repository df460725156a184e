"""One module for each command.

`run`, `check`, `test`, `plot`, `features`, `machines`, `alarms`, `data`, `memory`, `parameters`, `panel`.
"""
