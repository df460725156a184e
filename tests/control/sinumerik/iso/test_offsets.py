"""G43, G49, H and D of the ISO dialect."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

TOOLS = {1: {"length": 30.0, "radius": 5.0}}


def test_h_takes_the_lengths_of_an_edge_and_g49_ends_them() -> None:
    result = run(
        "T1 D0",
        "G291",
        "G43 H1 Z10 G0",
        "G290",
        "R1=$AA_IM[Z] R2=$P_TOOL",
        "G291",
        "G49",
        "G290",
        "R3=$P_TOOL",
        tools=TOOLS,
    )
    assert codes(result) == []
    assert [result.variables[f"R{n}"] for n in (1, 2, 3)] == [40.0, 1.0, 0.0]


@pytest.mark.parametrize(
    "lines",
    [
        ("G43 Z10",),
        ("Z10 H1",),
        ("G43 H1.5 Z10",),
        ("G44 Z10",),
        ("G43 H1 Z10", "G44 Z10"),
        ("G43 H1", "G41 D2 X10"),
        ("G49", "Z5 H1"),
        ("D1",),
    ],
)
def test_what_is_refused(lines: tuple[str, ...]) -> None:
    assert codes(run("T1 D0", "F100", "G291", *lines, tools=TOOLS)) == [("PC0001", 3 + len(lines))]


def test_g43_stays_for_another_h() -> None:
    result = run("T1 D0", "G291", "G43 H1", "H0", "G290", "R1=$P_TOOL", tools=TOOLS)
    assert codes(result) == []
    assert result.variables["R1"] == 0.0
