"""Angles that count full turns."""

from __future__ import annotations

TURN_DEG = 360.0


def nearest_turn(angle: float, near: float) -> float:
    """The position of a rotary axis at an angle, on the turn nearest to another position; degrees."""
    return angle + TURN_DEG * round((near - angle) / TURN_DEG)
