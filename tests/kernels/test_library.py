"""Kernels as machine code: how they are called, and where they are kept."""

from __future__ import annotations

import os
from array import array
from ctypes import Structure
from pathlib import Path
from typing import Annotated, NamedTuple

import pytest

from polycnc.kernels import library, store
from polycnc.kernels.layout import Bytes, Floats, Ints32, Kind, Places, arguments, place, record
from polycnc.kernels.library import Library
from tests.kernels import sums


def unwritable(_path: object, _mode: int) -> bool:
    return False


@pytest.fixture
def numba(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Kernels can be compiled, and a folder of the test's own keeps them."""
    pytest.importorskip("numba")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.delenv(library.CHOICE, raising=False)


def made() -> Library:
    return Library("sums", (sums,), (sums.add, sums.put))


def given() -> tuple[sums.Columns, sums.Total]:
    return sums.Columns(array("d", [1.5, 2.25]), array("i", [3, 4])), sums.Total(1.0, 2)


def test_a_kernel_gives_the_same_compiled_and_plain(numba: None) -> None:
    compiled = made().compiled(sums.add)
    assert compiled is not None
    (columns, total), (others, other) = given(), given()
    assert compiled(columns, total, 0.5) == sums.add(others, other, 0.5) == 2
    assert columns == others
    assert bytes(total) == bytes(other) != bytes(given()[1])
    assert total.parts[1] == 4.0


def test_a_kernel_that_gives_nothing_can_be_called(numba: None) -> None:
    compiled = made().compiled(sums.put)
    values = array("d", [0.0, 0.0, 0.0])
    assert compiled is not None
    compiled(values, True)
    assert list(values) == [0.0, 7.0, 0.0]


def test_the_second_time_nothing_is_compiled(numba: None, monkeypatch: pytest.MonkeyPatch) -> None:
    first = made()
    assert not first.ready
    assert first.compiled(sums.add) is not None
    again = made()
    monkeypatch.setattr(again, "object_code", None)
    assert again.ready
    assert again.compiled(sums.add) is not None


def test_the_environment_chooses_plain_kernels(numba: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(library.CHOICE, "python")
    assert made().compiled(sums.add) is None
    assert not made().ready


def test_an_array_of_other_items_is_refused(numba: None) -> None:
    compiled = made().compiled(sums.put)
    assert compiled is not None
    with pytest.raises(AssertionError, match="f is not d"):
        compiled(array("f", [0.0, 0.0]), False)


def test_a_kernel_with_another_constant_is_another_file(numba: None, monkeypatch: pytest.MonkeyPatch) -> None:
    before = made()._file
    monkeypatch.setattr(sums, "HALF", 0.25)
    after = made()._file
    monkeypatch.setattr(sums.Room, "LAST", 2)
    assert len({before, after, made()._file, None}) == 4


def test_the_folder_that_the_user_names_for_numba_comes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", "/some/where")
    assert store.folder() == Path("/some/where")


def test_an_installation_that_cannot_be_written_uses_the_cache_of_the_user(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(os, "access", unwritable)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert store.folder() == tmp_path / "polycnc"


def test_a_user_without_a_home_has_no_kernels(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError

    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(os, "access", unwritable)
    monkeypatch.setattr(Path, "home", homeless)
    assert store.folder() is None
    assert made().compiled(sums.add) is None
    assert not made().ready


def test_a_damaged_file_is_no_kernel(tmp_path: Path) -> None:
    file = tmp_path / "sums.kernel"
    store.write(file, b"code")
    assert store.read(file) == b"code"
    file.write_bytes(file.read_bytes()[:-1])
    assert store.read(file) is None


def test_places_are_numbered_in_their_order() -> None:
    class Three(Places):
        FIRST = place()
        PAIR = place(2)
        LAST = place()

    assert (Three.FIRST, Three.PAIR, Three.LAST, Three.SIZE) == (0, 1, 3, 4)


def test_a_record_has_its_fields_by_name_and_in_order() -> None:
    @record
    class Point(Structure):
        x: float
        line: int
        rest: Annotated[Floats, 2]

    point = Point(1.0, 2)
    point.rest[1] = 3.0
    assert (
        bytes(point)
        == array("d", [1.0]).tobytes() + array("q", [2]).tobytes() + array("d", [0.0, 3.0]).tobytes()
    )


def test_a_kernel_says_with_its_annotations_what_it_takes() -> None:
    group, total, number = arguments(sums.add)
    assert (group.kind, group.type, [part.code for part in group.parts]) == (
        Kind.GROUP,
        sums.Columns,
        ["d", "i"],
    )
    assert (total.kind, total.type, number.kind) == (Kind.RECORD, sums.Total, Kind.NUMBER)


def test_what_machine_code_cannot_have_is_refused() -> None:
    def kernel(_name: str, _text: Bytes, _numbers: Ints32) -> int:
        return 0

    class Strange(NamedTuple):
        names: dict[str, int]

    def other(_strange: Strange) -> int:
        return 0

    other.__annotations__["_strange"] = Strange
    for refused in (kernel, other):
        with pytest.raises(TypeError, match="cannot take"):
            arguments(refused)
