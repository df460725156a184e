"""Preprocessing: the channel runs ahead of the axes, and its rows wait in a look-ahead buffer.

preprocessing  the channel's rows become pieces of the path and events, in order
rows           a row as a move with its pieces
law_rows       rows as stretches of a run that a law leads
items          what is prepared and not yet executed
standing       what the axes stand for, and what begins beside them meanwhile
piece_buffer   the planner's records of the pieces, and how fast each may be entered
layout         for which overrides rows are laid out, and from what
queue          pieces are taken one by one, and laid out again for other overrides
run_blocks     where blocks begin and end among what is prepared
reapproach     a row that begins elsewhere than its program has led the axes
"""
