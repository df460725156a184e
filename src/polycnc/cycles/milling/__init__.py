"""Milling cycles as strokes (`stroke`).

`facing`, `contour` (along a path), `pockets`, `contour_pocket` (of any contour; its loops: `region`), `slots`,
`open_slot`, `spigots`, `thread`, `drilled_thread`, `engraving` and its `letters`.
"""
