"""What a program has used: extents with arcs, speeds, feeds, work offsets."""

from __future__ import annotations

import json
import math
from array import array
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

import polycnc
from polycnc.cli.report import as_state, extents
from polycnc.session import Result
from polycnc.toolpath import Kind, compiled
from polycnc.toolpath.compiled import LIBRARY
from polycnc.toolpath.survey import Boxes, Contexts, Moves, add_box, survey, widen
from polycnc.toolpath.usage import MANY, Extents, Usage


def usage(program: str, control: str = "fanuc-m", **setup: object) -> tuple[Result, Usage]:
    result = polycnc.run(program, control=control, setup=setup)
    assert result.alarms == []
    return result, result.usage


def box(extents: Extents, axis: int) -> tuple[float, float]:
    return round(extents.low[axis], 6), round(extents.high[axis], 6)


TWO_TOOLS = """O1
G21 G90 G94 G17 G54
T1 M6
S1200 M3
G0 X10. Y0 Z5.
G1 Z-2. F100
X60. F400
S1500
G3 X60. Y40. R20.
G1 X10.
G0 Z50.
T2 M6
G55 G0 X5. Y5.
Z2.
G1 Z-7. F80
G0 Z20.
M30
"""


def test_each_tool_has_the_extents_speeds_and_feeds_of_its_cuts() -> None:
    _, used = usage(TWO_TOOLS, work_offsets={"G54": {"X": -300, "Y": -200, "Z": -400}})
    first, second = used.tools[1], used.tools[2]
    assert [box(first.work, i) for i in range(3)] == [(10, 80), (0, 40), (-2, 5)]
    assert [box(first.machine, i) for i in range(3)] == [(-290, -220), (-200, -160), (-402, -395)]
    assert list(first.speeds) == [1200, 1500]
    assert first.feeds == {"mm/min": (100, 400)}
    assert [box(second.work, i) for i in range(3)] == [(5, 5), (5, 5), (-7, 2)]
    assert list(used.offsets) == ["G54", "G55"]


def test_a_cut_in_another_work_offset_reaches_from_where_it_starts() -> None:
    offsets = {"G54": {"X": 0}, "G55": {"X": 100}}
    text = "O1\nG21 G90 G94 G17 G54\nG0 X2. Y0\nG1 X10. F100\n{}\nM30\n"
    _, straight = usage(text.format("G55 G1 X-80."), work_offsets=offsets)
    assert box(straight.tools[0].work, 0) == (-90, 10)
    assert box(straight.tools[0].machine, 0) == (2, 20)
    _, round_ = usage(text.format("G55 G2 X-70. I10."), work_offsets=offsets)
    assert [box(round_.tools[0].work, i) for i in range(2)] == [(-90, 10), (0, 10)]
    assert [box(round_.tools[0].machine, i) for i in range(2)] == [(2, 30), (0, 10)]


@given(st.lists(st.sampled_from(tuple("DCTRASO")), min_size=1), st.randoms(use_true_random=False))
def test_whatever_changes_between_moves_each_row_counts_as_alone(codes: list[str], random: Random) -> None:
    changes = {"D": "G4 P10", "T": "T{0} M6", "R": "G0", "C": "G1", "A": "G2", "S": "S{0}00 M3", "O": "G5{0}"}
    text, arc = "O1\nG90 G17 G54 G1 F500.\n", False
    for code in codes:
        text += changes[code].format(random.choice("4567") if code == "O" else random.randint(1, 3)) + "\n"
        arc = code == "A" or (arc and code not in "RC")
        text += f"X{random.uniform(-20, 20):.3f} Y{random.uniform(-20, 20):.3f}{' R200.' if arc else ''}\n"
    offsets = {f"G5{i}": {"X": random.uniform(-9, 9), "Y": random.uniform(-9, 9)} for i in range(4, 8)}
    result, used = usage(text + "M30\n", work_offsets=offsets)
    alone = Usage(result.display)
    for chunk in result.toolpath.chunks:
        for row in range(len(chunk)):
            alone.take(chunk.only([row]) if len(chunk) > 1 else chunk)
    assert (alone.tools, alone.machine, alone.offsets) == (used.tools, used.machine, used.offsets)


def test_cuts_reach_along_what_the_display_calls_the_axes() -> None:
    polar = "G0 X40 Z5 C0\nTRANSMIT\nG1 X20 Y10 F500\nX-20\nTRAFOOF\nM30\n"
    result, used = usage(polar, "sinumerik-840d", machine="lathe-c-transmit")
    reached = dict(zip(result.display.names, range(9), strict=False))
    assert box(used.tools[0].work, reached["Y"]) == (0, 10)
    assert box(used.tools[0].work, reached["C"]) == (math.inf, -math.inf)
    assert json.loads(as_state(result, used))["extents"]["tools"][0]["work"].keys() == {"X", "Y", "Z"}
    reported = extents(result.display.names, used.tools[0].work)
    assert reported == "X -20.000 … 40.000  Z 5.000  Y 0.000 … 10.000"


