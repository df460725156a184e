"""Imports run downwards, and small runs load no heavy library."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import polycnc
from polycnc.language.bulk.compiled import LIBRARY as BULK
from polycnc.motion.compiled import LIBRARY as PLANNING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

SOURCE = Path(polycnc.__file__).parent
#: From the ground up: a folder (or module) imports only those that stand before it.
LAYERS = (
    "version",
    "finder",
    "deferred",
    "kernels",
    "parquet",
    "messages",
    "geometry",
    "machine",
    "transformation",
    "toolpath",
    "program",
    "memory",
    "channel",
    "language",
    "cycles",
    "compensation",
    "control",
    "motion",
    "mainrun",
    "view",
    "panel",
    "session",
    "interchange",
    "cases",
    "cli",
)
#: What only some programs need.
NOT_AT_START = {
    "polycnc.compensation.cutter", "polycnc.language.bulk.scanner",
    "polycnc.transformation.couplings.coupled", "polycnc.transformation.planes.tilted",
    "ast", "click", "datetime", "tomllib", "tqdm",
}  # fmt: skip
#: Functions of each control that a program of a few moves does not use.
NOT_USED = {
    "fanuc-m": (
        "word_address.transformations.tilted_plane",
        "word_address.macro_b.macro_calls",
        "fanuc.milling.five_axes",
    ),
    "meldas-m": (
        "word_address.transformations.tilted_plane",
        "word_address.motion.nurbs",
        "meldas.tool_axis_length",
    ),
    "syntec-mill": ("syntec.five_axes.tip_control", "syntec.macros.functions", "word_address.motion.nurbs"),
    "fanuc-0i-tf": (
        "fanuc.lathe.cycles.repetitive",
        "fanuc.lathe.cycles.shape",
        "fanuc.lathe.tools.nose_radius",
    ),
    "sinumerik-840d": (
        "sinumerik.variables.registry",
        "sinumerik.block.procedures",
        "sinumerik.tools.stages",
    ),
}
HEAVY = {"numpy", "numba", "pyarrow", "pydantic", "asyncua", "pygls", "nicegui"}
MODULES = sorted(SOURCE.rglob("*.py"))
FOLDERS = [path.parent for path in MODULES if path.name == "__init__.py" and path.parent != SOURCE]


def layer_of(module: str) -> str | None:
    """The layer of `polycnc.machine.model`; None for the package itself and what lies outside of it."""
    parts = module.split(".")
    return parts[1] if parts[0] == "polycnc" and len(parts) > 1 else None


def imports_of(path: Path) -> set[str]:
    """Full names of what a module imports, in functions and for type checkers too."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: imports are absolute"
            module = node.module or ""
            found |= {f"polycnc.{alias.name}" for alias in node.names} if module == "polycnc" else {module}
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_imports_run_downwards(path: Path) -> None:
    own = path.relative_to(SOURCE).parts[0].removesuffix(".py")
    if own in ("__init__", "__main__"):
        return
    assert own in LAYERS, f"{own} has no place in the order of layers"
    for module in imports_of(path):
        layer = layer_of(module)
        if layer is None:
            continue
        if layer in polycnc.__all__:  # what the package itself gives stands above all but the commands
            assert own == LAYERS[-1], f"{own} imports upwards: {module}"
            continue
        assert layer in LAYERS, f"{path.name} imports {module}"
        assert LAYERS.index(layer) <= LAYERS.index(own), f"{own} imports upwards: {module}"


def imported_at_once(path: Path) -> set[str]:
    """Full names of the modules of polycnc that a module needs to be there before it is."""
    return imported_from(ast.parse(path.read_text(encoding="utf-8")).body)


def imported_from(nodes: Iterable[ast.AST]) -> set[str]:
    """Full names of what statements import names from, and of these names."""
    found: set[str] = set()
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


def module_names() -> dict[str, Path]:
    """Every module by its full name."""
    return {".".join(("polycnc", *path.relative_to(SOURCE).with_suffix("").parts)): path for path in MODULES}


def test_no_module_waits_for_itself() -> None:
    names = module_names()
    open_imports = {name: imported_at_once(path) & names.keys() - {name} for name, path in names.items()}
    while free := [name for name, needed in open_imports.items() if not needed & open_imports.keys()]:
        for name in free:
            del open_imports[name]
    assert open_imports == {}


#: Folders where modules know each other's types in circles: a channel and what stands in it, compilers and the
#: statements that they read, a memory and the channel that it is in. No other folder is to be among them.
CIRCLES = (
    "channel", "control.fanuc.lathe", "control.syntec", "control.word_address", "language.sinumerik",
)  # fmt: skip


def test_types_form_no_circles_but_where_that_is_known() -> None:
    names = module_names()
    needs = {
        name: imported_from(ast.walk(ast.parse(path.read_text(encoding="utf-8")))) & names.keys() - {name}
        for name, path in names.items()
    }
    in_circles = {name for name in names if name in reached_from(name, needs)}
    known = tuple(f"polycnc.{folder}." for folder in CIRCLES)
    assert {name for name in in_circles if not name.startswith(known)} == set()
    unknown = {folder for folder in known if not any(name.startswith(folder) for name in in_circles)}
    assert unknown == set(), "these are free of circles now"


def reached_from(start: str, needs: Mapping[str, set[str]]) -> set[str]:
    """All that a module imports, and what that imports, and so on."""
    reached: set[str] = set()
    ahead = [start]
    while ahead:
        new = needs[ahead.pop()] - reached
        reached |= new
        ahead.extend(new)
    return reached


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.relative_to(SOURCE).as_posix())
def test_the_head_of_a_folder_says_what_every_module_in_it_is_for(folder: Path) -> None:
    head = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    modules = {path.stem for path in folder.glob("*.py")} - {"__init__"}
    assert modules <= set(re.findall(r"\w+", head))


