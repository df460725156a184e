"""The way of a move: `path` has the stages between a handler's move and the toolpath, `move_path` the points on it.

`chord_path` is the way of a curve that is written as chords. `turning` is the stage in which rotary axes turn along a
move, `knots` makes one motion of rows: chords, moves that are cut. `origins` names intermediate blocks.
`travel` says where it leads the machine, and guards its limits. `pole` knows where axes stand in the pole of a polar
plane. `fairing` leads cuts of short blocks beside their ends, `beside` keeps axes behind a
transformation in bounds meanwhile. `times` is how long single moves take, for what comes by
the clock in a run without one.
"""
