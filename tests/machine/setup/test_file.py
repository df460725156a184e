"""The setup of a run."""

import re
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from polycnc.machine import load_machine
from polycnc.machine.errors import SetupError
from polycnc.machine.setup.file import check_axes, check_bits, load_setup, parse_setup
from polycnc.machine.setup.values import (
    Interrupt,
    Offsets,
    ParameterKey,
    Parameters,
    ProbeEdge,
    Setup,
    Switches,
    Tool,
    parameter_key,
)

FULL = """
machine: lathe2
start: {X: 100, Z: 50.5}
work_offsets: {G54: {X: 1}, g54.1  p1: {Z: -2}, EXT: {x: 3}, G505: {}}
tools:
  1: {length: 100, radius: 5, tip: 3, type: 120, x: 1, y: 2, z: 3, wear: {x: 0.1, radius: -0.2},
      geom2: {z: 4}}
  "2": {name: FACE_MILL, radius: 25, edges: {2: {length: 7, tip: 1}}}
  DRILL_5: {length: 90}
variables: {"#100": 3.5, R1: 2, "#101": null, NAME: text, FLAG: true}
parameters:
  5102: 1000
  "5101#2": 1
  "1006#3 X": 0
  "$MA_IS_ROT_AX[A]": 1
  "36110[X]": 200.5
  "18661[0]": 4
  "1241 X": -3
  Option19: 1
  $MC_TRAFO5_AXIS1_1: [0, 0, 1]
channels: {1: [X, Y, Z, B], 2: [B]}
switches:
  single_block: SBL2
  optional_stop: true
  block_skip: [0, 7]
  mode: MDI
  skip_signal_at: {X: 30}
  measure_signal_at: {X: 100.6, Z: 48.75}
  probe: {1: [{axis: X, at: 30, edge: rising}, {axis: X, at: 37, edge: falling}]}
  interrupts: [{input: 1, line: 3, at: {X: 40}}, {input: 2, line: 4, at: {Z: 1}, program: SUB}]
  signals_at: {C49: {Z: 35}}
  plc: {DB21.DBX384.0: 1}
  thread_chamfer: false
  G2SLC: 1
"""


def test_every_key_of_a_setup_is_read() -> None:
    setup = parse_setup(yaml.safe_load(FULL))
    assert setup.machine == "lathe2"
    assert setup.start == {"X": 100.0, "Z": 50.5}
    assert setup.work_offsets == {"G54": {"X": 1.0}, "G54.1 P1": {"Z": -2.0}, "EXT": {"X": 3.0}, "G505": {}}
    assert setup.tools == {
        1: Tool(100, 5, 1, 2, 3, 3, 120, wear=Offsets(x=0.1, radius=-0.2), geom2=Offsets(z=4)),
        2: Tool(radius=25, name="FACE_MILL", edges={2: Tool(length=7, tip=1)}),
        "DRILL_5": Tool(length=90),
    }
    assert setup.variables == {"#100": 3.5, "R1": 2, "#101": None, "NAME": "text", "FLAG": True}
    assert len(setup.parameters) == 9
    assert setup.channels == {1: ("X", "Y", "Z", "B"), 2: ("B",)}
    assert setup.switches == Switches(
        single_block="SBL2",
        optional_stop=True,
        block_skip=(0, 7),
        mode="mdi",
        skip_signal_at={"X": 30.0},
        measure_signal_at={"X": 100.6, "Z": 48.75},
        probe={1: (ProbeEdge("X", 30.0, True), ProbeEdge("X", 37.0, False))},
        interrupts=(Interrupt(1, 3, {"X": 40.0}), Interrupt(2, 4, {"Z": 1.0}, "SUB")),
        signals_at={"C49": {"Z": 35.0}},
        plc={"DB21.DBX384.0": 1},
        thread_chamfer=False,
        signals={"G2SLC": 1},
    )


