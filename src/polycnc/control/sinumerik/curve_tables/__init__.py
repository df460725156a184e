"""Curve tables: where a following axis is for each place of a leading axis (job planning 9.2).

curve           a table as segments of polynomials, and what it says of a place
memory          the tables of the control: static and dynamic memory, locks, resources
recorder        catches the moves of a definition, as segments
splines         A and C splines through the points of a definition
definition      CTABDEF, CTABEND, `$P_CTABDEF`
administration  CTABDEL, CTABLOCK, CTABUNLOCK, and functions on numbers, properties, resources
reading         functions on values: CTAB, CTABINV and the others
"""
