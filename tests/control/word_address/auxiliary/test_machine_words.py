"""Words that the machine refuses, or answers to."""

from __future__ import annotations

import pytest

from polycnc.toolpath import Kind
from tests.support import codes, moves, run


@pytest.mark.parametrize(
    ("control_id", "block", "code"),
    [
        ("fanuc-m", "M3", "1095"),
        ("fanuc-m", "M14", "1095"),
        ("fanuc-m", "M19", "1094"),
        ("fanuc-m", "S5", "1105"),
        ("meldas-m", "M4", "3009"),
        ("meldas-m", "M19", "3009"),
        ("meldas-m", "S5", "3007"),
    ],
)
def test_a_loose_tool_keeps_the_spindle_still(control_id: str, block: str, code: str) -> None:
    assert codes(run(f"M11\n{block}\nM30\n", control_id, machine="hartford")) == [code]
    assert codes(run(f"M11\nM10\n{block}\nM30\n", control_id, machine="hartford")) == []


@pytest.mark.parametrize(("z", "refused"), [(0.0, False), (-20.0, False), (-20.5, True), (5.0, True)])
def test_the_tool_changes_at_a_reference_point_of_z(z: float, refused: bool) -> None:
    channel = run(f"G0 X7. Z{z}\nT1 M6\nM30\n", machine="hartford", setup={"parameters": {"1241 Z": -20}})
    assert codes(channel) == (["1046"] if refused else [])


def test_a_mirror_by_m_code_turns_arcs_round() -> None:
    kinds = [
        row.kind
        for row in moves(run("M71\nG2 X10. Y10. R10. F50\nM72\nG2 X20. Y0 R10.\nM30\n", machine="hartford"))
    ]
    assert kinds == [Kind.CCW, Kind.CW]
