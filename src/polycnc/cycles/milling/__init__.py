"""Milling cycles as strokes (`stroke`): `facing`, `contour` (along a path), `pockets`, `slots`, `spigots`, `thread`."""
