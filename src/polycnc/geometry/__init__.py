"""Vectors, frames, arcs and offsetting: pure functions on numbers, with no idea of a control.

In a plane: `arcs`, `involute`, `offset` (parallels of contours), `distance`, `zones`. In space: `vectors`, `frames`,
`fit`, `nurbs`, `through_points` (splines), `surfaces`. `planes` has G17 to G19, `angles` full turns, `units` the inch,
`polynomials` those of one parameter, `tolerances` what counts as nothing.
"""
