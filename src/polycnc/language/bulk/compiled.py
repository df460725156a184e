"""The scanner's kernel as machine code."""

from __future__ import annotations

from polycnc.kernels.library import Library
from polycnc.language.bulk import kernels, moves, reach
from polycnc.transformation.orientation import linkage, standing

LIBRARY = Library(
    "bulk", (linkage, standing, moves, kernels, reach), (kernels.scan, reach.rows_within), inline=True
)
