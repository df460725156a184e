"""Intermediate blocks that stages of the path make, by kind (thousands) and what has made them.

The numbers are those of SINUMERIK's `$AC_BLOCKTYPEINFO` (job planning 10.3.11), by which actions read them;
`Context.origin` carries them to the main run.
"""

from __future__ import annotations

#: What an intermediate block's number is divided by to get its kind.
KIND = 1000
#: Made by the control, without detail.
INTERNAL = 1000
#: A chamfer; a rounding of RND, RNDM.
CORNER_LINE, CORNER_ARC = 2001, 2002
#: Smooth approach and retraction: on a line, a quarter circle, a semicircle.
APPROACH_LINE, APPROACH_QUARTER, APPROACH_HALF = 3001, 3002, 3003
#: Radius compensation: the approach behind a preprocessing stop; what joins two parallels that do not meet; the way
#: about an outer corner.
APPROACH_BEHIND_STOP, JOINED, ROUND_CORNER = 4001, 4002, 4004
#: A tangential axis turns in a block of its own.
TURN = 6001
#: A segment of a path that is cut into them, without and with a stroke.
SEGMENT, STROKE_SEGMENT = 7001, 7002
