"""Radius compensation in space beside that of a plane, and seen from the work by the joints of the machine alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.toolpath import Kind
from tests.support import codes, ends, moves, run

if TYPE_CHECKING:
    from pathlib import Path

    from polycnc.channel.channel import Channel

WAYS = st.tuples(st.sampled_from((-1, 1)), st.integers(15_000, 40_000)).map(
    lambda way: way[0] * way[1] / 1000
)
#: What stands in a block beside its words: nothing, another radius, the same code again, the other side.
BESIDE = st.sampled_from(("", "", "", "D2", "same", "other"))
STEPS = st.lists(st.tuples(WAYS, WAYS, BESIDE), min_size=2, max_size=5)
TOOLS = {1: {"length": 50, "radius": 3.0}, 2: {"length": 50, "radius": 4.0}}


def program(length: str, dialect: str, steps: list[tuple[float, float, str]], start: str, end: str) -> str:
    """`dialect` stands behind G41 and G42, `start` and `end` beside the first code and the last one."""
    side = "G41"
    blocks, x, y = [f"G90 {length} H1", "G00 X0 Y0 Z0", "G01 F500", f"{side}{dialect} D1 {start}"], 0.0, 0.0
    for dx, dy, beside in steps:
        x, y = x + dx, y + dy
        side = {"G41": "G42", "G42": "G41"}[side] if beside == "other" else side
        word = f"{side}{dialect}" if beside in ("same", "other") else beside
        blocks.append(f"{word} X{x:.3f} Y{y:.3f}")
    return "\n".join([*blocks, f"G40 {end}", "X-90. Y-90.", "M30", ""])


@settings(max_examples=12, deadline=None)
@given(
    steps=STEPS,
    negative=st.booleans(),
    sup=st.integers(0, 1),
    suv=st.integers(0, 1),
    start=st.sampled_from(("", "X-20.")),
    end=st.sampled_from(("", "X-60. Y-90.")),
)
def test_an_upright_tool_goes_as_in_the_plane(
    steps: list[tuple[float, float, str]], negative: bool, sup: int, suv: int, start: str, end: str
) -> None:
    sign = -1.0 if negative else 1.0
    tools = {number: {**data, "radius": sign * data["radius"]} for number, data in TOOLS.items()}
    setup = {"tools": tools, "parameters": {"5003#0": sup, "5003#1": suv}}
    machine = "mill5-bc-head"
    plane = run(program("G43", "", steps, start, end), setup=setup, machine=machine)
    space = run(program("G43.4", ".2", steps, start, end), setup=setup, machine=machine)
    unled = run(program("G43", ".2", steps, start, end), setup=setup, machine=machine)
    assert codes(space) == codes(plane) == codes(unled)
    if not codes(plane):
        assert ends(unled) == pytest.approx(np.array(ends(plane)), abs=1e-5)
        assert ends(space) == pytest.approx(np.array(ends(plane)), abs=1e-5)


# ---- seen from the work --------------------------------------------------------------------------------------------


def turn(axis: int, angle: float) -> np.ndarray:
    """A right-handed turn about X, Y or Z, by degrees."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    found = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    found[i, i], found[i, j], found[j, i], found[j, j] = c, -s, s, c
    return found


#: A trunnion beside the zero of the machine; a head about B on a table C that lies off it.
MACHINES = {
    "table": """
base = "mill5-ac-table"
[[joint]]
axis = "A"
carries = "work"
direction = [1, 0, 0]
offset = [0, 7, -20]
[[joint]]
axis = "C"
carries = "work"
direction = [0, 0, 1]
offset = [3, 0, 12]
""",
    "mixed": """
base = "mill5-bc-head"
[[joint]]
axis = "C"
carries = "work"
direction = [0, 0, 1]
offset = [11, -5, 0]
[[joint]]
axis = "B"
carries = "tool"
direction = [0, 1, 0]
""",
}


def table_at(kind: str, first: float, second: float) -> tuple[np.ndarray, np.ndarray]:
    """How the table of a machine moves the work at two rotary positions: a turn and a shift."""
    if kind == "mixed":
        centre, turned = np.array([11.0, -5.0, 0.0]), turn(2, second)
        return turned, centre - turned @ centre
    outer, inner = np.array([0.0, 7.0, -20.0]), np.array([3.0, 0.0, 12.0])
    a, c = turn(0, first), turn(2, second)
    return a @ c, outer + a @ inner - a @ c @ (outer + inner)


