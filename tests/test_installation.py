"""What is installed beside polycnc by default stays small: all of it together takes less than 40 MB."""

from __future__ import annotations

import tomllib
from pathlib import Path

from benchmarks.installation import needed, size_of

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
#: Of 40 MB; polycnc itself takes the rest (`make bench` measures both).
MOST_BYTES = 16_000_000
#: Libraries that take more than they give here.
HEAVY = {"numpy", "numba", "pyarrow", "rich", "Pygments", "pygments", "nicegui"}


def default() -> set[str]:
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    return needed(project["dependencies"])


def test_libraries_of_the_default_installation_take_little() -> None:
    names = default()
    assert names & HEAVY == set()
    assert sum(map(size_of, names)) <= MOST_BYTES
