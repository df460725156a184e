"""Retained memory in a file: what lasts, and what happens where something goes wrong."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path
from random import Random
from time import sleep

import pytest

from polycnc import VirtualControl, open_session
from polycnc.control.registry import ids
from polycnc.memory.file import SCHEMA, FileStore, MemoryFileError
from polycnc.memory.retained import PARAMETERS, PROGRAMS, VARIABLES
from polycnc.messages.catalogue import LANGUAGES
from tests.examples import examples

PROGRAMS_OF = {
    "fanuc-m": "#500=#500+1\nG10 L2 P1 X#500\nG10 L10 P3 R7.5\nM30\n",
    "meldas-m": "#500=#500+1\nG10 L2 P1 X#500\nG10 L10 P3 R7.5\nM30\n",
    "fanuc-0i-tf": "#500=#500+1\nG10 P3 X4. Z1. Q3\nM30\n",
    "syntec-mill": "%@MACRO\n@700 := @700 + 1;\nG10 L2 P1 X5.;\nM30;\n",
    "sinumerik-840d": "R1=R1+1\n$P_UIFR[1]=CTRANS(X,5):CROT(Z,30)\n$TC_DP6[2,1]=4\n$MN_INT_INCR_PER_MM=100\nM30\n",
}
COUNTERS = {"syntec-mill": "@700", "sinumerik-840d": "R1"}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "shop.db"


def run(control: str, path: Path, text: str | None = None) -> object:
    session = open_session(text or PROGRAMS_OF[control], control=control, memory=path)
    result = session.run()
    session.channel.retained.close()
    assert not result.alarms
    return result.variables[COUNTERS.get(control, "#500")]


@pytest.mark.parametrize("control", ids())
def test_what_a_program_leaves_behind_lasts(control: str, path: Path) -> None:
    assert [run(control, path) for _ in range(3)] == [1, 2, 3]


@pytest.mark.parametrize("control", ids())
def test_every_table_of_every_control_comes_back_as_it_was(control: str, path: Path) -> None:
    with FileStore(path, control) as store:
        machine = VirtualControl(control, retained=store)
        machine.load(PROGRAMS_OF[control])
        machine.cycle_start()
        machine.run()
        machine.load("G1 X1. F100. QQ\nM30\n")
        machine.cycle_start()
        machine.run()
        assert machine.alarms
        store.commit()
        held = {of: dict(table) for of, table in store._tables.items()}
    assert sum(map(len, held.values())) > 3
    with FileStore(path, control) as store:
        assert {of: store.table(*of) for of in held} == held


def test_what_is_not_committed_does_not_last(path: Path) -> None:
    with FileStore(path, "fanuc-m") as store:
        store.table(VARIABLES, 1)[500] = 1.0
        store.commit()
        store.table(VARIABLES, 1)[500] = 2.0
    with FileStore(path) as store:
        assert store.table(VARIABLES, 1) == {500: 1.0}
        assert store.control == "fanuc-m"


def test_entries_keep_their_order_and_go_where_they_are_removed(path: Path) -> None:
    with FileStore(path, "fanuc-m") as store:
        store.table("a").update({"z": 1, "b": 2, "m": 3})
        store.commit()
        del store.table("a")["b"]
        store.table("a")["c"] = 4
        store.commit()
    with FileStore(path) as store:
        assert list(store.table("a").items()) == [("z", 1), ("m", 3), ("c", 4)]


def test_an_edited_program_lasts_and_is_run_by_its_name(path: Path) -> None:
    control = VirtualControl("fanuc-m", retained=path)
    control.load("O0007\nG0 X1.\nM30\n")
    control.select_mode("teach")
    control.teach("G0", line=2)
    control.close()
    result = open_session(Path("O0007"), control="fanuc-m", memory=path).run()
    assert [row["type"] for row in result.rows if row["type"] in ("rapid", "linear")] == ["rapid", "rapid"]


def test_a_snapshot_brings_back_what_the_tables_hold(path: Path) -> None:
    control = VirtualControl("fanuc-m", retained=path)
    control.load("#500=1.\nM00\n#500=2.\nM30\n")
    control.cycle_start()
    control.run()
    checkpoint = control.checkpoint()
    control.cycle_start()
    control.run()
    assert control.read_variable("#500") == 2.0
    checkpoint.restore()
    assert control.read_variable("#500") == 1.0
    control.close()
    with FileStore(path) as store:
        assert store.table(VARIABLES, 1)[500] == 1.0


# ---- faults ------------------------------------------------------------------------------------------------


def refusal(path: Path, control: str = "fanuc-m", **more: str) -> str:
    with pytest.raises(MemoryFileError) as caught:
        FileStore(path, control, **more)
    for lang in LANGUAGES:
        assert "{" not in caught.value.text(lang)
    return caught.value.message


def test_a_second_process_is_refused_until_the_first_one_has_closed_it(path: Path) -> None:
    tried = [sys.executable, "-c", f"from polycnc.memory.file import *; FileStore({str(path)!r}, 'fanuc-m')"]
    with FileStore(path, "fanuc-m"):
        assert refusal(path) == "memory.in-use"
        done = subprocess.run(tried, check=False, capture_output=True, text=True)
        assert "MemoryFileError" in done.stderr
    assert subprocess.run(tried, check=False).returncode == 0


@pytest.mark.parametrize("content", [b"no data base", b"SQLite format 3\0" + bytes(4000), os.urandom(8192)])
def test_a_file_that_is_no_memory_is_refused_and_kept(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    assert refusal(path) == "memory.damaged"
    assert path.read_bytes() == content


def test_a_data_base_of_somebody_else_is_refused_and_kept(path: Path) -> None:
    with sqlite3.connect(path) as base:
        base.execute("CREATE TABLE mine (a)")
    base.close()
    content = path.read_bytes()
    assert refusal(path) == "memory.damaged"
    assert path.read_bytes() == content


def test_a_damaged_memory_is_refused_and_kept(path: Path) -> None:
    with FileStore(path, "fanuc-m") as store:
        store.table(VARIABLES, 1).update((n, float(n)) for n in range(3000))
        store.commit()
    content = bytearray(path.read_bytes())
    content[len(content) // 2 : len(content) // 2 + 3000] = bytes(3000)
    path.write_bytes(content)
    assert refusal(path) == "memory.damaged"
    assert path.read_bytes() == bytes(content)


def test_a_value_that_cannot_be_read_is_a_damaged_memory(path: Path) -> None:
    with FileStore(path, "fanuc-m") as store:
        store.table(VARIABLES, 1)[500] = 1.0
        store.commit()
    with sqlite3.connect(path) as base:
        base.execute("""UPDATE entry SET value = '{"~":"what"}'""")
    base.close()
    with FileStore(path) as store, pytest.raises(MemoryFileError) as caught:
        store.table(VARIABLES, 1)
    assert caught.value.message == "memory.damaged"


def test_a_memory_of_a_newer_schema_is_refused(path: Path) -> None:
    FileStore(path, "fanuc-m").close()
    with sqlite3.connect(path) as base:
        base.execute(f"PRAGMA user_version = {SCHEMA + 1}")
    base.close()
    assert refusal(path) == "memory.newer"


def test_a_memory_of_another_control_or_machine_is_refused(path: Path) -> None:
    FileStore(path, "fanuc-m", "mill3").close()
    assert refusal(path, "meldas-m") == "memory.other-control"
    assert refusal(path, "fanuc-m", machine="hartford") == "memory.other-machine"


def test_a_memory_that_is_not_there_is_made_only_where_its_control_is_told(path: Path) -> None:
    assert refusal(path, "") == "memory.missing"
    assert not path.exists()


def test_a_folder_is_no_memory(tmp_path: Path) -> None:
    assert refusal(tmp_path) == "memory.unusable"
    assert refusal(tmp_path / "none" / "a.db") == "memory.unusable"


@pytest.mark.skipif(getattr(os, "geteuid", int)() == 0, reason="nothing is read-only for root")
def test_a_read_only_memory_is_refused(path: Path) -> None:
    FileStore(path, "fanuc-m").close()
    path.chmod(0o444)
    assert refusal(path) == "memory.read-only"


def test_on_a_full_disk_what_was_confirmed_stays(path: Path) -> None:
    with FileStore(path, "fanuc-m") as store:
        store.table(VARIABLES, 1)[500] = 1.0
        store.commit()
        pages = store._number("page_count")
        store._base.execute(f"PRAGMA max_page_count = {pages}")
        store.table("much").update((n, "x" * 1000) for n in range(1000))
        store.table(VARIABLES, 1)[500] = 2.0
        with pytest.raises(MemoryFileError) as caught:
            store.commit()
        assert caught.value.message == "memory.full"
        store._base.execute("PRAGMA max_page_count = 100000")
        store.commit()  # there is room again: nothing is lost
    with FileStore(path) as store:
        assert store.table(VARIABLES, 1)[500] == 2.0
        assert len(store.table("much")) == 1000


def _session(path: Path, confirmed: int) -> None:
    """A session that is killed: edits, offsets, variables and parameters, and a word behind every commit."""
    store = FileStore(path, "fanuc-m")
    control = VirtualControl("fanuc-m", retained=store)
    number = int(store.table(VARIABLES, 1).get(500) or 0)
    while True:
        number += 1
        control.load(f"O{number:04d}\n#500=#500+1\nG10 L2 P1 X#500\nG10 L10 P1 R[#500*0.01]\nM30\n")
        control.select_mode("auto")
        control.cycle_start()
        control.run()
        store.table(PARAMETERS, 1)["count"] = store.table("other")["count"] = number
        store.table(PROGRAMS)["", f"o{number % 7}"] = control._programs.main(1)
        store.commit()
        os.write(confirmed, b".")


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_process_that_is_killed_loses_nothing_confirmed_and_leaves_nothing_half_written(path: Path) -> None:
    random, count, times = Random(1), 0, examples(500)
    for number in range(times):
        read, write = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                _session(path, write)
            finally:
                os._exit(1)
        os.close(write)
        told = len(os.read(read, 1)) if number % 2 else 0  # every other one has something confirmed
        sleep(random.uniform(0.0, 0.03))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        told += len(os.read(read, 100_000))
        os.close(read)
        with FileStore(path, "fanuc-m") as store:
            reached = int(store.table(VARIABLES, 1).get(500) or 0)
            assert count + told <= reached <= count + told + 1
            count = reached
            if count:
                assert store.table(PARAMETERS, 1).get("count") == store.table("other").get("count")
                assert round(store.table("tool offsets", 1)[1].length * 100) == count
                assert store.table("work offsets", 1)["G54"][0] == count
    assert count >= times // 2
