"""Axes that are counted otherwise (PRESETON, AXCTSWAP) do not move: plan, samples and main run take the same time."""

from __future__ import annotations

import pytest

from tests.mainrun.motion.both_times import executed, planned

SINUMERIK = "sinumerik-840d"
HEAD = "G90 G64 F3000 {mode}\nG1 X10 Y1\n"
#: What follows, and the same with the places as they were counted before.
COUNTED = {
    "behind-a-move": ("PRESETON(X,100)\nX110 Y2\nX120\n", "STOPRE\nX20 Y2\nX30\n"),
    "another-axis": ("X20\nPRESETON(Z,30)\nX30 Y2\nZ31\n", "X20\nSTOPRE\nX30 Y2\nZ1\n"),
    "two-of-them": ("PRESETON(X,0)\nPRESETON(Y,3)\nG2 X10 Y3 I5 J0\n", "STOPRE\nG2 X20 Y1 I5 J0\n"),
    "at-once": ("PRESETON(X,0,Y,3)\nX5 Y3\n", "STOPRE\nX15 Y1\n"),
}


@pytest.mark.parametrize("mode", ["BRISK", "SOFT"])
@pytest.mark.parametrize("case", COUNTED)
def test_a_new_count_is_no_way(case: str, mode: str) -> None:
    text, same = (f"{HEAD.format(mode=mode)}{rest}M30\n" for rest in COUNTED[case])
    total_s = planned(text, SINUMERIK, "mill3")
    assert total_s == pytest.approx(planned(same, SINUMERIK, "mill3"), abs=5e-5)
    assert executed(text, SINUMERIK, "mill3") == pytest.approx(total_s, abs=5e-4)


@pytest.mark.parametrize("name", ["AXCTSWE", "AXCTSWAP"])
def test_a_container_that_turns_moves_no_axis(name: str) -> None:
    """Its axes change places: what Z is from then on stands where V has stood."""
    setup: dict[str, object] = {"parameters": {"12701": ["Z1", "V1"], "41700[0]": 1}}
    text = f"G90 G1 Z10 V20 F1000\n{name}(CT1)\nG91 G1 Z5\nM30\n"
    same = "G90 G1 Z10 V20 F1000\nSTOPRE\nG91 G1 Z5\nM30\n"
    total_s = planned(text, SINUMERIK, "mill5-xyzvw", setup)
    assert total_s == pytest.approx(planned(same, SINUMERIK, "mill5-xyzvw", setup), abs=1e-9)
    assert executed(text, SINUMERIK, "mill5-xyzvw", setup) == pytest.approx(total_s, abs=5e-4)
