from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

import polycnc
from polycnc.program import Form, Program, ProgramFileError, ProgramStore

if TYPE_CHECKING:
    from pathlib import Path

MAIN = "/_N_WKS_DIR/_N_TEST_WPD/_N_MAIN_MPF"
WPD = "/_N_WKS_DIR/_N_TEST_WPD"


def text_of(program: Program | None) -> str | None:
    return None if program is None else "\n".join(program.lines)


def write(folder: Path, **files: str) -> None:
    """`write(tmp, O0010_nc="M99")`: a double underscore is a folder, a single one the dot."""
    for key, text in files.items():
        path = folder.joinpath(*(part.replace("_", ".") for part in key.split("__")))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


# --- numbers and names -----------------------------------------------------------------------------------


def test_a_number_is_found_in_the_file_then_beside_it_then_in_search_folders(tmp_path: Path) -> None:
    write(
        tmp_path, main__part_nc="O1\nM30\nO10\n(SAME FILE)", main__O0010_nc="(BESIDE)", lib__O0010="(SEARCH)"
    )
    write(tmp_path, main__O0020_nc="(BESIDE)", lib__O0020="(SEARCH)", lib__O0030_tap="(SEARCH)")
    store = ProgramStore(search=[tmp_path / "lib"])
    assert store.add_file(tmp_path / "main" / "part.nc") is store.main
    assert text_of(store.find_number(10)) == "O10\n(SAME FILE)"
    assert text_of(store.find_number(20)) == "(BESIDE)"
    found = store.find_number(30)
    assert found is not None
    assert (found.name, found.number, found.path) == ("O0030", 30, str(tmp_path / "lib" / "O0030.tap"))
    assert store.find_number(30) is found
    assert store.find_number(40) is None


def test_a_program_is_found_by_the_number_inside_a_file_of_another_name(tmp_path: Path) -> None:
    write(tmp_path, main_nc="O1\nM30", subs_nc="%\nO8001\nM99\nO8002\n(TWO)\nM99\n%", notes_doc="O8003")
    store = ProgramStore()
    store.add_file(tmp_path / "main.nc")
    assert text_of(store.find_number(8002)) == "O8002\n(TWO)\nM99"
    assert store.find_number(8003) is None


def test_two_files_with_the_same_number_inside_are_not_guessed_between(tmp_path: Path) -> None:
    write(tmp_path, main_nc="O1\nM30", old_nc="O8001\nM99", new_nc="O8001\nM99")
    store = ProgramStore()
    store.add_file(tmp_path / "main.nc")
    with pytest.raises(ProgramFileError) as error:
        store.find_number(8001)
    assert error.value.message == "program.number-twice"
    assert error.value.args_by_name["files"] == "new.nc, old.nc"


def test_names_are_found_without_regard_to_case_and_with_suffix(tmp_path: Path) -> None:
    write(tmp_path, main_nc="M30", G0200="(G200)", Probe_nc="<PROBE>\n(PROBE)")
    store = ProgramStore()
    store.add_file(tmp_path / "main.nc")
    store.add_text("T0000", "(TOOL)")
    assert text_of(store.find_name("t0000")) == "(TOOL)"
    assert text_of(store.find_name("g0200")) == "(G200)"
    assert store.find_name("PROBE") is None
    assert text_of(store.find_name("PROBE", [".nc"])) == "<PROBE>\n(PROBE)"


def test_a_text_is_known_by_its_key_and_by_the_numbers_in_it() -> None:
    store = ProgramStore()
    store.add_text("MAIN.NC", "G0 X0\nM30")
    added = store.add_text("O9010", "%@MACRO\nM99;")
    assert (added.name, added.number, added.form) == ("O9010", 9010, Form.MACRO)
    store.add_text("SUBS", "O1\nM99\nO2\n(TWO)")
    assert store.find_number(9010) is added
    assert text_of(store.find_number(2)) == "O2\n(TWO)"
    assert store.main.name == "MAIN.NC"
    assert [program.name for program in store] == ["MAIN.NC", "O9010", "O0001", "O0002"]


def test_a_program_that_no_call_reaches_is_reported() -> None:
    store = ProgramStore()
    store.add_text("A", "O1\n(FIRST)\nM30\nO1\n(SECOND)\nM30")
    assert text_of(store.find_number(1)) == "O1\n(FIRST)\nM30"
    assert [text_of(program) for program in store.shadowed] == ["O1\n(SECOND)\nM30"]


