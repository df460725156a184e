"""Rows of a toolpath as a line: the same points as the strokes of a drawing, however they are cut into chunks."""

from __future__ import annotations

from array import array

import pytest

from polycnc.mainrun import VirtualControl
from polycnc.session import open_session
from polycnc.toolpath.strokes import strokes
from polycnc.view.lines import FEED, GAP, KINDS, RAPID, WIDTH, Lines
from polycnc.view.rows import CHORD_ERROR, RowLine

PROGRAMS = {
    "fanuc-m": "O1\nG0 X1. Y2.\nM3 S1000\nG1 Z-1. F100.\nG2 X5. Y2. R2. F200.\n"
    "T2 M6\nG3 X5. Y2. I3. Z-4.\nG95 G1 X9. F0.1\nM30\n",
    "fanuc-0i-tf": "O1\nG0 X20. Z2.\nM3 S500\nG99 G1 Z-10. F0.2\nG2 X30. Z-15. R5.\nG32 Z-30. F1.\nM30\n",
    "sinumerik-840d": "G0 X1 Y2\nTRANS X10\nG1 X5 F100\nROT RPL=30\nG1 X10\nG2 X20 Y0 CR=20\nM30\n",
}


def line_of(control: str, text: str) -> tuple[Lines, list[tuple[float, ...]]]:
    result = open_session(text, control=control).run()
    lines = Lines()
    geometry = result.machine.geometry_indices(1)
    maker = RowLine(lines, result.toolpath, geometry)
    for chunk in result.toolpath.chunks:
        maker.add(chunk)
    drawn: list[tuple[float, ...]] = []
    for each in strokes(result.toolpath, geometry, CHORD_ERROR):
        drawn.extend(each.points)
    return lines, drawn


def points_of(lines: Lines) -> list[tuple[float, ...]]:
    found = array("f", lines.part(0, len(lines)))
    return [tuple(found[i : i + WIDTH]) for i in range(0, len(found), WIDTH)]


def without_repeats(points: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    kept: list[tuple[float, ...]] = []
    for point in points:
        if not kept or max(abs(a - b) for a, b in zip(point, kept[-1], strict=True)) > 1e-4:
            kept.append(tuple(point))
    return kept


COUPLED = "G0 X1 Y2\nTRAILON(Y,X,-1)\nG1 X20 F100\nG4 F1\nG2 X30 I5\nTRAILOF(Y)\nG1 X40 Y5\nM30\n"


@pytest.mark.parametrize(("control", "text"), [*PROGRAMS.items(), ("sinumerik-840d", COUPLED)])
def test_a_line_has_the_points_of_the_strokes(control: str, text: str) -> None:
    lines, drawn = line_of(control, text)
    found = without_repeats([point[:3] for point in points_of(lines)])
    wanted = without_repeats([tuple(point) for point in drawn])
    assert len(found) == len(wanted) > 5
    for one, other in zip(found, wanted, strict=True):
        assert one == pytest.approx(other, abs=1e-4)


def test_kind_tool_and_feed_stand_beside_each_point() -> None:
    lines, _ = line_of("fanuc-m", PROGRAMS["fanuc-m"])
    found = points_of(lines)
    assert {int(point[4]) % KINDS for point in found} == {RAPID, FEED, GAP}
    assert lines.tools == ["T0", "T2"]
    assert {int(point[4]) // KINDS for point in found} == {0, 1}
    feeds = {round(point[3]) for point in found if int(point[4]) % KINDS == FEED and point[3]}
    assert feeds == {100, 200}


def test_the_path_of_a_control_comes_chunk_by_chunk() -> None:
    control = VirtualControl("fanuc-m")
    control.load("O1\nG0 X1. Y2.\nG1 X5. F100.\nM30\n")
    lines = Lines()
    forecast = control.forecast()
    forecast.take = RowLine(lines, forecast.toolpath, control.machine.geometry_indices(1)).add
    forecast.finish()
    assert lines.last() == (5.0, 2.0, 0.0)
