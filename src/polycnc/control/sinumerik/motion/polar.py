"""Pole and modal polar coordinates (Fundamentals, G110 to G112, AP, RP)."""

from __future__ import annotations

from math import nan

from polycnc.channel.states.state import Lifetime, State
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector


@dataclass(slots=True)
class Polar(State, lifetime=Lifetime.RESET):
    """The pole, and the polar coordinates that words leave out.

    Attributes:
        pole: In work coordinates of the geometry axes, mm.
        angle: Last AP, degrees.
        radius: Last RP, mm; NaN before the first.
    """

    pole: Vector = (0.0, 0.0, 0.0)
    angle: float = 0.0
    radius: float = nan
