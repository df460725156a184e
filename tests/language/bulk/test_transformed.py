# ruff: noqa: E501 - programs stand as they are written
"""Plain blocks under an active transformation: both ways give the same."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.examples import examples
from tests.language.bulk.both_ways import differences, scanned
from tests.language.bulk.programs import plain, program
from tests.language.bulk.test_sinumerik import COMMENTS
from tests.language.bulk.test_word_address import FANUC_COMMENTS

HEAD, TABLES = "mill5-bc-head", "mill5-ac-table"
TOOLS = {"tools": {1: {"length": 100, "radius": 3}}}

#: What begins and ends a transformation, and codes that act on its blocks.
FANUC = (
    "G43.4 H1", "G49", "G43.4 H1 X5.", "G54", "G55", "G90", "G91", "M3 S1000", "G0 B90. C10.", "G68.2 X1. I30. J20. K0", "G69",
    "G53.1", "G12.1", "G13.1", "G93 F5.", "G94 F900.",
)  # fmt: skip
SINUMERIK = (
    "TRAORI", "TRAFOOF", "TRANS X10", "ROT Z30", "TRANS", "A3=1 B3=0 C3=1", "ORIVECT", "ORIAXES", "ORIWKS", "ORIMKS", "G54", "G55",
    "G90", "G91", "T1 D1", "D0", "S900 M3", "G0 B40 C=DC(10)", "G93 F5", "G94 F900", 'CYCLE800(0,"",0,27,0,0,0,90,0,30,0,0,0,1)',
)  # fmt: skip


@pytest.mark.parametrize(("machine", "letters"), [(HEAD, "XYZBC"), (TABLES, "XYZAC")])
@settings(max_examples=examples(12), deadline=None)
@given(st.data())
def test_tool_centre_point_control(machine: str, letters: str, data: st.DataObject) -> None:
    start = f"O0001\nG90 G54 G1 F1000.\nG43.4 H1 Z20.\nG1 X1. {letters[3]}5."
    blocks = program(
        plain(letters, FANUC_COMMENTS), st.sampled_from(FANUC), st.just("G43.4 H99"), start, "M30"
    )
    text = data.draw(blocks)
    assert differences(text, "fanuc-m", {"machine": machine, **TOOLS}) == []


@pytest.mark.parametrize(("machine", "letters"), [(HEAD, "XYZBC"), (TABLES, "XYZAC")])
@settings(max_examples=examples(12), deadline=None)
@given(st.data())
def test_orientation_transformation(machine: str, letters: str, data: st.DataObject) -> None:
    start = f"G90 G54 G1 F1000 T1 D1\nTRAORI\nG1 X1 {letters[3]}5"
    blocks = program(
        plain(letters, COMMENTS, equals=True),
        st.sampled_from(SINUMERIK),
        st.just("GOTOF NIRGENDS"),
        start,
        "M30",
    )
    text = data.draw(blocks)
    assert differences(text, "sinumerik-840d", {"machine": machine, **TOOLS}) == []


POLAR = (
    "G12.1", "G13.1", "G0 X30.", "G7.1 C20.", "G7.1 C0", "G18", "G17", "G90", "G91", "M3 S100", "G54", "G40 X40.",
    "X0 C0", "X10. C5.\nX-10. C-5.",
)  # fmt: skip


@settings(max_examples=examples(12), deadline=None)
@given(
    program(
        plain("XZC", FANUC_COMMENTS),
        st.sampled_from(POLAR),
        st.just("G12.1 X5."),
        "O0001\nG90 G54 G0 X60.\nG12.1\nG1 F500.",
        "M30",
    )
)
def test_polar_and_cylindrical_interpolation(text: str) -> None:
    assert differences(text, "fanuc-m", {"machine": "mill4-xyzc"}) == []


FACE = (
    "TRANSMIT", "TRAFOOF", "TRACYL(40)", "G0 X30", "G17", "G19", "G90", "G91", "TRANS X1", "S100 M3", "X0 Y0", "X10 Y5\nX-10 Y-5",
    "X0\nX0 Y7",
)  # fmt: skip


@settings(max_examples=examples(12), deadline=None)
@given(
    program(
        plain("XYZ", COMMENTS, equals=True), st.sampled_from(FACE), st.just("GOTOF NIRGENDS"),
        "G90 G54 G0 X60 Z5\nTRANSMIT\nG17 G1 F500 X20 Y5", "M30",
    )
)  # fmt: skip
def test_face_and_cylinder(text: str) -> None:
    assert differences(text, "sinumerik-840d", {"machine": "lathe-c-transmit"}) == []


def test_blocks_off_the_centre_of_turning_are_scanned() -> None:
    face = "".join(f"N{i} G1 X{i} Y{0.5 * i}\n" for i in range(5, 40))
    text = f"G0 X60 Z5\nTRANSMIT\nG17 G1 F500 X20 Y5\n{face}X-7 Y-3.5\n{face}M30\n"
    assert scanned(text, "sinumerik-840d", {"machine": "lathe-c-transmit"}) >= 65


BLOCKS = "".join(f"N{i} G1 X{i}. Y{2 * i}. Z-1. B{i * 0.1:.1f} C{i * 0.2:.1f}\n" for i in range(1, 41))


@pytest.mark.parametrize(
    ("control", "start"),
    [("fanuc-m", "O1\nG90 G54 F1000.\nG43.4 H1\n"), ("sinumerik-840d", "G90 G54 F1000 T1 D1\nTRAORI\n")],
)
def test_blocks_of_five_axes_are_scanned(control: str, start: str) -> None:
    assert scanned(f"{start}{BLOCKS}M30\n", control, {"machine": HEAD, **TOOLS}) >= 35


STARTS = {"fanuc-m": "O1\nG90 G54 F1000.\nG43.4 H1\n", "sinumerik-840d": "G90 G54 F1000 T1 D1\nTRAORI\n"}
PLACE = st.tuples(*[st.integers(-60, 60)] * 3, *[st.integers(-40, 40)] * 2, st.sampled_from(["G0", "G1"]))


@pytest.mark.parametrize("control", STARTS)
def test_far_from_limits_of_travel_blocks_are_scanned(control: str) -> None:
    setup = {"machine": HEAD, **TOOLS}
    assert scanned(f"{STARTS[control]}{BLOCKS}M30\n", control, setup, travel=500.0) >= 35
    assert differences(f"{STARTS[control]}{BLOCKS}M30\n", control, setup, travel=85.0) == []


@pytest.mark.parametrize("control", STARTS)
@pytest.mark.parametrize(("machine", "letters"), [(HEAD, "BC"), (TABLES, "AC")])
@settings(max_examples=examples(15), deadline=None)
@given(st.lists(PLACE, min_size=3, max_size=12), st.integers(60, 140))
def test_limits_of_travel_are_found_in_the_same_block(
    control: str, machine: str, letters: str, places: list[tuple[int, int, int, int, int, str]], travel: int
) -> None:
    lines = [
        f"{code} X{x}. Y{y}. Z{z}. {letters[0]}{a}. {letters[1]}{b}. (P)" if control == "fanuc-m" else
        f"{code} X{x} Y{y} Z{z} {letters[0]}={a} {letters[1]}={b} S{100 + abs(a)}"
        for x, y, z, a, b, code in places
    ]  # fmt: skip
    text = "\n".join([STARTS[control] + lines[0], *lines, "M30", ""])
    assert differences(text, control, {"machine": machine, **TOOLS}, travel=float(travel)) == []


#: Directions of the tool: near each other, far apart, at the pole, of any length, and none at all.
DIRECTION = st.one_of(
    st.tuples(*[st.floats(-0.02, 0.02).map(lambda v: round(v, 5))] * 2, st.just(1.0)),
    st.tuples(st.floats(0.3, 0.32).map(lambda v: round(v, 5)), st.floats(-0.02, 0.02), st.just(1.0)),
    st.tuples(*[st.floats(-1.0, 1.0).map(lambda v: round(v, 4))] * 3),
    st.sampled_from([(0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (3.0, 0.1, 10.0)]),
)
#: What stands in a block beside its direction, and what changes how directions are meant.
BESIDE = st.sampled_from(
    ["G1 X{}", "G1 X{} Y{} Z1", "G0 Z{}", "G1 F{}", "G1 X{} F700", "G2 X{} Y0 I1", "G1 X{} B=3"]
)
CHANGES = st.sampled_from([
    "ORIAXES", "ORIVECT", "ORIMKS", "ORIWKS", "ROT X20", "ROT", "G91", "G90", "TRAFOOF", "TRAORI", "OSSE ORIS=5", "OSOF",
    "ORICONTO A3=0.3 B3=0.1 C3=1 A6=0 B6=0.2 C6=1", "G1 B=10 C=20", "PTP", "CP", "G54", "TRANS X3", "M3 S200",
    "ASPLINE", "G1", "A4=0 B4=0 C4=1",
])  # fmt: skip


@pytest.mark.parametrize(("machine", "angle"), [(HEAD, "B"), (TABLES, "A")])
@settings(max_examples=examples(20), deadline=None)
@given(st.lists(st.one_of(st.tuples(BESIDE, DIRECTION, st.integers(0, 9)), CHANGES), min_size=2, max_size=14))
def test_directions_of_the_tool(
    machine: str, angle: str, blocks: list[str | tuple[str, tuple[float, float, float], int]]
) -> None:
    lines = [f"G90 G54 F1000 T1 D1\nTRAORI\nG1 X1 {angle}=17 C=5"]
    for block in blocks:
        if isinstance(block, str):
            lines.append(block)
        else:
            beside, (x, y, z), number = block
            lines.append(f"{beside.format(*[number] * 2)} A3={x} B3={y} C3={z}")
    text = "\n".join([*lines, "M30", ""])
    assert differences(text, "sinumerik-840d", {"machine": machine, **TOOLS}) == []
    assert differences(text, "sinumerik-840d", {"machine": machine, **TOOLS}, travel=200.0) == []


@pytest.mark.parametrize("machine", [HEAD, TABLES])
def test_blocks_with_a_direction_are_scanned(machine: str) -> None:
    lines = [f"N{i} G1 X{i} A3={0.3 + 0.001 * i:.4f} B3={0.1 - 0.002 * i:.4f} C3=1" for i in range(1, 41)]
    text = "\n".join(["G90 G54 F1000 T1 D1\nTRAORI", *lines, "M30", ""])
    assert scanned(text, "sinumerik-840d", {"machine": machine, **TOOLS}) >= 35


#: Words beside a direction under G43.5, codes between, and what ends tip control.
BESIDE_VECTOR = ("G1 X{0} Y{1}", "G0 Z{0}", "X{0}", "", "G1 F{0}00.")
BETWEEN_VECTORS = (
    "G90",
    "G91",
    "G54",
    "G55",
    "G49\nG43.5 H1",
    "G0 X1.",
    "I0 J0 K0",
    "G43.4 H1 X2.",
    "G43.5 H1",
)
VECTOR = st.tuples(*[st.integers(-3, 3)] * 2, st.sampled_from([1, 2, 5, 0, -1]))


@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
@pytest.mark.parametrize("machine", [HEAD, TABLES])
@settings(max_examples=examples(10), deadline=None)
@given(
    st.lists(
        st.one_of(
            st.tuples(st.sampled_from(BESIDE_VECTOR), VECTOR, st.integers(1, 40)),
            st.sampled_from(BETWEEN_VECTORS),
        ),
        min_size=8,
        max_size=20,
    )
)
def test_directions_of_the_tool_by_i_j_k(machine: str, control: str, blocks: list[object]) -> None:
    lines = ["G90 G54 G1 F1000.", "G43.5 H1"]
    for block in blocks:
        if isinstance(block, tuple):
            beside, (x, y, z), number = block
            lines.append(f"{beside.format(number, number)} I{x}. J{y * 0.3:.3f} K{z}.")
        else:
            lines.append(str(block))
    text = "\n".join([*lines, "M30", ""])
    assert differences(text, control, {"machine": machine, **TOOLS}) == []


@pytest.mark.parametrize("control", ["fanuc-m", "syntec-mill"])
@pytest.mark.parametrize("machine", [HEAD, TABLES])
def test_blocks_with_i_j_k_are_scanned(machine: str, control: str) -> None:
    lines = [f"N{i} G1 X{i}. I{0.3 + 0.001 * i:.4f} J{0.1 - 0.002 * i:.4f} K1." for i in range(1, 41)]
    text = "\n".join(["G90 G54 F1000.\nG43.5 H1", *lines, "M30", ""])
    assert scanned(text, control, {"machine": machine, **TOOLS}) >= 35


@pytest.mark.parametrize("machine", [HEAD, TABLES])
def test_directions_within_a_rotated_program_keep_the_programmed_point(machine: str) -> None:
    lines = [
        f"X{i * 1.237 - 18.537:.3f} Y{-i * 0.128} I{-0.0281 + 0.003 * i:.4f} J-0.15 K1." for i in range(12)
    ]
    text = "\n".join(["G90 G54 G1 F1000.\nG43.5 H1\nG68 X0 Y0 R30.", *lines, "G69\nG91 X1.\nM30", ""])
    setup = {"machine": machine, **TOOLS}
    assert scanned(text, "fanuc-m", setup) >= 10
    assert differences(text, "fanuc-m", setup) == []
