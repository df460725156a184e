"""Milling cycles as strokes (`stroke`).

`facing`, `contour` (along a path), `pockets`, `slots`, `open_slot`, `spigots`, `thread`, `engraving` and its
`letters`.
"""
