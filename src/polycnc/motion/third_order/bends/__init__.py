"""From the stretches of a programmed path to a path bent within its tolerance.

    stretches   lines, chords and parts of arcs as cubics by the way; lines that are chords of a curve
    rests       where the axes must rest
    turning     how much the path turns, and how far apart knots may be for it
    knots       where they lie
    controls    the spline by its control points, and by place, q' and q'' at its knots
    keeping     what one round leaves to the next
    levelling   what short lines leave of the tolerance
    within      whether it is kept
    seams       where parts that are bent by themselves go over into each other
    seeking     where seams can be
    at_corners  how far around corners holds what parameters bound their speed by
    pieces      row and highest speed of each piece
    bending     all of it in turn

The functions are kernels: flat arrays, no class of the project, machine code by `../compiled.py`.
"""
