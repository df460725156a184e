"""Retained memory: tables by name and channel, and what a channel keeps in them."""

from __future__ import annotations

import pytest

from polycnc.channel.channel import Channel
from polycnc.channel.snapshot import Snapshot
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.memory.retained import WORK_OFFSETS, InMemoryStore
from polycnc.program import ProgramStore


def run(control_id: str, text: str, store: InMemoryStore) -> Channel:
    chosen, programs = control(control_id), ProgramStore()
    main = programs.add_text("MAIN", text)
    setup = parse_setup({"work_offsets": {"G54": {"X": 5.0}}})
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


def test_a_snapshot_covers_retained_memory() -> None:
    store = InMemoryStore()
    channel = run("fanuc-m", "O1\nM30\n", store)
    snapshot, table = Snapshot(channel), store.table(WORK_OFFSETS, 1)
    table["G54"][0] = 9.0
    table["G59"] = [1.0, 2.0, 3.0]
    snapshot.restore()
    assert table["G54"][0] == 5.0
    assert "G59" not in table
