"""Macros of SYNTEC: `calls` (G65, G66, M98), `functions`, `variables`, `system_variables`, `interrupts` (M96).

`machine_parameters` reads parameters by their numbers (PARAM).
"""
