"""From points of the path to positions of the axes, and back: modes in which a control makes axes of others.

`contract` is what the path, the planner and the displays ask of a transformation; `pole` is a place where an axis has
no direction. The kinds, one a file, parameters as frozen dataclasses: `polar` (G12.1, TRANSMIT), `cylinder` (G07.1,
TRACYL), `groove` (the same with walls), `inclined` (TRAANG), `tool_centre` (G43.4, TRAORI), `feature` (G68.2,
CYCLE800), `standing` (G07), `parallel` (other axes are X, Y, Z), and `chain`, one after the other; `seated` puts frames
in front of one and a tool behind it.
`orientation` finds the rotary positions for a direction of the tool, `choice` says which of several; `directions` are
ways of a direction, `turning` makes ways of the rotary axes of them; `tilted` is how planes are told and what turning
axes do to them.
`numbers` are the functions that they are made of, for a number and for a whole column alike; `rows` applies a
transformation to tables of points.

Nothing here knows a control, a channel or a file. When a transformation is on, and what is an alarm in it, is told by
the controls.
"""
