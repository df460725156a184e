"""Axes that are positioned beside the path (POS, POSA, SPOS) are one motion in plan, samples and main run."""

from __future__ import annotations

from random import Random

import pytest

from polycnc.machine import load_machine
from tests.mainrun.motion.both_times import executed, planned
from tests.mainrun.motion.random_programs import Writer
from tests.mainrun.motion.test_one_motion import compare

#: The four-axis mill's rotary axis has its own limits; so have the axes of a lathe whose spindle is C.
PROGRAMS = {
    "a block that waits, and one behind it": ("mill4", "POS[X]=100 FA[X]=6000", "G1 Y100 F6000"),
    "without a feed": ("mill4", "POS[A]=100 POS[X]=20", "G1 Y1 F1000"),
    "beside following blocks": ("mill4", "POSA[X]=100 FA[X]=1000", "G1 Y100 F6000", "Z0", "WAITP(X)", "Y0"),
    "nothing waits at the end": ("mill4", "POSA[X]=10 FA[X]=6000", "G1 Y100 F6000", "WAITP(X)", "Z0"),
    "a block that names the axis waits": ("mill4", "POSA[X]=50 FA[X]=3000", "G1 Y10 F6000", "X0", "X10", "X20"),
    "so does a new command": ("mill4", "POSA[X]=50 FA[X]=3000", "G4 F.2", "POSA[X]=-10", "Y100", "WAITP(X)", "Z0"),
    "with the path, which is slower": ("mill4", "G1 Y100 F2000 POS[X]=10", "Y0"),
    "with the path, which is quicker": ("mill4", "G1 Y100 F6000 POS[X]=100 FA[X]=3000", "Y0"),
    "what ACC leaves the path is not of an axis beside it": (
        "mill4", "ACC[X]=20 G1 F6000", "POS[X]=100 Y20", "G64 Y1", "Y2", "X90 Y90",
    ),
    "smoothed, and under limited jerk": (
        "mill4", "SOFT", "POS[X]=100 FA[X]=6000", "G1 Y100 F6000", "G642", "X90 Y90", "X80 Y91 POS[Z]=0", "X70",
    ),
    "indexing positions": ("indexed", "POS[A]=CAC(3)", "G1 Y10 F1000", "POSA[A]=CIC(-2)", "Y20", "WAITP(A)", "Y30"),
    "a spindle that is an axis": ("lathe-c", "SPOS=90", "G1 X10 F1000", "SPOSA=20", "Z10", "WAITS", "Z0"),
    "in front of a transformation": ("lathe-c-transmit", "G0 X40 C30", "SPOSA=90", "TRANSMIT", "G1 X20 Y0 F1000"),
    "within one": ("lathe-c-transmit", "G0 X40 C30", "TRANSMIT", "G1 X20 Y5 F1000", "POS[Z]=30", "X10 Y8", "X9 Z20"),
    "behind one": ("lathe-c-transmit", "G0 X40 C30", "TRANSMIT", "G1 X20 Y5 F1000", "TRAFOOF", "POS[C]=90", "G0 X50"),
}  # fmt: skip
INDEXED = {"30500[A]": 3, "30502[A]": 12, "30503[A]": 5}


def program(*blocks: str, mode: str = "BRISK") -> str:
    return "\n".join((mode, "G0 X0 Z5", *blocks, "M30", ""))


@pytest.mark.parametrize("name", PROGRAMS)
def test_plan_samples_and_main_run_are_one_motion(name: str) -> None:
    machine, *blocks = PROGRAMS[name]
    indexed: dict[str, object] = {"parameters": INDEXED}
    written = Writer(Random(0), "sinumerik-840d")
    written.machine, written.setup = ("mill4", indexed) if machine == "indexed" else (machine, {})  # type: ignore[misc]
    compare(program(*blocks), written)


def seconds(*blocks: str) -> float:
    """What blocks take behind the approach."""
    return planned(program(*blocks), "sinumerik-840d", "mill4") - planned(
        program(), "sinumerik-840d", "mill4"
    )


def way_s(way: float, speed: float, axis: str) -> float:
    """Seconds from rest to rest."""
    return way / speed + speed / load_machine("mill4").axis[axis].acceleration


def test_a_block_with_pos_lasts_until_the_axis_is_there() -> None:
    assert seconds("POS[X]=100 FA[X]=6000") == pytest.approx(way_s(100.0, 100.0, "X"))
    assert seconds("G1 Y50 F6000 POS[X]=100 FA[X]=6000") == pytest.approx(way_s(100.0, 100.0, "X"))


def test_without_a_feed_an_axis_has_that_of_the_machine_data() -> None:
    assert seconds("POS[X]=100") == pytest.approx(way_s(100.0, 10000.0 / 60.0, "X"))


def test_posa_waits_for_nothing_but_waitp_waits_for_it() -> None:
    quick = seconds("POSA[X]=100 FA[X]=600", "G1 Y50 F6000")
    assert quick == pytest.approx(way_s(50.0, 100.0, "Y"))
    awaited = seconds("POSA[X]=100 FA[X]=600", "G1 Y50 F6000", "WAITP(X)")
    assert awaited == pytest.approx(way_s(100.0, 10.0, "X"))


def test_an_axis_that_pos_has_moved_is_the_paths_again() -> None:
    lines = ("G64 G1 X20 F1000", "X21", "X22", "X23")
    before = seconds("POS[X]=10 FA[X]=6000")
    assert seconds("POS[X]=10 FA[X]=6000", *lines) - before == pytest.approx(
        seconds("G1 X10 F6000", *lines) - seconds("G1 X10 F6000"), abs=1e-6
    )
    text = program("POS[X]=10 FA[X]=6000", *lines)
    assert executed(text, "sinumerik-840d", "mill4") == pytest.approx(
        planned(text, "sinumerik-840d", "mill4"), abs=1e-6
    )
