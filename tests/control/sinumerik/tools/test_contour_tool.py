"""Contour tools: a wheel of several edges touches every line of a groove, and nowhere does it reach beyond one."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, degrees, radians, sin
from random import Random

import pytest

from polycnc.compensation.tips import tip_direction
from tests.control.sinumerik.support import codes, moves, run

#: Places along a row, and on each edge, at which the wheel is looked at; how near it comes, and stays off, mm.
LOOKS, NEAR = 8, 0.02
#: Directions of the normals between which edges change.
BORDERS = (200.0, 215.0, 230.0, 250.0, 270.0, 290.0, 310.0, 330.0, 345.0)
Point = tuple[float, float]


def unit(angle: float) -> Point:
    return cos(radians(angle)), sin(radians(angle))


class Wheel:
    """Noses side by side, joined by straight flanks, that cut from 180 degrees over 270 to 360."""

    def __init__(self, random: Random) -> None:
        count = random.choice((2, 3, 4))
        self.borders = [180.0, *sorted(random.sample(BORDERS, count - 1)), 360.0]
        self.radii = [random.choice((1.0, 2.0, 3.5)) for _ in range(count)]
        self.tips = [random.randint(1, 8) for _ in range(count)]
        self.active = random.randrange(count)
        self.centers: list[Point] = [(0.0, 0.0)]
        for border, before, after in zip(self.borders[1:], self.radii, self.radii[1:], strict=False):
            (x, y), (u, v), flank = self.centers[-1], unit(border), random.choice((0.0, 2.0, 5.0))
            self.centers.append((x + (before - after) * u - flank * v, y + (before - after) * v + flank * u))

    def point(self, i: int) -> Point:
        """The reference point of an edge."""
        (x, y), (u, v) = self.centers[i], tip_direction(self.tips[i])
        return x + self.radii[i] * u, y + self.radii[i] * v

    @property
    def data(self) -> str:
        lines = []
        (a, b), limits = self.point(self.active), pairwise(self.borders)
        for i, (tip, radius, (first, last)) in enumerate(zip(self.tips, self.radii, limits, strict=True)):
            (x, y), (u, v) = self.point(i), tip_direction(tip)
            reference = degrees(atan2(v, u))
            least, largest = (reference - last) % 360.0, (reference - first) % 360.0
            lines.append(
                f"$TC_DP1[1,{i + 1}]=450 $TC_DP2[1,{i + 1}]={tip} $TC_DP6[1,{i + 1}]={radius} "
                f"$TC_DP3[1,{i + 1}]={b - y:.9f} $TC_DP4[1,{i + 1}]={a - x:.9f} "
                f"$TC_DP10[1,{i + 1}]={least or 360.0:.9f} $TC_DP11[1,{i + 1}]={largest:.9f}"
            )
        return "\n".join(lines)

    def outline(self) -> list[Point]:
        """Points of its edges, seen from the reference point of the active one."""
        a, b = self.point(self.active)
        return [
            (x + radius * u - a, y + radius * v - b)
            for (x, y), radius, (first, last) in zip(
                self.centers, self.radii, pairwise(self.borders), strict=True
            )
            for u, v in (unit(first + (last - first) * k / (4 * LOOKS)) for k in range(4 * LOOKS + 1))
        ]


@pytest.mark.parametrize("seed", range(24))
def test_a_wheel_touches_every_line_and_cuts_into_none(seed: int) -> None:
    random = Random(seed)
    wheel = Wheel(random)
    directions = [270.0, *sorted(random.sample(range(310, 415, 5), random.choice((1, 2, 3)))), 450.0]
    corners: list[Point] = [(0.0, 0.0)]
    for direction in directions:
        (x, y), (u, v), length = corners[-1], unit(direction), random.uniform(40.0, 70.0)
        corners.append((x + length * u, y + length * v))
    backwards = random.random() < 0.5
    (x, y), *others = corners[::-1] if backwards else corners
    program = (
        f"{wheel.data}\nG17 T1 D{wheel.active + 1} F500\nG0 X{x + (-15 if backwards else 15)} Y{y + 15}\n"
    )
    program += f"{'G42' if backwards else 'G41'} G1 X{x:.6f} Y{y:.6f}\n"
    program += "\n".join(f"X{x:.6f} Y{y:.6f}" for x, y in others)
    result = run(program, parameters={"28290": 1})
    assert not codes(result), program
    ways = pairwise([(to["X"], to["Y"]) for _, to in moves(result)][1:])
    places = [
        (a + (c - a) * k / LOOKS, b + (d - b) * k / LOOKS)
        for (a, b), (c, d) in ways
        for k in range(LOOKS + 1)
    ]
    for (a, b), direction in zip(corners, directions, strict=False):
        u, v = unit(direction)
        off = min((y + q - b) * u - (x + p - a) * v for x, y in places for p, q in wheel.outline())
        assert -1e-3 < off < NEAR, program
