"""No file, function or folder is longer than one reads at a sitting."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import polycnc

SOURCE = Path(polycnc.__file__).parent
#: A file has 600 lines at most, a function 60 beside what its docstring tells, a folder 16 modules.
MOST_LINES, MOST_LINES_OF_FUNCTION, MOST_MODULES = 600, 60, 16
#: And so many with it.
MOST_LINES_IN_ALL = 65
#: Kernels that lay a row out in pieces: one loop over many numbers, which parts would hand to each other.
LONGER = {"lay_straight", "lay_arc"}
FILES = sorted(SOURCE.rglob("*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(SOURCE).as_posix())
def test_files_and_functions_are_short(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.count("\n") <= MOST_LINES
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    long = {
        node.name
        for node in functions
        if _lines(node) > MOST_LINES_IN_ALL or _lines(node) - _told(node) > MOST_LINES_OF_FUNCTION
    }
    assert long <= LONGER


def _lines(node: ast.stmt) -> int:
    return (node.end_lineno or 0) - node.lineno + 1


def _told(function: ast.FunctionDef) -> int:
    """Lines of a function's docstring."""
    return _lines(function.body[0]) if ast.get_docstring(function) is not None else 0


def test_folders_have_few_modules() -> None:
    counts: dict[Path, int] = {}
    for path in FILES:
        counts[path.parent] = counts.get(path.parent, 0) + (path.stem != "__init__")
    assert max(counts.values()) <= MOST_MODULES
