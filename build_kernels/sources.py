"""The sources whose words and numbers are in the machine code of a library."""

from __future__ import annotations

import ast
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from polycnc.kernels.library import Library

#: How classes are written: no number in machine code comes from there.
_MADE_BY = "polycnc.deferred."


def contents(library: Library) -> dict[str, bytes]:
    """By its path from the root, each file of the modules of a library, and of those that they import names from."""
    found: set[Path] = set()
    left = [module.__name__ for module in library.modules]
    root = Path(library.root)
    while left:
        name = left.pop()
        file = Path(getattr(sys.modules[name], "__file__", None) or "")
        if file in found or not file.is_relative_to(root) or name.startswith(_MADE_BY):
            continue
        found.add(file)
        left += _imported(ast.parse(file.read_bytes()))
    return {file.relative_to(root).as_posix(): file.read_bytes() for file in sorted(found)}


def _imported(tree: ast.Module) -> Iterator[str]:
    """Modules that a module imports, or imports names from, when it runs."""
    for node in tree.body:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in sys.modules)
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                within = f"{node.module}.{alias.name}"
                yield within if within in sys.modules else str(node.module)
