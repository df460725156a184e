"""Forward and inverse kinematics of random chains: any two rotary axes in head and table, anywhere, along anything."""

from __future__ import annotations

import random
from math import hypot

from polycnc.geometry.frames import Vector
from polycnc.machine.kinematics import Kinematics, unit
from polycnc.machine.model import Joint
from polycnc.transformation.orientation.solutions import pole_angle, solutions_for
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint

CHAINS, NAMES = 10_000, ("X", "Y", "Z", "A", "C")
#: Nearer to a pole than this (degrees) an axis has no direction of its own.
POLE_DEG = 1.0


def direction(chance: random.Random) -> Vector:
    """Any direction, of length 1."""
    while True:
        x, y, z = (chance.gauss(0.0, 1.0) for _ in range(3))
        if hypot(x, y, z) > 0.1:
            return unit((x, y, z))


def place(chance: random.Random, reach: float) -> Vector:
    x, y, z = (chance.uniform(-reach, reach) for _ in range(3))
    return (x, y, z)


def chain(chance: random.Random) -> ToolCentrePoint:
    """Two tables, a head on each side, or a head with two axes; with work zero and tool."""
    heads = chance.choice((0, 1, 2))
    joints = [
        Joint(name, True, "tool" if i < heads else "work", direction(chance), place(chance, 300.0))
        for i, name in enumerate(NAMES[3:])
    ]
    kinematics = Kinematics(
        tuple(joint for joint in joints if joint.carries == "tool"),
        tuple(joint for joint in joints if joint.carries == "work"),
        direction(chance),
    )
    zero = (*place(chance, 100.0), chance.uniform(-90.0, 90.0), chance.uniform(-90.0, 90.0))
    return ToolCentrePoint(kinematics, NAMES, (0, 1, 2), zero, place(chance, 150.0))


def test_chains_there_and_back() -> None:
    chance = random.Random("chains")
    for _ in range(CHAINS):
        point = chain(chance)
        work = [*place(chance, 500.0), chance.uniform(-179.0, 179.0), chance.uniform(-179.0, 179.0)]
        back = point.to_work(point.to_machine(work))
        assert max(abs(a - b) for a, b in zip(work, back, strict=True)) < 1e-9
        stands = {name: work[i] + point.zero[i] for i, name in enumerate(NAMES) if i > 2}
        if pole_angle(point.kinematics, stands) < POLE_DEG:
            continue
        tool = point.kinematics.tool_on_work(stands)
        found = solutions_for(point.kinematics, tool, stands)
        for angles in found:
            again = point.kinematics.tool_on_work(angles)
            assert max(abs(a - b) for a, b in zip(again, tool, strict=True)) < 1e-9
        ways = [max(abs(angles[name] - stands[name]) for name in stands) for angles in found]
        assert min(ways) < 1e-9
