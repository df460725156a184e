"""Tilted planes of the work: `tilted` is how they are told and what turning axes do to them, `feature` their frame.

`misplaced` is a workpiece beside its place on the table.
"""
