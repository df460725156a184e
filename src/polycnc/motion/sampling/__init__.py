"""Motion at even times: `run` (from one standstill to the next), `samples`, `sample_file`, `profile` (drawn).

`facts` is what samples must know of their rows, `own_ways` what axes do that are positioned beside the path, `spindle`
how fast the spindle turns, `tents` averages many of them at once. `timing` is how far a single move has come after a
time.
"""
