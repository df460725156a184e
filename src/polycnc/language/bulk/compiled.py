"""The scanner's kernels as machine code."""

from __future__ import annotations

from polycnc.kernels.library import Library

_BULK = "polycnc.language.bulk"
LIBRARY = Library(
    "bulk",
    (
        "polycnc.transformation.orientation.linkage",
        "polycnc.transformation.orientation.standing",
        f"{_BULK}.moves",
        f"{_BULK}.numerals",
        f"{_BULK}.formulas.reading",
        f"{_BULK}.formulas.calculating",
        f"{_BULK}.routines.flow",
        f"{_BULK}.kernels",
        f"{_BULK}.reach",
    ),
    (f"{_BULK}.kernels.scan", f"{_BULK}.reach.rows_within"),
    inline=True,
)
