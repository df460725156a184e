"""The motion of the axes between two events, in closed form.

piece_motion   along a piece of the path, or of each axis by itself
geometry       lines and arcs by the share of their way
follower       limited jerk: the axes follow through averages over time
law_run        a run of rows by a law that is found anew at any moment
law_motion     along one row of such a run
"""
