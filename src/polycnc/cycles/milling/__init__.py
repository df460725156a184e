"""Milling cycles as strokes (`stroke`).

`facing`, `contour` (along a path), `pockets`, `contour_pocket` (of any contour; its loops: `region`, what a larger
cutter has left of it: `residual`), `slots`, `open_slot`, `spigots`, `thread`, `drilled_thread`, `engraving` and its
`letters`.
"""
