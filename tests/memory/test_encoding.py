"""Values of retained memory as text."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.control.fanuc.lathe.tools.offset_memory import TurningOffset
from polycnc.control.sinumerik.tools.edges import Edge
from polycnc.control.sinumerik.tools.memory import Tool
from polycnc.control.word_address.memory import ToolOffset
from polycnc.language.sinumerik.names.frame import AxisFrame, NcFrame
from polycnc.language.sinumerik.names.values import Axis
from polycnc.machine.setup.values import parameter_key
from polycnc.memory.encoding import decode, encode
from polycnc.messages import Alarm
from polycnc.program import Form, Program

NUMBERS = st.floats(allow_nan=False)
PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | NUMBERS | st.text(),
    lambda inner: (
        st.lists(inner)
        | st.lists(inner).map(tuple)
        | st.dictionaries(st.text() | st.integers() | st.tuples(st.text(), st.integers()), inner)
    ),
    max_leaves=20,
)
OFFSETS = st.builds(ToolOffset, NUMBERS, NUMBERS, NUMBERS, NUMBERS, st.integers(0, 9))
EDGES = st.builds(Edge, st.lists(NUMBERS, max_size=26), NUMBERS, st.integers(0, 9), st.booleans())
FRAMES = st.builds(
    NcFrame,
    coarse=st.tuples(NUMBERS, NUMBERS, NUMBERS),
    others=st.dictionaries(st.text(), st.builds(AxisFrame, NUMBERS)),
)


@given(
    PLAIN
    | OFFSETS
    | FRAMES
    | EDGES
    | st.builds(Tool, st.integers(), st.text(), st.dictionaries(st.integers(), EDGES))
)
def test_a_value_comes_back_as_it_was(value: object) -> None:
    line = encode(value)
    assert "\n" not in line
    assert decode(line) == value
    assert type(decode(line)) is type(value)


@pytest.mark.parametrize(
    "value",
    [
        float("inf"), True, 1, 1.0, Axis("X"), Form.MACRO, TurningOffset({"X": 1.0}, tip=3), parameter_key("5003#1"),
        Alarm("fanuc-m", "PS0010", "O1", 3, 4, "G1", {"code": "G1", "value": 2.5}),
    ],
)  # fmt: skip
def test_values_of_features_come_back(value: object) -> None:
    found = decode(encode(value))
    assert found == value
    assert type(found) is type(value)


def test_no_number_is_lost_for_not_being_one() -> None:
    assert decode(encode([float("nan")]))[0] != decode(encode([float("nan")]))[0]


def test_a_program_comes_back_with_its_lines_and_its_form() -> None:
    program = Program("O0001", ("O1", "M30"), 1, "a.nc", "/_N_MPF_DIR", 2, Form.SINUMERIK, "big5", 3)
    found = decode(encode(program))
    assert [getattr(found, name) for name in Program.__slots__] == [
        getattr(program, name) for name in Program.__slots__
    ]


def test_a_class_without_a_name_is_refused() -> None:
    with pytest.raises(TypeError, match="has no name"):
        encode(object())


@pytest.mark.parametrize("line", ['{"~":"nonsense"}', "{", '{"a":1}'])
def test_a_line_that_is_none_is_refused(line: str) -> None:
    with pytest.raises(ValueError, match=r"unknown|Expecting|property"):
        decode(line)
