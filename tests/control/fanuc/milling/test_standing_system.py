"""Blocks in which tip control begins, and arcs in a work system that does not turn, seen from the table."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.toolpath.kinds import ARC_KINDS
from tests.support import codes, moves, run

TOOLS = {1: {"length": 50}}
TURN = st.integers(-120, 120)


def turned(angle: float, x: float, y: float) -> tuple[float, float]:
    """A point of the machine as C turns it."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return float(c * x - s * y), float(s * x + c * y)


def test_the_block_that_begins_tip_control_moves_the_axes_straight() -> None:
    channel = run(
        "G90 G01 G43.4 H1 X0 Y50. Z0 A90. F3000\nA0\nM30\n",
        machine="mill5-ac-table",
        setup={"tools": TOOLS, "start": {"Z": 50}},
    )
    first, second = moves(channel)
    assert first.context.transformation is None
    assert second.context.transformation is not None
    assert codes(channel) == []


@settings(max_examples=20, deadline=None)
@given(begun=TURN, start=TURN, end=TURN, ccw=st.booleans())
def test_an_arc_in_a_system_that_stands_is_one_of_the_table(
    begun: int, start: int, end: int, ccw: bool
) -> None:
    # On the table, as it stands at zero: a quarter about (40, 10), from (60, 10).
    zero, center, first, last = (7.0, -3.0), (40.0, 10.0), (60.0, 10.0), (40.0, 30.0 if ccw else -10.0)
    (x1, y1), (x2, y2), (xc, yc) = (
        turned(angle, *point) for angle, point in ((start, first), (end, last), (start, center))
    )
    channel = run(
        f"G90 G00 C{begun}.\nG43.4 H1\nG01 X{x1 - zero[0]:.6f} Y{y1 - zero[1]:.6f} Z0 C{start}. F900\n"
        f"G0{3 if ccw else 2} X{x2 - zero[0]:.6f} Y{y2 - zero[1]:.6f} C{end}. I{xc - x1:.6f} J{yc - y1:.6f}\nM30\n",
        machine="mill5-ac-table",
        setup={
            "tools": TOOLS,
            "work_offsets": {"G54": {"X": zero[0], "Y": zero[1]}},
            "parameters": {"19696#5": 1},
        },
    )
    assert codes(channel) == []
    arc, geometry = moves(channel)[-1], channel.coordinates.geometry
    assert arc.kind in ARC_KINDS
    machine = channel.toolpath.to_machine(arc.end, arc.context, geometry)
    assert machine[:2] == pytest.approx((x2, y2), abs=1e-3)
    middle = [*arc.curve[:3], *arc.end[3:]]
    assert channel.toolpath.to_machine(middle, arc.context, geometry)[:2] == pytest.approx(
        turned(end, *center), abs=1e-3
    )


# ---- a work that lies elsewhere (G54.4) ------------------------------------------------------------------------------

PLACE = st.tuples(*[st.integers(-20_000, 20_000).map(lambda value: value / 1000)] * 3)
LEAN = st.tuples(*[st.integers(-60, 60)] * 2)
ERROR = st.tuples(
    PLACE.map(lambda place: tuple(value / 10 for value in place)), st.tuples(*[st.integers(-8, 8)] * 3)
)


def about(axis: int, angle: float) -> np.ndarray:
    """A right-handed turn about X, Y or Z."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    found = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found[i, i], found[i, j], found[j, i], found[j, j] = c, -s, s, c
    return found


@settings(max_examples=15, deadline=None)
@given(
    begun=LEAN, blocks=st.lists(st.tuples(PLACE, LEAN, st.booleans()), min_size=2, max_size=4), error=ERROR
)
def test_a_work_that_lies_elsewhere_is_cut_as_one_that_does_not(
    begun: tuple[int, int],
    blocks: list[tuple[tuple[float, ...], tuple[int, int], bool]],
    error: tuple[tuple[float, ...], tuple[int, int, int]],
) -> None:
    shift, turns = error
    data = "\n".join(f"#{26010 + k}={value:.4f}" for k, value in enumerate((*shift, *turns)))
    lines, before = [data, f"G90 G00 A{begun[0]}. C{begun[1]}.", "G54.4 P1", "G43.4 H1"], None
    for number, (place, lean, counts) in enumerate(blocks):
        increment = counts and before is not None
        words = np.array([*place, *lean]) - (before if increment and before is not None else 0.0)
        motion = "G00" if number == 0 else "G01"
        named = " ".join(f"{name}{value:.3f}" for name, value in zip("XYZAC", words, strict=True))
        lines.append(f"{'G91' if increment else 'G90'} {motion} F900 {named}")
        before = np.array([*place, *lean])
    zero = np.array([7.0, -3.0, 2.0])
    channel = run(
        "\n".join([*lines, "M30", ""]),
        machine="mill5-ac-table",
        setup={
            "tools": TOOLS,
            "work_offsets": {"G54": dict(zip("XYZ", zero.tolist(), strict=True))},
            "parameters": {"19696#5": 1},
        },
    )
    assert codes(channel) == []
    lies = about(2, turns[2]) @ about(1, turns[1]) @ about(0, turns[0])
    rows = {row.line: row for row in moves(channel)}
    first = data.count("\n") + 5
    for number, (place, lean, _) in enumerate(blocks):
        if (row := rows.get(first + number)) is None:
            continue  # neither the tip nor an axis has a way
        machine = np.array(channel.toolpath.to_machine(row.end, row.context, channel.coordinates.geometry))
        told = about(0, lean[0]) @ about(2, lean[1])
        stood = about(0, machine[3]) @ about(2, machine[4])
        on_table = zero + shift + lies @ (told.T @ (zero + place) - zero)
        assert stood.T @ (machine[:3] - [0.0, 0.0, 50.0]) == pytest.approx(on_table, abs=1e-4)
        assert stood.T[:, 2] == pytest.approx(lies @ told.T[:, 2], abs=1e-6)


def test_a_tool_that_turns_with_the_work_goes_straight_on_the_table() -> None:
    channel = run(
        "#26013=10.\n#26010=1.\nG54.4 P1\nG90 G00 G43 H1 X0 Y10. Z0 A20. C0\nG01 X20. Y30. Z5. A-30. C50. F900\nM30\n",
        machine="mill5-ac-table",
        setup={"tools": TOOLS, "parameters": {"11200#0": 1}},
    )
    assert codes(channel) == []
    _, row = moves(channel)
    geometry, seen = channel.coordinates.geometry, []
    start = channel.toolpath.seen_from(
        list(moves(channel)[0].end), moves(channel)[0].context, row.context, geometry
    )
    for part in (0.0, 0.3, 1.0):
        place = [a + part * (b - a) for a, b in zip(start, row.end, strict=True)]
        machine = np.array(channel.toolpath.to_machine(place, row.context, geometry))
        stood = about(0, machine[3]) @ about(2, machine[4])
        seen.append(stood.T @ (machine[:3] - [0.0, 0.0, 50.0]))
    lies, told = about(0, 10), about(0, -30) @ about(2, 50)
    assert seen[0] == pytest.approx([1.0, 0, 0] + lies @ about(0, 20).T @ [0.0, 10.0, 0.0], abs=1e-4)
    assert seen[2] == pytest.approx([1.0, 0, 0] + lies @ told.T @ [20.0, 30.0, 5.0], abs=1e-4)
    assert seen[1] == pytest.approx(seen[0] + 0.3 * (seen[2] - seen[0]), abs=1e-4)
