"""How typed numbers become numbers in internal units: all of the scanner's data that a short program needs."""

from __future__ import annotations

from polycnc.kernels.layout import Places, place


class Reading(Places):
    """How a typed number becomes one in internal units; see `recipe.Scaling`."""

    AS_IS = place()
    TIMES = place()
    INCREMENTS = place()
    CUT = place()
    RATIO = place()
    ROUNDED = place()


#: Half an increment and a guard (`Reading.ROUNDED`): halves go away from zero as they do in the decimal arithmetic of
#: controls.
HALF = 0.5 + 1e-7
