"""Code for processors with wide vectors: which one runs, and that both do the same."""

from __future__ import annotations

import ctypes
import platform
import re
from array import array
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from polycnc.kernels import native
from polycnc.motion.third_order.laws.compiled import LIBRARY
from polycnc.motion.third_order.laws.courses import Axes
from polycnc.motion.third_order.laws.quickest import course_of, quickest
from tests.kernels import sums
from tests.kernels.test_library import library

if TYPE_CHECKING:
    from ctypes import c_int32

pytest.importorskip("numba")
from build_kernels import compiler, vectors

#: What Linux says of the processor.
CPUS = Path("/proc/cpuinfo")
#: Kinds of processors of which some have wide vectors.
pytestmark = pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="other processors")


def has_wide_vectors() -> bool:
    """Whether Linux says so of this processor."""
    return CPUS.exists() and " avx2 " in CPUS.read_text(encoding="ascii")


@pytest.fixture
def chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    """`sums` has loops that become vectors."""
    monkeypatch.setattr(vectors, "LIBRARIES", {"sums"})


def assembly(monkeypatch: pytest.MonkeyPatch) -> str:
    machine = compiler._machine()
    monkeypatch.setattr(machine, "emit_object", lambda module: machine.emit_assembly(module).encode())
    monkeypatch.setattr(compiler, "_machine", lambda: machine)
    return compiler.object_code(library(Path()), b"").decode()


def test_no_other_library_has_wide_vectors(monkeypatch: pytest.MonkeyPatch) -> None:
    code = assembly(monkeypatch)
    assert "ymm" not in code
    assert "cpuid" not in code


@pytest.mark.usefixtures("chosen")
def test_wide_vectors_fuse_no_product_with_a_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    code = assembly(monkeypatch)
    assert "cpuid" in code
    assert re.search(r"\tvmulpd\s.*ymm", code)
    assert re.search(r"\tvaddpd\s.*ymm", code)
    assert re.findall(r"\tvfn?m", code) == []


@pytest.mark.usefixtures("chosen")
def test_a_processor_is_asked_once_and_both_codes_give_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from build_kernels.linker import link, system_linker

    monkeypatch.delenv(native.CHOICE, raising=False)  # also where the suite runs with plain kernels
    native.load.cache_clear()
    if system_linker() is None:
        pytest.skip("no linker")
    made, code = tmp_path / Path(native.FILE).name, tmp_path / "sums.o"
    code.write_bytes(compiler.object_code(library(made), compiler.described(library(made))))
    link([code], made)
    go, processor = library(made).compiled("go"), noted(made, "sums")
    assert go is not None
    assert processor.value == 0
    went: list[tuple[array[float], int]] = []
    for known in (0, vectors.NARROW, vectors.WIDE):
        if known == vectors.WIDE and went[0][1] != vectors.WIDE:
            break  # it has none
        processor.value = known
        there = array("d", range(11))
        assert go(there, array("d", [0.1 * i for i in range(11)]), 7) == 11
        went.append((there, processor.value))
    plain = array("d", range(11))
    sums.go(plain, array("d", [0.1 * i for i in range(11)]), 7)
    assert [there for there, _ in went] == [plain] * len(went)
    if CPUS.exists():
        assert went[0][1] == (vectors.WIDE if has_wide_vectors() else vectors.NARROW)


@pytest.mark.skipif(LIBRARY.lack is not None, reason="no compiled kernels")
@pytest.mark.skipif(not has_wide_vectors(), reason="no wide vectors")
def test_laws_are_the_same_with_narrow_and_wide_vectors() -> None:
    processor, found = noted(Path(native.FILE), "jerk_laws"), []
    kept = processor.value
    for known in (vectors.NARROW, vectors.WIDE):
        processor.value = known
        law = quickest(
            course_of(
                array("d", [2.0 * k for k in range(41)]),
                array("d", [q for k in range(41) for q in (1.0 - 0.01 * (k % 2), 0.05 * (k % 2))]),
                array("d", [q for k in range(41) for q in (0.01 * (k % 3 - 1), 0.1 * (k % 2) - 0.05)]),
                array("d", [150.0**2] * 40),
                array("d", [1.0] * 40),
            ),
            Axes(array("d", (200.0, 200.0)), array("d", (2000.0, 2000.0)), array("d", (40000.0, 40000.0))),
            array("d", (0.0,) * 4),
        )
        assert law is not None
        found.append(law)
    processor.value = kept
    assert found[0] == found[1]


def noted(file: Path, name: str) -> c_int32:
    """What a library in a shared object knows of the processor."""
    return ctypes.c_int32.in_dll(ctypes.CDLL(str(file)), f"vectors_{name}")
