"""The scanner's kernel as machine code."""

from __future__ import annotations

from polycnc.kernels.library import Library
from polycnc.language.bulk import kernels, moves

LIBRARY = Library("bulk", (moves, kernels), (kernels.scan,), inline=True)