def test_rapids_count_for_the_machine_alone() -> None:
    _, used = usage("O1\nG90 G0 X100.\nX20.\nG1 X40. F100\nM30\n")
    assert box(used.tools[0].work, 0) == (20, 40)
    assert box(used.machine, 0) == (20, 100)


def test_inches_and_diameters_are_as_the_display_shows_them() -> None:
    _, used = usage("O1\nG20 G90 G0 X0\nG0 Y1.\nG1 X2. F10\nM30\n")
    assert box(used.tools[0].work, 0) == (0, 2)
    assert box(used.tools[0].machine, 0) == (0, 50.8)
    _, turned = usage("O1\nG21 G98\nG0 X50. Z2.\nG1 Z-10. F100\nX60.\nM30\n", "fanuc-0i-tf")
    assert box(turned.tools[0].work, 0) == (50, 60)


def test_a_program_without_motion_has_used_nothing() -> None:
    _, used = usage("O1\nM30\n")
    assert used.tools == {}
    assert not used.machine.known
    assert list(used.offsets) == []


def reach(
    start: list[float], end: list[float], curve: list[float], *, ccw: bool
) -> list[tuple[float, float]]:
    """Where an arc turns back along X, Y and Z: least and greatest place, infinite where it does not."""
    boxes = no_boxes()
    add_box(boxes, 3)
    points = array("d", start), 0, array("d", end), 0
    widen(*points, array("d", curve), 0, ccw, array("q", range(3)), boxes, 0)
    return list(zip(boxes.low, boxes.high, strict=True))


def no_boxes() -> Boxes:
    return Boxes(array("d"), array("d"), array("d"))


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@given(st.lists(st.sampled_from(("G1 ", "G0 ", "G2 ", "G3 ")), min_size=1), st.randoms(use_true_random=False))
def test_the_compiled_kernel_gives_the_same_bits(codes: list[str], random: Random) -> None:
    text = "O1\nG90 G17 G1 F500.\n"
    for code in codes:
        radius = f" R{random.uniform(60, 90):.3f}" if code in {"G2 ", "G3 "} else ""
        text += f"{code}X{random.uniform(-20, 20):.3f} Y{random.uniform(-20, 20):.3f}{radius}\n"
    result = polycnc.run(text + "M30\n", control="fanuc-m")
    (chunk,) = result.toolpath.chunks
    moves = Moves(chunk.kind, chunk.context, chunk.feed, chunk.end, chunk.curve, chunk.curves)
    classes = array("B", [0, *[1] * (len(Kind) - 1)])
    found = []
    for kernel in (survey, compiled.survey()):
        boxes = no_boxes()
        add_box(boxes, chunk.axes)
        add_box(boxes, chunk.axes)
        contexts = Contexts(array("q", [0, 1]), array("q", [0, 1, 0, 1]))
        ends, row = [], 0
        while row < len(chunk):
            before = chunk.end[(row - 1) * chunk.axes : row * chunk.axes] if row else array("d")
            row = kernel(moves, row, classes, array("q", range(3)), before, contexts, boxes)
            ends.append(row)
        found.append((boxes, ends))
    assert found[0] == found[1]


@given(
    start=st.floats(0, 2 * math.pi),
    sweep=st.floats(0.05, 2 * math.pi - 0.05),
    radius=st.floats(0.5, 200),
    ccw=st.booleans(),
    axis=st.integers(0, 2),
)
def test_an_arc_reaches_as_far_as_its_points(
    start: float, sweep: float, radius: float, ccw: bool, axis: int
) -> None:
    right, up = ((1, 2), (2, 0), (0, 1))[axis]

    def point(angle: float) -> list[float]:
        at = [3.0, -4.0, 5.0]
        at[right] += radius * math.cos(angle)
        at[up] += radius * math.sin(angle)
        return at

    turn = sweep if ccw else -sweep
    normal = [float(i == axis) for i in range(3)]
    ends = point(start), point(start + turn)
    reached = reach(*ends, [3.0, -4.0, 5.0, *normal, 0.0, 0.0], ccw=ccw)
    drawn = [point(start + turn * k / 2000) for k in range(2001)]
    for i in range(3):
        values = [at[i] for at in ends] + [value for value in reached[i] if math.isfinite(value)]
        assert min(values) == pytest.approx(min(at[i] for at in drawn), abs=radius * 1e-5)
        assert max(values) == pytest.approx(max(at[i] for at in drawn), abs=radius * 1e-5)


