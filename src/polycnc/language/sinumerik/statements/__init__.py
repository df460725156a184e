"""Statements: `flow` with `labels` and `structures`, `calls` with `sections` (program levels), `files`.

`definitions` (DEF, PROC …) and `redefinitions` (REDEF) declare what `names/` keeps.
"""
