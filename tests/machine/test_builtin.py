"""The machines that come with polycnc."""

import subprocess
import sys
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from polycnc.machine.builder import BUILDERS
from polycnc.machine.check import conditions, contradictions, gaps
from polycnc.machine.load import BUILTIN, builtin_ids, load_machine
from polycnc.machine.render import fields, machine_toml
from polycnc.machine.schema import BuilderTable, field_names, mistakes
from polycnc.machine.tables import BuilderData, MachineData

AXES = {
    "mill3": "X Y Z",
    "hartford": "X Y Z",
    "mill3-2ch": "X Y Z",
    "mill3-4ch": "X Y Z",
    "mill2-2ch": "X Y",
    "mill4-2ch": "X Y Z B",
    "mill3-two-spindles": "X Y Z",
    "mill4": "X Y Z A",
    "mill4-b": "X Y Z B",
    "mill4-xyzc": "X Y Z C",
    "mill4-c-head": "X Y Z C",
    "mill4-x1-y1-z1-z2": "X1 Y1 Z1 Z2",
    "mill4-xyzw": "X Y Z W",
    "mill5-x1-x-v-z2-z1": "X1 X V Z2 Z1",
    "mill5-xyzvw": "X Y Z V W",
    "mill6-uvw": "XX YY ZZ U V W",
    "mill6-x-y-z1-z2-z3-z4": "X Y Z1 Z2 Z3 Z4",
    "mill5-ac-table": "X Y Z A C",
    "mill5-bc-head": "X Y Z B C",
    "mill5-ca-head": "X Y Z C A",
    "mill5-ab-head": "X Y Z A B",
    "mill6-cac-head": "X Y Z C A B",
    "lathe2": "X Z",
    "lathe-c": "X Z C",
    "lathe-y": "X Z Y",
    "lathe-yab": "X Z Y A B",
    "lathe-xza": "X Z A",
    "lathe-c-transmit": "X Z C",
    "lathe-c-transmit-y": "X Y Z CC",
    "lathe2-2path": "X1 Z1 X2 Z2",
    "grinder-xz": "X Z",
    "grinder-mu-mz": "MU MZ",
}
FILES = sorted(Path(BUILTIN).rglob("*.toml"))


def test_every_machine_of_the_case_format_is_there_and_no_other() -> None:
    assert set(builtin_ids()) == set(AXES)


@pytest.mark.parametrize("path", FILES, ids=[path.stem for path in FILES])
def test_shipped_file_follows_the_schema(path: Path) -> None:
    assert list(mistakes(tomllib.loads(path.read_text(encoding="utf-8")))) == []


@pytest.mark.parametrize("path", sorted(Path(BUILDERS).glob("*/*.toml")), ids=lambda path: path.stem)
def test_shipped_builder_follows_the_schema(path: Path) -> None:
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    assert list(mistakes(data, BuilderTable)) == []
    assert list(conditions(cast("BuilderData", data))) == []


@pytest.mark.parametrize(("machine_id", "axes"), AXES.items())
def test_machine_has_its_axes_and_does_not_contradict_itself(machine_id: str, axes: str) -> None:
    machine = load_machine(machine_id)
    assert [axis.name for axis in machine.axes] == axes.split()
    assert list(contradictions(machine)) == []
    assert str(machine.name) != machine_id


@pytest.mark.parametrize("machine_id", AXES)
@pytest.mark.parametrize("lang", ["en", "zh-TW"])
def test_shown_machine_reads_back_as_the_same_machine(machine_id: str, lang: str, tmp_path: Path) -> None:
    shown = machine_toml(load_machine(machine_id), lang)
    assert list(gaps(cast("MachineData", tomllib.loads(shown)))) == []
    path = tmp_path / f"{machine_id}.toml"
    path.write_text(shown, encoding="utf-8")
    assert load_machine(path) == load_machine(machine_id)


def test_shown_machine_explains_every_key_once() -> None:
    shown = machine_toml(load_machine("lathe-c"))
    for table, keys in field_names().items():
        for key in keys - {"base", "defaults"}:
            if table or key in ("name", "description") or key.endswith("_s"):
                explanation = fields().text(f"{table}.{key}" if table else key)
                assert shown.count(f"  # {explanation}\n") >= 1, (table, key)


def test_every_key_of_the_schema_is_explained_in_both_languages() -> None:
    for table, keys in field_names().items():
        for key in keys:
            entry = fields().entry(f"{table}.{key}" if table else key)
            assert entry["en"]
            assert entry["zh-TW"] != entry["en"]


def test_no_machine_has_soft_limits() -> None:
    for machine_id in AXES:
        assert all(
            axis.overtravel(value) == 0 for axis in load_machine(machine_id).axes for value in (-1e9, 1e9)
        )


