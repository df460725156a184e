"""Regression tests of part programs: cases in YAML, run against their expectations (`polycnc test`).

`reading` finds files, `format` says what a case may hold, `runner` runs it, `operation` plays an operator on
a virtual control, `compare` holds the outcome against the expectations; `report` and `junit` tell it,
`features` counts it by function, `selection` picks cases by name.
"""
