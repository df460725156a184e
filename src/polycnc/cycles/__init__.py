"""Machining cycles as generators of moves, free of any control's words.

A generator yields strokes; the control that runs it turns them into moves. `drilling/` is for every control;
`milling/` are the cycles of SINUMERIK; of `turning/` the single and repetitive ones are FANUC's, those that cut a whole
contour and chains of threads SINUMERIK's. `count` bounds how many parts a cycle makes of a way.
"""
