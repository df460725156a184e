"""The package's own modules are found and loaded as by the library, in fewer steps."""

from __future__ import annotations

import importlib.util
import os
import py_compile
import subprocess
import sys
import zipfile
from importlib.machinery import PathFinder
from pathlib import Path
from shutil import copy

import pytest

import polycnc
from polycnc import finder

SOURCE = Path(polycnc.__file__).parent
NAMES = sorted(
    ".".join(("polycnc", *path.relative_to(SOURCE).with_suffix("").parts)).removesuffix(".__init__")
    for path in SOURCE.rglob("*.py")
    if path.parent != SOURCE or path.stem != "__init__"
)


def folder_of(name: str) -> list[str]:
    """What a package's `__path__` is in which a module lies."""
    return [str(SOURCE.joinpath(*name.split(".")[1:-1]))]


def found(name: str, folder: Path | str) -> importlib.machinery.ModuleSpec:
    spec = finder.find_spec(name, [str(folder)])
    assert spec is not None
    return spec


def loaded(folder: Path) -> object:
    """What the module `polycnc.part` of a folder says of itself, loaded as an import does."""
    spec = found("polycnc.part", folder)
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.SAID


@pytest.fixture(autouse=True)
def _byte_code_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)


def test_every_module_is_described_as_the_library_does() -> None:
    for name in NAMES:
        own, other = found(name, folder_of(name)[0]), PathFinder.find_spec(name, folder_of(name))
        assert other is not None
        for said in ("name", "origin", "cached", "parent", "submodule_search_locations", "has_location"):
            assert getattr(own, said) == getattr(other, said), (name, said)


def test_a_module_gets_the_attributes_that_the_library_gives_it() -> None:
    for name in ("polycnc.messages", "polycnc.messages.alarm"):
        own, other = found(name, folder_of(name)[0]), PathFinder.find_spec(name, folder_of(name))
        assert other is not None
        made, usual = importlib.util.module_from_spec(own), importlib.util.module_from_spec(other)
        assert vars(made).keys() == vars(usual).keys()
        for said in vars(usual).keys() - {"__loader__", "__spec__"}:
            assert getattr(made, said) == getattr(usual, said), (name, said)
        assert made.__loader__ is own.loader
        assert made.__spec__ is own


@pytest.mark.parametrize(
    "name", ["polycnc", "polycnc_x", "polycnc_x.part", "os", "polycnc.none", "polycnc.Part", "polycnc.native"]
)
def test_other_names_are_left_to_the_library(tmp_path: Path, name: str) -> None:
    for file in ("part.py", "Part.py", "native.abi3.so", "native.pyd", "os.py", "polycnc.py"):
        (tmp_path / file).touch()
    (tmp_path / "none").mkdir()
    assert finder.find_spec(name, [str(tmp_path)]) is None


def test_a_package_goes_before_a_module_of_its_name(tmp_path: Path) -> None:
    (tmp_path / "part").mkdir()
    (tmp_path / "part.py").touch()
    assert found("polycnc.part", tmp_path).submodule_search_locations is None
    (tmp_path / "part" / "__init__.py").touch()
    assert found("polycnc.part", tmp_path).submodule_search_locations == [str(tmp_path / "part")]


def test_a_package_of_several_places_is_left_to_the_library(tmp_path: Path) -> None:
    (tmp_path / "part.py").touch()
    assert finder.find_spec("polycnc.part", [str(tmp_path), str(tmp_path)]) is None
    assert finder.find_spec("polycnc.part", []) is None
    assert finder.find_spec("polycnc.part") is None


def test_byte_code_is_used_while_it_holds_for_its_source(tmp_path: Path) -> None:
    source = tmp_path / "part.py"
    source.write_text("SAID = 1\n", encoding="utf-8")
    py_compile.compile(str(source), invalidation_mode=py_compile.PycInvalidationMode.TIMESTAMP)
    cached = Path(importlib.util.cache_from_source(str(source)))
    time = source.stat().st_mtime_ns
    source.write_text("SAID = 2\n", encoding="utf-8")
    os.utime(source, ns=(time, time))
    assert loaded(tmp_path) == 1  # of the same time and size
    before = cached.read_bytes()
    source.write_text("SAID = 22\n", encoding="utf-8")
    os.utime(source, ns=(time, time))
    assert loaded(tmp_path) == 22  # of another size
    assert cached.read_bytes() != before
    source.write_text("SAID = 23\n", encoding="utf-8")
    os.utime(source, ns=(time + 2 * 10**9, time + 2 * 10**9))
    assert loaded(tmp_path) == 23  # of another time
    cached.unlink()
    assert loaded(tmp_path) == 23
    assert cached.exists()


