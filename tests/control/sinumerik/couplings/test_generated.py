"""Master values that are written: who waits for them, and what is refused meanwhile."""

from __future__ import annotations

import pytest

from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on

MACHINE = "mill5-xyzvw"
TABLE = ("CTABDEF(V,X,1,0)", "G1 X0 V0 F1000", "X100 V50", "CTABEND", "$SA_LEAD_TYPE[X]=2")
ON = "LEADON(V,X,1)"


def test_an_axis_waits_until_its_place_comes_to_it() -> None:
    result = run(
        *TABLE, "G0 V10", ON, "$AA_LEAD_SP[X]=8", "G4 F1", "R1=$AA_IM[V]",
        "$AA_LEAD_SP[X]=30", "G4 F1", "R2=$AA_IM[V]", "$AA_LEAD_SP[X]=4", "G4 F1", "R3=$AA_IM[V]", machine=MACHINE,
    )  # fmt: skip
    assert [result.variables[f"R{n}"] for n in (1, 2, 3)] == pytest.approx([10.0, 15.0, 2.0])


def test_actions_lead_an_axis_by_what_is_written_and_let_it_go() -> None:
    result = run(
        *TABLE, "WHEN TRUE DO LEADON(V,X,1,1)", "$AA_LEAD_SP[X]=30", "G4 F1", "R1=$AA_IM[V] R2=$AA_COUP_ACT[V]",
        "WHEN TRUE DO LEADOF(V,X)", "G4 F0.1", "$AA_LEAD_SP[X]=90", "G4 F1", "R3=$AA_IM[V]", "G1 V7 F600",
        "R4=$AA_IM[V]", machine=MACHINE,
    )  # fmt: skip
    assert codes(result) == []
    assert [result.variables[f"R{n}"] for n in range(1, 5)] == pytest.approx([15.0, 16.0, 15.0, 7.0])


@pytest.mark.parametrize(
    ("code", "lines"),
    [
        ("PC0001", (ON, "G1 V5 F100")),
        ("16797", ("CTABDEF(V,X,2,0)", "G1 X0 V0 F1", "X9 V9", "CTABEND", ON, "LEADON(V,X,2)")),
        ("PC0001", ("WHEN TRUE DO LEADON(V,X,1)", "G4 F1", "G1 V5 F100")),
        ("10940", (ON, "CTABDEF(V,X,1,0)")),
    ],
)
def test_what_is_refused(code: str, lines: tuple[str, ...]) -> None:
    assert [found for found, _ in codes(run(*TABLE, *lines, machine=MACHINE))] == [code]


def test_a_reset_ends_it_and_frees_the_table() -> None:
    control = power_on("\n".join((*TABLE, ON, ON, "M30\n")), "sinumerik-840d", machine=MACHINE)
    for text in (None, "CTABDEL(1)\nR1=CTABEXISTS(1)\nG1 V7 F600\nM30\n"):
        if text is not None:
            control.load(text)
        control.cycle_start()
        control.run()
    assert control.alarms == ()
    assert control.read_variable("R1") == 0
    assert control.positions.real["V"] == 7.0


def test_another_leading_axis_leaves_it_on() -> None:
    result = run(
        *TABLE, ON, "LEADOF(V,Y)", "R1=$AA_COUP_ACT[V]", "LEADOF(V,X)", "R2=$AA_COUP_ACT[V]", machine=MACHINE
    )
    assert (result.variables["R1"], result.variables["R2"]) == (16, 0)
