"""A memory as a setup, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.interchange import comparison, setups
from polycnc.interchange.errors import ReadingError
from polycnc.machine.errors import FileError
from polycnc.memory.retained import InMemoryStore
from tests.interchange.support import files_of, filled, machine_of

if TYPE_CHECKING:
    from pathlib import Path

PROGRAMS = {
    "fanuc-m": "#500=1.5\nG10 L2 P1 X1.5\nG10 L20 P3 Y2.\nG10 L10 P3 R7.5\nG10 L50\nN5003 Q0 R1\nG11\nM30\n",
    "meldas-m": "#500=1.5\nG10 L2 P1 X1.5\nG10 L13 P3 R.5\nM30\n",
    "fanuc-0i-tf": "#500=1.5\nG10 P3 X4. Z1. Q3\nG10 P10003 X3. R.8\nG10 L2 P2 X5. Z9.\nM30\n",
    "syntec-mill": "%@MACRO\n@5 := 7;\nSETPR(4001, 5);\nG10 L2 P1 X5.;\nG10 L10 P2 R1.5;\nG10 L1000 P60 R7;\nM30;\n",
    "sinumerik-840d": "R1=5\n$P_UIFR[1,X,TR]=5\n$TC_DP1[2,1]=120\n$TC_DP3[2,1]=50\n$TC_DP6[2,1]=4\n"
    '$TC_DP1[2,2]=500\n$TC_DP3[2,2]=10\n$TC_DP12[2,2]=.1\n$TC_TP2[2]="MILL"\n$MN_INT_INCR_PER_MM=100\nM30\n',
}


@pytest.mark.parametrize("control", PROGRAMS)
def test_a_setup_brings_back_what_it_says(control: str, tmp_path: Path) -> None:
    memory = filled(control, PROGRAMS[control])
    path = tmp_path / "setup.yaml"
    path.write_text(files_of(memory, control, "setup")["setup.yaml"], encoding="utf-8")
    again = InMemoryStore()
    assert setups.take(again, control, machine_of(control), path) == []
    assert list(comparison.missing(memory, again, 1)) == []
    assert list(comparison.missing(again, memory, 1)) == []


def test_what_a_setup_does_not_name_stays(tmp_path: Path) -> None:
    memory = filled("fanuc-m", PROGRAMS["fanuc-m"])
    path = tmp_path / "setup.yaml"
    path.write_text("work_offsets: {G55: {X: 3}}\nvariables: {'#500': 0}\nstart: {X: 1}\n")
    notes = setups.take(memory, "fanuc-m", "mill3", path)
    assert "start" in notes[0]
    assert memory.table("work offsets", 1)["G55"] == [3.0, 0.0, 0.0]
    assert memory.table("work offsets", 1)["G54"] == [1.5, 0.0, 0.0]
    assert memory.table("variables", 1)[500] == 0.0


@pytest.mark.parametrize(
    ("content", "place"),
    [
        ("tools: {1: {length: 5}}\nvariables: {'#99999': 1}\n", ":2:14:"),
        ("parameters: {'31999': 1}\n", ":1:15:"),
    ],
)
def test_a_setup_that_names_what_there_is_not_is_refused(content: str, place: str, tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text(content)
    with pytest.raises(ReadingError) as caught:
        setups.take(InMemoryStore(), "fanuc-m", "mill3", path)
    assert place in caught.value.text("en")


def test_what_is_no_setup_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "setup.yaml"
    path.write_text("tools: 5\n")
    with pytest.raises(FileError):
        setups.take(InMemoryStore(), "fanuc-m", "mill3", path)
