"""Files into a memory: what is refused, and where."""

from __future__ import annotations

from pathlib import Path

import pytest

from polycnc.interchange.errors import ReadingError
from polycnc.interchange.reading import Reading
from polycnc.memory.file import FileStore
from polycnc.memory.retained import PARAMETERS, PROGRAMS, VARIABLES, InMemoryStore
from polycnc.messages.catalogue import LANGUAGES
from polycnc.program import ProgramFileError
from tests.interchange.support import machine_of, read


@pytest.mark.parametrize(
    ("control", "name", "content", "place"),
    [
        ("fanuc-m", "A.TXT", "%\nG10 G90 L10 P1 R1.\nG10 G90 L10 P1 R9999.\nM02\n%\n", "A.TXT:3:"),
        ("fanuc-m", "A.TXT", "%\n#500=1\n#500=[1\nM02\n%\n", "A.TXT:3:"),
        ("fanuc-m", "A.TXT", "%\nG0 X1.\nM02\n%\n", "A.TXT:2:1:"),
        ("fanuc-m", "A.TXT", " \n", "A.TXT:1:1:"),
        ("fanuc-m", "P.TXT", "%\nN05003 Q1 P00000001\nN05003 Q1 P0000002\n%\n", "P.TXT:3:11:"),
        ("fanuc-m", "P.TXT", "%\nN01241 Q1 A9 P1.\n%\n", "P.TXT:2:11:"),
        ("fanuc-m", "P.TXT", "%\nN01241 Q1 A1 P1.\n", "P.TXT:2:"),
        ("fanuc-m", "P.TXT", "%\nG10 L50\nN5003 Q9 R1\nG11\n%\n", "P.TXT:3:"),
        ("meldas-m", "A.OFS", "%\nG10 G90 L10 P-1 R1.\nM02\n%\n", "A.OFS:2:"),
        ("fanuc-0i-tf", "A.TXT", "%\nG10 P01 X1.5 ;\nG10 P02 K3. ;\n%\n", "A.TXT:3:9:"),
        ("syntec-mill", "GLOBALS.NC", "%@MACRO\n@1 := 1;\n@1 := := 2;\nM30;\n", "GLOBALS.NC:3:"),
        ("sinumerik-840d", "A.INI", "%_N_A_INI\nR1=1\nR2==2\nM17\n", "A.INI:3:"),
        ("sinumerik-840d", "T.TOA", "$TC_DP6[1,1]=5\n$TC_DP6[0,1]=5\n", "T.TOA:2:"),
        ("sinumerik-840d", "A.INI", "%_N_A_INI\nG1 X1 F1\nM17\n", "A.INI:2:1:"),
    ],
)
def test_a_wrong_file_is_refused_with_its_place(control: str, name: str, content: str, place: str) -> None:
    with pytest.raises(ReadingError) as caught:
        read(control, {name: content})
    for lang in LANGUAGES:
        assert caught.value.text(lang).startswith(place), caught.value.text(lang)


def test_nothing_of_several_files_lasts_where_one_is_wrong(tmp_path: Path) -> None:
    good, bad, path = tmp_path / "MACRO.TXT", tmp_path / "B.TXT", tmp_path / "shop.db"
    good.write_text("%\n#500=7\nM02\n%\n")
    bad.write_text("%\n#501=[7\nM02\n%\n")
    with FileStore(path, "fanuc-m", "mill3") as store, pytest.raises(ReadingError):
        Reading(store, "fanuc-m", "mill3").take([good, bad])
    with FileStore(path) as store:
        assert not any(store.table(VARIABLES, 1).values())
        Reading(store, "fanuc-m", "mill3").take([good])
        store.commit()
    with FileStore(path) as store:
        assert store.table(VARIABLES, 1)[500] == 7.0


def test_what_a_file_does_not_name_stays() -> None:
    memory = read("fanuc-m", {"A.TXT": "%\n#500=1\n#501=2\nM02\n%\n"})
    read("fanuc-m", {"B.TXT": "%\n#501=#0\nM02\n%\n"}, memory)
    kept = memory.table(VARIABLES, 1)
    assert (kept[500], kept[501]) == (1.0, None)


def test_definitions_come_before_the_data_that_need_them() -> None:
    archive = "%_N_MGUD_DEF\n;$PATH=/_N_DEF_DIR\nDEF NCK REAL WIDTH\nM17\n"
    memory = read("sinumerik-840d", {"A.INI": "%_N_A_INI\nWIDTH=4.5\nM17\n", "P.ARC": archive})
    assert memory.table("user variables")["WIDTH"] == [4.5]


def test_an_initial_ini_brings_all_else_to_standard_values() -> None:
    memory = read("sinumerik-840d", {"A.INI": "%_N_A_INI\n$TC_DP6[1,1]=5\n$P_UIFR[1,X,TR]=3\nM17\n"})
    read("sinumerik-840d", {"I.INI": "%_N_INITIAL_INI\n$TC_DP6[2,1]=6\nM17\n"}, memory)
    assert list(memory.table("tools", 1)) == [2]
    assert memory.table("work offsets", 1)["$P_UIFR"][1].component("X", "TR") == 0.0


def test_an_init_file_of_a_workpiece_is_a_program() -> None:
    archive = "%_N_A_INI\n;$PATH=/_N_WKS_DIR/_N_A_WPD\nR1=5\nM17\n"
    memory = read("sinumerik-840d", {"P.ARC": archive})
    assert list(memory.table(PROGRAMS)) == [("/_N_WKS_DIR/_N_A_WPD", "_n_a_ini")]
    assert memory.table(VARIABLES, 1) == {}


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ProgramFileError):
        Reading(InMemoryStore(), "fanuc-m", machine_of("fanuc-m")).take([tmp_path / "none.txt"])


@pytest.mark.parametrize(
    ("block", "told"),
    [("N05003 Q1 P01000001", "5003#6"), ("N05003 Q1 P00000001", ""), ("G10 L50\nN5003 Q6 R1\nG11", "5003#6")],
)
def test_a_bit_that_polycnc_does_not_know_is_told(block: str, told: str) -> None:
    reading = Reading(memory := InMemoryStore(), "fanuc-m", machine_of("fanuc-m"))
    reading.take_texts({Path("P.TXT"): f"%\n{block}\n%\n"})
    assert [told] * bool(told) == [note.rpartition(" ")[2] for note in reading.notes]
    kept = memory.table(PARAMETERS, 1)
    assert any(key.bit == 0 and value == 1 for key, value in kept.items()) is ("Q1" in block)
    assert not any(key.bit == 6 for key in kept)
