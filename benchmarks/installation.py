"""What the default install takes on disk, and how long its very first run takes."""

from __future__ import annotations

import compileall
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

from benchmarks.bulk import write_program
from benchmarks.measure import Figure, polycnc, process_time

SIZE_LIMIT_MB = 40.0
FIRST_RUN_LIMIT = 1.3


def first_run() -> Iterator[Figure]:
    """1,000,000 G1 with cycle time by a package as an installation leaves it, and once more."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = write_program(folder)
        compileall.compile_dir(_installed(folder / "installed"), quiet=2)  # as pip does, and `make demo`
        command = polycnc("run", ours)
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
    total = (own + sum(map(size_of, needed(distribution("polycnc").requires or ())))) / 1e6
    yield Figure("installed size", f"{total:.1f} MB of files, limit {SIZE_LIMIT_MB:g}", SIZE_LIMIT_MB / total)


def needed(requirements: Iterable[str]) -> set[str]:
    """Names of the distributions that these requirements name, and of all that those need without extras."""
    from packaging.requirements import Requirement

    names: set[str] = set()
    ahead = [Requirement(line) for line in requirements]
    while ahead:
        requirement = ahead.pop()
        if requirement.marker is not None and not requirement.marker.evaluate({"extra": ""}):
            continue
        if requirement.name not in names:
            names.add(requirement.name)
            ahead += map(Requirement, distribution(requirement.name).requires or ())
    return names


def size_of(name: str) -> int:
    """Bytes of the files of a distribution."""
    found: Distribution = distribution(name)
    return sum(
        path.stat().st_size
        for file in found.files or ()
        if (path := Path(str(found.locate_file(file)))).is_file()
    )
