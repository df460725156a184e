"""Couplings of axes and spindles (job planning 9.1, 9.3 to 9.6): what `transformation/couplings` makes of their laws.

links      which axes follow which, how long that lasts, and their seat behind frames and tool
switching  a coupling changes in its place on the path
trailing   TRAILON, TRAILOF
leading    LEADON, LEADOF
generated  LEADON by master values that programs and actions write (`$SA_LEAD_TYPE` 2)
stage      lets an axis wait for its place on a curve while the leading axis moves
gears      EGDEF, EGON, EGONSYN, EGONSYNE, EGOFS, EGDEL of axes
gear_words the same and EGOFC of spindles that follow; which of both a word means
approach   a following axis goes to its synchronous place first
spindle_pairs  what spindles that follow others turn with, and where they stand
synchronous    COUPDEF, COUPON, COUPOF …, WAITC
masters        MASLDEF, MASLON, MASLOF, MASLOFS, MASLDEL
gantry         pairs that are coupled from power-on (MD37100)
variables  `$AA_COUP_ACT`, `$AA_LEAD_P`, `$AA_LEAD_V`, `$AA_EG_…`
"""
