"""Couplings of axes (job planning 9.1, 9.3, 9.4): what `transformation/couplings` makes of their laws.

links      which axes follow which, how long that lasts, and their seat behind frames and tool
switching  a coupling changes in its place on the path
trailing   TRAILON, TRAILOF
variables  `$AA_COUP_ACT`
"""
