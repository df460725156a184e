"""Time in which the axes stand.

`waits` finds it in a toolpath: tool changes, spindle ramps, auxiliary functions, dwells, exact stops. `beside` follows
what goes on beside the axes: spindles that run up, a magazine that turns. `zero_mark` follows the angle of a spindle
and says when a thread begins. `positioning` follows axes that go to a place by themselves.
"""