def test_no_setup_is_the_default_setup() -> None:
    assert parse_setup(None) == parse_setup({}) == Setup()


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("5102", ParameterKey(5102)),
        (5102, ParameterKey(5102)),
        ("0001#1", ParameterKey(1, bit=1)),
        ("1006#3 X", ParameterKey(1006, bit=3, axis="X")),
        ("1022 a", ParameterKey(1022, axis="A")),
        ("36110[X]", ParameterKey(36110, axis="X")),
        ("18661[0]", ParameterKey(18661, element=0)),
        ("$MA_IS_ROT_AX[AX4]", ParameterKey("$MA_IS_ROT_AX", axis="AX4")),
        ("$ma_enc[1, X1]", ParameterKey("$MA_ENC", element=1, axis="X1")),
        ("$MN_TAB[1,2]", ParameterKey("$MN_TAB", element=(1, 2))),
        ("$MC_TRAFO_TYPE_1", ParameterKey("$MC_TRAFO_TYPE_1")),
        ("Option19", ParameterKey("OPTION19")),
        ("Pr3221", ParameterKey(3221)),
        ("MD20150[3]", ParameterKey(20150, element=3)),
    ],
)
def test_parameter_names_are_taken_apart(text: str | int, key: ParameterKey) -> None:
    assert parameter_key(text) == key


