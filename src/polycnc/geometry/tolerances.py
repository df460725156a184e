"""What arithmetic leaves of nothing."""

from __future__ import annotations

#: A way up to this (mm, degrees) is the rounding of a sum: no way. Points no farther apart are the same.
NO_WAY = 1e-9
