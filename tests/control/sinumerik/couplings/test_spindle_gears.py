"""Gears that a spindle leads: the axis keeps its limits, in step with what the spindle has turned."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.conformance.reading import HERE
from tests.control.sinumerik.support import codes, run
from tests.mainrun.support import power_on

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.mainrun import VirtualControl

CONTROL, MACHINE, CYCLE = "sinumerik-840d", "mill4", 0.004
DEFINITION = "EGDEF(A,S1,1,X,1)"


def places(
    text: str,
    act: Callable[[VirtualControl, int], None] = lambda _control, _cycle: None,
    machine: str = MACHINE,
) -> np.ndarray:
    """Where the axis was in each cycle; it has kept its limits."""
    control = power_on(text, CONTROL, machine=machine)
    control.cycle_start()
    found = [control.positions.real["A"]]
    for cycle in range(5000):
        act(control, cycle)
        control.step(CYCLE)
        found.append(control.positions.real["A"])
        if not control.is_busy:
            break
    assert control.alarms == ()
    assert not control.is_busy
    axis = control.machine.axis["A"]
    steps = np.diff(found)
    assert np.abs(steps).max() <= axis.rapid * CYCLE * 1.001
    assert np.abs(np.diff(steps)).max() <= axis.acceleration * CYCLE**2 * 1.001 + 1e-9
    return np.array(found)


@settings(max_examples=6, deadline=None)
@given(
    st.sampled_from((3, 4)),
    st.integers(5, 2000),
    st.integers(-9, 9).filter(bool),
    st.booleans(),
    st.booleans(),
)
def test_the_axis_keeps_its_limits(
    way: int, speed: int, numerator: int, turns: bool, overridden: bool
) -> None:
    start, gear = f"M{way} S{speed}", f'EGON(A,"NOC",S1,{numerator},18)'
    first = (start, "G4 F0.5", gear) if turns else (gear, start)

    def override(control: VirtualControl, cycle: int) -> None:
        if overridden and cycle == 200:
            control.override(spindle=0.5)

    places("\n".join((DEFINITION, *first, "G4 F1", "M5", "G4 F0.5", "EGOFS(A)", "M30\n")), override)


@pytest.mark.parametrize("turns", [False, True])
def test_the_axis_is_where_the_spindle_has_turned_it(turns: bool) -> None:
    start, gear = "M3 S60", 'EGON(A,"NOC",S1,1,36)'
    first = (start, "G4 F0.5", gear) if turns else (gear, start)
    found = places("\n".join((DEFINITION, *first, "G4 F2", "G4 F2", "EGOFS(A)", "M30\n")))
    # 10 degrees a second; what it makes up it has made up.
    middle = len(found) // 2
    assert found[middle + 250] - found[middle] == pytest.approx(10.0, abs=1e-6)
    assert found[-1] == pytest.approx(40.0, abs=0.5)


def test_a_spindle_is_held_to_what_the_axis_can_do() -> None:
    fast = f'{DEFINITION}\nEGON(A,"NOC",S1,1,1)\nM3 S9000\nG4 F2\nM5\nG4 F1\nEGOFS(A)\nM30\n'
    found = places(fast)
    assert np.diff(found).max() / CYCLE > 20.0


@pytest.mark.parametrize("speed", [110, 155])
def test_no_override_takes_the_axis_past_its_limits(speed: int) -> None:
    lines = (DEFINITION, f"M4 S{speed}", "G4 F0.1", 'EGON(A,"NOC",S1,-3,18)', "G4 F2", "M5", "G4 F0.5")
    found = places(
        "\n".join((*lines, "EGOFS(A)", "M30\n")),
        lambda control, cycle: control.override(spindle=1.2) if cycle == 200 else None,
    )
    assert np.diff(found).max() > 0.79 * 120.0 * CYCLE


@pytest.mark.parametrize(("speed", "numerator"), [(90, -7), (1500, 5)])
def test_a_spindle_that_is_not_the_master_is_held_to_what_the_axis_can_do(speed: int, numerator: int) -> None:
    lines = ("EGDEF(A,S2,1)", f"M2=3 S2={speed}", "G4 F0.3", f'EGON(A,"FINE",S2,{numerator},18)', "G4 F0.5")
    end = ("M2=5", "G4 F0.5", "EGOFS(A)", "M30\n")
    found = places(
        "\n".join((*lines, *end)),
        lambda control, cycle: control.override(spindle=1.2) if cycle == 150 else None,
        str(HERE / "machines/mill4-two-spindles.toml"),
    )
    assert np.abs(np.diff(found)).max() > 0.5 * min(abs(6.0 * speed * numerator / 18.0), 90.0) * CYCLE


@pytest.mark.parametrize(
    "lines",
    [
        ("CTABDEF(A,X,1,0)", "G1 X0 A0 F100", "X9 A9", "CTABEND", DEFINITION, 'EGON(A,"NOC",S1,1,0)'),
        (DEFINITION, 'EGON(A,"NOC",S1,1,9)', "SPOS=90"),
        (DEFINITION, 'EGON(A,"NOC",S1,1,9)', "G1 A10 F100"),
        (DEFINITION, 'EGON(A,"NOC",S1,1,9)', "G331 Z-5 K1 S100"),
        (DEFINITION, "M3 S100", 'EGONSYN(A,"NOC",0,S1,0,1,9)'),
        (DEFINITION, 'EGON(A,"NOC",S1,1,9)', "M3 S100", "FPR(A) G95 F1", "EGOFS(A)"),
        (DEFINITION, "FPR(A)"),
    ],
)
def test_what_is_not_executed(lines: tuple[str, ...]) -> None:
    assert codes(run(*lines, machine=MACHINE)) == [("PC0001", len(lines))]


def test_variables_name_spindles() -> None:
    result = run(
        DEFINITION,
        'EGON(A,"NOC",S1,2,36)',
        "R1=$AA_EG_NUMERA[A,S1] R2=$AA_EG_ACTIVE[A,S1] R3=$AA_EG_ACTIVE[A,X] R4=$AA_COUP_ACT[A]",
        "R5=$AA_EG_AX[0,A]==S1 R6=$AA_EG_TYPE[A,S1]",
        "EGDEL(A)",
        machine=MACHINE,
    )
    assert [result.variables[f"R{n}"] for n in range(1, 7)] == [2, 1, 0, 32, 1, 1]
    assert codes(result) == [("16797", 5)]


def test_a_gear_outlives_a_reset() -> None:
    control = power_on(f'{DEFINITION}\nEGON(A,"NOC",S1,1,36)\nM3 S60\nG4 F1\nM30\n', CONTROL, machine=MACHINE)
    control.cycle_start()
    control.run()
    stood = control.positions.real["A"]
    control.step(1.0)
    stood = control.positions.real["A"]
    control.step(1.0)
    assert control.positions.real["A"] == stood
    control.load("M4 S60\nG4 F1\nM5\nG4 F1\nEGOFS(A)\nG91 G1 A1 F600\nM30\n")
    control.cycle_start()
    control.run()
    assert control.alarms == ()
    assert control.positions.real["A"] == pytest.approx(stood - 10.0 + 1.0, abs=0.5)
    assert control.positions.machine["A"] == pytest.approx(control.positions.real["A"])


@pytest.mark.parametrize(("mask", "locked"), [(0, 0), (1, 1), (2, 0)])
def test_a_search_cannot_enter_where_a_spindle_leads_if_the_machine_says_so(mask: int, locked: int) -> None:
    lines = (DEFINITION, 'EGON(A,"NOC",S1,1,9)', "R1=$P_IPTRLOCK")
    assert run(*lines, machine=MACHINE, parameters={"22680": mask}).variables["R1"] == locked
