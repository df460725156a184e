"""The scanner's kernel as machine code."""

from __future__ import annotations

from polycnc.kernels.library import Library
from polycnc.language.bulk import formulas, kernels, moves, numerals

LIBRARY = Library("bulk", (moves, numerals, formulas, kernels), (kernels.scan,), inline=True)
