"""From points of the path to positions of the axes, and back: modes in which a control makes axes of others.

`contract` is what the path, the planner and the displays ask of a transformation; `pole` is a place where an axis has
no direction. The kinds, one a file, parameters as frozen dataclasses: axes that stand in for others lie in
`kinematic/`, the tool centre point (G43.4, TRAORI) in `orientation/`, tilted planes (G68.2, CYCLE800) in `planes/`,
axes that follow others in `couplings/`. `chain` is one after the other; `seated` puts frames in front of one and a
tool behind it.
`numbers` are the functions that they are made of, for a number and for a whole column alike; `rows` applies a
transformation to tables of points.

Nothing here knows a control, a channel or a file. When a transformation is on, and what is an alarm in it, is told by
the controls.
"""
