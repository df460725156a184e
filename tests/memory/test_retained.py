"""Retained memory: tables by name and channel, and what a channel keeps in them."""

from __future__ import annotations

import pickle

import pytest

from polycnc.channel.channel import Channel
from polycnc.channel.states.snapshot import Snapshot
from polycnc.channel.states.state import State, plain_tables, tables
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.memory.retained import PARAMETERS, PROGRAMS, VARIABLES, WORK_OFFSETS, InMemoryStore
from polycnc.program import Form, ProgramStore
from polycnc.session import open_session


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
        ("syntec-mill", "%@MACRO\n#401 := #401 + 1;\n", "#401"),
        ("syntec-mill", "%@MACRO\n@656 := @656 + 1;\n", "@656"),
        ("syntec-mill", "%@MACRO\n@100103 := @100103 + 1;\n", "@100103"),
        ("syntec-mill", "%@MACRO\n@655 := @655 + 1;\n", "R255"),
    ],
)
def test_variables_of_the_table_outlive_the_channel(control_id: str, text: str, variable: str) -> None:
    store = InMemoryStore()
    for count in (3, 4, 5):
        channel = run(control_id, text + "M30\n", store, variables={variable: 2})
        assert channel.control.read_variable(channel, variable) == count


@pytest.mark.parametrize(
    ("control_id", "text", "variable"),
    [
        ("fanuc-m", "O1\n#100=#100+1\n", "#100"),
        ("syntec-mill", "%@MACRO\n@400 := @400 + 1;\n", "@400"),
        ("syntec-mill", "%@MACRO\n@502 := @502 + 1;\n", "R102"),
        ("syntec-mill", "%@MACRO\n@106000 := @106000 + 1;\n", "R6000"),
    ],
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
    for expected in (0.03, 12.0):
        channel = run("fanuc-m", text, store)
        assert channel.control.read_variable(channel, "#500") == expected


def test_axis_groups_share_registers_and_at_variables() -> None:
    store = InMemoryStore()
    channel = run("syntec-mill", "%@MACRO\n@5 := 7;\nM30;\n", store)
    assert store.table(VARIABLES)[5] == 7
    assert channel.memory.globals.values is store.table(VARIABLES)


SINUMERIK_DATA = """$P_UIFR[1,X,TR]=$P_UIFR[1,X,TR]+1
R1=R1+1
$TC_DP3[1,1]=$TC_DP3[1,1]+1
$TC_DP1[9,1]=120
$MA_AX_VELO_LIMIT[1,AX1]=$MA_AX_VELO_LIMIT[1,AX1]+1
$MN_INT_INCR_PER_MM=$MN_INT_INCR_PER_MM+1
DEPTH=DEPTH+1 FIELD[2]=FIELD[2]+1 ALL_OF_THEM=ALL_OF_THEM+1 ANEW=ANEW+1
TURN=CROT(Z,30) WAY=AX2 WORD=WORD<<"A" ON=NOT ON
M30
"""
DEFINITIONS = """DEF REAL DEPTH=-3
DEF INT FIELD[4]
DEF NCK REAL ALL_OF_THEM
DEF INIPO REAL ANEW=7
DEF FRAME TURN
DEF AXIS WAY=X
DEF STRING[20] WORD
DEF BOOL ON
M30
"""


def run_sinumerik(
    store: InMemoryStore, text: str = SINUMERIK_DATA, definitions: str = DEFINITIONS
) -> Channel:
    chosen, programs = control("sinumerik-840d"), ProgramStore(form=Form.SINUMERIK)
    main = programs.add_text("/_N_MPF_DIR/_N_MAIN_MPF", text)
    programs.add_text("/_N_DEF_DIR/_N_UGUD_DEF", definitions)
    given = {
        "work_offsets": {"G54": {"X": 5.0}},
        "tools": {1: {"length": 30.0}},
        "variables": {"R1": 2, "DEPTH": 4},
    }
    channel = Channel(
        chosen, load_machine(chosen.default_machine), parse_setup(given), programs, retained=store
    )
    for _ in channel.run(main):
        pass
    assert channel.alarms == []
    return channel


def values(channel: Channel, *names: str) -> list[object]:
    return [channel.control.read_variable(channel, name) for name in names]


@pytest.mark.parametrize(
    ("name", "seen"),
    [
        ("$P_UIFR[1,X,TR]", [6.0, 7.0, 8.0]),
        ("R1", [3.0, 4.0, 5.0]),
        ("$TC_DP3[1,1]", [31.0, 32.0, 33.0]),
        ("$MA_AX_VELO_LIMIT[1,AX1]", [11501.0, 11502.0, 11503.0]),
        ("$MN_INT_INCR_PER_MM", [1001.0, 1002.0, 1003.0]),
        ("DEPTH", [5.0, 6.0, 7.0]),
        ("FIELD[2]", [1, 2, 3]),
        ("ALL_OF_THEM", [1.0, 2.0, 3.0]),
        ("ANEW", [8.0, 8.0, 8.0]),
        ("WORD", ["A", "AA", "AAA"]),
        ("ON", [1, 0, 1]),
    ],
)
def test_data_of_a_sinumerik_outlive_the_channel(name: str, seen: list[object]) -> None:
    store = InMemoryStore()
    assert [values(run_sinumerik(store), name)[0] for _ in seen] == seen


def test_a_user_variable_of_another_type_or_size_begins_anew() -> None:
    store = InMemoryStore()
    run_sinumerik(store)
    other = DEFINITIONS.replace("DEF REAL DEPTH=-3", "DEF INT DEPTH=9").replace("FIELD[4]", "FIELD[5]")
    assert values(run_sinumerik(store, "M30\n", other), "DEPTH", "FIELD[2]", "ALL_OF_THEM") == [9, 0, 1.0]


def test_a_machine_datum_of_the_control_is_retained_for_all_channels() -> None:
    store = InMemoryStore()
    run_sinumerik(store)
    assert store.table(PARAMETERS) == {("$MN_INT_INCR_PER_MM", ()): 1001.0}
    assert list(store.table(PARAMETERS, 1)) == [("$MA_AX_VELO_LIMIT", (1, "X"))]


@pytest.mark.parametrize(
    "control_id", ["fanuc-m", "meldas-m", "fanuc-0i-tf", "syntec-mill", "sinumerik-840d"]
)
def test_what_is_retained_can_be_written_down_and_read_again(control_id: str) -> None:
    def through_a_file(store: InMemoryStore) -> InMemoryStore:
        again = InMemoryStore()
        for (name, number), table in store._tables.items():
            again.table(name, number).update(pickle.loads(pickle.dumps(table)))
        return again

    def once_more(store: InMemoryStore) -> Channel:
        if control_id == "sinumerik-840d":
            return run_sinumerik(store)
        return run(control_id, "O1\nG10 L2 P1 X1.\n#500=#500+1\nM30\n", store, tools={3: {"length": 1.0}})

    first, second = InMemoryStore(), InMemoryStore()
    once_more(first)
    once_more(second)
    first, again = through_a_file(first), once_more(second)
    channel = once_more(first)
    assert plain_tables(channel) == plain_tables(again)
    assert any(plain_tables(channel).values())


@pytest.mark.parametrize(
    "control_id", ["fanuc-m", "meldas-m", "fanuc-0i-tf", "syntec-mill", "sinumerik-840d"]
)
def test_every_table_belongs_to_a_state(control_id: str) -> None:
    store = InMemoryStore()
    if control_id == "sinumerik-840d":
        run_sinumerik(store)
    else:
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


def test_a_text_that_is_run_leaves_the_edited_program_main_in_the_memory() -> None:
    store = InMemoryStore()
    editor = ProgramStore(edited=store.table(PROGRAMS))
    editor.replace(ProgramStore().add_text("MAIN", "G0 X7.\nM30\n"))
    kept = dict(store.table(PROGRAMS))
    session = open_session("G0 X1.\nM30\n", control="fanuc-m", memory=store)
    assert session.run().final["work"]["X"] == pytest.approx(1.0)
    assert store.table(PROGRAMS) == kept
    again = open_session("MAIN", control="fanuc-m", memory=store)
    assert again.run().final["work"]["X"] == pytest.approx(7.0)