POINTS = st.lists(
    st.tuples(WAYS, WAYS, st.floats(-6.0, 6.0), st.floats(-25.0, 25.0), st.floats(-25.0, 25.0)),
    min_size=3,
    max_size=4,
)
Point = tuple[float, float, float, float, float]


def laid(points: list[Point]) -> list[np.ndarray]:
    """Points of the work one behind the other, with rotary positions; the last one is where G40 leads to."""
    place, found = np.zeros(3), [np.zeros(5)]
    for dx, dy, dz, first, second in points:
        place = place + np.array([dx, dy, dz])
        found.append(np.round(np.array([*place, first, second]), 3))
    return [*found, np.array([-300.0, -300.0, 0.0, *found[-1][3:]])]


def machine_file(kind: str, folder: Path) -> str:
    if kind == "head":
        return "mill5-bc-head"
    path = folder / f"{kind}.toml"
    path.write_text(MACHINES[kind], encoding="utf-8")
    return str(path)


def seen(kind: str, machine: np.ndarray, arm: float) -> tuple[np.ndarray, np.ndarray]:
    """Tip and tool as the table sees them at zero, by the positions of the axes."""
    first, second = machine[3:5]
    up = np.array([0.0, 0.0, 1.0])
    if kind == "head":
        tool = turn(2, second) @ turn(1, first) @ up
        return machine[:3] - arm * tool, tool
    tool = turn(1, first) @ up if kind == "mixed" else up
    turned, shift = table_at(kind, first, second)
    return turned.T @ (machine[:3] - arm * tool - shift), turned.T @ tool


def text_of(length: str, code: str, points: list[np.ndarray], names: str) -> str:
    blocks = [f"G90 {length} H1"]
    for number, point in enumerate(points):
        words = " ".join(f"{name}{value:.4f}" for name, value in zip(names, point, strict=True))
        before = {0: "G00", 1: f"{code} D1 G01 F900", len(points) - 1: "G40"}.get(number, "")
        blocks.append(f"{before} {words}")
    return "\n".join([*blocks, "M30", ""])


def off_parallels(kind: str, channel: Channel, points: list[np.ndarray], radius: float) -> list[float]:
    """How far the tip is off the parallel of each compensated line, at ends and middles of its moves, mm."""
    found, before, passed = [], np.zeros(5), set()
    for row in moves(channel):
        number, end = row.line - 2, np.array(row.end)
        if 2 <= number < len(points) - 1 and row.line not in passed:
            way = points[number][:3] - points[number - 1][:3]
            for part in (0.5, 1.0):
                place = (before + part * (end - before)).tolist()
                machine = channel.toolpath.to_machine(place, row.context, channel.coordinates.geometry)
                tip, tool = seen(kind, np.array(machine), 50.0)
                normal = np.cross(tool, way)
                beside = (tip - points[number][:3]) @ normal / np.linalg.norm(normal)
                found.append(float(beside - radius))
            if row.kind is not Kind.SPLINE:
                passed.add(row.line)  # what follows leads round a corner
        before = end
    return found


