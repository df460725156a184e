"""SYNTEC's pages of coordinate rotation (2.39) and of machining conditions (2.67.1), with what they do to programs."""

from __future__ import annotations

import pytest

from polycnc.mainrun import State, VirtualControl
from tests.panel.bench import Bench

LANGS = ["en", "zh-TW"]


def syntec(lang: str, **more: object) -> Bench:
    return Bench("syntec-mill", lang, **more)  # type: ignore[arg-type]


def runs(control: VirtualControl, text: str) -> float:
    """Run a program; gives the simulated seconds that it takes."""
    control.load(text)
    control.select_mode("auto")
    before = control.snapshot.time
    control.cycle_start()
    assert control.run() is State.READY
    return control.snapshot.time - before


# ---- coordinate rotation -----------------------------------------------------------------------------------------


@pytest.mark.feature("syn.g54_4_screen", control="syntec-mill")
@pytest.mark.parametrize("lang", LANGS)
def test_three_angles_of_a_work_system_turn_it_while_g54_4_is_on(lang: str) -> None:
    bench = syntec(lang)
    bench.keys("OFF/SET")
    bench.soft("Rotation", "座標旋轉")
    assert bench.view.title == bench.says("COORDINATE ROTATION", "座標旋轉")
    for head in (("X angle", "X 角"), ("Y angle", "Y 角"), ("Z angle", "Z 角")):
        assert bench.says(*head) in bench.text
    bench.keys("DOWN", "RIGHT", "RIGHT")
    bench.typed("30")
    bench.soft("Input", "輸入")
    bench.typed("60")
    bench.soft("+Input", "+輸入")
    assert "90.000" in bench.window("table").rows[2][3].text
    assert bench.window("table").rows[2][0].text == "G55"
    control = bench.control
    runs(control, "G55\nG54.4 P1\nG53.1\nG0 X10. Y2. Z3.\nM30\n")
    assert control.positions.machine == pytest.approx({"X": -2.0, "Y": 10.0, "Z": 3.0}, abs=1e-9)
    runs(control, "G55\nG54.4 P1\nG54.4 P0\nG0 X10. Y2. Z3.\nM30\n")
    assert control.positions.machine == pytest.approx({"X": 10.0, "Y": 2.0, "Z": 3.0}, abs=1e-9)
    runs(control, "G54.4 P1\nG54\nG0 X7. Y1.\nG55\nX5. Y0\nM30\n")  # the system that is chosen counts
    assert control.positions.machine == pytest.approx({"X": 0.0, "Y": 5.0, "Z": 3.0}, abs=1e-9)
    bench.keys("OFF/SET")
    bench.soft("Rotation", "座標旋轉")
    bench.typed("54.5", "INPUT")  # a row that the cursor left; it is still at G55
    assert bench.window("table").rows[2][3].text == "54.500"


def test_the_angles_turn_about_z_then_y_then_x() -> None:
    bench = syntec("en")
    bench.screen.show("rotation")
    for angle in ("90", "90", "0"):
        bench.typed(angle, "INPUT", "RIGHT")
    # X 90, Y 90, Z 0: Z'' = X turned by the Y angle, then by the X angle about X''.
    control = bench.control
    control.load("G54.4 P1\nG0 X1.\nM0\nX0 Y2.\nM0\nY0 Z3.\nM0\nM30\n")
    seen = []
    control.cycle_start()
    while control.run() is State.STOPPED:
        seen.append([round(value, 6) + 0.0 for value in control.positions.machine.values()])
        control.cycle_start()
    assert seen == [[0.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, -3.0, 0.0]]


def test_a_changed_angle_acts_when_the_length_is_called_again() -> None:
    bench = syntec("en")
    control = bench.control
    bench.screen.show("rotation")
    bench.keys("RIGHT", "RIGHT")
    control.load("G54.4 P1\nG43 H1\nM0\nG0 X5. Y0\nM0\nG49\nG43 H1\nG0 X5. Y0\nM0\nM30\n")
    control.cycle_start()
    control.run()
    bench.typed("90", "INPUT")
    control.cycle_start()
    control.run()
    assert control.positions.machine["X"] == pytest.approx(5.0)
    control.cycle_start()
    control.run()
    assert control.positions.machine["X"] == pytest.approx(0.0, abs=1e-9)
    assert control.positions.machine["Y"] == pytest.approx(5.0)


