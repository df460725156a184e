"""Parameters of SYNTEC that bound the speeds."""

from __future__ import annotations

import pytest

from polycnc.session import run

TEXT = "G90 G94 G01 X600. F12000\nG00 X0.\nM30\n"


def seconds(**parameters: int) -> float:
    given = {number[2:]: value for number, value in parameters.items()}
    return run(TEXT, control="syntec-mill", setup={"parameters": given}).time


def test_pr405_bounds_a_cut_along_the_path_and_pr621_its_axes() -> None:
    free = seconds()
    assert seconds(Pr405=6000) - free == pytest.approx(3.0, abs=0.2)
    assert seconds(Pr621=3000) - free == pytest.approx(9.0, abs=0.2)
    assert seconds(Pr622=3000) == free  # an axis that stands


def test_pr461_bounds_the_rapid_traverse_of_an_axis() -> None:
    assert seconds(Pr461=6000) - seconds(Pr461=12000) == pytest.approx(3.0, abs=0.2)


def rapid_seconds(block: str, **parameters: int) -> float:
    given = {number[2:]: value for number, value in parameters.items()}
    text = f"G90 G94 G71\n{block}\nG01 X600. Y600. F60000\nM30\n"
    result = run(text, control="syntec-mill", setup={"parameters": given})
    assert not result.alarms
    return result.plan.times.rapid_s


@pytest.mark.parametrize("block", ["G00 P1 X600. Y600. F1=6000.", "G53 P1 X600. Y600. F1=6000."])
def test_f1_is_the_speed_of_a_rapid_along_the_path(block: str) -> None:
    # 848.5 mm at 100 mm/s.
    assert rapid_seconds(block) == pytest.approx(8.485, abs=0.3)
    assert rapid_seconds(block.replace("P1", "")) < 4.0


def test_f1_bounds_each_axis_that_runs_a_rapid_alone() -> None:
    block = "G00 P1 X600. Y300. F1=6000."
    assert rapid_seconds(block, Pr411=1) == pytest.approx(6.0, abs=0.3)
    assert rapid_seconds(block, Pr411=1, Pr461=3000) == pytest.approx(12.0, abs=0.3)


def test_f1_holds_for_its_block_alone_and_is_a_speed_per_minute_in_every_feed_mode() -> None:
    twice = rapid_seconds("G95 S1000 M3\nG00 P1 X600. Y600. F1=6000.\nG00 X0. Y0.")
    once = rapid_seconds("G00 P1 X600. Y600. F1=6000.")
    assert twice == pytest.approx(once + rapid_seconds("G00 X600. Y600."), rel=1e-6)


def test_f1_counts_inches_under_g70_and_never_exceeds_the_rapid_traverse() -> None:
    inch = "G70\nG00 P1 X20. F1=200.\nG71"
    assert rapid_seconds(inch) == pytest.approx(508.0 / (200.0 * 25.4 / 60.0), abs=0.3)
    assert rapid_seconds("G00 P1 X600. Y600. F1=9999999.") == pytest.approx(rapid_seconds("G00 X600. Y600."))


def test_an_f_word_of_a_rapid_is_no_speed_of_the_rapid() -> None:
    assert rapid_seconds("G00 X600. Y600. F100") == rapid_seconds("G00 X600. Y600.")
