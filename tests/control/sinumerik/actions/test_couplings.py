from __future__ import annotations

import numpy as np
import pytest

from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on

CYCLE = 0.004


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


@pytest.mark.parametrize("begin", ["WHEN $AA_IM[X]>30", "EVERY $AA_IM[X]>30"])
@pytest.mark.parametrize("factor", [-0.9, 0.4, 1.0])
def test_an_axis_that_actions_couple_keeps_its_limits(begin: str, factor: float) -> None:
    lines = (
        f"ID=1 {begin} DO TRAILON(V,X,{factor})", "ID=2 WHEN $AA_IM[X]>150 DO TRAILOF(V,X)",
        "G1 X200 F18000", "G4 F0.5", "R1=$AA_IM[V]", "M30\n",
    )  # fmt: skip
    control = power_on("\n".join(lines), "sinumerik-840d", machine="mill5-xyzvw")
    control.cycle_start()
    places = [control.positions.real["V"]]
    while control.is_busy:
        control.step(CYCLE)
        places.append(control.positions.real["V"])
    assert control.alarms == ()
    axis = control.machine.axis["V"]
    steps = np.diff(places)
    assert abs(steps).max() <= axis.rapid * CYCLE * 1.001
    assert abs(np.diff(steps)).max() <= axis.acceleration * CYCLE**2 * 1.05
    assert abs(places[-1]) > 100.0 * abs(factor)


def test_what_leads_beyond_the_travel_leads_no_more() -> None:
    text = "WHEN TRUE DO TRAILON(V,X,2)\nG1 X100 F6000\nM30\n"
    control = power_on(text, "sinumerik-840d", machine="mill5-xyzvw", setup={"parameters": {"36110[V]": 30}})
    control.cycle_start()
    highest = 0.0
    while control.is_busy:
        control.step(CYCLE)
        highest = max(highest, control.positions.real["V"])
    assert [alarm.code for alarm in control.alarms] == ["20070"]
    assert 28.0 < highest <= 30.0
