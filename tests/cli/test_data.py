"""`polycnc data`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import yaml

if TYPE_CHECKING:
    from tests.cli.console import Console
LATHE = ("--control", "fanuc-0i-tf")
SETUP = "machine: lathe2\ntools: {1: {x: 20, type: 500, wear: {z: 0.5}}}\nparameters: {'5024': 2}\n"


def test_offsets_of_a_setup_are_written_as_the_control_punches_them(console: Console) -> None:
    console.file("setup.yaml", SETUP)
    said = console("data", "export", "offsets", *LATHE, "--setup", "setup.yaml")
    assert said.out.splitlines()[1] == "G10 P01 X0.000 Z0.500 R0.000 Q0 ;"
    console("data", "export", "work", *LATHE, "--setup", "setup.yaml", "-o", "work.txt")
    assert (console.folder / "work.txt").read_text().startswith("%\nG10 L2 P0 X0.000 Z0.000 ;\n")


def test_a_file_is_read_into_a_setup_and_the_rest_of_it_stays(console: Console) -> None:
    console.file("setup.yaml", SETUP)
    console.file("offsets.txt", "%\nG10 P01 X1.5 ;\nG10 P10002 Z-3. ;\nG10 L2 P1 Z7. ;\n%\n")
    said = console("data", "import", "offsets.txt", *LATHE, "--setup", "setup.yaml")
    assert (said.status, "3 blocks" in said.out) == (0, True)
    setup = yaml.safe_load((console.folder / "setup.yaml").read_text())
    assert setup["tools"][1] | {"radius": 0.0} == {
        "x": 20.0, "type": 500, "tip": 0, "radius": 0.0, "wear": {"x": 1.5, "z": 0.5, "radius": 0.0},
    }  # fmt: skip
    assert setup["tools"][2]["z"] == -3.0
    assert setup["work_offsets"]["G54"]["Z"] == 7.0
    assert setup["parameters"] == {"5024": 2}


def test_a_damaged_file_is_refused_with_line_and_reason(console: Console) -> None:
    console.file("setup.yaml", SETUP)
    console.file("offsets.txt", "%\nG10 P01 X1.5 ;\nG10 P02 K3. ;\n%\n")
    said = console("data", "import", "offsets.txt", *LATHE, "--setup", "setup.yaml")
    assert said.status == 1
    assert "offsets.txt:3: data of this kind have no address K here" in said.err
    assert (console.folder / "setup.yaml").read_text() == SETUP


def test_a_setup_in_toml_is_not_written(console: Console) -> None:
    console.file("setup.toml", "machine = 'lathe2'\n")
    console.file("offsets.txt", "%\nG10 P01 X1.5 ;\n%\n")
    said = console("data", "import", "offsets.txt", *LATHE, "--setup", "setup.toml")
    assert (said.status, "YAML" in said.err) == (2, True)


def test_other_controls_and_kinds_are_answered_clearly(console: Console) -> None:
    assert "fanuc-m" in console("data", "export", "offsets", "--control", "fanuc-m").err
    assert "second-geometry" in console("data", "export", "tools", *LATHE).err


def test_programs_go_onto_a_tape_and_come_back(console: Console) -> None:
    console.file("a.nc", "%\nO0001 (FIRST)\nM30\n%\n")
    console.file("part.nc", "G0 X1.\nM30\n")
    said = console("data", "export", "programs", "a.nc", "part.nc", "-o", "ALL-PROG.TXT")
    assert said.status == 0
    assert (console.folder / "ALL-PROG.TXT").read_text() == "%\nO0001 (FIRST)\nM30\n<PART>\nG0 X1.\nM30\n%\n"
    said = console("data", "import", "ALL-PROG.TXT", "--folder", "out")
    assert said.status == 0
    assert (console.folder / "out" / "O0001.nc").read_text() == "%\nO0001 (FIRST)\nM30\n%\n"
    assert (console.folder / "out" / "PART.nc").read_text() == "%\n<PART>\nG0 X1.\nM30\n%\n"
    assert console("data", "import", "ALL-PROG.TXT", "--folder", "out").status == 1
    assert console("data", "import", "ALL-PROG.TXT", "--folder", "out", "--overwrite").status == 0


def test_a_tape_that_is_cut_off_gives_no_program_at_all(console: Console) -> None:
    for tape, line in (("%\nO0001\nM30\n", 3), ("O0001\nM30\n%\n", 1), ("%\nM30\nO2\nM30\n%\n", 2)):
        console.file("tape.txt", tape)
        said = console("data", "import", "tape.txt", "--folder", "out")
        assert (said.status, f"tape.txt:{line}:" in said.err) == (1, True)
        assert not (console.folder / "out").exists()


def test_a_program_that_comes_twice_is_refused(console: Console) -> None:
    console.file("tape.txt", "%\nO1\nM30\nO0001\nM30\n%\n")
    assert "tape.txt:4:" in console("data", "import", "tape.txt", "--folder", "out").err


def test_data_belong_to_a_control_that_has_to_be_named(console: Console) -> None:
    for words in (("data", "export", "offsets"), ("parameters", "list")):
        said = console(*words)
        assert said.status == 2
        assert said.err.startswith("polycnc: name a control with --control (")


def test_a_device_is_no_data_file(console: Console) -> None:
    said = console("data", "import", "/dev/zero", "--control", "fanuc-0i-tf")
    assert said.status == 2
    assert "is a device" in said.err
