"""Macros of SYNTEC: `calls` (G65, G66, M98), `functions`, `variables`, `system_variables`, `interrupts` (M96).

`machine_parameters` reads and writes parameters by their numbers (PARAM, SETPR), `records` are those of cycles
(DBOPEN), `diagnosis` answers SYSDATA and DRVDATA, `single_block` says where macros do not halt, `registers` writes R
registers as the PLC does.
"""
