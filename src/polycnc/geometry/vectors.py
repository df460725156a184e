"""Vectors of space: products and sums."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.geometry.frames import Vector


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a: Sequence[float], b: Sequence[float]) -> Vector:
    """From `b` to `a`."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def plus(a: Sequence[float], b: Sequence[float]) -> Vector:
    """One vector behind another."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def times(a: Sequence[float], factor: float) -> Vector:
    """A vector `factor` times as long."""
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def axis_vector(axis: int) -> Vector:
    """Unit vector along X (0), Y (1) or Z (2)."""
    return (float(axis == 0), float(axis == 1), float(axis == 2))
