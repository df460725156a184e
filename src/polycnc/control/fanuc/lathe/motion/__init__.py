"""Motion of the lathe: `threads` (G32 to G36), `corners` (chamfer, R), `drawing` (direct drawing dimensions).

`beside`: polygon turning, gear box, oscillation.
"""
