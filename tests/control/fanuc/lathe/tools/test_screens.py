"""What the offset screens do with the memory (III.2.1); the table of key sequences with their results."""

from __future__ import annotations

from typing import Any

import pytest

from polycnc.control.fanuc.lathe.tools import screens
from polycnc.control.fanuc.lathe.tools.offset_memory import OffsetMemory
from polycnc.control.fanuc.lathe.tools.screens import Page, ScreenRefusal
from polycnc.control.fanuc.lathe.tools.sensor import MeasuredInputB
from tests.control.fanuc.lathe.support import run


def channel(program: str = "", **setup: Any) -> Any:
    return run(program + "\nM30", **setup).channel


# ---- input ----


def test_input_sets_and_plus_input_adds() -> None:
    lathe = channel()
    screens.set_offset(lathe, Page.WEAR, 3, "X", 0.2)
    screens.add_offset(lathe, Page.WEAR, 3, "X", -0.05)
    assert screens.offset(lathe, Page.WEAR, 3, "X") == pytest.approx(0.15)
    assert OffsetMemory.of(lathe).at(3).wear["X"] == pytest.approx(0.075)


def test_the_tip_is_one_for_both_pages_and_the_radius_is_not() -> None:
    lathe = channel()
    screens.set_offset(lathe, Page.WEAR, 1, "T", 3)
    screens.set_offset(lathe, Page.GEOMETRY, 1, "R", 0.8)
    assert screens.offset(lathe, Page.GEOMETRY, 1, "T") == 3
    assert screens.offset(lathe, Page.WEAR, 1, "R") == 0.0


def test_there_is_no_geometry_page_where_offsets_are_not_separate() -> None:
    assert Page.GEOMETRY in screens.pages(channel())
    assert Page.GEOMETRY not in screens.pages(channel(parameters={"8136#6": 1}))


def test_values_are_inches_while_the_control_reads_inches() -> None:
    lathe = channel("G20")
    screens.set_offset(lathe, Page.GEOMETRY, 1, "Z", 1.0)
    assert OffsetMemory.of(lathe).at(1).geometry["Z"] == 25.4
    assert screens.offset(lathe, Page.GEOMETRY, 1, "Z") == 1.0


@pytest.mark.parametrize(
    ("number", "field", "value"), [(0, "X", 1.0), (1000, "X", 1.0), (1, "X", 1e6), (1, "T", 10)]
)
def test_what_makes_no_sense_is_refused(number: int, field: str, value: float) -> None:
    with pytest.raises(ScreenRefusal) as refused:
        screens.set_offset(channel(), Page.WEAR, number, field, value)
    assert refused.value.text()


# ---- protection ----


@pytest.mark.parametrize(("bit", "page"), [("3290#0", Page.WEAR), ("3290#1", Page.GEOMETRY)])
def test_wof_and_gof_protect_their_page(bit: str, page: Page) -> None:
    lathe = channel(parameters={bit: 1})
    with pytest.raises(ScreenRefusal):
        screens.set_offset(lathe, page, 1, "X", 1.0)
    other = Page.WEAR if page is Page.GEOMETRY else Page.GEOMETRY
    screens.set_offset(lathe, other, 1, "X", 1.0)
    assert screens.offset(lathe, other, 1, "X") == 1.0


def test_consecutive_values_stop_in_front_of_a_protected_range() -> None:
    lathe = channel(parameters={"3294": 10, "3295": 5})
    with pytest.raises(ScreenRefusal) as refused:
        screens.set_offsets(lathe, Page.WEAR, 8, "Z", [1.0, 2.0, 3.0, 4.0, 5.0])
    assert refused.value.done == 2
    assert [screens.offset(lathe, Page.WEAR, n, "Z") for n in (8, 9, 10, 12)] == [1.0, 2.0, 0.0, 0.0]
    with pytest.raises(ScreenRefusal) as refused:
        screens.set_offsets(lathe, Page.WEAR, 12, "Z", [1.0])
    assert refused.value.done == 0
    screens.set_offsets(lathe, Page.WEAR, 15, "Z", [7.0])


def test_second_geometry_needs_go2() -> None:
    with pytest.raises(ScreenRefusal):
        screens.set_offset(channel(), Page.SECOND, 1, "X", 1.0)
    lathe = channel(parameters={"3290#5": 1}, machine="lathe-y")
    screens.set_offset(lathe, Page.SECOND, 1, "Y", 1.5)
    screens.add_offset(lathe, Page.SECOND, 1, "Y", 0.25)
    assert OffsetMemory.of(lathe).at(1).second == {"Y": 1.75}


# ---- measuring ----


def test_measure_on_the_geometry_page_clears_wear() -> None:
    lathe = channel(start={"X": 70.0, "Z": 5.0}, tools={2: {"x": 5.0, "wear": {"x": 0.3}}})
    screens.measure(lathe, Page.GEOMETRY, 2, "X", 69.0)
    assert screens.offset(lathe, Page.GEOMETRY, 2, "X") == pytest.approx(1.0)
    assert screens.offset(lathe, Page.WEAR, 2, "X") == 0.0