def test_m198_reads_the_external_memory_and_reads_a_file_anew(tmp_path: Path) -> None:
    write(tmp_path, main_nc="M30", O0005="(OLD)")
    store = ProgramStore()
    store.add_file(tmp_path / "main.nc")
    store.add_text("external:O0007", "(EXTERNAL)")
    store.add_text("O0008", "(MEMORY)")
    assert text_of(store.find_external_number(7)) == "(EXTERNAL)"
    assert store.find_number(7) is None
    assert text_of(store.find_external_number(8)) == "(MEMORY)"
    assert text_of(store.find_external_number(5)) == "(OLD)"
    write(tmp_path, O0005="(NEW)")
    assert text_of(store.find_external_number(5)) == "(NEW)"


# --- SINUMERIK -------------------------------------------------------------------------------------------


def sinumerik() -> ProgramStore:
    store = ProgramStore(form=Form.SINUMERIK)
    store.add_text(MAIN, "N10 M30")
    return store


@pytest.mark.parametrize("name", ["SUB_PROG", "sub_prog", "_N_SUB_PROG", "SUB_PROG_SPF", "_N_SUB_PROG_SPF"])
def test_all_spellings_of_a_name_call_the_same_program(name: str) -> None:
    store = sinumerik()
    added = store.add_text("Sub_Prog.SPF", "M17")
    assert store.find_sinumerik(name, WPD) is added
    assert (added.name, added.directory) == ("_N_SUB_PROG_SPF", WPD)


def test_the_search_goes_through_the_directories_in_the_order_of_the_manual() -> None:
    places = [
        f"{WPD}/_N_X_SPF",
        f"{WPD}/_N_X_MPF",
        "/_N_SPF_DIR/_N_X_SPF",
        "/_N_WKS_DIR/_N_MYWPD_WPD/_N_X_SPF",
        "/_N_CUS_DIR/_N_X_SPF",
        "/_N_CMA_DIR/_N_X_SPF",
        "/_N_CST_DIR/_N_X_SPF",
    ]
    store = sinumerik()
    added = [store.add_text(place, f"; {place}") for place in reversed(places)][::-1]
    for program in added:
        assert store.find_sinumerik("X", WPD, ["/_N_WKS_DIR/_N_MYWPD_WPD"]) is program
        store.remove(program)
    assert store.find_sinumerik("X", WPD, ["/_N_WKS_DIR/_N_MYWPD_WPD"]) is None


def test_a_call_looks_beside_its_own_caller() -> None:
    store = sinumerik()
    store.add_text("X.SPF", "; beside main")
    there = store.add_text("/_N_WKS_DIR/_N_B_WPD/_N_X_SPF", "; beside the caller")
    assert store.find_sinumerik("X", "/_N_WKS_DIR/_N_B_WPD") is there


@pytest.mark.parametrize(
    "path",
    [
        "/_N_WKS_DIR/_N_WELLE_WPD/WELLE",
        "/_N_WKS_DIR/_N_WELLE_WPD/_N_WELLE_SPF",
        "/WKS.DIR/WELLE.WPD/WELLE.SPF",
    ],
)
def test_a_path_leads_to_one_directory_only(path: str) -> None:
    store = sinumerik()
    store.add_text("WELLE.SPF", "; beside")
    added = store.add_text("/_N_WKS_DIR/_N_WELLE_WPD/_N_WELLE_SPF", "M17")
    assert store.find_sinumerik(path, WPD) is added
    store.remove(added)
    assert store.find_sinumerik(path, WPD) is None


def test_bare_definition_files_lie_in_the_definitions_directory() -> None:
    store = sinumerik()
    added = store.add_text("_N_MGUD_DEF", "%_N_MGUD_DEF\n;$PATH=/_N_DEF_DIR\nDEF NCK REAL A\nM30")
    assert store.programs_in("/_N_DEF_DIR") == [added]
    assert (added.directory, added.first_line) == ("/_N_DEF_DIR", 2)


@pytest.mark.parametrize(
    ("key", "name", "setting"),
    [
        ("/_N_WKS_DIR/_N_WST1/_N_ROUGHING_SPF", "ROUGHING", "_N_WKS_DIR/_N_WST1"),
        ("/_N_WKS_DIR/X.SPF", "/_N_WKS_DIR/X_SPF", ""),
        ("X.SPF", "X", "_N_WKS_DIR/_N_WST1"),
        ("/_N_A_DIR/X.MPF", "A.DIR/X", ""),
        ("/R4711/WORK/X.SPF", "\\\\R4711\\Work\\X.spf", ""),
    ],
)
def test_external_programs_are_found_by_extcall_only(key: str, name: str, setting: str) -> None:
    store = sinumerik()
    added = store.add_text("external:" + key, "M17")
    assert store.find_external(name, setting) is added
    assert store.find_sinumerik(name, WPD) is None
    assert store.main.name == "_N_MAIN_MPF"


