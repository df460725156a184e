"""Kernels as machine code: how they are called, when there are none, and what machine code says of itself."""

from __future__ import annotations

import re
import subprocess
import sys
from array import array
from ctypes import Structure
from functools import partial
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import pytest

from polycnc.kernels import call, native
from polycnc.kernels.layout import Floats, Places, place, record
from polycnc.kernels.library import Library
from polycnc.kernels.native import Lack
from tests.kernels import sums

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).resolve().parents[2]
KERNELS = "add", "put", "go", "count"
#: What the machine code of `sums` is made of.
SOURCES = (
    "src/polycnc/kernels/c_types.py", "src/polycnc/kernels/layout.py", "tests/kernels/halves.py",
    "tests/kernels/sums.py",
)  # fmt: skip


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A shared object with the kernels of `sums`."""
    pytest.importorskip("numba")
    from build_kernels.compiler import described, object_code
    from build_kernels.linker import link, system_linker

    if system_linker() is None:
        pytest.skip("no linker")
    folder = tmp_path_factory.mktemp("kernels")
    made, code = folder / Path(native.FILE).name, folder / "sums.o"
    code.write_bytes(object_code(library(made), described(library(made))))
    link([code], made)
    return made


@pytest.mark.parametrize(
    "triple", ["x86_64-unknown-linux-gnu", "aarch64-unknown-linux-gnu", "arm64-apple-darwin"]
)
def test_no_processor_fuses_a_product_with_a_sum(triple: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It would round once where Python rounds twice."""
    pytest.importorskip("numba")
    from build_kernels import compiler
    from llvmlite import binding

    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    machine = binding.Target.from_triple(triple).create_target_machine(cpu="", opt=3)
    monkeypatch.setattr(machine, "emit_object", lambda module: machine.emit_assembly(module).encode())
    monkeypatch.setattr(compiler, "_machine", lambda: machine)
    code = compiler.object_code(library(Path()), b"").decode()
    assert len(re.findall(r"\t(fmul|mulsd|mulpd)", code)) > 0
    assert len(re.findall(r"\t(fadd|addsd|addpd)", code)) > 0
    assert re.findall(r"\t(fn?m(?:add|sub|la|ls)|vfn?m)", code) == []


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """A tree with the same sources."""
    for name in SOURCES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    return tmp_path


@pytest.fixture(autouse=True)
def wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody has chosen plain kernels."""
    monkeypatch.delenv(native.CHOICE, raising=False)
    native.load.cache_clear()


def library(file: Path, root: Path = ROOT) -> Library:
    kernels = tuple(f"tests.kernels.sums.{name}" for name in KERNELS)
    return Library("sums", ("tests.kernels.sums",), kernels, file=str(file), root=str(root))


def given() -> tuple[sums.Columns, sums.Total]:
    return sums.Columns(array("d", [1.5, 2.25]), array("i", [3, 4])), sums.Total(1.0, 2)


def test_a_kernel_gives_the_same_compiled_and_plain(file: Path) -> None:
    compiled = library(file).compiled("add")
    assert compiled is not None
    (columns, total), (others, other) = given(), given()
    assert compiled(columns, total, 0.5) == sums.add(others, other, 0.5) == 2
    assert columns == others
    assert bytes(total) == bytes(other) != bytes(given()[1])
    assert total.parts[1] == 4.0


def test_bytes_that_are_only_read_are_handed_over_as_they_are(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text, found = b"G1 X1.1\nM1\n", array("d", [0.0])
    assert sums.count(text, ord("1"), found) == 4
    for few in (1, 0):  # handed one by one, and by a call written out
        monkeypatch.setattr(call, "_FEW", few)
        compiled, place = library(file).compiled("count"), array("d", [0.0])
        assert compiled is not None
        assert compiled(text, ord("1"), place) == 4
        assert place == found
        with pytest.raises(TypeError, match="arrays of B, not of d"):
            compiled(text, ord("1"), array("B", [0]))


def test_a_kernel_that_gives_nothing_can_be_called(file: Path) -> None:
    compiled = library(file).compiled("put")
    values = array("d", [0.0, 0.0, 0.0])
    assert compiled is not None
    compiled(values, True)
    assert list(values) == [0.0, 7.0, 0.0]


@pytest.mark.parametrize("axes", [1, 2, 3, 4, 6])
def test_a_kernel_gives_the_same_for_the_usual_number_of_axes_and_any_other(file: Path, axes: int) -> None:
    compiled = library(file).compiled("go")
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


def test_all_calls_of_a_kernel_give_the_same(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first ones take their arguments apart, those behind them are written out."""
    monkeypatch.setattr(call, "_FEW", 1)
    compiled = library(file).compiled("add")
    assert compiled is not None
    (columns, total), (others, other) = given(), given()
    for _ in range(3):
        assert compiled(columns, total, 0.5) == sums.add(others, other, 0.5) == 2
        assert columns == others
        assert bytes(total) == bytes(other)


def test_arguments_of_groups_within_groups_are_found() -> None:
    assert call._names("d(B(dq)*)#") == ["a0", "a1[0]", "a1[1][0]", "a1[1][1]", "a1[2]", "a2"]


def test_nothing_but_kernels_and_what_they_are_can_be_seen_from_outside(file: Path) -> None:
    """Two objects with the same helper of Numba would not link."""
    seen = file.read_bytes()
    assert b"about_sums" in seen
    assert b"NumbaEnv" not in seen