def test_the_page_is_not_there_without_work_systems() -> None:
    bench = syntec("en", setup={"parameters": {"3229": 1}})
    bench.keys("OFF/SET")
    assert "Rotation" not in [key.text for key in bench.view.soft_keys]
    assert "Work offset" not in [key.text for key in bench.view.soft_keys]
    bench.screen.show("rotation")
    assert bench.view.page == "offset"


def test_under_tip_control_the_tip_goes_by_the_turned_system() -> None:
    bench = syntec("en", machine="mill5-ac-table", setup={"tools": {1: {"length": 50.0}}})
    bench.screen.show("rotation")
    bench.typed("10", "INPUT")
    control = bench.control
    control.load(
        "G90 G54.4 P1\nG43.4 H1\nG0 X1. Y2. Z3. A-10. C0\nM0\nC90.\nM0\nG43.5 H1\nX0 Y0 Z20. I0 J0 K1.\nM0\n"
        "G54.4 P0\nX1. Y2. Z3. K1.\nM30\n"
    )
    places = []
    for _ in range(4):
        control.cycle_start()
        control.run()
        machine = control.positions.machine
        places.append([machine[axis] for axis in "XYZA"])
    # X of the system leans by 10 degrees, A stands it upright; then C turns it with the table about the machine's Z.
    assert places[0] == pytest.approx([1.0, 2.0, 53.0, -10.0])
    assert places[1] == pytest.approx([-1.448671, 1.558145, 53.077911, -10.0], abs=1e-5)
    assert places[2] == pytest.approx([0.0, 0.0, 70.0, -10.0], abs=1e-9)
    assert places[3][2:] == pytest.approx([53.0, 0.0], abs=1e-9)


def test_in_a_turned_system_radius_compensation_in_space_sees_the_tool_as_it_stands_there() -> None:
    tools = {"tools": {1: {"length": 50.0, "radius": 5.0}}}
    bench = syntec("en", machine="mill5-ac-table", setup=tools)
    bench.screen.show("rotation")
    bench.typed("10", "INPUT")
    control = bench.control
    control.load(
        "G90 G54.4 P1\nG43.4 H1\nG0 X0 Y0 Z0 A-10. C0\nG42.2 G1 X10. D1 F500\nX20.\nM0\nY10.\nG40 X0\nM30\n"
    )
    control.cycle_start()
    control.run()
    # The table stands the system upright under the tool: the corner of the offset lines as in the plane.
    assert [control.positions.work[axis] for axis in "XYZ"] == pytest.approx([25.0, -5.0, 0.0], abs=1e-6)


def test_a_posture_in_a_turned_system_is_not_executed() -> None:
    bench = syntec("en", machine="mill5-ac-table")
    bench.screen.show("rotation")
    bench.typed("10", "INPUT")
    bench.control.load("G54.4 P1\nG43.4 H1 Q1\nG1 X1. F100\nM30\n")
    bench.control.cycle_start()
    bench.control.run()
    assert bench.alarms() == ["PC0001"]


def test_the_tool_stands_on_a_turned_system_behind_g53_1() -> None:
    bench = syntec("en", machine="mill5-ac-table", setup={"tools": {1: {"length": 50.0}}})
    bench.screen.show("rotation")
    bench.typed("30", "INPUT")
    control = bench.control
    control.load(
        "G54.4 P1\nG53.1\nG43 H1\nG0 X0 Y0 Z20.\nM0\nG68.2 X0 Y0 Z0 I0 J-30. K0\nG53.1\nG43 H1\nG0 X0 Y0 Z9.\nM0\nM30\n"
    )
    control.cycle_start()
    control.run()
    assert abs(control.positions.machine["A"]) == pytest.approx(30.0)
    assert control.positions.machine["Y"] == pytest.approx(
        0.0, abs=1e-9
    )  # the table turns the system upright
    assert control.positions.machine["Z"] == pytest.approx(70.0)
    control.cycle_start()
    control.run()
    assert control.positions.machine["A"] == pytest.approx(0.0, abs=1e-9)  # 30 and -30 degrees about X
    assert control.positions.machine["Z"] == pytest.approx(59.0)


def test_the_angles_outlive_the_power() -> None:
    bench = syntec("en")
    bench.screen.show("rotation")
    bench.typed("12.5", "INPUT")
    bench.control.power_off()
    bench.control.power_on()
    bench.control.run()
    assert "12.500" in bench.text


