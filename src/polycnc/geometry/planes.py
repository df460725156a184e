"""The working planes."""

from __future__ import annotations

#: First, second and third axis of a plane as geometry axes (0 for X); the third one is its normal.
PLANES: dict[str, tuple[int, int, int]] = {"G17": (0, 1, 2), "G18": (2, 0, 1), "G19": (1, 2, 0)}
