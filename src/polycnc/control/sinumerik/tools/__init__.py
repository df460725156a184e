"""Tools: `memory` (T, D, lengths), `d_numbers`, `variables` (`$TC_DP` …).

`stages` puts chamfers and G41 into the path; `smooth_approach` (G147 …) has a stage of its own, `smooth_stage`.
"""