@pytest.mark.parametrize("text", ["", "#3", "12#", "1006#3 #4", "$MA[", "5-3", "$MA_X[X,Y]", "X[+]", "1 2"])
def test_what_is_no_parameter_is_refused(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - the text is the whole message
        parameter_key(text)


@given(
    st.integers(0, 99999), st.none() | st.integers(0, 31), st.none() | st.sampled_from(["X", "Z1", "AX12"])
)
def test_parameter_names_read_back(number: int, bit: int | None, axis: str | None) -> None:
    text = f"{number}{'' if bit is None else f'#{bit}'}{'' if axis is None else f' {axis}'}"
    assert parameter_key(text) == ParameterKey(number, bit, None, axis)


def test_the_axis_comes_before_all_axes_and_these_before_the_default() -> None:
    both = parse_setup({"parameters": {"1420": 5, "1420 X": 7}}).parameters
    assert both.get(1420, "X") == 7
    assert both.get(1420, "Z") == 5
    assert both.get(1421, "X", 9) == 9
    assert both.get(1421) is None


def test_a_zero_is_a_value_and_no_reason_for_the_default() -> None:
    given_zero = parse_setup({"parameters": {"5110": 0, "3401#0 X": 0}}).parameters
    assert given_zero.get(5110, default=8) == 0
    assert given_zero.bit(3401, 0, "X", default=1) == 0


def test_a_bit_is_read_from_its_name_or_from_the_whole_value() -> None:
    bits = parse_setup({"parameters": {"3401": 5, "3401#1": 1, "3402": 4}}).parameters
    assert [bits.bit(3401, n) for n in range(4)] == [1, 1, 1, 0]
    assert bits.bit(3402, 2) == 1
    assert bits.bit(3403, 2, default=1) == 1


def test_a_list_gives_its_elements_unless_one_is_named() -> None:
    values = parse_setup({"parameters": {"$MC_X": [4, 5], "$MC_X[1]": 6, "20150": [1]}}).parameters
    assert [values.get("$MC_X", index=n, default=0) for n in range(3)] == [4, 6, 0]
    assert values.number(20150, index=0) == 1.0
    assert values.number("$MC_X", default=2.5) == 2.5


def test_parameters_are_equal_when_their_values_are() -> None:
    assert Parameters() == Parameters({})
    assert parse_setup({"parameters": {"1": 2}}).parameters != Parameters()


@pytest.mark.parametrize(
    ("given_as", "plain", "mask"),
    [
        (False, 1, 0),
        (True, 1, 0b10),
        (True, 0, 0b1),
        ([1, 3], 1, 0b1010),
        ([0, 7], 0, 0b10000001),
        ([2, 2], 1, 0b100),
    ],
)
def test_block_skip_levels_are_a_mask(given_as: object, plain: int, mask: int) -> None:
    assert parse_setup({"switches": {"block_skip": given_as}}).switches.block_skip_mask(plain) == mask


@pytest.mark.parametrize(("given_as", "mode"), [(True, "SBL1"), (False, ""), ("SBL3", "SBL3")])
def test_single_block_can_be_a_plain_switch(given_as: object, mode: str) -> None:
    assert parse_setup({"switches": {"single_block": given_as}}).switches.single_block == mode


@pytest.mark.parametrize(
    ("text", "line", "key", "message"),
    [
        ("machin: mill3\n", 1, "machin", "unknown-key"),
        ("colour: red\n", 1, "colour", "unknown-key"),
        ("start:\n  X: a\n", 2, "start.X", "needs-number"),
        ("start: {X: .nan}\n", 1, "start.X", "needs-number"),
        ("start: {X: true}\n", 1, "start.X", "needs-number"),
        ("start: [1]\n", 1, "start", "needs-table"),
        ("work_offsets:\n  G54: 3\n", 2, "work_offsets.G54", "needs-table"),
        ("tools:\n  1: {lenght: 3}\n", 2, "tools.1.lenght", "unknown-key"),
        ("tools:\n  1:\n    wear: {tip: 3}\n", 3, "tools.1.wear.tip", "unknown-key"),
        ("tools: {1: {tip: 2.5}}\n", 1, "tools.1.tip", "needs-whole-number"),
        ("tools: {1: {edges: {a: {}}}}\n", 1, "tools.1.edges.a", "needs-whole-number"),
        ("tools: {1: {name: 3}}\n", 1, "tools.1.name", "needs-text"),
        ("machine: 3\n", 1, "machine", "needs-text"),
        ("variables: {R1: {a: 1}}\n", 1, "variables.R1", "needs-value"),
        ("parameters:\n  5101##: 1\n", 2, "parameters.5101##", "bad-parameter"),
        ('parameters:\n  5101: 1\n  "05101": 1\n', 3, "parameters.05101", "parameter-twice"),
        ("channels: {1: X}\n", 1, "channels.1", "needs-list"),
        ("switches: {single_block: SBL4}\n", 1, "switches.single_block", "not-one-of"),
        ("switches: {optional_stop: maybe}\n", 1, "switches.optional_stop", "needs-true-or-false"),
        ("switches: {block_skip: [10]}\n", 1, "switches.block_skip.0", "out-of-range"),
        ("switches:\n  probe:\n    1: [{axis: X}]\n", 3, "switches.probe.1.0.at", "missing-key"),
        (
            "switches: {probe: {1: [{axis: X, at: 1, edge: up}]}}\n",
            1,
            "switches.probe.1.0.edge",
            "not-one-of",
        ),
        ("switches: {interrupts: [{input: 1, at: {}}]}\n", 1, "switches.interrupts.0.line", "missing-key"),
    ],
)
def test_a_mistake_names_its_line_and_key(
    tmp_path: Path, text: str, line: int, key: str, message: str
) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SetupError) as caught:
        load_setup(path)
    error = caught.value
    assert (error.line, error.message, error.args_by_name["where"]) == (line, message, key)
    for lang in ("en", "zh-TW"):
        assert key in error.text(lang)
        assert "{where}" not in error.text(lang)
    with pytest.raises(SetupError) as caught:
        parse_setup(yaml.safe_load(text), source="my-case")
    assert caught.value.text().startswith("my-case: ")


@pytest.mark.parametrize(
    ("data", "meant"),
    [
        ({"machin": "mill3"}, "; did you mean machine?"),
        ({"single_block": True}, "; single_block is a key of switches"),
        ({"tools": {1: {"machine": "mill3"}}}, "; machine is a key of the top level"),
        (
            {"tools": {1: {"wear": {"tip": 3}}}},
            "; tip is a key of tools.TOOL, tools.TOOL.edges.NUMBER, switches.skip_surfaces",
        ),
        ({"colour": "red"}, ""),
    ],
)
def test_an_unknown_key_says_where_it_belongs(data: dict[str, object], meant: str) -> None:
    with pytest.raises(SetupError) as caught:
        parse_setup(data)
    assert caught.value.text("en").partition("there is no such key here")[2] == meant


