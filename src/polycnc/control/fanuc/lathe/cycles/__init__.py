"""Cycles of the lathe: `single` (G90, G92, G94), `repetitive` (G70 to G76) with `shape` (the blocks from P to Q).

`drilling`, `tapping`, `speed_arrival` (waits for the spindle), `grinding`; `modal` is what they keep from block to
block; `strokes` makes them moves, `intervention` is what an operator's hand does to them.
"""
