"""Preprocessing: the channel runs ahead of the axes, and its rows wait in a look-ahead buffer.

preprocessing  the channel's rows become pieces of the path and events, in order
items          what is prepared and not yet executed
piece_buffer   the planner's records of the pieces, and how fast each may be entered
reapproach     a row that begins elsewhere than its program has led the axes
"""
