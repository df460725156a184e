"""What tests of jerk laws share: axes, random smooth paths, and how far a law uses the limits, found independently."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from polycnc.motion.third_order.bent_path import BentPath
from polycnc.motion.third_order.law import limits_of
from tests.motion.paths import MILL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from polycnc.motion.third_order.law import JerkLaw
    from polycnc.motion.third_order.laws.courses import Axes

Numbers: TypeAlias = "NDArray[np.float64]"
AXES = limits_of(MILL.axes)


def line(length: float, feed: float = 1000.0) -> BentPath:
    """A straight path along X in one piece."""
    return _path(np.array([0.0, length]), np.zeros((2, 3)), np.full(1, feed**2))


def bow(radius: float, angle: float, feed: float = 1000.0, count: int = 40) -> BentPath:
    """A circular path, which is entered and left bent."""
    way = np.linspace(0.0, radius * angle, count + 1)
    turn = way / radius
    return _path(
        way, np.stack([-np.sin(turn), np.cos(turn), 0.0 * turn], 1) / radius, np.full(count, feed**2)
    )


def wild(seed: int, count: int) -> BentPath:
    """A path of random pieces whose curvature, length and feed are random."""
    rng = np.random.default_rng(seed)
    steps = 10.0 ** rng.uniform(-1.5, 1.5, count)
    way = np.append(0.0, np.cumsum(steps))
    bend = (
        rng.normal(size=(count + 1, 3)) * 10.0 ** rng.uniform(-4.0, -0.3) * (rng.random((count + 1, 1)) < 0.7)
    )
    bend[0] = bend[-1] = 0.0
    return _path(way, bend, rng.uniform(5.0, 500.0, count) ** 2)


def _path(way: Numbers, second: Numbers, cap2: Numbers) -> BentPath:
    step = np.diff(way)[:, None]
    first = np.zeros_like(second)
    first[0, 0] = 1.0
    first[1:] = first[0] + np.cumsum(0.5 * step * (second[1:] + second[:-1]), axis=0)
    place = np.zeros_like(second)
    place[1:] = np.cumsum(step * (first[:-1] + step * (second[:-1] / 3.0 + second[1:] / 6.0)), axis=0)
    rows = np.zeros(1, np.int64)
    return BentPath(
        way, place, first, second, cap2, np.ones(len(cap2)), np.zeros(len(cap2), np.int64), rows, way[-1:]
    )


def used(path: BentPath, law: JerkLaw, axes: Axes = AXES) -> Numbers:
    """The largest parts of velocity, acceleration and jerk that any axis uses, and of the speed programmed.

    At many moments in every phase on every piece, both ends among them.
    """
    moments = np.unique(np.concatenate([law.start, law.times_at(path.way), [law.seconds]]))
    share = np.linspace(0.0, 1.0, 9)
    times = (moments[:-1, None] + np.diff(moments)[:, None] * share).ravel()
    middles = np.repeat(moments[:-1] + 0.5 * np.diff(moments), len(share))
    way, speed, pull, _ = law.at(times)
    jerk = law.at(middles)[3][:, None]
    third = path.third[path.piece_at(law.at(middles)[0])]
    _, first, second = path.at(way)
    v, u = speed[:, None], pull[:, None]
    top, most, jolt = (np.array(limit) for limit in axes)
    return np.array(
        [
            np.abs(first * v / top).max(),
            np.abs((first * u + second * v**2) / most).max(),
            np.abs((first * jerk + 3.0 * second * v * u + third * v**3) / jolt).max(),
            (speed / np.sqrt(path.cap2[path.piece_at(law.at(middles)[0])])).max(),
        ]
    )