def test_measure_on_the_wear_page_leaves_out_the_wear_that_is_there() -> None:
    lathe = channel(start={"X": 70.0, "Z": 5.0}, tools={2: {"x": 5.0, "wear": {"x": 0.3}}})
    screens.measure(lathe, Page.WEAR, 2, "X", 69.0)
    assert screens.offset(lathe, Page.WEAR, 2, "X") == pytest.approx(0.7)
    assert screens.offset(lathe, Page.GEOMETRY, 2, "X") == 5.0


@pytest.mark.parametrize(
    ("parameters", "stored"),
    [({}, 1.0), ({"5004#1": 1}, 0.5), ({"1006#3 X": 0}, 1.0), ({"1006#3 X": 0, "5004#1": 1}, 1.0)],
)
def test_what_is_stored_is_a_diameter_or_a_radius_by_dia_and_orc(
    parameters: dict[str, int], stored: float
) -> None:
    lathe = channel(start={"X": 70.0, "Z": 5.0}, parameters=parameters)
    screens.measure(lathe, Page.GEOMETRY, 2, "X", 69.0)
    assert screens.offset(lathe, Page.GEOMETRY, 2, "X") == pytest.approx(stored)


def test_a_latched_coordinate_counts_in_place_of_the_present_one() -> None:
    lathe = channel(start={"X": 70.0, "Z": 5.0})
    screens.measure(lathe, Page.GEOMETRY, 1, "Z", 10.0, latched=12.5)
    assert screens.offset(lathe, Page.GEOMETRY, 1, "Z") == pytest.approx(2.5)


def test_counter_input_touches_only_its_page() -> None:
    lathe = channel(tools={5: {"wear": {"x": 0.1}}})
    screens.counter_input(lathe, Page.GEOMETRY, 5, "X", -3.25)
    assert screens.offset(lathe, Page.GEOMETRY, 5, "X") == -3.25
    assert screens.offset(lathe, Page.WEAR, 5, "X") == pytest.approx(0.1)


def test_counter_input_sets_the_y_offset_too() -> None:
    lathe = channel(machine="lathe-y")
    screens.counter_input(lathe, Page.WEAR, 5, "Y", 1.25)
    assert screens.offset(lathe, Page.WEAR, 5, "Y") == 1.25


# ---- work shift ----


def test_the_shift_acts_at_once_and_moves_nothing() -> None:
    lathe = channel(start={"X": 121.0, "Z": 69.0})
    screens.set_work_shift(lathe, "X", 1.0)
    screens.set_work_shift(lathe, "Z", -1.0)
    assert lathe.coordinates.position == pytest.approx([60.0, 70.0])
    assert lathe.coordinates.machine == pytest.approx([60.5, 69.0])
    screens.add_work_shift(lathe, "X", 0.5)
    assert screens.work_shift(lathe, "X") == 1.5


def test_a_measured_face_reads_what_was_typed() -> None:
    lathe = channel(start={"X": 0, "Z": 12.5})
    screens.measure_work_shift(lathe, "Z", 10.0)
    assert screens.work_shift(lathe, "Z") == pytest.approx(2.5)
    assert lathe.coordinates.position[1] == pytest.approx(10.0)
    screens.measure_work_shift(lathe, "Z", 0.0, latched=4.0)
    assert screens.work_shift(lathe, "Z") == pytest.approx(6.5)


# ---- 4th and 5th axis ----


def test_further_axes_are_cleared_page_by_page() -> None:
    parameters = {"5044": 4, "5045": 5, "11400#1": 1}
    tool = {"x": 3.0, "axes": {"A": 1.0, "B": 2.0}, "wear": {"axes": {"A": 0.1, "B": 0.2}}}
    lathe = channel(machine="lathe-yab", parameters=parameters, tools={1: tool})
    fields = screens.further_fields(lathe)
    assert fields == ("A", "B")
    screens.clear_offsets(lathe, [Page.WEAR], fields)
    assert [screens.offset(lathe, Page.WEAR, 1, f) for f in fields] == [0.0, 0.0]
    assert [screens.offset(lathe, Page.GEOMETRY, 1, f) for f in fields] == [1.0, 2.0]
    screens.clear_offsets(lathe, [Page.WEAR, Page.GEOMETRY], fields)
    assert [screens.offset(lathe, Page.GEOMETRY, 1, f) for f in (*fields, "X")] == [0.0, 0.0, 3.0]


# ---- barrier ----