def test_a_toml_setup_is_the_same_as_a_yaml_setup(tmp_path: Path) -> None:
    toml, yml = tmp_path / "setup.toml", tmp_path / "setup.yaml"
    toml.write_text(
        'machine = "mill3"\n[tools.1]\nlength = 3\n[parameters]\n"1006#3 X" = 1\n', encoding="utf-8"
    )
    yml.write_text("machine: mill3\ntools: {1: {length: 3}}\nparameters: {1006#3 X: 1}\n", encoding="utf-8")
    assert load_setup(toml) == load_setup(yml) != Setup()


@pytest.mark.parametrize(
    ("name", "text", "line", "message"),
    [
        ("setup.toml", "[tools.1]\nlenght = 3\n", 2, "unknown-key"),
        ("setup.toml", "[tools.1\n", 1, "not-toml"),
        ("setup.yaml", "a: 1\nb: [\n", 3, "not-yaml"),
        ("absent.yaml", None, 0, "unreadable"),
    ],
)
def test_a_wrong_setup_file_names_its_line(
    tmp_path: Path, name: str, text: str | None, line: int, message: str
) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(SetupError) as caught:
        load_setup(path)
    assert (caught.value.line, caught.value.message) == (line, message)


def test_an_empty_setup_file_is_the_default_setup(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text("# nothing yet\n", encoding="utf-8")
    assert load_setup(path) == Setup()


def test_surfaces_of_the_skip_input() -> None:
    text = {
        "shape": "cylinder",
        "at": {"x": 3},
        "direction": {"Z": 2},
        "radius": 20,
        "inside": True,
        "tip": 1,
    }
    (surface,) = parse_setup({"switches": {"skip_surfaces": [text]}}).switches.skip_surfaces
    assert (surface.at, surface.direction, surface.radius) == ((3.0, 0.0, 0.0), (0.0, 0.0, 2.0), 20.0)
    assert (surface.inside, surface.tip) == (True, 1.0)


@pytest.mark.parametrize(
    "switches",
    [
        {"skip_signal_after": -1},
        {"skip_surfaces": [{"shape": "plane", "at": {"X": 1}}]},
        {"skip_surfaces": [{"shape": "plane", "at": {"X": 1}, "direction": {"X": 0}}]},
        {"skip_surfaces": [{"shape": "sphere", "at": {"X": 1}, "radius": 0}]},
        {"skip_surfaces": [{"shape": "sphere", "at": {"B": 1}, "radius": 1}]},
        {"skip_surfaces": [{"shape": "sphere", "at": {"X": 1}, "radius": 1, "direction": {"X": 1}}]},
        {"skip_surfaces": [{"shape": "cone", "at": {"X": 1}}]},
    ],
)
def test_a_surface_that_makes_no_sense_is_a_mistake(switches: dict[str, object]) -> None:
    with pytest.raises(SetupError):
        parse_setup({"switches": switches})


@pytest.mark.parametrize("value", [-1, 1.5, True, [1]])
def test_the_tool_in_the_spindle_is_a_number_or_a_name(value: object) -> None:
    assert parse_setup({"spindle_tool": 3}).tool_at_start(1) == 3
    assert parse_setup({"spindle_tool": "3"}).tool_at_start(1) == 3
    assert parse_setup({"spindle_tool": 3}).tool_at_start(2) == 0
    assert parse_setup({"spindle_tool": {1: 3, 2: "FACE"}}).tool_at_start(2) == "FACE"
    assert parse_setup({"spindle_tool": "FACE"}).tool_name == "FACE"
    with pytest.raises(SetupError):
        parse_setup({"spindle_tool": value})


@pytest.mark.parametrize(
    ("data", "where"),
    [
        ({"start": {"Q": 1}}, "start.Q"),
        ({"work_offsets": {"G54": {"X": 1, "W": 2}}}, "work_offsets.G54.W"),
        ({"tools": {1: {"axes": {"U": 2}}}}, "tools.1.axes.U"),
        ({"tools": {1: {"edges": {2: {"wear": {"axes": {"U": 2}}}}}}}, "tools.1.edges.2.wear.axes.U"),
        ({"switches": {"skip_signal_at": {"A": 2}}}, "switches.skip_signal_at.A"),
    ],
)
def test_an_axis_that_the_machine_does_not_have_is_a_mistake(data: dict[str, object], where: str) -> None:
    with pytest.raises(
        SetupError, match=re.escape(f"{where}: machine mill3 has no such axis; it has X, Y, Z")
    ):
        check_axes(parse_setup(data), load_machine("mill3"))


def test_an_axis_that_the_machine_does_not_have_is_found_in_the_file(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text("work_offsets:\n  G54: {X: 1}\nstart:\n  X: 5\n  B: 3\n", encoding="utf-8")
    with pytest.raises(SetupError) as error:
        check_axes(load_setup(path), load_machine("mill3"), path)
    assert (error.value.line, error.value.column) == (5, 3)


def test_axes_are_known_by_the_names_of_the_channel_too() -> None:
    setup = parse_setup({"start": {"x": 1}, "work_offsets": {"G54": {"Z": 1}}})
    check_axes(setup, load_machine("lathe-c-transmit"))


@pytest.mark.parametrize("name", ["G99", "54", "G54P", "G60", "EXTERN", "G5"])
def test_what_is_no_work_offset_is_a_mistake(name: str) -> None:
    with pytest.raises(SetupError, match="is no work offset"):
        parse_setup({"work_offsets": {name: {"X": 1}}})


def test_a_work_offset_is_found_however_its_number_is_written() -> None:
    assert list(parse_setup({"work_offsets": {"g54.1p2": {}, "G54  P3": {}}}).work_offsets) == [
        "G54.1 P2",
        "G54 P3",
    ]


@pytest.mark.parametrize("value", [2, -1, 0.5, "on"])
def test_a_bit_holds_nothing_but_0_and_1(value: object) -> None:
    with pytest.raises(SetupError, match="5101#2"):
        parse_setup({"parameters": {"5101#2": value}})


def test_channels_are_dealt_out_from_the_first_on() -> None:
    with pytest.raises(SetupError, match=r"channels\.1 is missing"):
        parse_setup({"channels": {7: ["X"]}})


def test_an_operating_mode_has_a_name_that_is_known() -> None:
    assert parse_setup({"switches": {"mode": "MDI"}}).switches.mode == "mdi"
    with pytest.raises(SetupError, match="it can be memory, auto, mdi"):
        parse_setup({"switches": {"mode": "mdii"}})


def test_an_axis_that_the_machine_does_not_have_may_be_zero() -> None:
    check_axes(parse_setup({"start": {"A": 0}, "work_offsets": {"G54": {"A": 0.0}}}), load_machine("mill3"))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("tools:\n  1: {radius: 3, tip: 99}", 2),
        ("start:\n  X: 1.0e+300", 2),
        ("start:\n  X: 1\n  x: 2", 3),
        ("tools:\n  '': {radius: 3}", 2),
        ("variables:\n  R1: 1.0e+200", 2),
        ("switches:\n  interrupts:\n  - {input: 12345678901, line: 1, at: {}}", 3),
        ("parameters:\n  5102#32: 1", 2),
        ("start:\n  X: 010", 2),
    ],
)
def test_a_value_that_no_machine_has_is_refused_with_its_line(tmp_path: Path, text: str, line: int) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SetupError) as error:
        load_setup(path)
    assert error.value.line == line


def test_a_bit_that_parameters_of_the_control_do_not_have_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text("parameters:\n  5102#7: 1\n  1006#8 X: 1\n", encoding="utf-8")
    check_bits(load_setup(path), "sinumerik-840d", 31, path)
    with pytest.raises(SetupError, match="1006#8 X: a parameter of fanuc-m has the bits 0 to 7") as error:
        check_bits(load_setup(path), "fanuc-m", 7, path)
    assert error.value.line == 3


@pytest.mark.parametrize("text", ["a = " + "[" * 5000, "a = " + "9" * 5000])
def test_toml_beyond_all_bounds_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "setup.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SetupError):
        load_setup(path)
