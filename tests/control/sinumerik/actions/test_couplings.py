from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run


@pytest.mark.parametrize(
    ("effect", "code"),
    [
        ("TRAILON(Y)", "14020"), ("TRAILON(Y,Y)", "16785"), ("LEADON(Y,X,9)", "16776"), ("LEADOF()", "14020"),
        ("TRAILON(V,X) TRAILON(V,Y) TRAILON(V,Z)", "16779"),
    ],
)  # fmt: skip
def test_calls_that_mean_nothing(effect: str, code: str) -> None:
    result = run(f"WHEN TRUE DO {effect}", "G1 X5 F1000", machine="mill5-xyzvw")
    assert [found for found, _ in codes(result)] == [code]


def test_a_coupling_of_the_program_and_one_of_an_action_do_not_mix() -> None:
    result = run("TRAILON(Y,X)", "WHEN TRUE DO TRAILON(Z,X)", "G1 X5 F1000")
    assert [found for found, _ in codes(result)] == ["PC0001"]


def test_chains_and_overlays_lead_too() -> None:
    result = run(
        "WHEN TRUE DO TRAILON(V,X,2) TRAILON(W,V,-1)", "G1 X5 F1000", "R1=$AA_IM[W]", machine="mill5-xyzvw"
    )
    assert codes(result) == []
    assert result.variables["R1"] == pytest.approx(-10.0, abs=0.3)
