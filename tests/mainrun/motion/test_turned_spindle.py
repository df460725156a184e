"""A spindle that M03, M04 or M05 turns goes to that speed first, whatever S the next block has."""

from __future__ import annotations

import pytest

from polycnc.machine import load_machine
from tests.mainrun.motion.both_times import executed, planned

MACHINES = {
    "fanuc-m": "mill3", "meldas-m": "mill3", "syntec-mill": "mill3", "fanuc-0i-tf": "lathe2", "sinumerik-840d": "mill3",
}  # fmt: skip
#: Blocks behind M03 S1000, and by how much the spindle changes its speed in them, rpm.
CHANGES = {
    ("M04", "S500"): 2500.0,
    ("M04", "S2000"): 3000.0,
    ("M05", "M03"): 2000.0,
    ("M05", "S500", "M03"): 1500.0,
    ("M04 S500",): 1500.0,
    ("M04", "M03"): 4000.0,
}


def seconds(control: str, *blocks: str) -> float:
    """What the blocks take in the plan, and in the main run."""
    head = () if control == "sinumerik-840d" else ("O1",)
    text = "\n".join((*head, "M03 S1000", "G00 X1.", *blocks, "G00 X2.", "M30", ""))
    total_s = planned(text, control, MACHINES[control])
    assert executed(text, control, MACHINES[control]) == pytest.approx(total_s, abs=5e-4)
    return total_s


@pytest.mark.parametrize("control", MACHINES)
@pytest.mark.parametrize("blocks", CHANGES, ids=" / ".join)
def test_it_goes_to_every_speed(control: str, blocks: tuple[str, ...]) -> None:
    spindle = load_machine(MACHINES[control]).spindle[1]
    if control == "sinumerik-840d" and blocks == ("M04 S500",):
        pytest.skip("its block writes M and S apart")
    taken = seconds(control, *blocks) - seconds(control)
    assert taken == pytest.approx(CHANGES[blocks] / spindle.acceleration_rpm_s, abs=1e-3)