def test_an_absolute_external_path_is_not_searched_elsewhere() -> None:
    store = sinumerik()
    store.add_text("external:X.SPF", "M17")
    assert store.find_external("/_N_WKS_DIR/X_SPF") is None


def test_written_and_deleted_programs_are_seen_by_the_next_call() -> None:
    store = sinumerik()
    written = Program("_N_LOG_MPF", ["; one"], directory=WPD, form=Form.SINUMERIK)
    store.replace(written)
    assert store.find_sinumerik("LOG", WPD) is written
    store.remove(written)
    assert store.find_sinumerik("LOG", WPD) is None
    assert [program.name for program in store] == ["_N_MAIN_MPF"]


def test_the_host_tree_of_a_workpiece_is_the_tree_of_the_control(tmp_path: Path) -> None:
    write(
        tmp_path,
        WKS_DIR__TEST_WPD__MAIN_MPF="N10 M30",
        WKS_DIR__TEST_WPD__A_SPF="; A beside",
        WKS_DIR__OTHER_WPD__B_SPF="; B other",
        SPF_DIR__A_SPF="; A global",
        SPF_DIR__C_SPF="; C global",
        CUS_DIR__C_SPF="; C cycle",
        CUS_DIR__D_SPF="; D cycle",
        DEF_DIR__MGUD_DEF="DEF NCK REAL X",
    )
    store = ProgramStore(form=Form.SINUMERIK)
    main = store.add_file(tmp_path / "WKS.DIR" / "TEST.WPD" / "MAIN.MPF")
    assert (main.name, main.directory) == ("_N_MAIN_MPF", WPD)
    assert text_of(store.find_sinumerik("A", WPD)) == "; A beside"
    assert text_of(store.find_sinumerik("C", WPD)) == "; C global"
    assert text_of(store.find_sinumerik("D", WPD)) == "; D cycle"
    assert store.find_sinumerik("B", WPD) is None
    assert text_of(store.find_sinumerik("B", WPD, ["/_N_WKS_DIR/_N_OTHER_WPD"])) == "; B other"
    assert [program.name for program in store.programs_in("/_N_DEF_DIR")] == ["_N_MGUD_DEF"]
    assert store.has_directory("/_N_WKS_DIR/_N_OTHER_WPD")
    assert not store.has_directory("/_N_WKS_DIR/_N_NONE_WPD")


def test_a_plain_folder_and_search_folders_serve_sinumerik_too(tmp_path: Path) -> None:
    write(
        tmp_path, work__part_nc="N10 M30", work__A_SPF="; A", lib__B_SPF="; B", lib__CST_DIR__CYCLE1_SPF="; C"
    )
    store = ProgramStore(form=Form.SINUMERIK, search=[tmp_path / "lib"])
    main = store.add_file(tmp_path / "work" / "part.nc")
    assert (main.name, main.directory) == ("_N_PART_MPF", "/_N_MPF_DIR")
    for name, text in {"A": "; A", "B": "; B", "CYCLE1": "; C"}.items():
        assert text_of(store.find_sinumerik(name, main.directory)) == text
    write(tmp_path, work__A_SPF="; changed")
    assert text_of(store.find_sinumerik("A", main.directory)) == "; A"


def test_definition_files_may_lie_beside_the_main_program(tmp_path: Path) -> None:
    write(tmp_path, part_mpf="N10 M30", mgud_def="DEF NCK REAL X")
    store = ProgramStore(form=Form.SINUMERIK)
    store.add_file(tmp_path / "part.mpf")
    assert [(p.name, p.directory) for p in store.programs_in("/_N_DEF_DIR")] == [
        ("_N_MGUD_DEF", "/_N_DEF_DIR")
    ]


def test_a_file_beside_the_program_is_no_definition_file_for_its_suffix_alone(tmp_path: Path) -> None:
    write(tmp_path, part_mpf="N10 M30", parts_def="DEF NCK REAL X", DEF_DIR__own_def="DEF NCK REAL Y")
    write(tmp_path, lib__gud4_def="DEF NCK REAL A", lib__tools_def="DEF NCK REAL B")
    store = ProgramStore(form=Form.SINUMERIK, search=[tmp_path / "lib"])
    store.add_file(tmp_path / "part.mpf")
    assert [p.name for p in store.programs_in("/_N_DEF_DIR")] == ["_N_GUD4_DEF", "_N_OWN_DEF"]