def test_the_environment_chooses_plain_kernels(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(native.CHOICE, "python")
    native.load.cache_clear()
    assert library(file).compiled("add") is None
    assert library(file).lack is Lack.CHOSEN


def test_an_installation_without_machine_code_has_plain_kernels(tmp_path: Path) -> None:
    assert library(tmp_path / "none.so").compiled("add") is None
    assert library(tmp_path / "none.so").lack is Lack.MISSING


def test_a_file_that_cannot_be_loaded_is_none(tmp_path: Path) -> None:
    """Such as one of another platform."""
    damaged = tmp_path / "damaged.so"
    damaged.write_bytes(b"code")
    assert library(damaged).lack is Lack.MISSING


def zeros(code: bytes, begin: int, end: int) -> bytes:
    """With zeros from a byte to another."""
    begin, end, _ = slice(begin, end).indices(len(code))
    return code[:begin] + bytes(end - begin) + code[end:]


ALL = sys.maxsize
#: What is left of a file in the place of its bytes, by how it came about.
DAMAGED: dict[str, Callable[[bytes], bytes]] = {
    "nothing but zeros": lambda code: zeros(code, 0, ALL),
    **{f"cut at {n}": itemgetter(slice(n)) for n in (0, 1, 6, 63, 64, 4096, -4000, -64, -1)},
    **{
        f"zeros from {n}": partial(zeros, begin=n, end=ALL) for n in (6, 40, 64, 512, 4096, -6000, -1000, -64)
    },
    "a page of zeros": lambda code: zeros(code, 4096, 8192),
    "another processor": lambda code: code[:18] + b"\xf3\0" + code[20:],
    "32 bit": lambda code: code[:4] + b"\1" + code[5:],
    "another platform": lambda code: b"\xcf\xfa\xed\xfe" + code[4:],
}


@pytest.mark.skipif(sys.platform != "linux", reason="ELF")
@pytest.mark.parametrize("how", DAMAGED)
def test_a_damaged_file_is_none(file: Path, tmp_path: Path, how: str) -> None:
    """The disk was full, or a copy was interrupted: the loader of the system would end the process."""
    damaged = tmp_path / "damaged.so"
    damaged.write_bytes(DAMAGED[how](file.read_bytes()))
    code = f"from polycnc.kernels import native; print(native.load({str(damaged)!r}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "None\n")


def test_machine_code_as_it_was_made_is_whole(file: Path) -> None:
    """No linker leaves a page of it out; that of this tree neither."""
    for made in filter(Path.exists, (file, Path(native.FILE))):
        assert native.is_whole(str(made))


def test_machine_code_holds_its_sources(file: Path) -> None:
    """Those of modules that it takes numbers and records from, too."""
    described = library(file)._described
    assert described is not None
    assert [name for name, _ in described._sources] == list(SOURCES)
    assert described.signatures == {"add": "(di)*.", "put": "d#", "go": "dd#", "count": "$#d"}


def test_machine_code_of_the_same_sources_is_run(file: Path, copied: Path) -> None:
    assert library(file, copied).lack is None


@pytest.mark.parametrize("changed", SOURCES)
def test_machine_code_of_other_sources_is_not_run(file: Path, copied: Path, changed: str) -> None:
    """Not even where they are as long, and as old."""
    source = copied / changed
    source.write_bytes(source.read_bytes().replace(b".", b",", 1))
    assert library(file, copied).lack is Lack.STALE
    assert library(file, copied).compiled("add") is None


def test_a_longer_source_is_another_one(file: Path, copied: Path) -> None:
    with (copied / SOURCES[0]).open("ab") as source:
        source.write(b"# more\n")
    assert library(file, copied).lack is Lack.STALE


def test_machine_code_whose_sources_are_missing_is_not_run(file: Path, copied: Path) -> None:
    (copied / SOURCES[1]).unlink()
    assert library(file, copied).lack is Lack.STALE


def test_a_library_that_is_newer_than_the_machine_code_has_none(file: Path) -> None:
    kernels = ("tests.kernels.sums.add",)
    assert Library("others", ("tests.kernels.sums",), kernels, file=str(file)).lack is Lack.STALE
    assert (
        Library("sums", ("tests.kernels.sums",), kernels, file=str(file), root=str(ROOT)).lack is Lack.STALE
    )


def test_where_there_is_machine_code_the_sources_are_not_imported(file: Path, tmp_path: Path) -> None:
    described = library(file)
    kernels = tuple(f"no.such.{name}" for name in KERNELS)
    unknown = Library("sums", ("no.such",), kernels, file=str(file), root=str(ROOT))
    assert described.compiled("put") is not None
    assert unknown.compiled("put") is not None


@pytest.mark.parametrize("few", [0, 1])
def test_an_array_of_other_items_is_refused(file: Path, few: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(call, "_FEW", few)
    compiled = library(file).compiled("put")
    assert compiled is not None
    with pytest.raises(TypeError, match="arrays of f, not of d"):
        compiled(array("f", [0.0, 0.0]), False)


def test_as_many_arguments_are_taken_as_the_kernel_has(file: Path) -> None:
    compiled, values = library(file).compiled("put"), array("d", [0.0, 0.0])
    assert compiled is not None
    for given in ((values,), (values, False, 1.0), ((values, values), False)):
        with pytest.raises(ValueError, match="arguments, not 2"):
            compiled(*given)


def test_a_kernel_that_can_raise_is_not_compiled() -> None:
    pytest.importorskip("numba")
    from build_kernels.compiler import object_code

    raising = Library("sums", ("tests.kernels.sums",), ("tests.kernels.sums.refuse",))
    with pytest.raises(TypeError, match="can raise"):
        object_code(raising, b"")


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