def test_byte_code_of_a_time_behind_four_bytes_holds(tmp_path: Path) -> None:
    source = tmp_path / "part.py"
    source.write_text("SAID = 1\n", encoding="utf-8")
    os.utime(source, (2**32 + 5, 2**32 + 5))
    assert loaded(tmp_path) == 1
    source.write_text("SAID = 2\n", encoding="utf-8")
    os.utime(source, (2**32 + 5, 2**32 + 5))
    assert loaded(tmp_path) == 1


@pytest.mark.parametrize("mode", list(py_compile.PycInvalidationMode))
def test_byte_code_told_by_a_hash_is_what_the_library_says(
    tmp_path: Path, mode: py_compile.PycInvalidationMode
) -> None:
    source = tmp_path / "part.py"
    source.write_text("SAID = 1\n", encoding="utf-8")
    py_compile.compile(str(source), invalidation_mode=mode)
    time = source.stat().st_mtime_ns
    source.write_text("SAID = 2\n", encoding="utf-8")
    os.utime(source, ns=(time, time))
    assert loaded(tmp_path) == (2 if mode is py_compile.PycInvalidationMode.CHECKED_HASH else 1)


@pytest.mark.parametrize("damage", ["short", "head", "magic", "empty"])
def test_damaged_byte_code_is_what_the_library_says(tmp_path: Path, damage: str) -> None:
    source = tmp_path / "part.py"
    source.write_text("SAID = 1\n", encoding="utf-8")
    py_compile.compile(str(source))
    cached = Path(importlib.util.cache_from_source(str(source)))
    data = cached.read_bytes()
    cached.write_bytes(
        {"short": data[:-5], "head": data[:12], "magic": b"\0" + data[1:], "empty": b""}[damage]
    )
    if damage == "short":
        with pytest.raises(EOFError):
            loaded(tmp_path)
    else:
        assert loaded(tmp_path) == 1


def test_byte_code_longer_than_what_is_read_at_first_is_used(tmp_path: Path) -> None:
    source = tmp_path / "part.py"
    source.write_text(f"SAID = 1\nLONG = {'x' * 100_000!r}\n", encoding="utf-8")
    py_compile.compile(str(source))
    assert loaded(tmp_path) == 1


