"""The cases of this folder; a process reads each file once, however many tests look at it."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from polycnc.cases.features import case_files
from polycnc.cases.reading import read_cases

HERE = Path(__file__).parent
FILES = case_files(HERE)


@cache
def cases_in(path: Path) -> tuple[Any, ...]:
    """The cases of a file, as plain values that nobody changes."""
    return tuple(read_cases(path))
