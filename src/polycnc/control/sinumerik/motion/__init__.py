"""Motion of a block.

`moves` (G0, G1, G4 …), `threads` and taps, `polar` words, `circles`, `involutes`, `splines` with `points_stage` (A, C),
`spline_stage` (B) and `polynomial_groups`, `indexing`, `repositioning`; `last_move` is where a move came from, for CT;
`contour_reading` catches the moves of blocks that describe a contour.
"""
