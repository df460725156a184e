"""The tests that a run with plain kernels leaves out are those under which no kernel is, and no others."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from build_kernels.shared_object import libraries

from polycnc.kernels import native
from polycnc.kernels.library import Library
from tests import both_ways
from tests.both_ways import ROOT, Touch, is_compiled

if TYPE_CHECKING:
    from collections.abc import Iterator

LIBRARIES = libraries()
#: Tests of every sort; what stands behind each says whether it is to be repeated.
TESTS = """
import subprocess, sys
from functools import cache
import pytest
import polycnc
from polycnc.motion.compiled import run_kernel

def test_nothing(): pass
def test_a_run_without_times(): assert polycnc.run("G0 X1\\nM30\\n", control="fanuc-m").ok
def test_a_run_with_times(): assert polycnc.run("G0 X1\\nM30\\n", control="fanuc-m").time > 0.0  # again
def test_a_library(): run_kernel()  # again
def test_a_process(): subprocess.run([sys.executable, "-c", ""], check=True)  # again

@pytest.fixture(scope="module")
def shared(): return run_kernel()
def test_the_first_of_a_shared_fixture(shared): pass  # again
def test_the_second_of_a_shared_fixture(shared): pass  # again
"""
OF_A_MODULE = "from polycnc.motion.compiled import run_kernel\nrun_kernel()\ndef test_nothing(): pass\n"
OF_A_HELPER = """
from functools import cache
from polycnc.motion.compiled import run_kernel

@cache
def kept(): return run_kernel()
def test_the_first(): kept()
def test_the_second(): kept()
def test_another(): pass
"""
needs_machine_code = pytest.mark.skipif(
    any(library.lack is not None for library in LIBRARIES), reason="needs compiled kernels"
)


@pytest.fixture
def touch() -> Iterator[Touch]:
    """What notes a touch; it looks already."""
    watching = Touch()
    watching.watch()
    watching.noted = False
    yield watching
    watching.end()


@needs_machine_code
@pytest.mark.parametrize("library", LIBRARIES, ids=lambda library: library.name)
def test_no_kernel_is_called_unseen(library: Library, touch: Touch, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(library, "_callers", {})
    for name in library.names:
        kernel = library.kernel(name)
        assert touch.noted
        touch.noted = False
        with suppress(ValueError):  # arguments are lacking
            kernel()
        assert touch.noted, name
        touch.noted = False


@pytest.mark.parametrize("asked", ["lack", "plain", "choice", "process"])
def test_no_question_that_both_ways_answer_otherwise_is_asked_unseen(
    asked: str, touch: Touch, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(vars(LIBRARIES[0]), "lack", raising=False)  # this module has asked already
    match asked:
        case "lack":
            assert LIBRARIES[0].lack is None or not is_compiled()
        case "plain":
            LIBRARIES[0].plain(LIBRARIES[0].names[0])
        case "choice":
            native.is_wanted()
        case _:
            subprocess.run([sys.executable, "-c", ""], check=True)
    assert touch.noted


def test_what_asks_for_nothing_is_not_noted(touch: Touch) -> None:
    assert LIBRARIES[0].names
    assert not touch.noted


def runs(folder: Path, *words: str) -> str:
    """What pytest says of the tests of a folder."""
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "tests.both_ways", "--rootdir", folder, "-v", *words, folder],
        cwd=ROOT, capture_output=True, text=True, check=True, timeout=120,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )  # fmt: skip
    return done.stdout


@needs_machine_code
@pytest.mark.parametrize("workers", ["0", "1"])
def test_a_run_finds_what_another_leaves_out(tmp_path: Path, workers: str) -> None:
    (tmp_path / "tests").mkdir()  # helpers of tests are known by the name of their package
    for name, text in {"all": TESTS, "module": OF_A_MODULE, "helper": OF_A_HELPER}.items():
        (tmp_path / "tests" / f"test_{name}.py").write_text(text, encoding="utf-8")
    file = tmp_path / "found" / "alike.json"
    runs(tmp_path, "-n", workers, "--import-mode=importlib", "--write-alike", str(file))
    alike = {
        "tests/test_all.py::test_nothing", "tests/test_all.py::test_a_run_without_times",
        "tests/test_helper.py::test_another",
    }  # fmt: skip
    assert set(json.loads(file.read_text(encoding="utf-8"))["alike"]) == alike
    told = runs(tmp_path, "-n", workers, "--import-mode=importlib", "--leave-out", str(file))
    assert not [test for test in alike if test in told]
    assert "8 passed" in told


def test_what_is_of_other_sources_leaves_nothing_out(tmp_path: Path) -> None:
    (tmp_path / "test_one.py").write_text("def test_nothing(): pass\n", encoding="utf-8")
    file = tmp_path / "alike.json"
    file.write_text(
        json.dumps({"digest": "of another state", "alike": ["test_one.py::test_nothing"]}), encoding="utf-8"
    )
    assert "1 passed" in runs(tmp_path, "--leave-out", str(file))
    assert "1 passed" in runs(tmp_path, "--leave-out", str(tmp_path / "none.json"))


def test_plain_kernels_find_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "test_one.py").write_text("def test_nothing(): pass\n", encoding="utf-8")
    monkeypatch.setenv(native.CHOICE, "python")
    assert "1 passed" in runs(tmp_path, "--write-alike", str(tmp_path / "alike.json"))
    assert not (tmp_path / "alike.json").exists()


def test_a_change_of_any_file_changes_the_digest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(both_ways, "ROOT", tmp_path)
    before = both_ways.digest()
    (tmp_path / "a.py").write_text("1", encoding="utf-8")
    changed = both_ways.digest()
    (tmp_path / "__pycache__").mkdir()
    (tmp_path / "__pycache__" / "a.pyc").write_text("2", encoding="utf-8")
    (tmp_path / ".hidden").write_text("2", encoding="utf-8")
    assert before != changed == both_ways.digest()