def loaded_by(code: str, folder: Path) -> set[str]:
    """Names of all modules that some code loads in a fresh interpreter, which has loaded `re` as start scripts do."""
    probe = f"import re, sys\nbefore = {{*sys.modules}}\n{code}\nprint(*({{*sys.modules}} - before))"
    done = subprocess.run(
        [sys.executable, "-c", probe], cwd=folder, capture_output=True, text=True, timeout=120, check=True
    )
    return set(done.stdout.splitlines()[-1].split())


def test_importing_the_package_loads_nothing_of_it(tmp_path: Path) -> None:
    probe = "import polycnc\nassert not [name for name in sys.modules if name.startswith('polycnc.')]"
    assert "polycnc" in loaded_by(probe, tmp_path)


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_small_run_loads_no_heavy_library(tmp_path: Path, command: str) -> None:
    (tmp_path / "part.nc").write_text("O1\nG90 G0 X1.\nG2 X2. R5. F100.\nM30\n", encoding="utf-8")
    words = [command, "part.nc", "--control", "fanuc-m"]
    probe = (
        f"from polycnc.cli import main\ntry: main({words!r})\nexcept SystemExit as left: assert not left.code"
    )
    assert loaded_by(probe, tmp_path) & (HEAVY | NOT_AT_START) == set()


#: What a start does without: a tenth of a short run, and more. `re`, which start scripts load, brings what it needs.
NOT_OF_LIBRARY = {
    "ast", "contextlib", "copy", "ctypes", "dataclasses", "datetime", "fnmatch", "hashlib", "importlib", "inspect",
    "ipaddress", "ntpath", "pathlib", "random", "signal", "string", "struct", "tempfile", "threading", "tomllib",
    "traceback", "urllib", "warnings",
}  # fmt: skip


@pytest.mark.parametrize(
    ("options", "call"),
    [
        ("fanuc-m", "M98 P7"),
        ("fanuc-m --no-time", "M98 P7"),
        ("fanuc-m --machine mill3 --encoding utf-8", "#1=2*[3+4]"),
        ("fanuc-0i-tf", "M98 P7"),
        ("meldas-m", "M98 P7"),
        ("syntec-mill", "M98 P7"),
        ("sinumerik-840d", "SUB"),
    ],
)
def test_a_start_loads_little_of_the_library(tmp_path: Path, options: str, call: str) -> None:
    (tmp_path / "part.nc").write_text(f"G90 G0 X1.\n{call}\nM30\n", encoding="utf-8")
    for name, end in (("O0007.nc", "M99"), ("SUB.SPF", "M17")):
        (tmp_path / name).write_text(f"G1 X2. F100.\n{end}\n", encoding="utf-8")
    words = ["polycnc", "run", "part.nc", "--control", *options.split()]
    main = "from polycnc.cli import main\ntry: main()\nexcept SystemExit as left: assert not left.code"
    loaded = loaded_by(f"sys.argv = {words!r}\n{main}", tmp_path)
    of_typing = {"contextlib", "warnings"} if "typing" in loaded else set()
    assert loaded & NOT_OF_LIBRARY <= of_typing


@pytest.mark.parametrize("control_id", NOT_USED)
def test_a_control_loads_no_function_that_a_program_does_not_use(tmp_path: Path, control_id: str) -> None:
    (tmp_path / "part.nc").write_text("G90 G0 X1.\nZ5.\nG1 X2. F100.\nM30\n", encoding="utf-8")
    words = ["run", "part.nc", "--control", control_id]
    probe = (
        f"from polycnc.cli import main\ntry: main({words!r})\nexcept SystemExit as left: assert not left.code"
    )
    unused = {f"polycnc.control.{name}" for name in NOT_USED[control_id]} | {"polycnc.compensation.corner"}
    assert loaded_by(probe, tmp_path) & (HEAVY | unused) == set()


#: Modules with nothing but kernels.
KERNELS = (
    "language.bulk.kernels", "language.bulk.moves", "language.bulk.numerals", "language.bulk.formulas.reading",
    "language.bulk.routines.flow", "language.bulk.reach", "motion.kernels.lay", "motion.kernels.speeds",
    "motion.kernels.chords", "motion.kernels.arcs", "motion.third_order.laying.rows",
)  # fmt: skip
#: What a program of straight moves does not use of the scanner.
UNUSED = ("language.bulk.guard", "language.bulk.staged", "language.bulk.routines.running")


@pytest.mark.skipif(BULK.lack is not None or PLANNING.lack is not None, reason="needs compiled kernels")
def test_where_kernels_are_compiled_their_modules_are_not_loaded(tmp_path: Path) -> None:
    moves = "".join(f"X{i}. Y{i % 7}.\n" for i in range(600))
    (tmp_path / "part.nc").write_text(f"O1\nG90 G1 F500.\n{moves}M30\n", encoding="utf-8")
    words = ["run", "part.nc", "--control", "fanuc-m"]
    probe = (
        f"from polycnc.cli import main\ntry: main({words!r})\nexcept SystemExit as left: assert not left.code"
    )
    loaded = loaded_by(probe, tmp_path)
    assert {"polycnc.language.bulk.scanner", "polycnc.motion.planner"} <= loaded
    assert [name for name in (*KERNELS, *UNUSED) if f"polycnc.{name}" in loaded] == []
