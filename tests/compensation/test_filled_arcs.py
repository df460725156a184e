"""Inner arcs and grooves that the tool just fills: rounded points are no alarm, in any direction, absolute or not."""

from __future__ import annotations

from cmath import exp, pi
from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.cases.format import parse_case
from polycnc.session import open_session

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

CONTROLS = {
    "fanuc-m": ("G17 D1", "D1", "R"),
    "meldas-m": ("G17 D1", "D1", "R"),
    "syntec-mill": ("G17", "D1", "R"),
    "sinumerik-840d": ("G17 T1 D1", "", "CR="),
}
RADII = st.sampled_from([0.2, 0.4, 0.8, 3.0, 4.75, 10.0])
DIRECTIONS = st.floats(0.0, 360.0) | st.sampled_from([float(angle) for angle in range(0, 360, 15)])


def program(
    control: str, points: Sequence[complex], arcs: dict[int, str], *, left: bool, increments: bool
) -> str:
    """Blocks from point to point, all rounded to a micrometre; the second is the start-up, the last the cancel."""
    head, number, _ = CONTROLS[control]
    rounded = [complex(round(p.real, 3), round(p.imag, 3)) for p in points]
    lines = [f"G90 {head}", f"G0 X{rounded[0].real:.3f} Y{rounded[0].imag:.3f}"]
    lines += ["G91"] * increments
    for i, (a, b) in enumerate(pairwise(rounded), 1):
        to = b - a if increments else b
        start = f"{'G41' if left else 'G42'} {number} F100" if i == 1 else ""
        code = "G40" if i == len(rounded) - 1 else start
        motion = f"{'G3' if left else 'G2'}" if i in arcs else "G1"
        lines.append(f"{code} {motion} X{to.real:.3f} Y{to.imag:.3f} {arcs.get(i, '')}")
    return "\n".join([*lines, "M30", ""])


def alarms(control: str, text: str, radius: float) -> list[str]:
    case = parse_case(
        {
            "id": "filled",
            "control": control,
            "program": text,
            "setup": {"tools": {1: {"radius": radius}}},
            "expect": {},
        }
    )
    return [
        alarm.code for alarm in open_session(case.program, control=control, setup=case.setup).run().alarms
    ]


def pocket(radius: float, turn: float, left: bool, direction: float) -> list[complex]:
    """Start, entry, line, arc of the radius that turns by an angle, line, exit: turned into a direction."""
    way = exp(1j * turn * pi / 180.0)
    end = 20.0 + radius * (1j - 1j * way)
    points = [-10.0 + 0.0j, 0.0j, 20.0 + 0.0j, end, end + 25.0 * way, end + 35.0 * way, 20.0 + 1j * radius]
    mirrored = [p if left else p.conjugate() for p in points]
    return [p * exp(1j * direction * pi / 180.0) for p in mirrored]


def by_radius(control: str, radius: float, _points: Sequence[complex]) -> str:
    return f"{CONTROLS[control][2]}{radius:.3f}"


def by_center(_control: str, _radius: float, points: Sequence[complex]) -> str:
    at, center = (complex(round(p.real, 3), round(p.imag, 3)) for p in (points[2], points[-1]))
    return f"I{(center - at).real:.3f} J{(center - at).imag:.3f}"


@pytest.mark.parametrize("control", CONTROLS)
@settings(max_examples=30, deadline=None)
@given(RADII, st.floats(5.0, 170.0), DIRECTIONS, st.booleans(), st.sampled_from([by_radius, by_center]))
def test_an_inner_arc_as_large_as_the_tool_is_cut_in_every_direction_and_mode(
    control: str,
    radius: float,
    turn: float,
    direction: float,
    left: bool,
    told: Callable[[str, float, Sequence[complex]], str],
) -> None:
    points = pocket(radius, turn, left, direction)
    word = told(control, radius, points)
    for increments in (False, True):
        text = program(control, points[:-1], {3: word}, left=left, increments=increments)
        assert not alarms(control, text, radius), text


@pytest.mark.parametrize("control", ["fanuc-m", "meldas-m"])
@settings(max_examples=30, deadline=None)
@given(RADII, st.floats(20.0, 150.0), DIRECTIONS, st.booleans())
def test_an_arc_smaller_than_the_tool_by_two_hundredths_is_refused_in_every_direction_and_mode(
    control: str, radius: float, turn: float, direction: float, left: bool
) -> None:
    points = pocket(radius - 0.02, turn, left, direction)
    word = by_center(control, radius, points)
    for increments in (False, True):
        text = program(control, points[:-1], {3: word}, left=left, increments=increments)
        assert alarms(control, text, radius) in (["PS0041"], ["P153"]), text


@pytest.mark.parametrize("control", CONTROLS)
@settings(max_examples=30, deadline=None)
@given(RADII, DIRECTIONS)
def test_a_groove_as_wide_as_the_tool_is_cut_in_every_direction_and_mode(
    control: str, radius: float, direction: float
) -> None:
    wide = 2.0 * radius
    shape = [-20, -20 + 30j, 30j, 10j, wide + 10j, wide + 30j, wide + 20 + 30j, wide + 20, wide + 30]
    points = [p * exp(1j * direction * pi / 180.0) for p in shape]
    for increments in (False, True):
        text = program(control, points, {}, left=True, increments=increments)
        assert not alarms(control, text, radius), text