def test_a_search_folder_may_be_the_definition_directory_itself(tmp_path: Path) -> None:
    write(tmp_path, nc__part_mpf="N10 M30", archive__DEF_DIR__own_def="DEF NCK REAL Y")
    store = ProgramStore(form=Form.SINUMERIK, search=[tmp_path / "archive" / "DEF.DIR"])
    store.add_file(tmp_path / "nc" / "part.mpf")
    assert [p.name for p in store.programs_in("/_N_DEF_DIR")] == ["_N_OWN_DEF"]


def test_a_deleted_host_file_stays_on_the_host_but_is_not_found(tmp_path: Path) -> None:
    write(tmp_path, part_mpf="N10 M30", A_SPF="; A")
    store = ProgramStore(form=Form.SINUMERIK)
    directory = store.add_file(tmp_path / "part.mpf").directory
    found = store.find_sinumerik("A", directory)
    assert found is not None
    store.remove(found)
    assert store.find_sinumerik("A", directory) is None
    assert (tmp_path / "A.SPF").exists()


def test_the_main_program_of_an_archive_starts(tmp_path: Path) -> None:
    write(tmp_path, job_arc="%_N_SUB_SPF\nM17\n%_N_MAIN_MPF\n;$PATH=/_N_WKS_DIR/_N_A_WPD\nSUB\nM30\n")
    store = ProgramStore()
    assert store.add_file(tmp_path / "job.arc").name == "_N_MAIN_MPF"
    assert text_of(store.find_sinumerik("SUB", store.main.directory)) == "M17"


# --- errors ----------------------------------------------------------------------------------------------


def test_a_search_folder_that_is_none_is_an_error_value(tmp_path: Path) -> None:
    with pytest.raises(ProgramFileError) as error:
        ProgramStore(search=[tmp_path / "nowhere"])
    assert error.value.message == "program.search-missing"


def test_an_unreadable_subprogram_is_an_error_value(tmp_path: Path) -> None:
    write(tmp_path, main_nc="M30")
    subprogram = tmp_path / "O0010"
    subprogram.write_text("M99")
    store = ProgramStore()
    store.add_file(tmp_path / "main.nc")
    assert store.find_number(11) is None, "the folder has been looked through"
    subprogram.unlink()
    subprogram.symlink_to(subprogram)
    with pytest.raises(ProgramFileError) as error:
        store.find_number(10)
    assert error.value.message == "program.unreadable"


@given(st.binary(max_size=300), st.sampled_from(Form))
def test_arbitrary_bytes_load_as_programs(
    tmp_path_factory: pytest.TempPathFactory, data: bytes, form: Form
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.nc"
    path.write_bytes(data)
    store = ProgramStore(form=form)
    assert store.add_file(path) is store.main
    assert store.main in list(store)


def test_the_folder_of_a_workpiece_stands_for_its_main_program(tmp_path: Path) -> None:
    write(tmp_path, SHAFT_WPD__SHAFT_MPF="SAME NAME", SHAFT_WPD__B_MPF="OTHER")
    write(
        tmp_path, ONLY_WPD__X_MPF="ONLY ONE", ONLY_WPD__ONLY_SPF="SUB", TWO_WPD__A_MPF="1", TWO_WPD__B_MPF="2"
    )
    for name, expected in (("SHAFT.WPD", "SAME NAME"), ("ONLY.WPD", "ONLY ONE")):
        store = ProgramStore(form=Form.SINUMERIK)
        assert text_of(store.add_file(tmp_path / name)) == expected
        assert text_of(store.main_of_workpiece(store.main.directory)) == expected
    with pytest.raises(ProgramFileError):
        ProgramStore(form=Form.SINUMERIK).add_file(tmp_path / "TWO.WPD")


def test_a_file_beside_the_workpiece_that_no_control_reads_does_not_matter(tmp_path: Path) -> None:
    (tmp_path / "part.arc").write_text(
        "%_N_PART_MPF\n;$PATH=/_N_WKS_DIR/_N_PART_WPD\nSUB\nM30\n%_N_SUB_SPF\n;$PATH=/_N_WKS_DIR/_N_PART_WPD\nM17\n"
    )
    (tmp_path / "report.xml").write_text("<x>" * 30_000)
    result = polycnc.run(tmp_path / "part.arc", control="sinumerik-840d")
    assert not result.alarms
