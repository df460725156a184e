"""What arithmetic leaves of nothing, and up to where it holds."""

from __future__ import annotations

#: A point whose two coordinates are rounded to a micrometre, as programs hold them, lies up to this far off, mm.
ROUNDED_MM = 0.00071
#: A way up to this (mm, degrees) is the rounding of a sum: no way. Points no farther apart are the same.
NO_WAY = 1e-9
#: Up to where the end of a move and the start of the next one, each from a zero of its own, are the same point, mm.
SAME_POINT_MM = 1e-6
#: A turn that moves a point of a parallel curve by less than this (mm) is no corner: far below any increment.
SMOOTH_MM = 1e-6
#: No machine is larger, mm; and what is calculated with such a number stays a number.
FARTHEST = 1e12
