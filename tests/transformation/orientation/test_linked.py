"""How far the axes behind a way of the tip can be from where they are at its end."""

from __future__ import annotations

from random import Random

import pytest

from polycnc.geometry.frames import IDENTITY, Frame, rotation
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.orientation.linked import ways_behind
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from polycnc.transformation.seated import Seated
from tests.motion.five_axes import machines

FRAMES = {
    "none": IDENTITY,
    "turned": rotation(0, 40.0) @ rotation(2, 25.0),
    "larger": Frame(((3.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 0.5)), (10.0, -20.0, 5.0)),
}


def tips() -> dict[str, ToolCentrePoint]:
    return {name: axes.tip for name, axes in machines().items()}


@pytest.mark.parametrize("name", tips())
@pytest.mark.parametrize("frame", FRAMES)
def test_all_points_of_a_way_and_around_it_are_no_farther(name: str, frame: str) -> None:
    draw, nearest = Random(name + frame), 0.0
    made = Seated(tips()[name], FRAMES[frame], (1.0, 2.0, 3.0, 4.0, 5.0))
    for _ in range(200):
        start = [draw.uniform(-200.0, 200.0) for _ in range(5)]
        end = [at + draw.uniform(-1.0, 1.0) * draw.choice((0.1, 10.0, 60.0)) for at in start]
        by = [draw.uniform(0.0, 1.0) * draw.choice((0.0, 0.01, 5.0)) for _ in range(5)]
        ways, goal = ways_behind(made, start, end, by), made.to_machine(end)
        for _ in range(20):
            share = draw.random()
            point = [
                a + (b - a) * share + draw.uniform(-d, d) for a, b, d in zip(start, end, by, strict=True)
            ]
            for at, to, way in zip(made.to_machine(point), goal, ways, strict=True):
                assert abs(at - to) <= way + 1e-9
                nearest = max(nearest, abs(at - to) / max(way, 1e-9))
    assert nearest > 0.5, "the bound says something"


def test_of_others_nothing_is_known() -> None:
    point = [0.0] * 5
    tip = next(iter(tips().values()))
    assert ways_behind(None, point, point, point) == []
    assert ways_behind(Cylinder.of_radius(3, 20.0, (0, 3, 2)), point, point, point) == []
    assert ways_behind(Seated(tip), point, point, point) == [0.0] * 5
