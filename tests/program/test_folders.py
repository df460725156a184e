from __future__ import annotations

import os
from pathlib import Path

import pytest

from polycnc.program import ProgramFileError
from polycnc.program.folders import Folder, number_of_file, read_file, stored_name_of_file


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nothing.nc", "program.missing"),
        ("", "program.directory"),
        ("file/x.nc", "program.missing"),
        ("a\0b", "program.unreadable"),
    ],
)
def test_what_is_no_file_is_an_error_value(tmp_path: Path, name: str, message: str) -> None:
    (tmp_path / "file").write_bytes(b"")
    path = os.path.join(tmp_path, name)  # noqa: PTH118 - Path refuses what is tested here
    with pytest.raises(ProgramFileError) as error:
        read_file(path)
    assert (error.value.message, error.value.path) == (message, path)
    assert path in error.value.text("en")
    assert path in error.value.text("zh-TW")


def test_a_device_is_no_program() -> None:
    with pytest.raises(ProgramFileError) as error:
        read_file("/dev/zero")
    assert error.value.message == "program.not-a-file"


def test_a_file_that_may_not_be_read_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "secret.nc"
    path.write_bytes(b"M30")
    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(ProgramFileError) as error:
        read_file(str(path))
    assert error.value.message == "program.unreadable"
    assert error.value.args_by_name == {"path": str(path), "reason": "no permission"}


def test_a_file_above_the_limit_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("polycnc.program.folders.MAX_FILE_BYTES", 10)
    (tmp_path / "a").write_bytes(b"x" * 10)
    (tmp_path / "b").write_bytes(b"x" * 11)
    assert read_file(str(tmp_path / "a")) == b"x" * 10
    with pytest.raises(ProgramFileError) as error:
        read_file(str(tmp_path / "b"))
    assert error.value.message == "program.too-large"


@pytest.mark.parametrize(
    ("name", "number"),
    [
        ("O0010", 10),
        ("o10.NC", 10),
        ("0010.nc", 10),
        ("O0010.xyz", None),
        ("O10A.nc", None),
        ("PART.NC", None),
    ],
)
def test_a_file_name_is_a_program_number(name: str, number: int | None) -> None:
    assert number_of_file(name) == number


def test_the_most_exact_file_of_a_number_is_taken(tmp_path: Path) -> None:
    names = ["O0010", "O0010.nc", "O0010.txt", "o10.nc", "0010.nc", "10"]
    for name in names:
        (tmp_path / name).touch()
    for name in names:
        found = Folder(tmp_path).numbered(10, 4)
        assert found is not None
        assert found == str(tmp_path / name)
        Path(found).unlink()


@pytest.mark.parametrize(
    ("name", "stored"),
    [
        ("SUB1.SPF", "_N_SUB1_SPF"),
        ("part.nc", "_N_PART_MPF"),
        ("part", "_N_PART_MPF"),
        ("mgud.def", "_N_MGUD_DEF"),
        ("_N_SUB1_SPF", "_N_SUB1_SPF"),
    ],
)
def test_files_of_a_pc_have_a_name_on_the_control(name: str, stored: str) -> None:
    assert stored_name_of_file(name) == stored


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows")
def test_pipes_and_links_that_lead_nowhere_beside_a_program_are_passed_over(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "O0007.nc")
    (tmp_path / "loop.nc").symlink_to(tmp_path / "loop.nc")
    (tmp_path / "other.nc").write_text("O0008\nM99\n", encoding="utf-8")
    folder = Folder(tmp_path)
    assert folder.numbered(7, 4) is None
    assert folder.named("loop", (".nc",)) is None
    assert folder.headed(8) == [str(tmp_path / "other.nc")]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows")
def test_a_program_is_not_read_from_a_pipe_or_a_device(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.nc")
    for path in (str(tmp_path / "pipe.nc"), "/dev/zero"):
        with pytest.raises(ProgramFileError, match="is a device or a pipe, not a program"):
            read_file(path)
    with pytest.raises(ProgramFileError, match="director"):
        read_file(str(tmp_path))
