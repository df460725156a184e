"""Random contours on the lathe: the nose keeps off the work, and drawing dimensions mean the points they describe."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, cos, degrees, hypot, radians, sin

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from shapely.geometry import LineString, Point

from polycnc.geometry import arcs
from tests.control.fanuc.lathe.support import alarms, moves, run

#: A point of a profile: Z, and X as a radius.
Spot = tuple[float, float]
NOSE = 0.8
#: A busy computer is no mistake of the program.
SLOW = [HealthCheck.too_slow, HealthCheck.filter_too_much]
TIPS = {
    0: (0, 0),
    1: (1, 1),
    2: (-1, 1),
    3: (-1, -1),
    4: (1, -1),
    5: (1, 0),
    6: (0, 1),
    7: (-1, 0),
    8: (0, -1),
}


@st.composite
def profile(draw: st.DrawFn) -> list[Spot]:
    """A profile that runs towards -Z, with edges that are long against the nose."""
    z, x = 0.0, 20.0
    spots = [(z, x)]
    for _ in range(draw(st.integers(2, 7))):
        z = round(z - draw(st.floats(8, 30)), 3)
        x = round(min(max(x + draw(st.floats(-12, 12)), 8.0), 60.0), 3)
        spots.append((z, x))
    return spots


def words(spot: Spot) -> str:
    """A point as the program writes it."""
    return f"X{2 * spot[1]:.4f} Z{spot[0]:.4f}"


def bulges(count: int) -> st.SearchStrategy[list[int]]:
    """For each edge -1 or 1 for an arc, 0 for a line."""
    return st.lists(st.sampled_from([-1, 0, 0, 1]), min_size=count, max_size=count)


def edge(one: Spot, two: Spot, bulge: int) -> tuple[str, list[Spot]]:
    """A block, and points along it; arcs have the radius of twice their chord, so that the nose fits inside."""
    if bulge == 0:
        return f"G1 {words(two)}", [one, two]
    chord = hypot(two[0] - one[0], two[1] - one[1])
    radius = round(2.0 * chord, 3)
    ccw = bulge > 0
    height = (radius * radius - 0.25 * chord * chord) ** 0.5 * (1 if ccw else -1)
    across = (-(two[1] - one[1]) / chord, (two[0] - one[0]) / chord)
    center = (0.5 * (one[0] + two[0]) + height * across[0], 0.5 * (one[1] + two[1]) + height * across[1])
    code = "G3" if ccw else "G2"
    return f"{code} {words(two)} R{radius:.3f}", [one, *arcs.split(one, two, center, ccw, 64)]


@settings(max_examples=40, deadline=None, suppress_health_check=SLOW)
@given(st.data(), profile(), st.sampled_from([-1, 1]), st.sampled_from(sorted(TIPS)), st.booleans())
def test_the_nose_touches_every_edge_and_cuts_none(
    data: st.DataObject, spots: list[Spot], side: int, tip: int, arc_corners: bool
) -> None:
    shapes = data.draw(bulges(len(spots) - 1))
    blocks, ways = [], []
    for (one, two), bulge in zip(pairwise(spots), shapes, strict=True):
        block, way = edge(one, two, bulge)
        blocks.append(block)
        ways.append(way)
    before = (spots[0][0] + 10.0, spots[0][1])
    after = (spots[-1][0] - 10.0, spots[-1][1])
    code = "G42" if side < 0 else "G41"
    program = [
        "T0101", f"G0 {words((before[0] + 10.0, before[1] - 10.0 * side))}", f"{code} {words(before)} F.2",
        f"G1 {words(spots[0])}", *blocks, f"G1 {words(after)}", "G40 G0 X200. Z50.", "M30",
    ]  # fmt: skip
    result = run(
        "\n".join(program),
        tools={1: {"radius": NOSE, "tip": tip}},
        parameters={"19607#2": int(arc_corners), "5010": 0.0},
    )
    assume(not alarms(result))
    tz, tx = TIPS[tip]
    contour = LineString([before, *(spot for way in ways for spot in way), after])
    path: list[Spot] = []
    rows = [row for row in result.rows if "to" in row][1:-1]
    place = (rows[0]["to"]["Z"] - NOSE * tz, 0.5 * rows[0]["to"]["X"] - NOSE * tx)
    path.append(place)
    for row in rows[1:]:
        end = (row["to"]["Z"] - NOSE * tz, 0.5 * row["to"]["X"] - NOSE * tx)
        if "center" in row:
            center = (row["center"]["Z"] - NOSE * tz, 0.5 * row["center"]["X"] - NOSE * tx)
            path += arcs.split(place, end, center, row["type"] == "ccw", 64)
        else:
            path.append(end)
        place = end
    centre = LineString(path)
    assert centre.distance(contour) >= NOSE - 2e-3
    for way in ways:
        touched = LineString(way).interpolate(0.5, normalized=True)
        assert centre.distance(touched) == pytest.approx(NOSE, abs=2e-2)
    ahead = path[1][0] - path[0][0], path[1][1] - path[0][1]
    aside = before[0] - path[0][0], before[1] - path[0][1]
    assert (ahead[0] * aside[1] - ahead[1] * aside[0]) * side < 0.0
    assert Point(path[0]).distance(contour) == pytest.approx(NOSE, abs=1e-3)


@settings(max_examples=60, deadline=None, suppress_health_check=SLOW)
@given(profile(), st.floats(0.2, 1.5), st.booleans(), st.booleans())
def test_angles_describe_the_same_figure_as_points(
    spots: list[Spot], size: float, rounds: bool, supplement: bool
) -> None:
    angles = [degrees(atan2(two[1] - one[1], two[0] - one[0])) for one, two in pairwise(spots)]
    size = round(size, 3)
    for one, two in pairwise(angles):
        assume(abs((one - two + 180.0) % 360.0 - 180.0) > 3.0)
    corner = f",{'R' if rounds else 'C'}{size:.3f}"
    start = [f"G0 {words(spots[0])}", "F.2"]
    by_points = [f"G1 {words(spot)} {corner}" for spot in spots[1:-1]] + [f"G1 {words(spots[-1])}", "M30"]
    typed = [180.0 - a if supplement else a for a in angles]
    by_angles, k = [], 0
    while k < len(angles):
        end = "" if k == len(angles) - 1 else corner
        if k + 1 < len(angles):
            by_angles.append(f"G1 ,A{typed[k]:.4f} {end}")
            k += 1
            end = "" if k == len(angles) - 1 else corner
            by_angles.append(f"G1 {words(spots[k + 1])} ,A{typed[k]:.4f} {end}")
        else:
            by_angles.append(f"G1 {words(spots[k + 1])} {end}")
        k += 1
    parameters = {"3453#0": 1, "3405#5": int(supplement)}
    pointed = run("\n".join([*start, *by_points]), parameters=parameters)
    angled = run("\n".join([*start, *by_angles, "M30"]), parameters=parameters)
    assert alarms(pointed) == alarms(angled)
    for (kind, x, z), (other, u, w) in zip(moves(pointed), moves(angled), strict=not alarms(pointed)):
        assert kind == other
        assert (x, z) == pytest.approx((u, w), abs=2e-2)


@settings(max_examples=40, deadline=None, suppress_health_check=SLOW)
@given(profile(), st.floats(2.0, 178.0))
def test_one_coordinate_and_an_angle_lead_along_the_line(spots: list[Spot], angle: float) -> None:
    (z, x), end = spots[0], spots[1]
    assume(abs(angle - 90.0) > 1.5)
    program = f"G0 {words((z, x))}\nG1 Z{end[0]:.4f} ,A{180.0 - angle:.3f} F.2\nM30"
    result = run(program, parameters={"3453#0": 1})
    kind, got_x, got_z = moves(result)[-1]
    assert kind == "feed"
    assert got_z == pytest.approx(end[0])
    slope = radians(180.0 - round(angle, 3))
    assert 0.5 * got_x - x == pytest.approx((got_z - z) / cos(slope) * sin(slope), abs=1e-2, rel=1e-4)
