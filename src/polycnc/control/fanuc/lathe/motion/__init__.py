"""Motion of the lathe: `threads` (G32 to G36), `corners` (chamfer, R), `drawing` (direct drawing dimensions).

`beside`: polygon turning, gear boxes, synchronous control, oscillation. `retract`: G10.6 and its signal.
"""
