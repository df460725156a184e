"""Where compiled kernels are kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from polycnc.language.bulk import kernels, layout, native


def unwritable(_path: object, _mode: int) -> bool:
    return False


def test_the_folder_that_the_user_names_for_numba_comes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", "/some/where")
    assert native._folder() == Path("/some/where")


def test_an_installation_that_cannot_be_written_uses_the_cache_of_the_user(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(os, "access", unwritable)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert native._folder() == tmp_path / "polycnc"


def test_a_user_without_a_home_has_no_kernels(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError

    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(os, "access", unwritable)
    monkeypatch.setattr(Path, "home", homeless)
    assert native._folder() is None
    kernel = native.Native("none", (), lambda _functions: lambda: 0, "")
    assert kernel.function is None
    assert not kernel.ready


def test_a_kernel_with_another_constant_is_another_file(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("llvmlite")

    def file() -> Path | None:
        return native.Native("none", (kernels,), lambda _functions: lambda: 0, "")._file

    before = file()
    monkeypatch.setattr(kernels, "KEY_COUNT", layout.KEY_COUNT + 1)
    assert before is not None
    assert file() != before


def test_a_damaged_file_is_no_kernel(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("llvmlite")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    kernel = native.Native("none", (), lambda _functions: lambda: 0, "")
    file = kernel._file
    assert file is not None
    native._write(file, ("name", b"code"))
    assert kernel._stored() == ("name", b"code")
    file.write_bytes(file.read_bytes()[:-1])
    assert kernel._stored() is None
