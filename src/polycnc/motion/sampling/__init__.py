"""Motion at even times: `run` (from one standstill to the next), `samples`, `sample_file`, `profile` (drawn).

`timing` is how far a single move has come after a time.
"""
