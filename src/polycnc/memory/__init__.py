"""What outlives a run: work and tool offsets, parameters, retentive variables, edited programs, the alarm history.

`retained` is the one interface by which the rest of polycnc reaches it, and its form in memory. `file` is its form in
an SQLite file, whose values are what `encoding` makes of them.
"""
