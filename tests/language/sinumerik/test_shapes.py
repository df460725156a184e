from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.language.sinumerik.shapes import Shapes
from tests.language.sinumerik.running import run, targets, values

NUMBERS = st.one_of(st.integers(0, 500).map(str), st.floats(0, 500).map(lambda x: f"{x:.4f}"), st.just(".5"))
BLOCKS = [
    "G1 X{} Y-{} F{}",
    "N5 X=R1+{} Y=R2*{}-{}",
    "N7 X{}Y={}",
    "R1={}/2 R2={} DIV 7",
    "II={}",
    "AA[2]={} AA[1]=II+{}",
    "IF R1>{} GOTOF LL1",
    "G0 X=AC({}) ; remark {}",
    "II=({}+{}) MOD 7",
]


def test_a_block_of_a_known_shape_is_not_compiled_again() -> None:
    shapes = Shapes()
    assert shapes.step("N10 G1 X=R1+1.5") is None
    session = run("G1 F100 X=R1+1.5\nX=R1+2.5\nX=R1+3.5")
    assert [row["to"]["X"] for row in session.rows if "to" in row] == [1.5, 2.5, 3.5]


def test_whole_numbers_keep_their_type_in_equal_shapes() -> None:
    assert values("R1=7 DIV 2\nR2=9 DIV 2\nR3=9.0 DIV 2\nR4=5/2\nR5=7/2", "R1", "R2", "R3", "R5") == [
        3,
        4,
        4,
        3.5,
    ]


def test_extended_addresses_are_no_numbers() -> None:
    assert run("S1=100 M1=3\nS2=100 M2=3").alarms[0].line == 2


def test_a_macro_that_comes_later_changes_equal_texts() -> None:
    assert targets("DEFINE AA AS G0 X5\nAA\nX6")[-1]["X"] == 6


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_blocks_run_alike_with_and_without_shapes(data: st.DataObject) -> None:
    lines = ["DEF INT II", "DEF REAL AA[3]", "G1 F100"]
    for _ in range(data.draw(st.integers(1, 8))):
        block = data.draw(st.sampled_from(BLOCKS))
        lines.append(block.format(*(data.draw(NUMBERS) for _ in range(block.count("{}")))))
    lines.append("LL1: M30")
    # A string in the block keeps it from having a shape: EXECSTRING compiles each text by itself.
    plain = [line if line.startswith(("DEF", "LL1")) else f'EXECSTRING("{line}")' for line in lines]
    with_shapes, without = run("\n".join(lines)), run("\n".join(plain))
    assert [row.get("to") for row in with_shapes.rows] == [row.get("to") for row in without.rows]
    assert [a.code for a in with_shapes.alarms] == [a.code for a in without.alarms]
    names = ("R1", "R2", "II", "AA[1]", "AA[2]")
    assert [with_shapes.variables[n] for n in names] == [without.variables[n] for n in names]
