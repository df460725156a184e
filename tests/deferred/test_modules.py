from __future__ import annotations

import sys

import pytest

from polycnc.deferred import modules


def test_a_module_is_imported_by_its_full_name() -> None:
    assert modules.import_module("polycnc.geometry.vectors") is sys.modules["polycnc.geometry.vectors"]
    with pytest.raises(ModuleNotFoundError):
        modules.import_module("polycnc.none")


def test_a_library_is_there_or_not(monkeypatch: pytest.MonkeyPatch) -> None:
    assert modules.is_installed("re")
    assert not modules.is_installed("no_such_library")
    monkeypatch.setitem(sys.modules, "numpy", None)
    assert not modules.is_installed("numpy")