@given(
    normal=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: math.hypot(*n) > 0.1),
    start=st.floats(0, 2 * math.pi),
    sweep=st.floats(0.05, 2 * math.pi - 0.05),
)
def test_a_tilted_arc_reaches_as_far_as_its_points(
    normal: tuple[float, float, float], start: float, sweep: float
) -> None:
    length = math.hypot(*normal)
    n = [value / length for value in normal]
    least = min(range(3), key=lambda i: abs(n[i]))
    helper = [float(i == least) for i in range(3)]
    u = [
        n[1] * helper[2] - n[2] * helper[1],
        n[2] * helper[0] - n[0] * helper[2],
        n[0] * helper[1] - n[1] * helper[0],
    ]
    u = [value / math.hypot(*u) for value in u]
    v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]

    def point(angle: float) -> list[float]:
        return [7.0 * (u[i] * math.cos(angle) + v[i] * math.sin(angle)) for i in range(3)]

    reached = reach(point(start), point(start + sweep), [0.0, 0.0, 0.0, *n, 0.0, 0.0], ccw=True)
    drawn = [point(start + sweep * k / 2000) for k in range(2001)]
    # A normal along an axis but for 1e-9 counts as along it: over a radius of 7 that is 0.0003.
    for i in range(3):
        values = [drawn[0][i], drawn[-1][i], *(value for value in reached[i] if math.isfinite(value))]
        assert min(values) == pytest.approx(min(at[i] for at in drawn), abs=4e-4)
        assert max(values) == pytest.approx(max(at[i] for at in drawn), abs=4e-4)


def test_a_following_geometry_axis_counts_where_it_is() -> None:
    _, used = usage(
        "G0 X10 Y0 Z5\nTRAILON(Y,X,-2)\nG1 X40 F500\nY80\nG2 X80 I20\nTRAILOF(Y)\nM30\n", "sinumerik-840d"
    )
    # Its own way to 80 goes beside the -60 of the coupling: 20, then the upper half circle with its slope.
    lowest, highest = box(used.tools[0].work, 1)
    assert lowest == -60
    assert highest == pytest.approx(20 - 40 + 20 * math.sqrt(5), abs=1e-4)
    assert box(used.machine, 1) == (lowest, highest)


@pytest.mark.parametrize(
    "couple",
    [
        "TRAILON(Y,X,1)",
        'EGDEF(Y,X,1)\nEGON(Y,"NOC",X,1,1)',
        "MASLDEF(Y,X)\nMASLON(Y)",
        "CTABDEF(Y,X,1,0)\nG1 X0 Y0 F100\nX60 Y60\nCTABEND\nLEADON(Y,X,1)",
    ],
)
def test_so_it_is_with_every_coupling(couple: str) -> None:
    _, used = usage(f"G0 Z5\n{couple}\nG1 X50 F500\nM30\n", "sinumerik-840d")
    assert box(used.tools[0].work, 1) == (0, 50)
    assert box(used.machine, 1) == (0, 50)


def test_a_peak_of_a_table_within_a_row_counts() -> None:
    table = "CTABDEF(Y,X,1,0)\nG1 X0 Y0 F1000\nX77 Y50\nX200 Y0\nCTABEND\n"
    _, used = usage(f"{table}G0 Z5\nLEADON(Y,X,1)\nG1 X200 F1000\nLEADOF(Y)\nM30\n", "sinumerik-840d")
    assert box(used.tools[0].work, 1) == (0, 50)
    assert box(used.machine, 1) == (0, 50)


def test_own_way_against_the_coupling_leaves_an_axis_where_it_is() -> None:
    _, used = usage("G0 Z5\nTRAILON(Y,X,1)\nG1 X50 Y-50 F500\nTRAILOF(Y)\nM30\n", "sinumerik-840d")
    assert box(used.tools[0].work, 1) == (0, 0)
    assert box(used.machine, 1) == (0, 0)


def test_many_rows_under_a_transformation_reach_as_far_as_each_of_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    random = Random(3)
    lines = [f"G1 X{random.uniform(-40, 40):.3f} B{random.uniform(-60, 60):.3f} F400" for _ in range(MANY)]
    program = "\n".join(["TRAORI", *lines, "TRAFOOF", "M30", ""])
    result = polycnc.run(program, control="sinumerik-840d", machine="mill5-bc-head")
    assert result.alarms == []
    whole = result.usage.machine
    monkeypatch.setattr("polycnc.toolpath.usage.MANY", MANY + 1)
    assert result.usage.machine == whole
    for row in result.toolpath.rows():
        if row.kind is Kind.FEED:
            at = result.toolpath.to_machine(row.end, row.context, result.display.layout.geometry)
            places = zip(whole.low, at, whole.high, strict=True)
            assert all(low - 1e-9 <= place <= high + 1e-9 for low, place, high in places)
