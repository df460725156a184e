"""Tools: `memory` (T, D), `edges` ($TC_DP), `lengths` by plane, wear and system, `selection` of their rules.

`management/` are lists of tools, sister tools, their monitoring and magazines; `holders/` are orientable toolholders
(TCARR), `cutting_data` edge positions that turn with them (CUTMOD). `online` has offsets that come while the tool works
(PUTFTOC, TOFFON). `master_holder` says which spindle has the tool of D. `d_numbers`, `variables` (`$TC_DP` …).

`stages` puts chamfers and G41 into the path, `tool_plane` says where G41 acts under frames; `smooth_approach` (G147 …)
has a stage of its own, `smooth_stage`. `spatial` is CUT3DC, `faces` CUT3DF, `sides` what words say of a contour.
"""