def test_byte_code_of_another_folder_names_this_one(tmp_path: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    first.mkdir()
    (first / "part.py").write_text("SAID = (lambda: 1).__code__.co_filename\n", encoding="utf-8")
    assert loaded(first) == str(first / "part.py")
    first.rename(second)
    assert loaded(second) == str(second / "part.py")


def test_a_folder_in_the_place_of_byte_code_is_no_byte_code(tmp_path: Path) -> None:
    (tmp_path / "part.py").write_text("SAID = 1\n", encoding="utf-8")
    Path(importlib.util.cache_from_source(str(tmp_path / "part.py"))).mkdir(parents=True)
    assert loaded(tmp_path) == 1


def test_a_loader_refuses_the_code_of_another_module(tmp_path: Path) -> None:
    (tmp_path / "part.py").write_text("SAID = 1\n", encoding="utf-8")
    loader = found("polycnc.part", tmp_path).loader
    with pytest.raises(ImportError, match="cannot handle"):
        loader.get_code("polycnc.other")  # type: ignore[union-attr]


def test_where_it_stands(monkeypatch: pytest.MonkeyPatch) -> None:
    other = object()
    monkeypatch.setattr(sys, "meta_path", [other, *(each for each in sys.meta_path if each is not finder)])
    usual = [*sys.meta_path]
    finder.install()
    finder.install()
    at = sys.meta_path.index(finder)
    assert sys.meta_path[:at] + sys.meta_path[at + 1 :] == usual
    assert sys.meta_path[at + 1].__module__ == "_frozen_importlib"
    assert sys.meta_path[0] is other


# ---- whole processes -------------------------------------------------------------------------------------------


def printed(folder: Path, code: str, *words: str, **environment: str) -> str:
    """What a fresh interpreter prints that finds packages in a folder."""
    unwanted = {"PYTHONDONTWRITEBYTECODE", "PYTHONPYCACHEPREFIX", "PYTHONOPTIMIZE"}
    inherited = {name: value for name, value in os.environ.items() if name not in unwanted}
    done = subprocess.run(
        [sys.executable, *words, "-c", code],
        cwd=folder,
        env={**inherited, "PYTHONPATH": str(folder), **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


#: A package that uses the finder.
INSTALLED = "from polycnc import finder\nfinder.install()\n"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A folder with a package `polycnc` of few modules."""
    folder = tmp_path / "polycnc"
    (folder / "inner").mkdir(parents=True)
    for name in ("__init__", "inner.__init__"):
        (folder / f"{name.replace('.', '/')}.py").write_text('"""A package."""\n', encoding="utf-8")
    copy(SOURCE / "finder.py", folder)
    for name in ("part", "inner.part"):
        (folder / f"{name.replace('.', '/')}.py").write_text(
            "class Thing:\n    pass\n\n\ndef fail():\n    raise ValueError('failed')\n", encoding="utf-8"
        )
    (folder / "broken.py").write_text("1 / 0\n", encoding="utf-8")
    (folder / "inner" / "data.txt").write_text("data", encoding="utf-8")
    return tmp_path


def test_what_the_library_does_with_modules_works(package: Path) -> None:
    code = f"""{INSTALLED}
import importlib, importlib.resources, inspect, pickle, pkgutil, traceback
import polycnc.inner.part as part
assert type(part.__loader__).__module__ == "polycnc.finder", part.__loader__
first = part.Thing
assert importlib.reload(part) is part and part.Thing is not first
assert importlib.resources.files("polycnc.inner").joinpath("data.txt").read_text() == "data"
print(sorted(each.name for each in pkgutil.walk_packages(["polycnc"], "polycnc.", onerror=lambda name: None)))
assert inspect.getsource(part.Thing) == "class Thing:\\n    pass\\n"
assert type(pickle.loads(pickle.dumps(part.Thing()))) is part.Thing
try: part.fail()
except ValueError as error: print(traceback.format_exc().splitlines()[-2].strip())
assert importlib.util.find_spec("polycnc.inner.part") is part.__spec__
assert importlib.util.find_spec("polycnc.nothing") is None
print(part.__spec__, part)
"""
    modules = [f"polycnc.{each}" for each in ("broken", "finder", "inner", "inner.part", "part")]
    lines = printed(package, code).splitlines()
    assert lines[:2] == [repr(modules), "raise ValueError('failed')"]
    file = package / "polycnc" / "inner" / "part.py"
    assert lines[2].startswith("ModuleSpec(name='polycnc.inner.part'")
    assert lines[2].endswith(f"<module 'polycnc.inner.part' from {str(file)!r}>")


@pytest.mark.parametrize("name", ["nothing", "inner.nothing", "nothing.part", "part.nothing"])
def test_a_module_that_is_not_there_is_told_as_by_the_library(package: Path, name: str) -> None:
    code = f"""
try: import polycnc.{name}
except ModuleNotFoundError as error: print(error, error.name, error.path)"""
    assert printed(package, INSTALLED + code) == printed(package, code) != ""


@pytest.mark.parametrize("name", ["broken", "inner"])
def test_the_way_to_an_error_shows_nothing_of_the_finder(package: Path, name: str) -> None:
    (package / "polycnc" / "inner" / "__init__.py").write_text("import polycnc.broken\n", encoding="utf-8")
    code = f"""import traceback
try: import polycnc.{name}
except ZeroDivisionError as error: print([each.filename for each in traceback.extract_tb(error.__traceback__)])"""
    files = [str(package / "polycnc" / "broken.py")]
    if name == "inner":
        files.insert(0, str(package / "polycnc" / "inner" / "__init__.py"))
    for _ in range(2):  # without byte code and with it
        shown = eval(printed(package, INSTALLED + code))
        assert [each for each in shown if not each.startswith("<frozen")] == ["<string>", *files]


def test_a_mistake_in_a_source_is_told_as_by_the_library(package: Path) -> None:
    (package / "polycnc" / "wrong.py").write_text("a b\n", encoding="utf-8")
    code = """
try: import polycnc.wrong
except SyntaxError as error: print(error.filename, error.lineno, error.msg)"""
    assert printed(package, INSTALLED + code) == printed(package, code) != ""


@pytest.mark.parametrize(
    ("words", "environment", "ending"),
    [
        ([], {}, ""),
        (["-O"], {}, ".opt-1"),
        (["-OO"], {}, ".opt-2"),
        (["-B"], {}, None),
        ([], {"PYTHONDONTWRITEBYTECODE": "1"}, None),
    ],
)
def test_byte_code_lies_where_the_library_puts_it(
    package: Path, words: list[str], environment: dict[str, str], ending: str | None
) -> None:
    code = f"{INSTALLED}import sys, polycnc.part as part\nassert type(part.__loader__).__module__ == finder.__name__"
    for _ in range(2):
        printed(package, code, *words, **environment)
    cached = {path.name for path in (package / "polycnc" / "__pycache__").glob("part.*")}
    assert cached == (set() if ending is None else {f"part.{sys.implementation.cache_tag}{ending}.pyc"})


def test_byte_code_may_lie_elsewhere(package: Path) -> None:
    for _ in range(2):
        printed(package, f"{INSTALLED}import polycnc.part", PYTHONPYCACHEPREFIX=str(package / "cache"))
    assert len([*(package / "cache").rglob("part.*.pyc")]) == 1
    assert not (package / "polycnc" / "__pycache__").exists()


def test_a_package_in_an_archive_is_left_to_the_library(package: Path, tmp_path: Path) -> None:
    archive = tmp_path / "archive.zip"
    with zipfile.ZipFile(archive, "w") as file:
        for path in (package / "polycnc").rglob("*.py"):
            file.write(path, path.relative_to(package))
    code = f"import sys\nsys.path.insert(0, {str(archive)!r})\n{INSTALLED}"
    code += "import polycnc.inner.part as part\nprint(type(part.__loader__).__name__)"
    assert printed(tmp_path, code) == "zipimporter"


def test_threads_that_import_at_the_same_time_get_one_module(package: Path) -> None:
    code = f"""{INSTALLED}
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
names = ["polycnc.inner.part", "polycnc.part", "polycnc.inner"] * 20
with ThreadPoolExecutor(8) as pool: found = [*pool.map(import_module, names)]
print(len({{id(each) for each in found}}))
"""
    assert printed(package, code) == "3"


def test_the_command_line_uses_it(tmp_path: Path) -> None:
    (tmp_path / "part.nc").write_text("O1\nG90 G0 X1.\nM30\n", encoding="utf-8")
    code = """import atexit, runpy, sys
def tell():
    other = {name for name, module in sys.modules.items()
             if name.startswith("polycnc") and type(module.__spec__.loader).__module__ != "polycnc.finder"}
    print(*sorted(other))
sys.argv = ["polycnc", "run", "part.nc", "--control", "fanuc-m"]
try: runpy.run_module("polycnc", run_name="__main__", alter_sys=True)
except SystemExit: tell()
"""
    # The finder is there when the command line begins; `main` of a caller's own changes nothing for him.
    expected = "polycnc polycnc.cli polycnc.finder"
    assert printed(tmp_path, code, PYTHONPATH=str(SOURCE.parent)).splitlines()[-1] == expected
    code = "import sys\nfrom polycnc.cli import main\ntry: main(['run', 'part.nc', '--control', 'fanuc-m'])\n"
    code += "except SystemExit: print([each for each in sys.meta_path if 'polycnc' in repr(each)])"
    assert printed(tmp_path, code, PYTHONPATH=str(SOURCE.parent)).splitlines()[-1] == "[]"
