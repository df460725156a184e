"""The lathe after a reset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from polycnc.compensation.cutter import CutterCompensation
from polycnc.control import registry
from polycnc.control.fanuc.lathe.cycles.modal import SingleCycleState
from polycnc.control.word_address.cycles.drilling import CycleState
from polycnc.program.program import Program
from tests.control.fanuc.lathe.support import moves, run

if TYPE_CHECKING:
    from polycnc.session import Result


def after_reset(program: str, **setup: Any) -> Result:
    """A program has ended, then the control was reset."""
    result = run(program + "\nM30", **setup)
    assert not result.alarms
    result.control.reset(result.channel)
    return result


def codes(result: Result, *groups: str) -> list[str]:
    return [result.channel.mode[group] for group in groups]


PROGRAM = "G20\nG23\nG98 G96 S100\nG55 G17 G1 X1. F10"


def test_the_clear_state_brings_power_on_codes_back_but_for_units_and_stroke_check() -> None:
    result = after_reset(PROGRAM, parameters={"3402#6": 1, "3402#4": 0})
    groups = ("unit", "stroke", "feed", "surface_speed", "wcs", "plane", "motion")
    assert codes(result, *groups) == ["G20", "G23", "G99", "G97", "G54", "G18", "G0"]


def test_the_reset_state_keeps_modal_codes() -> None:
    groups = ("feed", "surface_speed", "wcs", "plane", "motion")
    assert codes(after_reset(PROGRAM), *groups) == ["G98", "G96", "G55", "G17", "G1"]


@pytest.mark.parametrize(
    ("parameters", "motion"), [({}, "G1"), ({"3402#6": 1}, "G0"), ({"3402#6": 1, "3406#1": 1}, "G1")]
)
def test_a_single_cycle_leaves_g01(parameters: dict[str, int], motion: str) -> None:
    result = after_reset("G0 X60. Z5.\nG90 X50. Z-20. F.2", parameters=parameters)
    assert codes(result, "motion") == [motion]
    assert not SingleCycleState.of(result.channel).has_words


@pytest.mark.parametrize(("lvc", "tgc", "display"), [(0, 0, 40.0), (1, 0, 40.5), (0, 1, 50.0), (1, 1, 50.5)])
def test_offsets_stay_unless_parameters_cancel_them(lvc: int, tgc: int, display: float) -> None:
    parameters = {"5006#3": lvc, "5003#7": tgc, "5002#2": 1}
    result = after_reset("G0 T0101\nZ40.", tools={1: {"z": 10.0, "wear": {"z": 0.5}}}, parameters=parameters)
    assert result.channel.coordinates.machine[1] == 50.5
    assert result.channel.coordinates.position[1] == pytest.approx(display)


def test_transformations_always_end() -> None:
    program = "G98 G1 X40. Z2. C0 F100\nG12.1\nG3 X0 C20. I-20. J0"
    result = after_reset(program, machine="lathe-c", parameters={"5450#0": 1})
    assert codes(result, "polar_interpolation", "plane") == ["G13.1", "G18"]
    assert result.channel.coordinates.position[2] == pytest.approx(90.0)


def test_a_reset_does_not_move_the_machine() -> None:
    result = run(
        "T0101\nG0 X50. Z2.\nG42 G1 X40. F.1\nM30", tools={1: {"x": 3, "radius": 1, "wear": {"x": 0.2}}}
    )
    before = list(result.channel.coordinates.machine)
    result.control.reset(result.channel)
    assert result.channel.coordinates.machine == pytest.approx(before)
    assert registry.control("fanuc-0i-tf") is result.control


@pytest.mark.parametrize(
    ("clr", "c10", "cycle"), [(0, 0, "G84"), (0, 1, "G84"), (1, 0, "G80"), (1, 1, "G84")]
)
def test_a_tapping_cycle_stays_or_goes_by_clr_and_c10(clr: int, c10: int, cycle: str) -> None:
    program = "G98 G0 X0 Z5.\nM29 S500\nG84 Z-10. R-3. F500"
    result = after_reset(program, parameters={"3402#6": clr, "3407#2": c10})
    assert codes(result, "cycle") == [cycle]


@pytest.mark.parametrize(("clr", "code"), [(0, "G42"), (1, "G40")])
def test_compensation_stays_modal_without_a_vector_or_ends(clr: int, code: str) -> None:
    program = "T0101\nG42 G0 X20. Z2.\nG1 Z-10. F.2"
    result = after_reset(program, tools={1: {"radius": 2.0}}, parameters={"3402#6": clr})
    assert codes(result, "compensation") == [code]
    assert result.channel.path.find(CutterCompensation) is None


@pytest.mark.parametrize(("number", "start"), [("", 40.0), ("T0101", 44.0)])
def test_compensation_that_stayed_modal_starts_with_the_next_offset_number(number: str, start: float) -> None:
    result = after_reset("T0101\nG42 G0 X20. Z2.\nX30. Z5.", tools={1: {"radius": 2.0}})
    program = Program("NEXT", f"G0 X60. Z5.\nX40. Z2. {number}\nZ-10.\nG40\nM30".splitlines())
    for _ in result.channel.run(program, power_on=False):
        pass
    assert not result.channel.alarms
    assert moves(result)[-2:] == [("rapid", start, 2.0), ("rapid", start, -10.0)]


def test_a_series_15_cycle_and_its_data_outlive_a_reset_in_a_hole() -> None:
    result = after_reset("G0 X20. Z10.\nG83 Z-8. R-6. Q4. F.1", parameters={"1#1": 1})
    assert codes(result, "cycle") == ["G83"]
    assert CycleState.of(result.channel).active.amount("Q") == 4.0
