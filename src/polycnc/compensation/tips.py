"""Imaginary tips of turning tools: all controls number them alike (FANUC 0i-TF Plus II.5.2.2, SINUMERIK $TC_DP2)."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.geometry.arcs import Point

#: By number, along the first and second axis of the plane (Z and X in G18).
_DIRECTIONS: dict[int, Point] = {
    1: (1.0, 1.0), 2: (-1.0, 1.0), 3: (-1.0, -1.0), 4: (1.0, -1.0),
    5: (1.0, 0.0), 6: (0.0, 1.0), 7: (-1.0, 0.0), 8: (0.0, -1.0),
}  # fmt: skip


def tip_direction(number: int) -> Point:
    """From the nose centre to the tip, in units of the nose radius; none for other numbers (0 and 9: the centre)."""
    return _DIRECTIONS.get(number, (0.0, 0.0))
