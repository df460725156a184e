"""`polycnc memory`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from polycnc.control.registry import ids

if TYPE_CHECKING:
    from tests.cli.console import Console

DATA = "%\n#500=12.5\nG10 G90 L10 P3 R7.5\nM02\n%\n"


def test_a_memory_is_made_filled_shown_and_written(console: Console) -> None:
    assert console("memory", "new", "shop.db", "--control", "fanuc-m").status == 0
    console.file("DATA.TXT", DATA)
    console.file("PROG.TXT", "%\nO0001\nM30\n%\n")
    said = console("memory", "import", "shop.db", "DATA.TXT", "PROG.TXT")
    assert (said.status, "2 files" in said.out) == (0, True)
    said = console("memory", "show", "shop.db")
    assert said.out.splitlines()[0] == "control fanuc-m, machine mill3"
    assert "variables of channel 1: 1" in said.out
    assert "programs: 1" in said.out
    said = console("memory", "export", "shop.db", "--folder", "out")
    assert said.status == 0
    assert "#500=12.5\n" in (console.folder / "out" / "MACRO.TXT").read_text()
    assert (console.folder / "out" / "ALL-PROG.TXT").read_text() == "%\nO0001\nM30\n%\n"
    assert console("memory", "export", "shop.db", "--folder", "out").status == 1
    assert console("memory", "export", "shop.db", "--folder", "out", "--overwrite").status == 0


@pytest.mark.parametrize("control", ids())
def test_the_files_of_every_control_go_into_a_new_memory(console: Console, control: str) -> None:
    console("memory", "new", "a.db", "--control", control)
    assert console("memory", "export", "a.db", "--folder", "out").status == 0
    console("memory", "new", "b.db", "--control", control)
    files = sorted(f"out/{path.name}" for path in (console.folder / "out").iterdir())
    assert console("memory", "import", "b.db", *files).status == 0


def test_a_setup_goes_in_and_out(console: Console) -> None:
    console.file(
        "setup.yaml", "work_offsets: {G54: {X: 5}}\nparameters: {'5003#0': 1}\nvariables: {'#500': 3}\n"
    )
    assert console("memory", "new", "a.db", "--control", "fanuc-m", "--setup", "setup.yaml").status == 0
    said = console("memory", "export", "a.db", "setup", "-o", "back.yaml")
    assert said.status == 0
    back = (console.folder / "back.yaml").read_text()
    assert "X: 5.0" in back
    assert "5003#0: 1" in back
    assert "'#500': 3.0" in back
    console("memory", "new", "b.db", "--control", "fanuc-m")
    assert console("memory", "import", "b.db", "back.yaml").status == 0


def test_a_run_goes_on_where_an_import_has_left_the_memory(console: Console) -> None:
    console("memory", "new", "a.db", "--control", "fanuc-m")
    console.file("DATA.TXT", DATA)
    console("memory", "import", "a.db", "DATA.TXT")
    console.file("part.nc", "#501=#500*2\nM30\n")
    assert console("run", "part.nc", "--control", "fanuc-m", "--memory", "a.db").status == 0
    assert "#501=25\n" in console("memory", "export", "a.db", "variables").out


def test_a_wrong_file_changes_nothing_and_names_its_place(console: Console) -> None:
    console("memory", "new", "a.db", "--control", "fanuc-m")
    console.file("DATA.TXT", DATA.replace("R7.5", "Q7.5"))
    said = console("memory", "import", "a.db", "DATA.TXT")
    assert said.status == 2
    assert "DATA.TXT:3:" in said.err
    assert "variables of channel 1: 0" not in console("memory", "show", "a.db").out
    assert "#500=#0\n" in console("memory", "export", "a.db", "variables").out


def test_nothing_is_overwritten(console: Console) -> None:
    console("memory", "new", "a.db", "--control", "fanuc-m")
    assert console("memory", "new", "a.db", "--control", "fanuc-m").status == 1
    assert console("memory", "export", "a.db", "offsets", "-o", "a.db").status == 2
    assert console("memory", "show", "a.db").status == 0


def test_a_memory_that_cannot_be_made_leaves_nothing(console: Console) -> None:
    console.file("setup.yaml", "variables: {'#99999': 3}\n")
    assert console("memory", "new", "a.db", "--control", "fanuc-m", "--setup", "setup.yaml").status == 2
    assert [path.name for path in console.folder.iterdir()] == ["setup.yaml"]
    assert console("memory", "new", "a.db").status == 2


def test_several_files_want_a_folder(console: Console) -> None:
    console("memory", "new", "a.db", "--control", "fanuc-m")
    said = console("memory", "export", "a.db")
    assert (said.status, "--folder" in said.err) == (2, True)
    assert console("memory", "export", "none.db").status == 2


CASE = """
- id: kept
  feature: x
  control: fanuc-m
  program: |
    #500=#500+1
    M30
  expect: {variables: {'#500': 13.5}}
- id: other
  feature: x
  control: meldas-m
  program: M30
  expect: {}
"""


def test_every_case_begins_with_the_memory_and_leaves_it_alone(console: Console) -> None:
    console("memory", "new", "a.db", "--control", "fanuc-m")
    console.file("DATA.TXT", DATA)
    console("memory", "import", "a.db", "DATA.TXT")
    console.file("case.yaml", CASE)
    for _ in range(2):
        assert console("test", "case.yaml", "-k", "kept", "--memory", "a.db").status == 0
    said = console("test", "case.yaml", "-k", "other", "--memory", "a.db")
    assert (said.status, "not of a meldas-m" in said.out) == (2, True)
    assert console("test", "case.yaml", "--memory", "none.db").status == 2
    assert "#500=12.5\n" in console("memory", "export", "a.db", "variables").out
