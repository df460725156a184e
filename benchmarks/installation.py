"""What the default install takes on disk, and how long its very first run takes."""

from __future__ import annotations

import compileall
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

from benchmarks.bulk import write_program
from benchmarks.measure import Figure, process_time

SIZE_LIMIT_MIB = 40.0
FIRST_RUN_LIMIT = 1.3


def first_run() -> Iterator[Figure]:
    """1,000,000 G1 with cycle time by a package as an installation leaves it, and once more."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = write_program(folder)
        compileall.compile_dir(_installed(folder / "installed"), quiet=2)  # as pip does, and `make demo`
        command = [sys.executable, "-m", "polycnc", "run", str(ours), "--control", "fanuc-m"]
        before = os.environ.get("PYTHONPATH")
        os.environ["PYTHONPATH"] = str(folder / "installed")
        try:
            first, second = process_time(command, 1), process_time(command, 1)
        finally:
            os.environ.pop("PYTHONPATH") if before is None else os.environ.update(PYTHONPATH=before)
    said = f"{first:.2f} s, the second {second:.2f} s: {first / second:.2f} times, limit {FIRST_RUN_LIMIT}"
    yield Figure("first run of 1,000,000 G1 with cycle time", said, FIRST_RUN_LIMIT * second / first)


def _installed(folder: Path) -> Path:
    """The package without byte code in a folder of its own."""
    import polycnc

    ignored = shutil.ignore_patterns("__pycache__")
    return Path(shutil.copytree(Path(polycnc.__file__).parent, folder / "polycnc", ignore=ignored))


def size() -> Iterator[Figure]:
    """Files of polycnc and of what it needs, with byte code, beside Python and its installer."""
    with tempfile.TemporaryDirectory() as name:
        package = _installed(Path(name))
        compileall.compile_dir(package, quiet=2)
        own = sum(file.stat().st_size for file in package.rglob("*") if file.is_file())
    total = (own + sum(_bytes(each) for each in _needed("polycnc") - {"polycnc"})) / 2**20
    yield Figure(
        "installed size", f"{total:.1f} MiB of files, limit {SIZE_LIMIT_MIB:g}", SIZE_LIMIT_MIB / total
    )


def _needed(name: str) -> set[str]:
    """Names of a distribution and of all that it needs without extras."""
    from packaging.requirements import Requirement

    needed: set[str] = set()
    open_names = [name]
    while open_names:
        name = open_names.pop()
        if name not in needed:
            needed.add(name)
            for line in distribution(name).requires or ():
                requirement = Requirement(line)
                if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
                    open_names.append(requirement.name)
    return needed


def _bytes(name: str) -> int:
    found: Distribution = distribution(name)
    return sum(
        path.stat().st_size
        for file in found.files or ()
        if (path := Path(str(found.locate_file(file)))).is_file()
    )
