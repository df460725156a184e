"""Data files of the lathe."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from polycnc.control.data_files import DataFileError
from polycnc.control.fanuc.lathe.tools import files
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from tests.control.fanuc.lathe.support import run

FIVE_AXES = {"machine": "lathe-yab", "parameters": {"5044": 4, "5045": 5, "11400#1": 1, "5024": 2}}
TOOL = {
    "x": 9.68,
    "z": 9.28,
    "y": 8.88,
    "radius": 0.8,
    "tip": 3,
    "wear": {"x": 1.25, "z": 1.75, "y": 2.25, "radius": 0.1},
}


def channel(**setup: Any) -> Any:
    return run("M30", **setup).channel


def test_the_example_of_the_manual_is_written_as_it_is_printed() -> None:
    parameters = {**FIVE_AXES["parameters"], "8136#7": 1}  # type: ignore[dict-item]
    tool = {
        "x": 9.68, "z": 9.28, "y": 8.88, "axes": {"A": 8.48, "B": 24.345},
        "wear": {"x": 1.25, "z": 1.75, "y": 2.25, "axes": {"A": 2.75, "B": 12.6}},
    }  # fmt: skip
    lines = files.write(
        channel(machine="lathe-yab", parameters=parameters, tools={1: tool}), "offsets"
    ).splitlines()
    assert lines[:2] == ["%", "G10 P01 X1.250 Z1.750 Y2.250 E2.750 F12.600 ;"]
    assert lines[3] == "G10 P10001 X9.680 Z9.280 Y8.880 E8.480 F24.345 ;"
    assert lines[-1] == "%"
    assert len(lines) == 2 + 2 * 2


def test_radius_and_tip_stand_behind_z_where_the_nose_is_compensated() -> None:
    lines = files.write(channel(**FIVE_AXES, tools={1: TOOL}), "offsets").splitlines()
    assert lines[1] == "G10 P01 X1.250 Z1.750 R0.100 Q3 Y2.250 E0.000 F0.000 ;"


def test_axis_names_stand_for_e_and_f_by_ofn() -> None:
    setup = {**FIVE_AXES, "parameters": {**FIVE_AXES["parameters"], "11403#2": 1}}  # type: ignore[dict-item]
    lines = files.write(channel(**setup), "offsets").splitlines()
    assert lines[1].endswith("Y0.000 A0.000 B0.000 ;")


def test_one_set_of_offsets_has_no_geometry_lines() -> None:
    lines = files.write(channel(parameters={"8136#6": 1, "5024": 3}), "offsets").splitlines()
    assert [line.split()[1] for line in lines[1:-1]] == ["P01", "P02", "P03"]


def test_without_a_number_of_sets_there_are_the_standard_ones() -> None:
    assert len(files.write(channel(), "second-geometry").splitlines()) == 2 + 32


def test_a_file_overwrites_what_it_names_and_nothing_else() -> None:
    lathe = channel(tools={1: TOOL})
    taken = files.read(lathe, "%\nG10 P01 Z2.5 ;\nG10 P10001 R1.2\nG10 P20001 X4.\n%\n")
    offset = OffsetMemory.of(lathe).at(1)
    assert (offset.wear["X"], offset.wear["Z"]) == (0.625, 2.5)
    assert (offset.geometry["X"], offset.radius, offset.tip, offset.second["X"]) == (4.84, 1.2, 3, 2.0)
    assert (taken.blocks, sorted(taken.numbers), sorted(taken.systems)) == (3, [1], [])


def test_work_offsets_come_back_from_their_file() -> None:
    offsets = {"G54": {"X": 10, "Z": 5}, "G54.1 P48": {"Z": -7}, "EXT": {"X": 1}}
    content = files.write(channel(work_offsets=offsets), "work")
    lathe = channel()
    files.read(lathe, content)
    assert lathe.memory.work_offset("G54") == [5.0, 5.0]
    assert lathe.memory.work_offset("G54.1 P48") == [0.0, -7.0]
    assert lathe.memory.work_offset("EXT") == [0.5, 0.0]


def test_least_increments_and_inches_are_understood() -> None:
    lathe = channel()
    files.read(lathe, "%\nG10 P1 Z1500\n%")
    assert OffsetMemory.of(lathe).at(1).wear["Z"] == 1.5
    inch = run("G20\nM30").channel
    files.read(inch, "%\nG10 P1 Z1. X2.\n%")
    assert OffsetMemory.of(inch).at(1).wear == {"Z": 25.4, "X": 25.4}


@pytest.mark.parametrize(
    ("content", "line", "reason"),
    [
        ("G10 P1 X1.\n%", 1, "no-start"),
        ("%\nG10 P1 X1.\n", 2, "no-end"),
        ("", 1, "no-start"),
        ("%\nG10 P1 X1.\nG10 P2 X1.5.2\n%", 3, "no-word"),
        ("%\nG10 P1 X\n%", 2, "no-word"),
        ("%\nG10 P1 X1. X2.\n%", 2, "word-twice"),
        ("%\nP1 X1.\n%", 2, "no-g10"),
        ("%\nG10 X1.\n%", 2, "no-number"),
        ("%\nG10 P1.5 X1.\n%", 2, "value"),
        ("%\nG10 P11000 X1.\n%", 2, "number"),
        ("%\nG10 L2 P7 X1.\n%", 2, "number"),
        ("%\nG10 P1 X99999.\n%", 2, "value"),
        ("%\nG10 P1 Q12\n%", 2, "value"),
        ("%\nG10 P1 E1.\n%", 2, "word"),
    ],
)
def test_a_damaged_file_is_refused_whole(content: str, line: int, reason: str) -> None:
    lathe = channel(tools={1: TOOL})
    before = files.write(lathe, "offsets")
    with pytest.raises(DataFileError) as refused:
        files.read(lathe, content)
    assert (refused.value.line, refused.value.message) == (line, f"data.{reason}")
    assert refused.value.text()
    assert files.write(lathe, "offsets") == before


VALUES = st.integers(-9_999_999, 9_999_999).map(lambda n: n / 1000.0)


@settings(max_examples=25, deadline=None)
@given(st.dictionaries(st.integers(1, 2), st.tuples(VALUES, VALUES, VALUES, st.integers(0, 9)), max_size=2))
def test_what_is_written_is_read_again(tools: dict[int, tuple[float, float, float, int]]) -> None:
    given_tools = {n: {"x": x, "z": z, "wear": {"y": y}, "tip": tip} for n, (x, z, y, tip) in tools.items()}
    content = files.write(channel(**FIVE_AXES, tools=given_tools), "offsets")
    lathe = channel(**FIVE_AXES)
    files.read(lathe, content)
    assert files.write(lathe, "offsets") == content
