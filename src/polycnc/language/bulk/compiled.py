"""The scanner's kernel as machine code."""

from __future__ import annotations

from polycnc.kernels.library import Library
from polycnc.language.bulk import kernels, moves, numerals, reach
from polycnc.language.bulk.formulas import calculating, reading
from polycnc.language.bulk.routines import flow
from polycnc.transformation.orientation import linkage, standing

LIBRARY = Library(
    "bulk",
    (linkage, standing, moves, numerals, reading, calculating, flow, kernels, reach),
    (kernels.scan, reach.rows_within),
    inline=True,
)
