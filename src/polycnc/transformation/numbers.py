"""Functions of a number or of a column of numbers (a NumPy vector), which give both the same bits.

Sums, products, quotients and roots are rounded alike everywhere. Sines, arcs and the like are not: NumPy has its own,
so those of a column are taken one by one from `math`. Nothing here loads NumPy unless it is given a column.
"""

from __future__ import annotations

import math
from functools import lru_cache

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import QUARTERS, cos_sin_deg

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    import numpy.typing as npt

    from polycnc.deferred.typing import TypeVar

    Column = npt.NDArray[np.float64]
    #: A number, or a column of numbers: one for each point.
    N = TypeVar("N", float, Column)
#: What is one number; a tuple, since a union is built anew at every look.
NUMBER = (float, int)
#: Columns of angles whose cosines and sines are at hand.
LAST_ANGLES = 16
#: Radians of a degree, and degrees of a radian.
RADIAN, DEGREE = math.pi / 180.0, 180.0 / math.pi


def cosine(angle: N) -> N:
    """Of an angle in radians."""
    if isinstance(angle, NUMBER):
        return math.cos(angle)
    return _each(math.cos, angle)


def sine(angle: N) -> N:
    """Of an angle in radians."""
    if isinstance(angle, NUMBER):
        return math.sin(angle)
    return _each(math.sin, angle)


def cosine_and_sine_deg(angle: N) -> tuple[N, N]:
    """Of an angle in degrees, exact at multiples of 90."""
    if isinstance(angle, NUMBER):
        return cos_sin_deg(angle)
    return _cosines_and_sines(angle.tobytes())


@lru_cache(LAST_ANGLES)
def _cosines_and_sines(angles: bytes) -> tuple[Column, Column]:
    """Of a column of angles: whoever asks for derivatives behind places asks for the same ones once more."""
    import numpy as np

    angle = np.frombuffer(angles)
    turned = angle % 360.0
    pairs = np.stack([_each(math.cos, turned * RADIAN), _each(math.sin, turned * RADIAN)])
    quarters = angle % 90.0 == 0.0
    pairs[:, quarters] = np.array(QUARTERS).T[:, (turned[quarters] / 90.0).astype(int)]
    pairs.flags.writeable = False
    return pairs[0], pairs[1]


def angle_deg(y: N, x: N) -> N:
    """Direction of a point from the origin, degrees from -180 to 180."""
    if isinstance(y, NUMBER):
        return math.degrees(math.atan2(y, x))
    return _each(math.atan2, y, x) * DEGREE


def distance(x: N, y: N) -> N:
    """Of a point from the origin."""
    if isinstance(x, NUMBER):
        return math.hypot(x, y)
    return _each(math.hypot, x, y)


def kept_off(x: N, y: N, least: float) -> tuple[N, N, N]:
    """A point and its distance from the origin; one that is nearer than `least` is put there, in the direction of X."""
    if isinstance(x, NUMBER):
        away = math.hypot(x, y)
        return (x, y, away) if away >= least else (least, 0.0, least)
    import numpy as np

    away = distance(x, y)
    near = away < least
    return np.where(near, least, x), np.where(near, 0.0, y), np.where(near, least, away)


def where_less(size: N, least: float, value: float, other: N) -> N:
    """A number where a size is less than another one, else a third."""
    if isinstance(size, NUMBER):
        return value if size < least else other
    import numpy as np

    return np.where(size < least, value, other)


def constant(value: float, like: N) -> N:
    """A number in the shape of another."""
    if isinstance(like, NUMBER):
        return value
    import numpy as np

    return np.full_like(like, value)


def _each(function: Callable[..., float], *columns: Column) -> Column:
    """A function of `math` on every number of some columns."""
    import numpy as np

    numbers = (column.tolist() for column in columns)
    return np.fromiter(map(function, *numbers), np.float64, len(columns[0]))
