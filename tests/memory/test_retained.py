"""Retained memory: tables by name and channel, and what a channel keeps in them."""

from __future__ import annotations

import pytest

from polycnc.channel.channel import Channel
from polycnc.channel.states.snapshot import Snapshot
from polycnc.channel.states.state import State, tables
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.memory.retained import VARIABLES, WORK_OFFSETS, InMemoryStore
from polycnc.program import ProgramStore


def run(control_id: str, text: str, store: InMemoryStore, **more: object) -> Channel:
    chosen, programs = control(control_id), ProgramStore()
    main = programs.add_text("MAIN", text)
    setup = parse_setup({"work_offsets": {"G54": {"X": 5.0}}, **more})
    channel = Channel(chosen, load_machine(chosen.default_machine), setup, programs, retained=store)
    for _ in channel.run(main):
        pass
    assert channel.alarms == []
    return channel


def test_a_table_is_the_same_one_for_all_who_ask() -> None:
    store = InMemoryStore()
    assert store.table("a") is store.table("a")
    assert store.table("a") is not store.table("a", 1)


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "fanuc-0i-tf", "syntec-mill"])
def test_work_offsets_outlive_the_channel(control_id: str) -> None:
    store = InMemoryStore()
    run(control_id, "O1\nM30\n", store)
    delivered = store.table(WORK_OFFSETS, 1)["G54"][0]
    assert delivered in (5.0, 2.5)  # a lathe's setup says a diameter
    store.table(WORK_OFFSETS, 1)["G54"][0] = 9.0
    second = run(control_id, "O1\nM30\n", store)
    assert second.memory.work_offset("G54")[0] == 9.0


@pytest.mark.parametrize(
    ("control_id", "text", "variable"),
    [
        ("fanuc-m", "O1\n#500=#500+1\n", "#500"),
        ("fanuc-m", "O1\n#98001=[#98001]+1\n", "#98001"),
        ("meldas-m", "O1\n#999=#999+1\n", "#999"),
        ("fanuc-0i-tf", "O1\n#500=#500+1\n", "#500"),
        ("syntec-mill", "%@MACRO\n@1 := @1 + 1;\n", "@1"),
        ("syntec-mill", "%@MACRO\n@106000 := @106000 + 1;\n", "@106000"),
    ],
)
def test_variables_of_the_table_outlive_the_channel(control_id: str, text: str, variable: str) -> None:
    store = InMemoryStore()
    for count in (3, 4, 5):
        channel = run(control_id, text + "M30\n", store, variables={variable: 2})
        assert channel.control.read_variable(channel, variable) == count


@pytest.mark.parametrize(
    ("control_id", "text", "variable"),
    [("fanuc-m", "O1\n#100=#100+1\n", "#100"), ("syntec-mill", "%@MACRO\n#401 := #401 + 1;\n", "#401")],
)
def test_other_variables_begin_with_the_power(control_id: str, text: str, variable: str) -> None:
    store = InMemoryStore()
    for _ in range(2):
        channel = run(control_id, text + "M30\n", store, variables={variable: 2})
        assert channel.control.read_variable(channel, variable) == 3


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "syntec-mill"])
def test_tool_offsets_outlive_the_channel(control_id: str) -> None:
    store = InMemoryStore()
    run(control_id, "O1\nG10 L10 P3 R7.\nM30\n", store, tools={3: {"length": 1.0}})
    second = run(control_id, "O1\nG43 H3 Z0\nM30\n", store, tools={3: {"length": 1.0}})
    assert second.coordinates.machine[2] == 7.0


def test_parameters_that_a_program_has_changed_outlive_the_channel() -> None:
    store = InMemoryStore()
    text = "O1\n#500=PRM[3410]\nG10 L50\nN3410 R12.\nG11\nM30\n"
    for expected in (0.0, 12.0):
        channel = run("fanuc-m", text, store)
        assert channel.control.read_variable(channel, "#500") == expected


def test_axis_groups_share_registers_and_at_variables() -> None:
    store = InMemoryStore()
    channel = run("syntec-mill", "%@MACRO\n@5 := 7;\nM30;\n", store)
    assert store.table(VARIABLES)[5] == 7
    assert channel.memory.globals.values is store.table(VARIABLES)


@pytest.mark.parametrize("control_id", ["fanuc-m", "meldas-m", "fanuc-0i-tf", "syntec-mill"])
def test_every_table_belongs_to_a_state(control_id: str) -> None:
    store = InMemoryStore()
    run(control_id, "O1\nG10 L2 P1 X1.\nM30\n", store)
    known = {table.name for cls in State.CLASSES.values() for table in tables(cls).values()}
    assert {name for name, _ in store._tables} <= known


def test_a_snapshot_covers_retained_memory() -> None:
    store = InMemoryStore()
    channel = run("fanuc-m", "O1\nM30\n", store)
    snapshot, table = Snapshot(channel), store.table(WORK_OFFSETS, 1)
    table["G54"][0] = 9.0
    table["G59"] = [1.0, 2.0, 3.0]
    snapshot.restore()
    assert table["G54"][0] == 5.0
    assert "G59" not in table
