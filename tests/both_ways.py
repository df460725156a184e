"""Which tests a run with plain kernels repeats: those under which it may differ from one with compiled kernels.

Both runs are the same code but for what a `Library` gives. A test that asks no library for anything, calls no kernel
and starts no process does the same in both, and to repeat it proves nothing. Nobody lists these tests: a run with
compiled kernels finds them (`--write-alike=FILE`), and one with plain kernels leaves them out (`--leave-out=FILE`) as
long as not a byte of the project has changed. What that file does not name is run.
"""

from __future__ import annotations

import json
import sys
from functools import _lru_cache_wrapper, cached_property
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from polycnc.kernels import call, native
from polycnc.kernels.library import Library

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

ROOT = Path(__file__).parents[1]
#: What is no part of the sources: machine code, which is made of them (and byte code, which has a folder).
MADE = {".so", ".dylib", ".dll"}
#: What Python says (`sys.addaudithook`) before it starts a process.
PROCESS = {"subprocess.Popen", "os.fork", "os.forkpty", "os.posix_spawn", "os.spawn", "os.exec", "os.system"}
#: Under this name a worker of xdist hands over what it found.
FOUND = "polycnc_alike"


class Asked:
    """A property that is found out each time it is asked for; who wants may set it on an object.

    Args:
        function: What finds it out.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function

    def __get__(self, library: Library | None, owner: type | None = None) -> Any:
        return self if library is None else self.function(library)


class Touch:
    """Notes that something has happened that differs between compiled and plain kernels, or may.

    Attributes:
        noted: It has, since somebody took this back.
    """

    def __init__(self) -> None:
        self.noted = False
        self._patched = pytest.MonkeyPatch()

    def watch(self) -> None:
        """Look at libraries, their kernels and processes from now on; nobody may have asked for a kernel before."""
        caller, lack = call.caller, vars(Library)["lack"]
        lacks = lack.func if isinstance(lack, cached_property) else lack.function
        self._patched.setattr(call, "caller", lambda *given: self._noting(caller(*given)))
        self._patched.setattr(Library, "compiled", self._noting(Library.compiled))
        self._patched.setattr(Library, "plain", self._noting(Library.plain))
        self._patched.setattr(Library, "lack", Asked(self._noting(lacks)))
        self._patched.setattr(native, "is_wanted", self._noting(native.is_wanted))
        sys.addaudithook(self._hear)

    def end(self) -> None:
        """Look no more."""
        self._patched.undo()

    def _noting(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def noting(*given: Any) -> Any:
            self.noted = True
            return function(*given)

        return noting

    def _hear(self, event: str, _: object) -> None:
        if event in PROCESS:
            self.noted = True


class Finder:
    """A plugin that finds the tests that do the same both ways, and writes their ids.

    What tests share may hold numbers of kernels, so a test counts as one that differs where its module touches kernels
    when it is imported, or a fixture that it shares with others; and what helpers keep (`functools.cache`) is thrown
    away behind a test that touches them.

    Args:
        file: For the ids.
    """

    def __init__(self, file: Path) -> None:
        self._file, self._touch = file, Touch()
        self._alike: list[str] = []
        self._modules: set[Path] = set()
        self._fixtures: set[str] = set()
        self._kept: list[_lru_cache_wrapper[Any]] = []
        self._of_modules = 0
        file.unlink(missing_ok=True)
        self._touch.watch()

    @pytest.hookimpl(wrapper=True)
    def pytest_make_collect_report(
        self, collector: pytest.Collector
    ) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
        self._touch.noted = False
        report = yield
        if self._touch.noted and isinstance(collector, pytest.Module):
            self._modules.add(collector.path)
        return report

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[Any]) -> Generator[None, object, object]:
        before, self._touch.noted = self._touch.noted, False
        try:
            return (yield)
        finally:
            if self._touch.noted and fixturedef.scope != "function":
                self._fixtures.add(fixturedef.argname)
            self._touch.noted |= before

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Function) -> Generator[None, object, object]:
        self._touch.noted = False
        done = yield
        if self._touch.noted:
            self._forget()
        elif item.path not in self._modules and self._fixtures.isdisjoint(item.fixturenames):
            self._alike.append(item.nodeid)
        return done

    def _forget(self) -> None:
        """Empty what helpers of tests keep."""
        if self._of_modules != len(sys.modules):
            self._of_modules = len(sys.modules)
            ours = [vars(module) for name, module in sys.modules.items() if name.partition(".")[0] == "tests"]
            self._kept = [
                each for names in ours for each in names.values() if isinstance(each, _lru_cache_wrapper)
            ]
        for kept in self._kept:
            kept.cache_clear()

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """A worker of xdist ends."""
        self._alike += getattr(node, "workeroutput", {}).get(FOUND, ())

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        self._touch.end()
        if is_worker(session.config):
            session.config.workeroutput[FOUND] = self._alike  # type: ignore[attr-defined]
        elif is_compiled():
            self._file.parent.mkdir(parents=True, exist_ok=True)
            found = {"digest": digest(), "alike": sorted(self._alike)}
            self._file.write_text(json.dumps(found, indent=1), encoding="utf-8")


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("kernels")
    group.addoption(
        "--write-alike", metavar="FILE", help="find the tests that do the same with plain kernels"
    )
    group.addoption(
        "--leave-out", metavar="FILE", help="leave out tests that do the same with compiled kernels"
    )


def pytest_configure(config: pytest.Config) -> None:
    if written := config.getoption("--write-alike"):
        config.pluginmanager.register(Finder(Path(written)))
    if not is_worker(config) and (left_out := config.getoption("--leave-out")):
        config.option.leave_out = left_out if is_current(Path(left_out)) else None  # workers are told so too


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if left_out := config.getoption("--leave-out"):
        alike = set(json.loads(Path(left_out).read_text(encoding="utf-8"))["alike"])
        config.hook.pytest_deselected(items=[item for item in items if item.nodeid in alike])
        items[:] = [item for item in items if item.nodeid not in alike]


def is_worker(config: pytest.Config) -> bool:
    """Whether this process runs tests for another one."""
    return hasattr(config, "workerinput")


def is_current(file: Path) -> bool:
    """Whether what a run wrote is of these sources and tests."""
    return file.exists() and json.loads(file.read_text(encoding="utf-8"))["digest"] == digest()


def is_compiled() -> bool:
    """Whether every library has its machine code; plain kernels call each other without a word."""
    from build_kernels.shared_object import libraries

    return all(library.lack is None for library in libraries())


def digest() -> str:
    """Of every file that tests may look at."""
    found = sha256(sys.version.encode())
    tops = [top for top in ROOT.iterdir() if not top.name.startswith(".")]
    for path in sorted(path for top in tops for path in (top, *top.rglob("*"))):
        if path.suffix not in MADE and path.parent.name != "__pycache__" and path.is_file():
            content = path.read_bytes()
            found.update(f"{path.relative_to(ROOT).as_posix()}\n{len(content)}\n".encode() + content)
    return found.hexdigest()