# ---- machining conditions ----------------------------------------------------------------------------------------

CUT = "{}G91 G1 X100. F6000\nM30\n"


@pytest.mark.feature("syn.g120_1_screen", control="syntec-mill")
@pytest.mark.parametrize("lang", LANGS)
def test_nine_sets_are_edited_and_restored_after_their_use_was_shown(lang: str) -> None:
    bench = syntec(lang)
    control = bench.control
    bench.soft("Back", "返回")
    bench.keys("F10")  # manual: F10, F3, F6, F5
    bench.screen.soft(2)
    assert bench.view.page == "parameter"
    bench.screen.soft(5)
    rows = bench.window("table").rows[1:]
    assert [row[0].text for row in rows] == [f"P{p}Q{q}" for p in (1, 2, 3) for q in (1, 2, 3)]
    assert {row[1].text for row in rows} == {"0"}
    plain = runs(control, CUT.format(""))
    bench.keys("DOWN")
    bench.typed("3000")
    bench.soft("Input", "輸入")
    bench.keys("DOWN")
    bench.typed("-1", "INPUT")
    assert bench.message
    bench.screen.buffer = ""
    assert runs(control, CUT.format("G120.1 P1 Q2\n")) > 1.5 * plain
    assert runs(control, CUT.format("G62 P2\n")) > 1.5 * plain  # P1Q2 is set 2
    assert runs(control, CUT.format("G120.1 P1 Q2\nG121\n")) == pytest.approx(plain)
    assert runs(control, CUT.format("G120.1 P1 Q2\nG120.1 P0\n")) == pytest.approx(plain)
    assert runs(control, CUT.format("G120.1 P2 Q2\n")) == pytest.approx(plain)
    assert runs(control, CUT.format("")) == pytest.approx(plain)  # the end of a program is the default again
    bench.screen.soft(4)
    assert bench.says("P1Q2 roughing, balanced", "P1Q2 粗加工，兼顧") in bench.text
    bench.soft("Cancel", "取消")
    assert "3000" in bench.text
    bench.screen.soft(4)
    bench.soft("This set", "恢復本組")  # the cursor stands on another one
    assert "3000" in bench.text
    bench.screen.soft(4)
    bench.soft("All sets", "恢復全部")
    assert "3000" not in bench.text
    assert runs(control, CUT.format("G120.1 P1 Q2\n")) == pytest.approx(plain)


def test_a_set_may_be_the_one_of_the_start_and_lets_rapids_alone() -> None:
    bench = syntec("en", setup={"parameters": {"3835": 9}})
    rapid, cut = "G91 G0 X100.\nM30\n", CUT.format("")
    plain = runs(bench.control, rapid), runs(bench.control, cut)
    bench.screen.show("conditions")
    bench.screen.place(9, 0)
    bench.typed("1500", "INPUT")
    assert runs(bench.control, rapid) == pytest.approx(plain[0])
    assert runs(bench.control, cut) > 2.0 * plain[1]
    assert runs(bench.control, CUT.format("G120.1 P1 Q1\n")) == pytest.approx(plain[1])


@pytest.mark.feature("syn.g120_1_screen", control="syntec-mill")
@pytest.mark.parametrize("lang", LANGS)
@pytest.mark.parametrize(
    ("unit", "keys"),
    [("keys-8", ("F10", 2, 5, 4)), ("keys-5", ("F10", 2, "F10", 0, 4))],
)
def test_the_function_keys_of_the_manual_lead_to_the_defaults(
    lang: str, unit: str, keys: tuple[str | int, ...]
) -> None:
    bench = syntec(lang)
    bench.unit = unit
    assert len(bench.view.soft_keys) == int(unit[-1])
    bench.screen.menu = "root"  # the manual begins at the main row
    for key in keys:
        if isinstance(key, str):
            bench.keys(key)
        else:
            bench.screen.soft(key)
    assert bench.view.page == "conditions-default"
    assert bench.says("P1Q1 roughing, speed first", "P1Q1 粗加工，速度優先") in bench.text


def test_f10_leads_from_a_row_without_further_keys_to_those_of_the_main_row() -> None:
    bench = syntec("en")
    bench.keys("COOR", "F10")
    assert [key.text for key in bench.view.soft_keys][:3] == ["Graph", "PLC state", "Parameter"]
    bench.keys("F10")
    assert bench.view.soft_keys[0].text == "Coordinates"
