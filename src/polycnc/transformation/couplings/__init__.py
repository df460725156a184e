"""Couplings of axes: a following axis goes its own way, and beside that one by those of leading axes.

laws     what a leading axis does to a following one: a ratio, a curve, a curve from some place on
graph    in which order following axes are worked out, and that none follows itself
coupled  all couplings of a channel as a transformation from the ways of the axes to their places
acting   which couplings act under a transformation, and which axes follow others there
kinks    where the curves that lead axes have kinks on the way of a row
"""
