"""Kernels as machine code: how they are called, and when there are none."""

from __future__ import annotations

from array import array
from ctypes import Structure
from pathlib import Path
from typing import Annotated, NamedTuple

import pytest

from polycnc.kernels import native
from polycnc.kernels.layout import Bytes, Floats, Ints32, Kind, Places, arguments, place, record
from polycnc.kernels.library import Library
from polycnc.kernels.native import Lack
from tests.kernels import sums


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A shared object with the kernels of `sums`."""
    pytest.importorskip("numba")
    from build_kernels.compiler import object_code
    from build_kernels.linker import link, system_linker

    if system_linker() is None:
        pytest.skip("no linker")
    made = tmp_path_factory.mktemp("kernels") / native.FILE.name
    link([object_code(library(made))], made)
    return made


@pytest.fixture(autouse=True)
def wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody has chosen plain kernels."""
    monkeypatch.delenv(native.CHOICE, raising=False)
    native.load.cache_clear()


def library(file: Path) -> Library:
    return Library("sums", (sums,), (sums.add, sums.put, sums.go), file=file)


def given() -> tuple[sums.Columns, sums.Total]:
    return sums.Columns(array("d", [1.5, 2.25]), array("i", [3, 4])), sums.Total(1.0, 2)


def test_a_kernel_gives_the_same_compiled_and_plain(file: Path) -> None:
    compiled = library(file).compiled(sums.add)
    assert compiled is not None
    (columns, total), (others, other) = given(), given()
    assert compiled(columns, total, 0.5) == sums.add(others, other, 0.5) == 2
    assert columns == others
    assert bytes(total) == bytes(other) != bytes(given()[1])
    assert total.parts[1] == 4.0


def test_a_kernel_that_gives_nothing_can_be_called(file: Path) -> None:
    compiled = library(file).compiled(sums.put)
    values = array("d", [0.0, 0.0, 0.0])
    assert compiled is not None
    compiled(values, True)
    assert list(values) == [0.0, 7.0, 0.0]


@pytest.mark.parametrize("axes", [1, 2, 3, 4, 6])
def test_a_kernel_gives_the_same_for_the_usual_number_of_axes_and_any_other(file: Path, axes: int) -> None:
    compiled = library(file).compiled(sums.go)
    assert compiled is not None
    here, there, way = (
        array("d", range(axes)),
        array("d", range(axes)),
        array("d", [0.1 * i for i in range(8)]),
    )
    assert compiled(here, way, 7) == sums.go(there, way, 7) == axes
    assert here == there


def test_only_kernels_that_are_told_how_many_axes_there_are_have_code_for_the_usual_number() -> None:
    pytest.importorskip("llvmlite")
    from build_kernels.axes import counts_of_axes

    assert [counts_of_axes(kernel) for kernel in (sums.add, sums.put, sums.go)] == [[], [], [1]]


def test_nothing_but_kernels_and_their_digest_can_be_seen_from_outside(file: Path) -> None:
    """Two objects with the same helper of Numba would not link."""
    seen = file.read_bytes()
    assert b"digest_of_sums" in seen
    assert b"NumbaEnv" not in seen


def test_the_environment_chooses_plain_kernels(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(native.CHOICE, "python")
    native.load.cache_clear()
    assert library(file).compiled(sums.add) is None
    assert library(file).lack is Lack.CHOSEN


def test_an_installation_without_machine_code_has_plain_kernels(tmp_path: Path) -> None:
    assert library(tmp_path / "none.so").compiled(sums.add) is None
    assert library(tmp_path / "none.so").lack is Lack.MISSING


def test_a_file_that_cannot_be_loaded_is_none(tmp_path: Path) -> None:
    """Such as one of another platform."""
    damaged = tmp_path / "damaged.so"
    damaged.write_bytes(b"code")
    assert library(damaged).lack is Lack.MISSING


def test_machine_code_of_other_sources_is_not_run(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert library(file).lack is None
    monkeypatch.setattr(sums, "HALF", 0.25)
    assert library(file).lack is Lack.STALE
    assert library(file).compiled(sums.add) is None


def test_a_library_that_is_newer_than_the_machine_code_has_none(file: Path) -> None:
    assert Library("others", (sums,), (sums.add,), file=file).lack is Lack.STALE


def test_a_number_of_the_sources_changes_their_digest(monkeypatch: pytest.MonkeyPatch) -> None:
    digests = {library(native.FILE).digest}
    monkeypatch.setattr(sums, "HALF", 0.25)
    digests.add(library(native.FILE).digest)
    monkeypatch.setattr(sums.Room, "LAST", 2)
    assert len({*digests, library(native.FILE).digest}) == 3


def test_an_array_of_other_items_is_refused(file: Path) -> None:
    compiled = library(file).compiled(sums.put)
    assert compiled is not None
    with pytest.raises(TypeError, match="arrays of f, not of d"):
        compiled(array("f", [0.0, 0.0]), False)


def test_a_kernel_that_can_raise_is_not_compiled() -> None:
    pytest.importorskip("numba")
    from build_kernels.compiler import object_code

    with pytest.raises(TypeError, match="can raise"):
        object_code(Library("sums", (sums,), (sums.refuse,)))


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