@settings(max_examples=10, deadline=None)
@given(points=POINTS, kind=st.sampled_from(("table", "mixed", "head")), radius=st.sampled_from((4.0, -4.0)))
def test_the_tip_keeps_its_distance_to_the_path_all_the_way(
    points: list[Point], kind: str, radius: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    machine = machine_file(kind, tmp_path_factory.mktemp("machine"))
    work = laid(points)
    setup = {"tools": {1: {"length": 50, "radius": radius}}}
    text = text_of("G43.4", "G41.2", work, "XYZAC" if kind == "table" else "XYZBC")
    channel = run(text, setup=setup, machine=machine)
    assert set(codes(channel)) <= {"PS0041"}, channel.alarms
    assert max(map(abs, off_parallels(kind, channel, work, radius)), default=0.0) < 1e-3


def shifts(channel: Channel, words: list[np.ndarray]) -> dict[int, list[np.ndarray]]:
    """How far beside its programmed end each block ends, and how far beside the corner it leads on from there."""
    found: dict[int, list[np.ndarray]] = {}
    for row in moves(channel):
        number = row.line - 2
        if number < len(words) and row.kind is not Kind.SPLINE:
            found.setdefault(number, []).append(np.array(row.end[:3]) - words[number][:3])
    return found


@settings(max_examples=8, deadline=None)
@given(
    points=POINTS,
    form=st.sampled_from((("table", "G41.4"), ("table", "G42.2"), ("mixed", "G42.5"), ("mixed", "G41.2"))),
    sup=st.integers(0, 1),
)
def test_without_tip_control_a_block_ends_as_far_beside_the_same_point_of_the_work(
    points: list[Point], form: tuple[str, str], sup: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    kind, code = form
    machine = machine_file(kind, tmp_path_factory.mktemp("machine"))
    names, work = "XYZAC" if kind == "table" else "XYZBC", laid(points)
    turned = [table_at(kind, *point[3:]) for point in work]
    axes = [np.array([*(m @ point[:3] + t), *point[3:]]) for (m, t), point in zip(turned, work, strict=True)]
    setup = {"tools": {1: {"length": 50, "radius": 4.0}}, "parameters": {"1013#1": 1, "5003#0": sup}}
    led = run(text_of("G43.4", f"{code[:3]}.2", work, names), setup=setup, machine=machine)
    unled = run(text_of("G43", code, axes, names), setup=setup, machine=machine)
    on_work, on_axes = shifts(led, work), shifts(unled, axes)
    for number in range(1, len(work) if not codes(led) else 0):
        for wanted, found in zip(on_work[number], on_axes[number], strict=True):
            assert turned[number][0].T @ found == pytest.approx(wanted, abs=3e-3)


ANGLE = st.integers(-25, 25).map(float)


@settings(max_examples=6, deadline=None)
@given(
    kind=st.sampled_from(("table", "mixed")),
    start=st.tuples(ANGLE, ANGLE),
    end=st.tuples(ANGLE, ANGLE),
    own_block=st.booleans(),
)
def test_tip_control_takes_the_work_system_along_as_it_lies_when_it_begins(
    kind: str,
    start: tuple[float, float],
    end: tuple[float, float],
    own_block: bool,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    machine = machine_file(kind, tmp_path_factory.mktemp("machine"))
    first, second = "AC" if kind == "table" else "BC"
    turned = f"{first}{start[0]} {second}{start[1]}"
    begin = f"G90 G43.4 H1 G00 {turned}" if own_block else f"G90 G00 {turned}\nG43.4 H1"
    text = f"{begin}\nX12. Y-7. Z20. {first}{end[0]} {second}{end[1]}\nM30\n"
    setup = {"tools": {1: {"length": 50}}, "work_offsets": {"G54": {"X": 5, "Y": 6, "Z": 7}}}
    channel = run(text, setup=setup, machine=machine)
    assert codes(channel) == []
    tip, _ = seen(kind, np.array(channel.coordinates.machine), 50.0)
    m, t = table_at(kind, *start)
    assert tip == pytest.approx(m.T @ (np.array([17.0, -1.0, 27.0]) - t), abs=1e-6)


@settings(max_examples=6, deadline=None)
@given(kind=st.sampled_from(("table", "mixed")), start=st.tuples(ANGLE, ANGLE), points=POINTS)
def test_in_a_system_that_stands_the_tip_goes_straight_on_the_table(
    kind: str,
    start: tuple[float, float],
    points: list[Point],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    machine = machine_file(kind, tmp_path_factory.mktemp("machine"))
    names, zero = "XYZAC" if kind == "table" else "XYZBC", np.array([5.0, 6.0, 7.0])
    blocks = [f"G90 G00 {names[3]}{start[0]} C{start[1]}", "G43.4 H1", "G01 F900"]
    goals = laid(points)[:-1]
    blocks += [
        " ".join(f"{name}{value:.3f}" for name, value in zip(names, goal, strict=True)) for goal in goals
    ]
    setup = {
        "tools": {1: {"length": 50}},
        "work_offsets": {"G54": dict(zip("XYZ", zero.tolist(), strict=True))},
        "parameters": {"19696#5": 1},
    }
    channel = run("\n".join([*blocks, "M30", ""]), setup=setup, machine=machine)
    assert codes(channel) == []
    rows, geometry = moves(channel)[-len(goals) :], channel.coordinates.geometry
    before = None
    for row, goal in zip(rows, goals, strict=True):
        end = np.array(row.end)
        tip, _ = seen(kind, np.array(channel.toolpath.to_machine(row.end, row.context, geometry)), 50.0)
        m, t = table_at(kind, *goal[3:])
        assert tip == pytest.approx(m.T @ (goal[:3] + zero - t), abs=1e-6)
        if before is not None:
            middle = channel.toolpath.to_machine(((before[0] + end) / 2.0).tolist(), row.context, geometry)
            assert seen(kind, np.array(middle), 50.0)[0] == pytest.approx((before[1] + tip) / 2.0, abs=1e-6)
        before = (end, tip)
