"""A number that kernels of tests take from elsewhere."""

from __future__ import annotations

HALF = 0.5
