"""Tool tip control sits between the work zero and the axes, wherever that lies."""

from __future__ import annotations

import pytest

import polycnc

SETUP: dict[str, object] = {
    "work_offsets": {"G54": {"X": 3.0, "Y": -2.0}, "G55": {"X": 40.0, "Z": 7.0, "C": 15.0}},
    "tools": {1: {"length": 80.0}},
}
CUTS = "G1 X10. Y5. Z1. A20. C30. F500\nX-4. C200.\nA-15. Z3.\n"


def ends(text: str) -> list[dict[str, float]]:
    result = polycnc.run(text, control="fanuc-m", machine="mill5-ac-table", setup=SETUP)
    assert not result.alarms, result.alarms
    return [row["machine"] for row in result.rows if row["type"] == "feed"]


@pytest.mark.parametrize(
    ("before", "meanwhile"),
    [
        ("G55 G43.4 H1\n", "G43.4 H1\nG55\n"),
        ("G54 G52 X7. Z2.\nG43.4 H1\n", "G54 G43.4 H1\nG52 X7. Z2.\n"),
        ("G10 L2 P1 X9. Y1.\nG43.4 H1\n", "G43.4 H1\nG10 L2 P1 X9. Y1.\n"),
    ],
)
def test_a_zero_that_changes_meanwhile_is_one_that_was_there_before(before: str, meanwhile: str) -> None:
    expected, found = (ends(f"G90\n{start}{CUTS}M30\n") for start in (before, meanwhile))
    for a, b in zip(expected, found, strict=True):
        assert b == pytest.approx(a, abs=1e-6)