def test_file_units_become_internal_units_once() -> None:
    x = load_machine("mill3").axis["X"]
    assert (x.rapid, x.max_feed, x.acceleration, x.jerk) == (400.0, 250.0, 3000.0, 50000.0)


def test_rotary_axes_are_modulo_except_in_five_axis_heads() -> None:
    assert load_machine("mill4").axis["A"].modulo
    assert load_machine("mill5-ac-table").axis["C"].modulo
    for machine_id in ("mill5-bc-head", "mill5-ca-head", "mill5-ab-head", "mill6-cac-head"):
        rotary = [axis for axis in load_machine(machine_id).axes if axis.rotary]
        assert len(rotary) >= 2
        assert not any(axis.modulo for axis in rotary)


def test_linear_a_of_a_lathe_is_parallel_to_x() -> None:
    a = load_machine("lathe-xza").axis["A"]
    assert (a.rotary, a.parallel_to, a.diameter) == (False, "X", False)


def test_only_x_of_a_lathe_is_a_diameter_axis() -> None:
    assert [axis.name for axis in load_machine("lathe-yab").axes if axis.diameter] == ["X"]
    assert [axis.name for axis in load_machine("lathe2-2path").axes if axis.diameter] == ["X1", "X2"]


def test_both_paths_of_a_lathe_call_their_axes_x_and_z() -> None:
    machine = load_machine("lathe2-2path")
    assert [channel.axes for channel in machine.channels] == [("X1", "Z1"), ("X2", "Z2")]
    assert machine.channel_axes(2) == ("X", "Z")
    assert machine.geometry_indices(2) == (0, -1, 1)
    assert [channel.spindles for channel in machine.channels] == [(1,), (1,)]


def test_machine_axis_names_end_in_a_digit() -> None:
    names = {axis.name: axis.machine_name for axis in load_machine("mill6-x-y-z1-z2-z3-z4").axes}
    assert names == {"X": "X1", "Y": "Y1", "Z1": "Z1", "Z2": "Z2", "Z3": "Z3", "Z4": "Z4"}


def test_head_joints_stand_in_the_order_in_which_they_carry_each_other() -> None:
    machine = load_machine("mill5-ca-head")
    assert [(joint.axis, joint.direction) for joint in machine.tool_chain if joint.rotary] == [
        ("C", (0.0, 0.0, 1.0)),
        ("A", (1.0, 0.0, 0.0)),
    ]
    assert [joint.axis for joint in machine.tool_chain] == ["X", "Y", "Z", "C", "A"]
    assert machine.work_chain == ()
    assert [joint.axis for joint in load_machine("mill6-cac-head").tool_chain][3:] == ["C", "A", "B"]


def test_table_a_carries_table_c() -> None:
    machine = load_machine("mill5-ac-table")
    assert [joint.axis for joint in machine.work_chain] == ["A", "C"]
    assert machine.tool_chain[0].direction == (1.0, 0.0, 0.0)


def test_geometry_axes_need_not_bear_their_names() -> None:
    assert load_machine("mill6-uvw").channels[0].geometry == {"X": "XX", "Y": "YY", "Z": "ZZ"}
    grinder = load_machine("grinder-mu-mz").channels[0]
    assert (grinder.geometry, grinder.virtual) == ({"Z": "MZ"}, ("X",))
    assert load_machine("grinder-mu-mz").geometry_indices(1) == (-1, -1, 1)


def test_one_channel_owns_an_axis_that_all_can_move() -> None:
    machine = load_machine("mill3-4ch")
    assert [channel.number for channel in machine.channels] == [1, 2, 3, 4]
    assert machine.owner("Z") == 1


def test_channels_of_a_setup_deal_the_axes_out_anew() -> None:
    machine = load_machine("mill4-2ch").with_channels({2: ("B",), 1: ("X", "Y", "Z", "B")})
    assert [channel.axes for channel in machine.channels] == [("X", "Y", "Z", "B"), ("B",)]
    assert machine.channels[1].geometry == {}
    assert machine.owner("B") == 1
    with pytest.raises(KeyError):
        machine.with_channels({1: ("X", "Q")})


def test_shown_texts_keep_quotes_and_limits(tmp_path: Path) -> None:
    machine = load_machine("mill3")
    x = replace(
        machine.axis["X"], limit_minus=-510.5, limit_plus=0.25, reference_points=(0.0, -1.0, -2.0, -3.0)
    )
    mine = replace(machine, name=replace(machine.name, en='The "big" one\\'), axes=(x, *machine.axes[1:]))
    path = tmp_path / "mill3.toml"
    path.write_text(machine_toml(mine), encoding="utf-8")
    assert load_machine(path) == mine


def test_loading_a_shipped_machine_imports_no_schema_library() -> None:
    code = (
        "import sys; from polycnc.machine import Setup, load_machine; load_machine('lathe-c'); Setup();"
        "print(sorted({'pydantic', 'yaml', 'numpy'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