def test_the_barrier_is_set_under_g23_only() -> None:
    with pytest.raises(ScreenRefusal):
        screens.set_barrier(channel("G22"), "chuck", "L", 40.0)
    lathe = channel("G23")
    screens.set_barrier(lathe, "chuck", "L", 40.0)
    screens.add_barrier(lathe, "chuck", "L", 2.0)
    assert screens.barrier_value(lathe, "chuck", "L") == 42.0
    with pytest.raises(ScreenRefusal):
        screens.set_barrier(lathe, "chuck", "TY", 2)


def test_set_takes_the_present_position_for_three_symbols() -> None:
    lathe = channel("G23\nG0 X100. Z-50.")
    screens.set_barrier_here(lathe, "chuck", "CX")
    screens.set_barrier_here(lathe, "chuck", "CZ")
    screens.set_barrier_here(lathe, "tailstock", "TZ")
    assert screens.barrier_value(lathe, "chuck", "CX") == 100.0
    assert [screens.barrier_value(lathe, page, s) for page, s in (("chuck", "CZ"), ("tailstock", "TZ"))] == [
        -50.0
    ] * 2
    with pytest.raises(ScreenRefusal):
        screens.set_barrier_here(lathe, "chuck", "W")


def test_every_value_of_the_barrier_has_a_parameter_of_its_own() -> None:
    numbers = [each.key.id for page in screens.BARRIER.values() for each in page.values()]
    assert sorted(map(int, numbers)) == [*range(1330, 1337), *range(1341, 1349)]


# ---- modal codes ----


def test_the_modal_display_of_a_delivered_control() -> None:
    assert screens.modal_codes(channel()) == [
        ["G00", "G97", "G69", "G98", "G21", "G40", "G25", "G22"],
        ["G80", "G67", "G54", "G64", "G18", "G69.1", "G40.1", "G50.2"],
        ["G13.1", "G50.1", "G49", "G15", "G05.5", "", "G80.5", "G80.4"],
    ]


def test_the_modal_display_follows_the_program_and_the_system() -> None:
    columns = screens.modal_codes(channel("G1 G99 G55 X1. F1.", parameters={"3401#6": 1, "3402#6": 0}))
    assert columns[0][:4] == ["G01", "G97", "G69", "G94"]  # G99 is the return level in system B
    assert columns[1][2] == "G55"


# ---- sensor ----


def test_a_touch_writes_geometry_and_locks_the_axis() -> None:
    lathe = channel("G0 X60. Z-20.", parameters={"5015": 50.0, "5018": -30.0})
    sensor = MeasuredInputB(lathe)
    with pytest.raises(ScreenRefusal):
        sensor.signal("+MIT1", on=True)
    sensor.signal("GOQSM", on=True)
    assert (sensor.status, sensor.outputs) == ("OFST", {"S1MES": True, "S2MES": False})
    sensor.choose(7)
    sensor.signal("+MIT1", on=True)
    assert screens.offset(lathe, Page.GEOMETRY, 7, "X") == pytest.approx(10.0)
    assert sensor.locked == {("X", 1)}
    sensor.signal("+MIT1", on=False)
    sensor.signal("-MIT2", on=True)
    assert screens.offset(lathe, Page.GEOMETRY, 7, "Z") == pytest.approx(10.0)
    sensor.signal("GOQSM", on=False)
    assert (sensor.status, sensor.locked, any(sensor.outputs.values())) == ("", set(), False)


def test_the_spindle_cannot_be_changed_while_measuring() -> None:
    sensor = MeasuredInputB(channel())
    sensor.signal("S2TLS", on=True)
    sensor.signal("GOQSM", on=True)
    sensor.signal("S2TLS", on=False)
    assert sensor.outputs == {"S1MES": False, "S2MES": True}


def test_signals_choose_the_number_by_qni() -> None:
    sensor = MeasuredInputB(channel(parameters={"5005#5": 1}))
    with pytest.raises(ScreenRefusal):
        sensor.choose(3)
    sensor.choose_by_signal(3)
    assert sensor.number == 3


def test_one_contact_for_all_directions_by_ts1() -> None:
    lathe = channel("G0 X60.", parameters={"5004#3": 1})
    sensor = MeasuredInputB(lathe)
    sensor.signal("GOQSM", on=True)
    sensor.signal("-MIT2", on=True)
    assert not sensor.locked
    sensor.signal("+MIT1", on=True)
    assert screens.offset(lathe, Page.GEOMETRY, 1, "X") == pytest.approx(60.0)


def test_woset_makes_the_touched_face_z_zero() -> None:
    lathe = channel("G0 Z50.", parameters={"5020": 4}, tools={4: {"z": 12.0}})
    sensor = MeasuredInputB(lathe)
    sensor.signal("WOQSM", on=True)
    assert (sensor.status, sensor.number) == ("WSFT", 4)
    sensor.signal("WOSET", on=True)
    assert screens.work_shift(lathe, "Z") == pytest.approx(38.0)
    sensor.signal("WOQSM", on=False)
    assert sensor.status == ""
