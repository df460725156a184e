"""Gears of spindles that follow: what is refused, and how long they last."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run

MACHINE = "mill3-two-spindles"
DEFINITION, ON = "EGDEF(S2,S1,1)", 'EGON(S2,"NOC",S1,1,2)'


@pytest.mark.parametrize(
    ("code", "lines"),
    [
        ("PC0001", ("EGDEF(S2,X,1)",)),
        ("PC0001", ("EGDEF(S2,S1,1,X,1)",)),
        ("14020", ("EGDEF(S2,S1,2)",)),
        ("16785", ("EGDEF(S2,S2,1)",)),
        ("16797", (DEFINITION, DEFINITION)),
        ("16797", ("COUPDEF(S2,S1,1,1)", DEFINITION)),
        ("16796", (ON,)),
        ("16795", (DEFINITION, 'EGON(S2,"SOON",S1,1,2)')),
        ("14020", (DEFINITION, 'EGON(S2,"NOC",S1,1)')),
        ("PC0001", (DEFINITION, 'EGON(S2,"NOC",S1,0,1)')),
        ("PC0001", (DEFINITION, 'EGONSYN(S2,"NOC",0,S1,0,1,2)')),
        ("16797", (DEFINITION, ON, ON)),
        ("16797", (DEFINITION, ON, "EGDEL(S2)")),
        ("16797", (DEFINITION, ON, "COUPDEF(S2,S1,1,1)")),
        ("16796", (DEFINITION, ON, "COUPOF(S2,S1)")),
        ("14020", (DEFINITION, ON, "EGOFC(S2,S1)")),
    ],
)
def test_what_is_refused(code: str, lines: tuple[str, ...]) -> None:
    assert codes(run(*lines, machine=MACHINE)) == [(code, len(lines))]


def test_a_gear_that_is_off_does_nothing_more() -> None:
    result = run(DEFINITION, "EGOFS(S2)", "EGOFC(S2)", "EGDEL(S2)", "EGDEL(S2)", DEFINITION, machine=MACHINE)
    assert codes(result) == []


def test_a_leading_spindle_taken_out_stops_the_following_one() -> None:
    lines = (DEFINITION, ON, "M3 S600", "EGOFS(S2,S1)", "R1=$AA_S[S2] R2=$AA_S[S1] R3=$AA_EG_ACTIVE[S2,S1]")
    found = run(*lines, machine=MACHINE).variables
    assert [found[f"R{n}"] for n in (1, 2, 3)] == [0, 600, 0]
